//! The testers of illumination models and of the ways to draw directions.
//!
//! Each answers one question with a number, so that a test states its own tolerance:
//!
//! - [`chi_square`]: does `sample` draw directions with the density that `pdf` says?
//! - [`integrate`]: what is the integral of a function of direction (is `pdf` normalised)?
//! - [`sample_weight`]: is the weight of a drawn direction f |cos θ| / pdf?
//! - [`discrete`]: are mirror direction and smooth refraction drawn as often as their weights say?
//! - [`reciprocity`]: is f(v, l) = f(l, v), up to the n² of the two sides?
//! - [`random_walk`]: what does light do that meets facet after facet? An oracle of microfacet models.
//! - [`audit`]: all of it for a material, with the shares of what is reflected, transmitted and absorbed.
//! - [`energy`]: how much of the light comes back, by quadrature and by drawing?
//!
//! The testers of models look at a [`site::Site`], the two media at a point of a surface; chi-square and
//! integration also take any closure. Directions are local unit vectors with z along the normal that point away
//! from the surface, as everywhere (book 2.2.1); random numbers are keyed by a seed, so that a test that failed
//! fails again.

pub mod audit;
pub mod chi_square;
pub mod discrete;
pub mod energy;
pub mod integrate;
pub mod random;
pub mod random_walk;
pub mod reciprocity;
pub mod sample_weight;
pub mod site;
