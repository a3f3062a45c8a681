//! Fresnel's equations (book 2.2.5, eqs 2.13–2.15; exact for conductors where the book approximates).
//!
//! [`amplitudes`] gives the complex amplitude ratios of any boundary; [`dielectric`] and [`conductor`] are the
//! unpolarised reflectances in real arithmetic, fast enough to run in every lane.
//!
//! Sign convention: at normal incidence both ratios of a denser dielectric are (1 − n)/(1 + n), that is, E∥ is
//! counted in the frame in which r∥ = r⊥ there; time dependence exp(−iωt), index n + ik with k ≥ 0 absorbing.

use crate::Real;
use num_complex::Complex;

/// Complex amplitude ratios of the reflected and transmitted fields.
#[derive(Clone, Copy, Debug)]
pub struct Amplitudes<R> {
    /// Reflected, electric field in the plane of incidence (∥).
    pub r_parallel: Complex<R>,
    /// Reflected, electric field perpendicular to it (⊥).
    pub r_perpendicular: Complex<R>,
    /// Transmitted, ∥.
    pub t_parallel: Complex<R>,
    /// Transmitted, ⊥.
    pub t_perpendicular: Complex<R>,
}

impl<R: Real> Amplitudes<R> {
    /// The reflectance of unpolarised light, (|r∥|² + |r⊥|²)/2 (book eq 2.15).
    #[must_use]
    pub fn reflectance(&self) -> R {
        (self.r_parallel.norm_sqr() + self.r_perpendicular.norm_sqr()) / R::of(2.0)
    }
}

/// The amplitude ratios at a boundary, for the cosine of the angle of incidence in [0, 1] and the relative index
/// `eta` = (n_t + i k_t) / n_i of the far side (Born and Wolf, 1.5.2 and 14.2). Beyond the critical angle the
/// transmitted cosine is imaginary and |r| = 1.
///
/// ```
/// use illuminant_optics::fresnel::amplitudes;
/// use num_complex::Complex;
/// let glass = amplitudes(1.0f64, Complex::new(1.5, 0.0));
/// assert!((glass.reflectance() - 0.04).abs() < 1e-12);
/// ```
#[must_use]
pub fn amplitudes<R: Real>(cos_i: R, eta: Complex<R>) -> Amplitudes<R> {
    let one = Complex::new(R::one(), R::zero());
    let cos_i = Complex::new(cos_i, R::zero());
    let sin2_i = one - cos_i * cos_i;
    // The root in the upper half plane decays away from the boundary.
    let mut cos_t = (one - sin2_i / (eta * eta)).sqrt();
    if (eta * cos_t).im < R::zero() {
        cos_t = -cos_t;
    }
    let two_cos = cos_i + cos_i;
    Amplitudes {
        r_parallel: (cos_t - eta * cos_i) / (cos_t + eta * cos_i),
        r_perpendicular: (cos_i - eta * cos_t) / (cos_i + eta * cos_t),
        t_parallel: two_cos / (cos_t + eta * cos_i),
        t_perpendicular: two_cos / (cos_i + eta * cos_t),
    }
}

/// The reflectance of a dielectric boundary for unpolarised light; 1 beyond the critical angle.
///
/// `cos_i` in [0, 1]; `eta` = n_t / n_i (book eqs 2.13–2.15).
#[inline(always)]
#[must_use]
pub fn dielectric<R: Real>(cos_i: R, eta: R) -> R {
    let one = R::one();
    let cos2_t = one - (one - cos_i * cos_i) / (eta * eta);
    // Written without a branch so that a loop over lanes stays one: at and beyond the critical angle both
    // ratios below are ±1 with cos_t = 0.
    let cos_t = cos2_t.max(R::zero()).sqrt();
    let parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    let reflectance = (parallel * parallel + perpendicular * perpendicular) / R::of(2.0);
    if cos_i <= R::zero() { one } else { reflectance }
}

