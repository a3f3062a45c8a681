//! The GGX microfacet distribution (Walter et al. 2007; Trowbridge and Reitz 1975, book eq 4.18 renormalised).
//!
//! With slope parameter α: D(h) = α² / (π ((h_z² (α² − 1) + 1)²), Smith's masking Λ(v) = (√(1 + α² tan²θ) − 1)/2,
//! height-correlated G₂ = 1/(1 + Λ(v) + Λ(l)) for one side, and sampling of the normals visible from V by spherical
//! caps (Heitz 2018; Dupuy and Benyoub 2023). The normalisation is ∫ D(h) h_z dω = 1.

use crate::vectors::{dot, normalize};
use crate::{Real, Vector};

/// An isotropic GGX surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ggx<R> {
    /// The slope parameter α > 0.
    pub alpha: R,
}

impl<R: Real> Ggx<R> {
    /// The density of facets with normal `h`, per solid angle and unit area of the surface, 1/sr.
    #[inline(always)]
    #[must_use]
    pub fn distribution(&self, h: Vector<R>) -> R {
        if h[2] <= R::zero() {
            return R::zero();
        }
        let a2 = self.alpha * self.alpha;
        let cos2 = h[2] * h[2];
        // sin² + α² cos², from the tangential parts: 1 − cos² would lose all digits of a polished surface.
        let s = (h[0] * h[0] + h[1] * h[1]) + a2 * cos2;
        a2 / (R::PI() * s * s)
    }

    /// Smith's Λ of a direction.
    #[inline(always)]
    #[must_use]
    pub fn lambda(&self, v: Vector<R>) -> R {
        let cos2 = v[2] * v[2];
        if cos2 <= R::zero() {
            return R::infinity();
        }
        let tan2 = (v[0] * v[0] + v[1] * v[1]) / cos2;
        ((R::one() + self.alpha * self.alpha * tan2).sqrt() - R::one()) / R::of(2.0)
    }

    /// The fraction of facets visible from one direction, G₁.
    #[inline(always)]
    #[must_use]
    pub fn masking(&self, v: Vector<R>) -> R {
        (R::one() + self.lambda(v)).recip()
    }

    /// The fraction visible from both directions: height-correlated on one side, separable through the surface
    /// (for transmission the correlated form is a beta function of both Λ; the product is its usual stand-in).
    #[inline(always)]
    #[must_use]
    pub fn masking_shadowing(&self, v: Vector<R>, l: Vector<R>) -> R {
        if v[2] * l[2] > R::zero() {
            (R::one() + self.lambda(v) + self.lambda(l)).recip()
        } else {
            self.masking(v) * self.masking(l)
        }
    }

    /// A facet normal as seen from `v` (v_z > 0), from two numbers in [0, 1).
    #[inline(always)]
    #[must_use]
    pub fn sample_visible(&self, v: Vector<R>, u: [R; 2]) -> Vector<R> {
        let stretched = normalize([v[0] * self.alpha, v[1] * self.alpha, v[2]]);
        let (sin_phi, cos_phi) = (R::TAU() * u[0]).sin_cos();
        let z = (R::one() - u[1]).mul_add(R::one() + stretched[2], -stretched[2]);
        let r = (R::one() - z * z).max(R::zero()).sqrt();
        let h = [r * cos_phi + stretched[0], r * sin_phi + stretched[1], z + stretched[2]];
        normalize([h[0] * self.alpha, h[1] * self.alpha, h[2].max(R::zero())])
    }

    /// The density of [`Self::sample_visible`], 1/sr of facet normals: G₁(v) max(0, v·h) D(h) / v_z.
    #[inline(always)]
    #[must_use]
    pub fn pdf_visible(&self, v: Vector<R>, h: Vector<R>) -> R {
        if v[2] <= R::zero() {
            return R::zero();
        }
        self.masking(v) * dot(v, h).max(R::zero()) * self.distribution(h) / v[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, TAU};

    fn over_hemisphere(f: impl Fn(Vector<f64>) -> f64) -> f64 {
        let (rows, columns) = (4000, 200);
        let mut sum = 0.0;
        for i in 0..rows {
            // Fine near the normal, where a polished surface has all its facets.
            let t = (i as f64 + 0.5) / rows as f64;
            let theta = FRAC_PI_2 * t * t;
            let width = FRAC_PI_2 * 2.0 * t / rows as f64;
            for j in 0..columns {
                let phi = TAU * (f64::from(j) + 0.5) / f64::from(columns);
                let h = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
                sum += f(h) * theta.sin() * width * TAU / f64::from(columns);
            }
        }
        sum
    }

    #[test]
    fn projected_area_and_visible_normals_are_normalised() {
        for alpha in [0.05, 0.3, 1.0] {
            let ggx = Ggx { alpha };
            let area = over_hemisphere(|h| ggx.distribution(h) * h[2]);
            assert!((area - 1.0).abs() < 2e-3, "{alpha}: {area}");
            for theta in [0.0f64, 0.8, 1.4] {
                let v = [theta.sin(), 0.0, theta.cos()];
                let visible = over_hemisphere(|h| ggx.pdf_visible(v, h));
                assert!((visible - 1.0).abs() < 5e-3, "{alpha} {theta}: {visible}");
            }
        }
    }
}
