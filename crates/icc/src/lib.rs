//! ICC profiles of displays: primaries, white, curves and luminance as other programs read them (ICC.1:2022).
//!
//! A display with three primaries is a profile of matrix and tone curves: linear = TRC(code) for each channel, and
//! XYZ = [rXYZ gXYZ bXYZ] linear, adapted to the D50 of the profile connection space by the linear Bradford transform.
//! The tag `chad` holds that adaptation, so [`decode`] undoes it and gives the display's own white and primaries back.
//!
//! | tag | what [`encode`] writes |
//! | --- | --- |
//! | `desc`, `cprt` | the display's own description; copyright |
//! | `wtpt` | D50, as ICC.1 asks of a display |
//! | `chad` | from the native white to D50 |
//! | `rXYZ gXYZ bXYZ` | colorants, whose sum is D50 to the last bit, so that greys are neutral |
//! | `rTRC gTRC bTRC` | `para` where the curve has a formula, else `curv`; equal curves are stored once |
//! | `lumi` | cd/m² of white, when it is known |
//! | `cicp` | code points of ITU-T H.273, when they are given |
//!
//! Version 4 is the default. Version 2 is for old programs: it has no `para` and no `cicp`, so every curve that is no
//! power with an exponent of 1/256ths is sampled at [`SAMPLES`] codes. The date is fixed, so the same display gives the
//! same bytes, and version 4 carries the profile's identity (MD5).
//!
//! A display for PQ or HLG gets a `curv` of light relative to white, which every program understands, and `cicp`
//! beside it: programs that know it take the exact curve, since 16 bits relative to white leave PQ few steps in the
//! dark, and HLG's is no curve of one channel alone.
//!
//! Only profiles of matrix and curves are read. A profile that has a lookup table alone is refused: no primaries and
//! curves say what it says, and a perceptual table is not even a measurement of the display.
//!
//! Limits: numbers of a profile are s15Fixed16, so chromaticities come back within 5·10⁻⁵; table values have 16 bits.
//!
//! ```
//! use illuminant_icc::{Curve, ProfileDescription, Version, decode, encode};
//! let display = ProfileDescription {
//!     description: "My monitor".into(),
//!     copyright: "No copyright.".into(),
//!     version: Version::Four,
//!     primaries: [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]],
//!     white: [0.3127, 0.329],
//!     curves: [Curve::Gamma(2.2), Curve::Gamma(2.2), Curve::Gamma(2.2)],
//!     luminance: Some(120.0),
//!     cicp: None,
//! };
//! let back = decode(&encode(&display)?)?;
//! assert!((back.white[0] - 0.3127).abs() < 5e-5);
//! assert_eq!(back.description, "My monitor");
//! # Ok::<(), illuminant_icc::IccError>(())
//! ```

mod curve;
mod read;
mod tags;
mod text;
mod write;

pub use curve::{Curve, SAMPLES};
pub use read::decode;
pub use write::encode;

use thiserror::Error;

/// XYZ of the white of the profile connection space, D50 as the header of every profile writes it.
pub const D50: [f64; 3] = [63190.0 / 65536.0, 1.0, 54061.0 / 65536.0];

/// Which edition of the standard a profile keeps to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// ICC version 2 (2.4).
    Two,
    /// ICC version 4 (4.4).
    Four,
}

impl Version {
    /// The version of a number, 2 or 4.
    #[must_use]
    pub fn of(number: u32) -> Option<Self> {
        match number {
            2 => Some(Self::Two),
            4 => Some(Self::Four),
            _ => None,
        }
    }

    /// 2 or 4.
    #[must_use]
    pub fn number(self) -> u32 {
        match self {
            Self::Two => 2,
            Self::Four => 4,
        }
    }
}

/// A display as a profile describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileDescription {
    /// What programs show as the profile's name.
    pub description: String,
    /// Who may do what with the profile; version 2 holds ASCII only.
    pub copyright: String,
    /// Edition of the standard.
    pub version: Version,
    /// x and y of red, green and blue.
    pub primaries: [[f64; 2]; 3],
    /// x and y of white.
    pub white: [f64; 2],
    /// From code values to linear ones, for each channel; 1 becomes 1.
    pub curves: [Curve; 3],
    /// Luminance of white, cd/m².
    pub luminance: Option<f64>,
    /// Primaries, transfer, matrix and range of ITU-T H.273.
    pub cicp: Option<[u8; 4]>,
}

/// Why there is no profile, or none that describes a display.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum IccError {
    /// The bytes are no ICC profile.
    #[error("it is not an ICC profile: {0}")]
    NotAProfile(String),
    /// The profile is damaged.
    #[error("the profile is damaged: {0}")]
    Damaged(String),
    /// The profile describes something else than a display with three primaries and curves.
    #[error("the profile cannot describe a display here: {0}")]
    Unsuitable(String),
    /// What should be written cannot be.
    #[error("no profile can be written: {0}")]
    Description(String),
}
