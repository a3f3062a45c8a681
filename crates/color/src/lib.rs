//! Colours as the eye and the monitor describe them.
//!
//! Tristimulus values in RGB systems ([`RgbSystem`]) and in CIE L\*a\*b\* ([`Lab`]), their differences
//! ([`delta_e_2000`]), and the way back from RGB to a smooth spectrum ([`Upsampler`]). Tristimulus values are
//! relative here: a perfect diffuser has Y = 1.

mod difference;
mod lab;
mod metric;
mod rgb_system;
mod upsampling;

pub use difference::delta_e_2000;
pub use lab::Lab;
pub use metric::delta_e_2000_metric;
pub use rgb_system::{RgbSystem, Transfer, rgb_system_names};
pub use upsampling::{Sigmoid, SigmoidTable, Upsampler};

/// Tristimulus values, or the three values of an RGB system.
pub type Triple = [f64; 3];
