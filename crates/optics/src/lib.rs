//! The optics of a surface.
//!
//! Closed forms at a boundary: directions ([`vectors`]), the local [`frame`], Fresnel's equations ([`fresnel`]),
//! the [`ggx`] microfacet distribution with its masking and its visible normals, and solid angles with the ways
//! to sample them ([`spherical_rectangle`], [`spherical_triangle`]). Everything is generic over the real type:
//! f64 for analysis, f32 in the tracer. Vectors point away from the surface and have unit length (book 2.2.1).

pub mod frame;
pub mod fresnel;
pub mod ggx;
pub mod hemisphere;
pub mod spherical_rectangle;
pub mod spherical_triangle;
pub mod vectors;

use num_traits::{Float, FloatConst};

/// The real numbers that optics computes with: f32 or f64.
pub trait Real: Float + FloatConst + std::fmt::Debug + Send + Sync + 'static {
    /// A constant written as f64.
    #[must_use]
    fn of(value: f64) -> Self;
}

impl Real for f32 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value as Self
    }
}

impl Real for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
}

/// A vector in the local frame of a surface, whose third component is along the normal.
pub type Vector<R> = [R; 3];
