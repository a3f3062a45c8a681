//! From absolute tristimulus values to what a display is sent, and what it then shows.
//!
//! A [`Display`] says what light it sends for its code values ([`Response`] of each channel). [`develop`] takes XYZ
//! through exposure, the display's primaries, a [`Tone`] operator, a method for its [`Gamut`] and its transfer function;
//! [`encode_png`] puts code values into a file that says how they are meant.

mod develop;
mod display;
mod dither;
mod encoding_table;
mod gamut;
mod png;
mod response;
mod tone;

pub use develop::{Development, Met, Pixels, Sample, develop, develop_codes};
pub use display::{Display, DisplayError};
pub use dither::{
    ClassMatrix, Code, Dither, DitherError, Patterning, Thresholds, Weights, quantise, quantise_into,
};
pub use encoding_table::EncodingTable;
pub use gamut::{Gamut, GamutMap};
pub use png::{PngError, PngTags, encode_png};
pub use response::Response;
pub use tone::Tone;