/// The reflectance of a conductor for unpolarised light, exact for a complex index (real arithmetic; book eqs 2.16 and
/// 2.17 approximate it for n² + k² ≫ 1).
///
/// `cos_i` in [0, 1]; `n` and `k` relative to the medium in front.
///
/// ```
/// use illuminant_optics::fresnel::conductor;
/// // The book's copper at 589 nm: ((n−1)² + k²)/((n+1)² + k²) at normal incidence.
/// let (n, k) = (0.617f64, 2.63);
/// let normal = ((n - 1.0) * (n - 1.0) + k * k) / ((n + 1.0) * (n + 1.0) + k * k);
/// assert!((conductor(1.0, n, k) - normal).abs() < 1e-12);
/// ```
#[inline(always)]
#[must_use]
pub fn conductor<R: Real>(cos_i: R, n: R, k: R) -> R {
    let (one, two) = (R::one(), R::of(2.0));
    let cos2 = cos_i * cos_i;
    let sin2 = one - cos2;
    let (n2, k2) = (n * n, k * k);
    // a² − b² = n² − k² − sin²θ, 2ab = 2nk.
    let difference = n2 - k2 - sin2;
    let a2_plus_b2 = (difference * difference + R::of(4.0) * n2 * k2).sqrt();
    let a = ((a2_plus_b2 + difference) / two).max(R::zero()).sqrt();
    let perpendicular = (a2_plus_b2 - two * a * cos_i + cos2) / (a2_plus_b2 + two * a * cos_i + cos2);
    let t1 = cos2 * a2_plus_b2 + sin2 * sin2;
    let t2 = two * a * cos_i * sin2;
    let parallel = perpendicular * (t1 - t2) / (t1 + t2);
    // At grazing incidence on n = 1, k = 0 both are 0/0; there the boundary is none.
    let reflectance = (perpendicular + parallel) / two;
    if reflectance.is_nan() { R::zero() } else { reflectance }
}

/// The reflectance of a conductor at an angle, from its own at normal incidence and from the reflectance of an average
/// conductor at that angle and at normal incidence (Cook and Torrance 1982; book eq III.20):
/// F(θ) = F(0) + (1 − F(0)) (F̄(θ) − F̄(0)) / (1 − F̄(0)), not below zero.
///
/// It serves where only a colour is known of a conductor, as in computation with RGB.
///
/// ```
/// use illuminant_optics::fresnel::{conductor, interpolated};
/// let average = |cos: f64| conductor(cos, 1.0, 2.5);
/// assert_eq!(interpolated(0.3, average(1.0), average(1.0)), 0.3); // what was known at normal incidence
/// let grazing: f64 = interpolated(0.3, average(1e-9), average(1.0));
/// assert!((grazing - 1.0).abs() < 1e-6);
/// ```
#[inline(always)]
pub fn interpolated<R: Real>(normal: R, average: R, average_at_normal: R) -> R {
    let rise = (average - average_at_normal) / (R::one() - average_at_normal);
    (normal + (R::one() - normal) * rise).max(R::zero())
}

/// The reflectances of a dielectric boundary for light polarised parallel and perpendicular to the plane of incidence (book eqs
/// 2.13 and 2.14, squared); both 1 beyond the critical angle.
///
/// ```
/// use illuminant_optics::fresnel::dielectric_polarised;
/// // At Brewster's angle, atan 1.5, nothing that is polarised in the plane of incidence is reflected.
/// let [parallel, perpendicular] = dielectric_polarised(1.5f64.atan().cos(), 1.5);
/// assert!(parallel < 1e-20 && perpendicular > 0.14);
/// ```
#[must_use]
pub fn dielectric_polarised<R: Real>(cos_i: R, eta: R) -> [R; 2] {
    let cos2_t = R::one() - (R::one() - cos_i * cos_i) / (eta * eta);
    let cos_t = cos2_t.max(R::zero()).sqrt();
    let square = |x: R| x * x;
    if cos_i <= R::zero() || cos2_t <= R::zero() {
        return [R::one(); 2];
    }
    [
        square((eta * cos_i - cos_t) / (eta * cos_i + cos_t)),
        square((cos_i - eta * cos_t) / (cos_i + eta * cos_t)),
    ]
}

/// The book's approximation for conductors, parallel and perpendicular (book eqs 2.16 and 2.17), good for n² + k² ≫ 1; the
/// exact one is [`conductor`].
///
/// ```
/// use illuminant_optics::fresnel::{conductor, conductor_approximated};
/// let [parallel, perpendicular] = conductor_approximated(0.5f64, 0.617, 2.63);
/// assert!(((parallel + perpendicular) / 2.0 - conductor(0.5, 0.617, 2.63)).abs() < 0.02);
/// ```
#[must_use]
pub fn conductor_approximated<R: Real>(cos: R, n: R, k: R) -> [R; 2] {
    let (one, two) = (R::one(), R::of(2.0));
    let square = n * n + k * k;
    let both = square * cos * cos;
    [
        (both - two * n * cos + one) / (both + two * n * cos + one),
        (square - two * n * cos + cos * cos) / (square + two * n * cos + cos * cos),
    ]
}

