//! Radiosity (Goral et al. 1984; Cohen and Greenberg 1985; book 4.4.2): light between diffuse surfaces is solved for once, and then seen
//! from anywhere.
//!
//! Lamps of every kind are asked from all over each side (as path tracing asks them), so that their light is as exact as shadow rays
//! are; what surfaces send on goes by form factors. The solution is kept for one unit of light in every sample from each lamp, so
//! that other lamps are a matter of multiplying.

mod cutting;
mod direct;
mod directional;
mod field;
mod global_cube;
mod reflectance;
mod rows;
mod sensor;
mod settings;
mod solution;
mod specular;
mod update;
mod view;

pub(crate) use directional::Directional;
pub(crate) use field::Field;
pub(crate) use reflectance::{Counted, diffuse_at};
pub use rows::RowFinder;
pub use settings::{Gather, Mechanisms, RadiositySettings};
pub use solution::{Given, RadiosityParts, RadiosityReport, RadiositySolution};
pub(crate) use view::{View, seen};
