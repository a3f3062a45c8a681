//! `fitted:N`: N wavelengths and weights chosen for the lamps and materials at hand.

use crate::fit::fit;
use crate::{Basis, Products, Role, ToXyz};
use illuminant_spectrum::{Curve, SpectralRange};

/// N wavelengths, and for each lamp the weights to XYZ that make the colours of the scene's products least wrong.
///
/// Reflectances, n and k are taken at the wavelengths. The light of a lamp in a lane is its mean over the lane's band
/// (from half way to the neighbour on one side to half way on the other), so that no line of its spectrum is lost; what
/// it is worth in XYZ stands in the weights of that lamp. The bare lamp, and with it every grey under it, is exact.
/// Weights are not negative, so neither is any colour.
#[derive(Clone, Debug)]
pub struct Fitted {
    range: SpectralRange,
    wavelengths_nm: Vec<f64>,
    /// Whether the lamps share one map: then the light of a lane is that at its wavelength.
    one_map: bool,
    /// For each lamp that is here already, what its light in each lane is worth.
    maps: Vec<ToXyz>,
}

/// The light of a lane is at least this fraction of the lamp's mean, so that a weight can be carried by it.
const DIMMEST: f64 = 1e-3;

impl Fitted {
    /// The best N wavelengths for these products; `None` where there is nothing to fit: no lamp gives light that the
    /// observer sees, or the range has fewer wavelengths than N.
    #[must_use]
    pub fn new(n: usize, range: SpectralRange, products: &Products) -> Option<Self> {
        let found = fit(products, n)?;
        let first = f64::from(products.range.min_nm);
        let wavelengths_nm = found.wavelengths.iter().map(|&w| first + w as f64).collect();
        let mut fitted = Self { range, wavelengths_nm, one_map: products.one_map, maps: Vec::new() };
        fitted.maps = products
            .lamps
            .iter()
            .zip(found.weights)
            .take(products.together)
            .map(|(lamp, weights)| {
                let light = if fitted.one_map { vec![1.0; n] } else { fitted.reduce(lamp, Role::Emission) };
                let per_unit = |row: Vec<f64>| row.iter().zip(&light).map(|(v, l)| v / l).collect();
                weights.map_or_else(|| [0; 3].map(|_| vec![0.0; n]), |rows| rows.map(per_unit))
            })
            .collect();
        Some(fitted)
    }

    /// First and last nm of the band of a lane.
    fn band(&self, lane: usize) -> SpectralRange {
        let w = &self.wavelengths_nm;
        let border = |i: usize| f64::midpoint(w[i], w[i + 1]).ceil() as u32;
        let min_nm = if lane == 0 { self.range.min_nm } else { border(lane - 1) };
        let max_nm = if lane + 1 == w.len() { self.range.max_nm } else { border(lane) - 1 };
        SpectralRange { min_nm, max_nm: max_nm.max(min_nm) }
    }
}

impl Basis for Fitted {
    fn len(&self) -> usize {
        self.wavelengths_nm.len()
    }

    fn wavelength_nm(&self, sample: usize) -> f64 {
        self.wavelengths_nm[sample]
    }

    fn reduce(&self, curve: &Curve, role: Role) -> Vec<f64> {
        match role {
            Role::Fraction | Role::Constant => self.wavelengths_nm.iter().map(|&w| curve.at(w)).collect(),
            Role::Emission if self.one_map => self.wavelengths_nm.iter().map(|&w| curve.at(w)).collect(),
            Role::Emission => {
                let least = DIMMEST * curve.area(self.range) / self.range.width_nm();
                let mean = |band: SpectralRange| curve.area(band) / band.width_nm();
                (0..self.len()).map(|lane| mean(self.band(lane)).max(least)).collect()
            }
        }
    }

    fn to_xyz(&self, lamp: usize) -> ToXyz {
        self.maps[lamp].clone()
    }
}
