//! Spectral sampling: how wavelengths are carried.
//!
//! Three words for three ideas: a curve on wavelength (room `spectrum`), the few values carried along a path
//! ([`Lanes`]), and the [`Basis`] that gives those values their meaning (which wavelengths, which map to XYZ).
//! Lanes without their basis mean nothing, so whatever turns one into the other takes both.
//!
//! A new sampling is one file with a type that implements [`Basis`], and one line in [`SpectralSampling::basis`].

mod basis;
mod error;
mod lanes;
mod one_nanometre;
mod uniform;

pub use basis::{Basis, Role, SamplingError, SpectralSampling, ToXyz};
pub use error::{SpectralError, spectral_error};
pub use lanes::{LANE_COUNTS, Lanes, lanes_for};
pub use one_nanometre::OneNanometre;
pub use uniform::Uniform;
