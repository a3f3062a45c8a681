//! `1nm`: every wavelength of the range, the reference that the others are measured against.

use crate::{Basis, Role, ToXyz};
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, SpectralRange};

/// One sample for each nm of the range.
#[derive(Clone, Debug)]
pub struct OneNanometre {
    range: SpectralRange,
}

impl OneNanometre {
    /// The reference over a range.
    #[must_use]
    pub fn new(range: SpectralRange) -> Self {
        Self { range }
    }
}

impl Basis for OneNanometre {
    fn len(&self) -> usize {
        self.range.len()
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        f64::from(self.range.min_nm) + sample as f64
    }

    fn reduce(&self, curve: &Curve, _role: Role) -> Vec<f64> {
        curve.tabulate(self.range)
    }

    fn to_xyz(&self, _lamp: usize) -> ToXyz {
        let observer = Observer::cie_1931_2deg();
        observer
            .matching
            .each_ref()
            .map(|m| self.range.wavelengths().map(|w| LUMINOUS_EFFICACY * m.at(w)).collect())
    }
}
