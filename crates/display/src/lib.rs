//! From absolute tristimulus values to what a display is sent.
//!
//! [`develop`] takes XYZ through exposure, the display's RGB system, its transfer function and quantisation;
//! [`encode_png`] puts the code values into a file that says which system they belong to.

mod develop;
mod dither;
mod png;

pub use develop::{Developed, Pixels, develop};
pub use dither::{
    ClassMatrix, Code, Dither, DitherError, Patterning, Thresholds, Weights, quantise, quantise_into,
};
pub use png::{PngError, PngTags, encode_png};
