//! The optics of a surface.
//!
//! Closed forms at a boundary: directions ([`vectors`], [`frame`]), [`fresnel`]'s equations, [`dispersion`]; how rough a surface is
//! ([`roughness`]), what of it hides ([`masking`]), and how its facets lie ([`distribution`], [`wave_optics`]). The
//! [`facets`] of the tracer with their visible normals, light that meets several of them ([`multiple_scattering`]) and the balance
//! of all of it ([`equilibrium`]); light under a vehicle ([`saunderson`]), and how sources shine ([`goniometry`]). [`solid_angle`]s with the ways
//! to sample them ([`hemisphere`], [`spherical_rectangle`], [`spherical_triangle`]). What the tracer needs is generic over the real type:
//! f64 for analysis, f32 in the tracer. Vectors point away from the surface and have unit length (book 2.2.1).

extern crate illuminant_elementary as _;

pub mod dispersion;
pub mod distribution;
pub mod equilibrium;
pub mod error_function;
pub mod facets;
pub mod frame;
pub mod fresnel;
pub mod goniometry;
mod grazing_warp;
pub mod hemisphere;
pub mod hosek_wilkie;
pub mod masking;
pub mod multiple_scattering;
pub mod photometric_web;
pub mod roughness;
pub mod saunderson;
pub mod solid_angle;
pub mod spherical_rectangle;
pub mod spherical_triangle;
pub mod vectors;
pub mod wave_optics;

use num_traits::{Float, FloatConst};

/// The real numbers that optics computes with: f32 or f64.
pub trait Real: Float + FloatConst + std::fmt::Debug + Send + Sync + 'static {
    /// A constant written as f64.
    #[must_use]
    fn of(value: f64) -> Self;

    /// The arc cosine of a number in [−1, 1]. In f32 it is a polynomial (Hastings 1955; Abramowitz and Stegun 4.4.46,
    /// error 2·10⁻⁸), which a loop over lanes can run side by side and which is the same on every machine.
    #[must_use]
    fn arc_cos(self) -> Self;
}

impl Real for f32 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value as Self
    }

    #[inline(always)]
    fn arc_cos(self) -> Self {
        const C: [f32; 8] = [
            std::f32::consts::FRAC_PI_2,
            -0.214_598_8,
            0.088_978_99,
            -0.050_174_303,
            0.030_891_88,
            -0.017_088_126,
            0.006_670_09,
            -0.001_262_491_1,
        ];
        let x = self.abs();
        let polynomial = C.into_iter().rev().fold(0.0, |sum: f32, c| sum.mul_add(x, c));
        let acute = (1.0 - x).max(0.0).sqrt() * polynomial;
        if self < 0.0 { std::f32::consts::PI - acute } else { acute }
    }
}

impl Real for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn arc_cos(self) -> Self {
        self.clamp(-1.0, 1.0).acos()
    }
}

/// A vector in the local frame of a surface, whose third component is along the normal.
pub type Vector<R> = [R; 3];

#[cfg(test)]
mod tests {
    use super::Real;

    #[test]
    fn the_arc_cosine_of_f32_is_good_to_its_last_digits() {
        for i in -1000i16..=1000 {
            let x = f32::from(i) / 1000.0;
            let exact = f64::from(x).acos();
            assert!((f64::from(x.arc_cos()) - exact).abs() < 5e-7, "{x}: {} {exact}", x.arc_cos());
        }
    }
}
