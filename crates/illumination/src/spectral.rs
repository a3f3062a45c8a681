//! What lanes are on the scale of wavelengths, where a model must know.

use illuminant_sampling::{Basis, Lanes};
use illuminant_spectrum::SpectralRange;
use std::f64::consts::TAU;
use std::ops::Range;

/// The wavelength for lanes that are colours: the middle of what the eye sees (book 2.3.2.3 uses one for all).
const MIDDLE_NM: f64 = 580.0;

/// The wavelengths of the lanes of a pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectral<const N: usize> {
    /// Wavelength of every lane, nm; infinite in padded ones.
    pub wavelength_nm: Lanes<N>,
    /// The first and last wavelength of the range, nm.
    pub ends_nm: [f64; 2],
}

impl<const N: usize> Spectral<N> {
    /// The wavelengths of some samples of a basis.
    #[must_use]
    pub fn new(basis: &dyn Basis, samples: Range<usize>, range: SpectralRange) -> Self {
        let mut wavelength_nm = Lanes::splat(f32::INFINITY);
        for (lane, sample) in samples.enumerate() {
            let nm = if basis.is_spectral() { basis.wavelength_nm(sample) } else { MIDDLE_NM };
            wavelength_nm[lane] = nm as f32;
        }
        let ends = [f64::from(range.min_nm), f64::from(range.max_nm)];
        Self { wavelength_nm, ends_nm: if basis.is_spectral() { ends } else { [MIDDLE_NM; 2] } }
    }

    /// One wavelength in all lanes.
    #[must_use]
    pub fn monochromatic(nm: f64) -> Self {
        Self { wavelength_nm: Lanes::splat(nm as f32), ends_nm: [nm; 2] }
    }

    /// 2πσ/λ of a height σ in every lane.
    pub(crate) fn phase(&self, sigma_nm: f64) -> Lanes<N> {
        self.wavelength_nm.map(|nm| (TAU * sigma_nm) as f32 / nm)
    }

    /// The same at both ends of the range.
    pub(crate) fn end_phases(&self, sigma_nm: f64) -> [f32; 2] {
        self.ends_nm.map(|nm| (TAU * sigma_nm / nm) as f32)
    }
}
