//! The range of wavelengths over which light is followed.

use serde::{Deserialize, Serialize};

/// A range of wavelengths in nm, both ends included, walked in steps of 1 nm.
///
/// The default is the 380–780 nm of the book's code (R1.8); any other range serves as well, for example
/// infrared shown in pseudo-colour.
///
/// ```
/// use illuminant_spectrum::SpectralRange;
/// let visible = SpectralRange::default();
/// assert_eq!(visible.len(), 401);
/// assert_eq!(visible.wavelengths().last(), Some(780.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "[f64; 2]", into = "[u32; 2]")]
pub struct SpectralRange {
    /// The shortest wavelength, nm.
    pub min_nm: u32,
    /// The longest wavelength, nm.
    pub max_nm: u32,
}

impl Default for SpectralRange {
    fn default() -> Self {
        Self { min_nm: 380, max_nm: 780 }
    }
}

impl From<[u32; 2]> for SpectralRange {
    fn from([min_nm, max_nm]: [u32; 2]) -> Self {
        Self { min_nm, max_nm: max_nm.max(min_nm) }
    }
}

impl TryFrom<[f64; 2]> for SpectralRange {
    type Error = String;

    fn try_from([min, max]: [f64; 2]) -> Result<Self, String> {
        let whole = |v: f64| v.fract() == 0.0 && (1.0..=1e6).contains(&v);
        if whole(min) && whole(max) && min < max {
            Ok(Self { min_nm: min as u32, max_nm: max as u32 })
        } else {
            Err(format!("a range runs from one whole nm to a larger one, and {min} to {max} does not"))
        }
    }
}

impl From<SpectralRange> for [u32; 2] {
    fn from(range: SpectralRange) -> Self {
        [range.min_nm, range.max_nm]
    }
}

impl SpectralRange {
    /// How many wavelengths 1 nm apart the range holds.
    #[must_use]
    #[allow(clippy::len_without_is_empty)] // a range holds at least one wavelength
    pub fn len(self) -> usize {
        (self.max_nm - self.min_nm) as usize + 1
    }

    /// The width of the range in nm: the number of its 1 nm cells.
    #[must_use]
    pub fn width_nm(self) -> f64 {
        self.len() as f64
    }

    /// The wavelengths of the range, in steps of 1 nm.
    pub fn wavelengths(self) -> impl ExactSizeIterator<Item = f64> + Clone {
        (0..self.len()).map(move |i| f64::from(self.min_nm) + i as f64)
    }
}
