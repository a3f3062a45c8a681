//! The view-independent half of light (book 4.4 and 4.5, appendix IV).
//!
//! Surfaces are cut into [`Elements`], whose sides receive light and, gathered into patches, send it on (substructuring, Cohen et al.
//! 1986). How much of what a patch sends reaches a side is a form factor: [`FormFactors`], found by one of several [`Method`]s.
//! A [`Solver`] finds the irradiance of all sides under all lamps and in all spectral samples at once.
//!
//! Nothing here knows of spectra or illumination models: a sample is a number, and reflectances are given.

mod area;
mod bicgstab;
mod cancel;
mod elements;
pub mod form_factor;
mod form_factors;
mod hemicube;
mod mirrored;
mod points;
mod progressive;
mod rays;
mod reach;
mod scanline;
mod sequence;
mod solve;
mod sparse;
mod subdivision;

pub use cancel::{Cancel, Cancelled};
pub use elements::{Element, Elements, Part, Place, Refinement, Side};
pub use form_factors::{FormFactors, Looking, Method, Row};
pub use hemicube::Hemicube;
pub use mirrored::{Mirror, Reflection, Sight, look_into_mirrors};
pub use points::Points;
pub use progressive::{Shot, progressive};
pub use rays::{Direction, directions};
pub use reach::reached;
pub use sequence::Kronecker;
pub use solve::{Problem, Solution, SolveError, Solver};
pub use sparse::{Sparse, SpectralRows};
pub use subdivision::{Located, Subdivision};
