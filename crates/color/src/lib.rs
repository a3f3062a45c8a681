//! Colours as the eye and the monitor describe them.
//!
//! Tristimulus values in RGB systems ([`RgbSystem`]) and in CIE L\*a\*b\* ([`Lab`]), their differences
//! ([`delta_e_2000`]), and the way back from RGB to a smooth spectrum ([`Upsampler`]). Tristimulus values are
//! relative here: a perfect diffuser has Y = 1.

mod difference;
mod dominant;
mod fidelity;
mod lab;
mod metamer;
mod rendering_index;
mod rgb_system;
mod temperature;
mod upsampling;

pub use difference::delta_e_2000;
pub use dominant::{Dominant, DominantError, dominant_wavelength};
pub use fidelity::{FidelityError, FidelityIndex, fidelity_index};
pub use lab::Lab;
pub use metamer::{Metamer, MetamerError, fundamental, metamer};
pub use rendering_index::{RenderingError, RenderingIndex, rendering_index, test_color_samples};
pub use rgb_system::{RgbSystem, Transfer, rgb_system_names};
pub use temperature::{ColorTemperature, TemperatureError, correlated_color_temperature};
pub use upsampling::{Sigmoid, SigmoidTable, Upsampler};

/// Tristimulus values, or the three values of an RGB system.
pub type Triple = [f64; 3];
