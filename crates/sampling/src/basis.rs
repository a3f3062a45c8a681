//! What gives lanes their meaning.

use crate::{OneNanometre, Uniform};
use illuminant_spectrum::{Curve, SpectralRange};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

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

    /// The values of a curve in every sample.
    fn reduce(&self, curve: &Curve, role: Role) -> Vec<f64>;

    /// The map to XYZ for light that left the lamp with this number; a basis that is not fitted to its lamps
    /// has the same map for all.
    fn to_xyz(&self, lamp: usize) -> ToXyz;
}

/// A spectral sampling by name, before it knows its range and scene.
///
/// ```
/// use illuminant_sampling::SpectralSampling;
/// let sampling: SpectralSampling = "uniform:8".parse().unwrap();
/// assert_eq!(sampling.to_string(), "uniform:8");
/// assert!("uniform:99".parse::<SpectralSampling>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpectralSampling {
    /// N wavelengths, evenly spaced.
    Uniform(usize),
    /// Every nm of the range: the reference.
    OneNanometre,
}

/// Why a name is no spectral sampling.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum SamplingError {
    /// The name is unknown.
    #[error("no spectral sampling {0:?}; known are uniform:N (N from 1 to 32) and 1nm")]
    Unknown(String),
    /// The count is out of range.
    #[error("uniform:N takes a whole number N from 1 to 32, not {0:?}")]
    Count(String),
}

impl FromStr for SpectralSampling {
    type Err = SamplingError;

    fn from_str(name: &str) -> Result<Self, SamplingError> {
        match name.split_once(':') {
            Some(("uniform", count)) => match count.parse() {
                Ok(n) if (1..=32).contains(&n) => Ok(Self::Uniform(n)),
                _ => Err(SamplingError::Count(count.into())),
            },
            None if name == "1nm" => Ok(Self::OneNanometre),
            _ => Err(SamplingError::Unknown(name.into())),
        }
    }
}

impl fmt::Display for SpectralSampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform(n) => write!(f, "uniform:{n}"),
            Self::OneNanometre => f.write_str("1nm"),
        }
    }
}

impl SpectralSampling {
    /// The basis over a range of wavelengths.
    #[must_use]
    pub fn basis(self, range: SpectralRange) -> Box<dyn Basis> {
        match self {
            Self::Uniform(n) => Box::new(Uniform::new(n, range)),
            Self::OneNanometre => Box::new(OneNanometre::new(range)),
        }
    }
}
