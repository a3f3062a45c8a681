//! Facets of a rough surface that is seen by geometrical optics: distribution, masking, visible normals.
//!
//! The relief is a height field whose slopes along and across the grain have the parameters m_x and m_y. With slopes
//! (p, q) of a facet and s² = (p/m_x)² + (q/m_y)², their density is
//!
//! - Beckmann: exp(−s²) / (π m_x m_y) (Beckmann and Spizzichino 1963; book eq 2.42c, so m is that of book eq 2.19,
//!   √2 times the rms slope of book eq 2.20),
//! - GGX: 1 / (π m_x m_y (1 + s²)²) (Trowbridge and Reitz 1975; Walter et al. 2007), with m for their α.
//!
//! Both are normalised by ∫ D(h) h_z dω = 1. Heights and slopes are uncorrelated (Smith 1967), so what is seen from a
//! direction follows from Λ, the ratio of hidden to visible projected area: G₁ = 1/(1 + Λ) (Heitz 2014). Facets seen
//! from a direction have the density D_v(h) = G₁(v) max(0, v·h) D(h)/v_z; they are drawn by spherical caps for GGX
//! (Heitz 2018; Dupuy and Benyoub 2023) and by inverting the distribution of the slope towards the viewer for Beckmann
//! (Heitz and d'Eon 2014; Jakob 2014).

use crate::error_function::{erf, erf_inverse, smith_lambda};
use crate::vectors::{dot, normalize};
use crate::{Real, Vector};

/// How the slopes of facets are distributed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Shape {
    /// Gaussian slopes (Beckmann and Spizzichino 1963; book eq 2.42c).
    #[default]
    Beckmann,
    /// Student's t with long tails (Trowbridge and Reitz 1975; Walter et al. 2007).
    Ggx,
}

impl Shape {
    /// The slope, in units of m, below which a fraction `u` in [0, 1) of the facets lies.
    #[must_use]
    pub fn slope_radius(self, u: f64) -> f64 {
        match self {
            Self::Beckmann => (-(-u).ln_1p()).sqrt(),
            Self::Ggx => (u / (1.0 - u)).sqrt(),
        }
    }
}

/// The facets of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets<R> {
    /// How slopes are distributed.
    pub shape: Shape,
    /// The slope m along the first and the second axis of the local frame, above 0.
    pub slope: [R; 2],
}

impl<R: Real> Facets<R> {
    /// Facets of one slope in all directions.
    #[must_use]
    pub fn isotropic(shape: Shape, slope: R) -> Self {
        Self { shape, slope: [slope; 2] }
    }

    /// The density of facets with normal `h`, per solid angle and unit area of the surface, 1/sr.
    ///
    /// ```
    /// use illuminant_optics::facets::{Facets, Shape};
    /// use std::f64::consts::PI;
    /// let facets = Facets::isotropic(Shape::Beckmann, 0.5f64);
    /// assert!((facets.distribution([0.0, 0.0, 1.0]) - 1.0 / (PI * 0.25)).abs() < 1e-12);
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn distribution(&self, h: Vector<R>) -> R {
        if h[2] <= R::zero() {
            return R::zero();
        }
        let [mx, my] = self.slope;
        let (x, y, z2) = (h[0] / mx, h[1] / my, h[2] * h[2]);
        // Tangential parts, never 1 − cos²: that would lose all digits of a polished surface.
        let tangential = x * x + y * y;
        let area = R::PI() * mx * my;
        match self.shape {
            Shape::Beckmann => (-tangential / z2).exp() / (area * z2 * z2),
            Shape::Ggx => {
                let s = tangential + z2;
                (area * s * s).recip()
            }
        }
    }

    /// Smith's Λ of a direction above the surface; infinite at grazing.
    #[inline(always)]
    #[must_use]
    pub fn lambda(&self, v: Vector<R>) -> R {
        let z = v[2].abs();
        if z <= R::zero() {
            return R::infinity();
        }
        let (x, y) = (v[0] * self.slope[0], v[1] * self.slope[1]);
        let tan2 = (x * x + y * y) / (z * z);
        match self.shape {
            Shape::Beckmann => {
                if tan2 < R::of(0.05) {
                    // Beyond cot θ / m = 4.5 Λ is below 10⁻¹⁰.
                    return R::zero();
                }
                smith_lambda(tan2.sqrt().recip())
            }
            Shape::Ggx => ((R::one() + tan2).sqrt() - R::one()) / R::of(2.0),
        }
    }

