//! The view-independent half of light.
//!
//! So far it holds the closed [`form_factor`]s against which direct light is verified; patches, hemi-cubes and
//! solvers come with the radiosity techniques.

pub mod form_factor;
