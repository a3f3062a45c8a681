//! What gives lanes their meaning.

use illuminant_color::Triple;
use illuminant_spectrum::Curve;
use std::fmt;

/// What a curve stands for when it is reduced to lane values.
///
/// Where lanes are wavelengths every role is a look-up; for boxes, RGB or XYZ the role decides how the curve is
/// averaged (book 3.5.1 and 3.5.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// A fraction that multiplies light: reflectance, transmittance.
    Fraction,
    /// Light itself, W·sr⁻¹·m⁻²·nm⁻¹.
    Emission,
    /// A property of the material at a wavelength: n, k, absorption coefficient.
    Constant,
}

/// The map from samples to absolute XYZ: three rows of one weight a sample.
pub type ToXyz = [Vec<f64>; 3];

/// The XYZ that a map makes of samples: the sum of weight times sample in each row.
///
/// ```
/// let map = [vec![1.0, 0.0], vec![0.5, 0.5], vec![0.0, 2.0]];
/// assert_eq!(illuminant_sampling::xyz_by(&map, &[2.0, 4.0]), [2.0, 3.0, 8.0]);
/// ```
#[must_use]
pub fn xyz_by(map: &ToXyz, samples: &[f64]) -> Triple {
    map.each_ref().map(|row| row.iter().zip(samples).map(|(w, v)| w * v).sum())
}

/// A spectral sampling over one range: a list of samples, split into passes of at most 32 lanes.
///
/// A path is followed once for each pass, over the same vertices, because every decision along it is taken
/// without looking at the lanes.
pub trait Basis: fmt::Debug + Send + Sync {
    /// How many samples there are in all.
    fn len(&self) -> usize;

    /// Whether there is no sample: never, but clippy asks.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The wavelength in nm that stands for a sample.
    fn wavelength_nm(&self, sample: usize) -> f64;

    /// Whether samples belong to wavelengths. Where they are colours instead, a conductor is the colour that it has at
    /// normal incidence, and nothing disperses.
    fn is_spectral(&self) -> bool {
        true
    }

    /// The values of a curve in every sample.
    fn reduce(&self, curve: &Curve, role: Role) -> Vec<f64>;

    /// The map to XYZ for light that left the lamp with this number; a basis that is not fitted to its lamps
    /// has the same map for all.
    fn to_xyz(&self, lamp: usize) -> ToXyz;
}