    /// The fraction of facets visible from one direction, G₁ = 1/(1 + Λ).
    #[inline(always)]
    #[must_use]
    pub fn masking(&self, v: Vector<R>) -> R {
        (R::one() + self.lambda(v)).recip()
    }

    /// The fraction visible from both directions, heights correlated (Heitz 2014, eqs 99 and 102; Heitz et al. 2016):
    /// 1/(1 + Λ(v) + Λ(l)) on one side, B(1 + Λ(v), 1 + Λ(l)) through the surface with Euler's beta function.
    #[inline(always)]
    #[must_use]
    pub fn masking_shadowing(&self, v: Vector<R>, l: Vector<R>) -> R {
        let (a, b) = (self.lambda(v), self.lambda(l));
        if v[2] * l[2] > R::zero() { (R::one() + a + b).recip() } else { beta(a, b) }
    }

    /// A facet normal as seen from `v` (v_z > 0), from two numbers in [0, 1).
    #[inline(always)]
    #[must_use]
    pub fn sample_visible(&self, v: Vector<R>, u: [R; 2]) -> Vector<R> {
        let [mx, my] = self.slope;
        // Stretched so that the slopes have m = 1.
        let stretched = normalize([v[0] * mx, v[1] * my, v[2]]);
        let h = match self.shape {
            Shape::Ggx => {
                let (sin_phi, cos_phi) = (R::TAU() * u[0]).sin_cos();
                let z = (R::one() - u[1]).mul_add(R::one() + stretched[2], -stretched[2]);
                let r = (R::one() - z * z).max(R::zero()).sqrt();
                [r * cos_phi + stretched[0], r * sin_phi + stretched[1], z + stretched[2]]
            }
            Shape::Beckmann => {
                let sin = (stretched[0] * stretched[0] + stretched[1] * stretched[1]).sqrt();
                let towards = if sin > R::zero() {
                    [stretched[0] / sin, stretched[1] / sin]
                } else {
                    [R::one(), R::zero()]
                };
                let along = slope_towards(sin, stretched[2], u[0]);
                let two = R::of(2.0);
                let rest = R::one() - R::epsilon();
                let across = erf_inverse((two * u[1] - R::one()).max(-rest).min(rest));
                let x = along * towards[0] - across * towards[1];
                let y = along * towards[1] + across * towards[0];
                [x, y, R::one()]
            }
        };
        normalize([h[0] * mx, h[1] * my, h[2].max(R::zero())])
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

/// B(1 + a, 1 + b) for a, b ≥ 0: 0 where either is infinite.
#[inline(always)]
fn beta<R: Real>(a: R, b: R) -> R {
    if a == R::zero() {
        return (R::one() + b).recip();
    }
    if b == R::zero() {
        return (R::one() + a).recip();
    }
    let sum = a + b;
    if !(sum < R::of(1e4)) {
        return R::zero();
    }
    (log_factorial(a) + log_factorial(b) - log_factorial(sum + R::one())).exp()
}

/// ln Γ(1 + x) for x ≥ 0, by Stirling's series three steps on: to 10⁻⁶.
#[inline(always)]
fn log_factorial<R: Real>(x: R) -> R {
    let z = x + R::of(4.0);
    let steps = (x + R::one()) * (x + R::of(2.0)) * (x + R::of(3.0));
    let inverse = z.recip();
    let series = inverse * (R::of(1.0 / 12.0) - inverse * inverse * R::of(1.0 / 360.0));
    (z - R::of(0.5)) * z.ln() - z + R::of(0.918_938_533_204_672_7) + series - steps.ln()
}

/// The slope towards the viewer of a visible facet with m = 1, from a number in [0, 1): density ∝ (s sin θ + cos θ)
/// exp(−s²) for s > −cot θ.
///
/// With e = erf s the distribution is e + erf c + (exp(−c²) − exp(−s²))/(c √π), c = cot θ, up to a factor; Newton's
/// steps in e converge where the tails of s would be far away (Jakob 2014), and are kept in a bracket here.
#[inline(always)]
fn slope_towards<R: Real>(sin: R, cos: R, u: R) -> R {
    let one = R::one();
    let largest = one - R::epsilon();
    let tan = sin / cos;
    let least = if tan > R::zero() { -erf(tan.recip()) } else { -one };
    let (mut low, mut high) = (least.max(-largest), largest);
    let over_c = tan * R::FRAC_2_SQRT_PI() / R::of(2.0);
    let gauss = |e: R| {
        let s = erf_inverse(e);
        (s, (-s * s).exp())
    };
    let start = if tan > R::zero() { over_c * (-(tan * tan).recip()).exp() } else { R::zero() };
    let wanted = u * (one - least + start);
    let first = (-(one - u).ln()).sqrt();
    let mut e = least + (one - least) * erf(first);
    e = e.max(low).min(high);
    let mut s = R::zero();
    for _ in 0..5 {
        let (at, bell) = gauss(e);
        s = at;
        let excess = e - least + start - over_c * bell - wanted;
        if excess > R::zero() {
            high = e;
        } else {
            low = e;
        }
        let slope = one + s * tan;
        let next = e - excess / slope;
        let moved = if next >= low && next <= high { next } else { (low + high) / R::of(2.0) };
        if (moved - e).abs() <= R::epsilon() {
            break;
        }
        e = moved;
    }
    let (at, _) = gauss(e);
    if at.is_finite() { at } else { s }
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

    const SLOPES: [[f64; 2]; 5] = [[0.05, 0.05], [0.3, 0.3], [1.0, 1.0], [0.1, 0.4], [0.8, 0.2]];

    #[test]
    fn projected_area_and_visible_normals_are_normalised() {
        for shape in [Shape::Beckmann, Shape::Ggx] {
            for slope in SLOPES {
                let facets = Facets { shape, slope };
                let area = over_hemisphere(|h| facets.distribution(h) * h[2]);
                assert!((area - 1.0).abs() < 2e-3, "{facets:?}: {area}");
                for (theta, phi) in [(0.0f64, 0.0f64), (0.8, 0.4), (1.4, 2.0)] {
                    let v = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
                    let visible = over_hemisphere(|h| facets.pdf_visible(v, h));
                    assert!((visible - 1.0).abs() < 5e-3, "{facets:?} {theta}: {visible}");
                }
            }
        }
    }

    #[test]
    fn the_beta_function_is_right() {
        // B(x, y) of small whole numbers, and of halves: B(3/2, 3/2) = π/8.
        for (a, b, exact) in
            [(0.0, 3.0, 0.25), (1.0, 2.0, 1.0 / 12.0), (0.5, 0.5, std::f64::consts::PI / 8.0)]
        {
            assert!((beta(a, b) / exact - 1.0).abs() < 2e-6);
            assert!((beta(a as f32, b as f32) / exact as f32 - 1.0).abs() < 2e-5);
        }
        assert_eq!(beta(f32::INFINITY, 0.3), 0.0);
    }

    #[test]
    fn slopes_towards_the_viewer_follow_their_distribution() {
        // The share of draws below a slope, by the closed form of the distribution.
        for theta in [0.0f64, 0.3, 1.0, 1.5, 1.57] {
            let (sin, cos) = theta.sin_cos();
            let below = |s: f64| {
                let c = (cos / sin).min(1e6);
                let gauss = (c * TAU.sqrt() / 2f64.sqrt()).recip();
                let part = |x: f64| erf(x) - gauss * (-x * x).exp();
                ((part(s) - part(-c)) / (1.0 - part(-c))).max(0.0)
            };
            for i in 0..200 {
                let u = (f64::from(i) + 0.5) / 200.0;
                let s = slope_towards(sin, cos, u);
                assert!((below(s) - u).abs() < 2e-5, "{theta} {u}: {s} {}", below(s));
                let single = f64::from(slope_towards(sin as f32, cos as f32, u as f32));
                assert!((below(single) - u).abs() < 2e-3, "{theta} {u}: {single} {}", below(single));
            }
        }
    }
}
