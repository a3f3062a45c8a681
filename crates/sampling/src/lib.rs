//! Spectral sampling: how wavelengths are carried.
//!
//! Three words for three ideas: a curve on wavelength (room `spectrum`), the few values carried along a path
//! ([`Lanes`]), and the [`Basis`] that gives those values their meaning (which wavelengths, which map to XYZ).
//! Lanes without their basis mean nothing, so whatever turns one into the other takes both.
//!
//! A new sampling is one file with a type that implements [`Basis`], and one line in [`SpectralSampling::basis`].

mod basis;
mod error;
mod fit;
mod fitted;
mod gauss;
mod hall;
mod lanes;
mod nonnegative;
mod normal_equations;
mod one_nanometre;
mod products;
mod registry;
mod tristimulus;
mod uniform;

pub use basis::{Basis, Role, ToXyz, xyz_by};
pub use error::{Comparison, SpectralError, compare};
pub use fitted::Fitted;
pub use gauss::Gauss;
pub use hall::Hall;
pub use lanes::{LANE_COUNTS, Lanes, lanes_for};
pub use one_nanometre::OneNanometre;
pub use products::{Part, Product, Products, seen, white_of};
pub use registry::{Boxes, SAMPLING_NAMES, SamplingError, SpectralSampling};
pub use tristimulus::{Normalisation, Tristimulus};
pub use uniform::Uniform;
