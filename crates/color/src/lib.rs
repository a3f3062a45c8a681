//! Colours as the eye and the monitor describe them.
//!
//! Tristimulus values in RGB systems ([`RgbSystem`]) with their transfer functions ([`Transfer`]) and printed matrices
//! ([`published`]); chromaticities; uniform spaces ([`Lab`], [`LuvWhite`]) and differences ([`Difference`]); adaptation
//! to another white ([`Adaptation`]); the solids of colour selection ([`rgb_to_hsv`], [`HslSolid`]); video
//! ([`RGB_TO_YIQ`]) and Meyer's axes ([`XYZ_TO_AC1C2`]); all of them over arrays ([`convert`]). Spectra become XYZ by
//! [`SpectralWeights`], and RGB becomes a smooth spectrum by [`Upsampler`]. Tristimulus values are relative here: a
//! perfect diffuser has Y = 1.

mod ac1c2;
mod adaptation;
mod cam16;
mod chromaticity;
mod conversion;
mod difference;
mod dominant;
mod elementary;
mod fidelity;
mod hsl;
mod hsv;
mod lab;
mod luv;
mod matrix;
mod metamer;
mod metric;
mod oklab;
mod published;
mod rendering_index;
mod rgb_system;
mod spectral_weights;
mod temperature;
mod threads;
mod transfer;
mod upsampling;
mod yiq;

pub use ac1c2::XYZ_TO_AC1C2;
pub use adaptation::Adaptation;
pub use cam16::Cam16;
pub use chromaticity::{project, uvy_to_xyz, xyy_to_xyz, xyz_to_uvy, xyz_to_xyy};
pub use conversion::{Conversion, convert, convert_in_place, differences};
pub use difference::{Difference, delta_e_2000};
pub use dominant::{Dominant, DominantError, dominant_wavelength};
pub use elementary::Real;
pub use fidelity::{FidelityError, FidelityIndex, fidelity_index};
pub use hsl::HslSolid;
pub use hsv::{hsv_to_rgb, rgb_to_hsv};
pub use lab::{Lab, Lightness};
pub use luv::LuvWhite;
pub use matrix::{Matrix, Singular};
pub use metamer::{Metamer, MetamerError, fundamental, metamer};
pub use metric::delta_e_2000_metric;
pub use oklab::Oklab;
pub use published::{REC709_LUMA, published, published_names};
pub use rendering_index::{RenderingError, RenderingIndex, rendering_index, test_color_samples};
pub use rgb_system::{RgbSystem, rgb_system_names};
pub use spectral_weights::{Interpolation, Scale, SpectralWeights, WeightsError};
pub use temperature::{ColorTemperature, TemperatureError, correlated_color_temperature};
pub use transfer::Transfer;
pub use upsampling::{Sigmoid, SigmoidTable, Upsampler};
pub use yiq::{RGB_TO_YIQ, YIQ_TO_RGB};

/// Tristimulus values, or the three values of an RGB system.
pub type Triple = [f64; 3];
