//! Curves on wavelength, and the observer who looks at them.
//!
//! The first room: everything that depends on wavelength (a lamp, a reflectance, n, k, a matching function)
//! is a [`Curve`]; [`Observer`] holds the CIE matching functions; [`SpectralRange`] says over which wavelengths a
//! computation runs. Wavelengths are in nm. Nothing is clamped and nothing is extrapolated without being asked.

extern crate illuminant_elementary as _;

mod arithmetic;
mod blackbody;
mod curve;
mod daylight;
mod interpolation;
mod observer;
mod pseudo_color;
mod range;
mod table;

pub use blackbody::{SECOND_RADIATION_CONSTANT, planck};
pub use curve::{Curve, CurveError, Outside};
pub use daylight::{daylight, daylight_chromaticity};
pub use interpolation::{Extrapolation, Interpolation};
pub use observer::{LUMINOUS_EFFICACY, Observer};
pub use range::SpectralRange;
pub use table::curves_from_csv;