/// The reflectance at normal incidence of an index (book eqs III.16 and III.18).
#[must_use]
pub fn normal_reflectance<R: Real>(n: R, k: R) -> R {
    let (one, k2) = (R::one(), k * k);
    ((n - one) * (n - one) + k2) / ((n + one) * (n + one) + k2)
}

/// The index n ≥ 1 of a dielectric, or of a conductor if k = 0, by its reflectance at normal incidence in [0, 1) (book eq III.17).
///
/// ```
/// use illuminant_optics::fresnel::{index_of_reflectance, normal_reflectance};
/// assert!((index_of_reflectance(normal_reflectance(1.51124f64, 0.0)) - 1.51124).abs() < 1e-12);
/// ```
#[must_use]
pub fn index_of_reflectance<R: Real>(reflectance: R) -> R {
    let root = reflectance.sqrt();
    (R::one() + root) / (R::one() - root)
}

/// The k of a conductor with n = 1 by its reflectance at normal incidence in [0, 1) (book eq III.19).
///
/// ```
/// use illuminant_optics::fresnel::{extinction_of_reflectance, normal_reflectance};
/// assert!((normal_reflectance(1.0, extinction_of_reflectance(0.6f64)) - 0.6).abs() < 1e-12);
/// ```
#[must_use]
pub fn extinction_of_reflectance<R: Real>(reflectance: R) -> R {
    R::of(2.0) * (reflectance / (R::one() - reflectance)).sqrt()
}

/// The reflectance at normal incidence of the boundary between two dielectrics, by those of both against air: that of the pseudo-material
/// of book III.5.1.
///
/// ```
/// use illuminant_optics::fresnel::{normal_reflectance, pseudo_material};
/// let (water, glass) = (normal_reflectance(1.33f64, 0.0), normal_reflectance(1.5, 0.0));
/// assert!((pseudo_material(water, glass) - normal_reflectance(1.5 / 1.33, 0.0)).abs() < 1e-12);
/// ```
#[must_use]
pub fn pseudo_material<R: Real>(near: R, far: R) -> R {
    normal_reflectance(index_of_reflectance(far) / index_of_reflectance(near), R::zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn brewster_and_the_critical_angle() {
        let eta = 1.5f64;
        let brewster = eta.atan().cos();
        assert!(amplitudes(brewster, Complex::new(eta, 0.0)).r_parallel.norm() < 1e-12);
        let beyond = (0.9f64).acos().cos().min((1.0 / eta).asin().cos() * 0.99);
        let total = amplitudes(beyond, Complex::new(1.0 / eta, 0.0));
        assert!(
            (total.r_parallel.norm() - 1.0).abs() < 1e-12
                && (total.r_perpendicular.norm() - 1.0).abs() < 1e-12
        );
        assert_eq!(dielectric(beyond, 1.0 / eta), 1.0);
        assert_eq!(dielectric(0.0, eta), 1.0);
    }

    proptest! {
        #[test]
        fn real_arithmetic_agrees_with_the_complex(cos in 0.001..1.0f64, n in 0.05..4.0f64, k in 0.0..10.0f64) {
            let exact = amplitudes(cos, Complex::new(n, k)).reflectance();
            prop_assert!((conductor(cos, n, k) - exact).abs() < 1e-9);
            prop_assert!((conductor(cos as f32, n as f32, k as f32) - exact as f32).abs() < 2e-4);
            let exact = amplitudes(cos, Complex::new(n, 0.0)).reflectance();
            prop_assert!((dielectric(cos, n) - exact).abs() < 1e-9);
        }

        #[test]
        fn a_boundary_reflects_the_same_from_both_sides(cos in 0.001..1.0f64, n in 1.0..3.0f64) {
            let sin2_t = (1.0 - cos * cos) / (n * n);
            let cos_t = (1.0 - sin2_t).sqrt();
            prop_assert!((dielectric(cos, n) - dielectric(cos_t, 1.0 / n)).abs() < 1e-9);
        }

        #[test]
        fn energy_is_conserved(cos in 0.001..1.0f64, n in 1.0..3.0f64) {
            let a = amplitudes(cos, Complex::new(n, 0.0));
            let cos_t = (1.0 - (1.0 - cos * cos) / (n * n)).sqrt();
            let through = n * cos_t / cos * (a.t_parallel.norm_sqr() + a.t_perpendicular.norm_sqr()) / 2.0;
            prop_assert!((a.reflectance() + through - 1.0).abs() < 1e-9);
        }
    }
}
