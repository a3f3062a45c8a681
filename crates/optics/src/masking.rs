//! What part of the facets is neither hidden nor in shadow (book 2.2.7, III.3).

use crate::vectors::{dot, half};
use crate::{Real, Vector};

/// The complement of the error function, erfc x, for x ≥ 0, to 10⁻¹³ or better: a series below 2, a continued fraction above (Abramowitz and Stegun
/// 7.1.6, 7.1.14).
fn erfc(x: f64) -> f64 {
    if x < 2.0 {
        let (mut term, mut sum) = (x, x);
        for i in 1..200 {
            term *= 2.0 * x * x / f64::from(2 * i + 1);
            sum += term;
            if term < 1e-17 * sum {
                break;
            }
        }
        return 1.0 - std::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp() * sum;
    }
    let mut fraction = 0.0;
    for i in (1..=120).rev() {
        fraction = f64::from(i) / 2.0 / (x + fraction);
    }
    (-x * x).exp() / ((x + fraction) * std::f64::consts::PI.sqrt())
}

/// The V-grooves of Torrance and Sparrow 1967 (book eq 2.21): min(1, 2 (N·H)(N·V)/(V·H), 2 (N·H)(N·L)/(V·H)), not below 0; 0 where H does
/// not exist.
///
/// ```
/// use illuminant_optics::masking::torrance_sparrow;
/// let n = [0.0f64, 0.0, 1.0];
/// assert_eq!(torrance_sparrow(n, n, n), 1.0);
/// ```
#[must_use]
pub fn torrance_sparrow<R: Real>(n: Vector<R>, l: Vector<R>, v: Vector<R>) -> R {
    let Some(h) = half(l, v) else { return R::zero() };
    let (nh, nv, nl, vh) = (dot(n, h), dot(n, v), dot(n, l), dot(v, h));
    if vh <= R::zero() {
        return R::zero();
    }
    let two = R::of(2.0) * nh / vh;
    R::one().min(two * nv).min(two * nl).max(R::zero())
}

/// C of Sancer for one direction (book eq 2.22): e^(−c)/(2√(πc)) − ½ erfc √c with c = cot² θ/m², which is Smith's Λ of Gaussian slopes.
#[must_use]
pub fn sancer_term(cos: f64, m_squared: f64) -> f64 {
    let sin2 = 1.0 - cos * cos;
    if sin2 <= 0.0 || m_squared <= 0.0 {
        return 0.0;
    }
    let c = cos * cos / (sin2 * m_squared);
    if c <= 0.0 {
        return f64::INFINITY;
    }
    ((-c).exp() / (2.0 * (std::f64::consts::PI * c).sqrt()) - 0.5 * erfc(c.sqrt())).max(0.0)
}

/// The masking of a Gaussian surface by Sancer 1969 (book eq 2.22), 1/(1 + C_i + C_r), with m² of book eq 2.19; 0 below the
/// surface, 1 for m² ≤ 0.
///
/// ```
/// use illuminant_optics::masking::sancer;
/// let n = [0.0, 0.0, 1.0];
/// assert_eq!(sancer(n, n, n, 0.25), 1.0); // from above nothing is hidden
/// assert!(sancer(n, [0.995, 0.0, 0.0998749], n, 0.25) < 0.6);
/// ```
#[must_use]
pub fn sancer(n: Vector<f64>, l: Vector<f64>, v: Vector<f64>, m_squared: f64) -> f64 {
    if m_squared <= 0.0 {
        return 1.0;
    }
    let (nl, nv) = (dot(n, l).min(1.0), dot(n, v).min(1.0));
    if nl <= 0.0 || nv <= 0.0 {
        return 0.0;
    }
    1.0 / (1.0 + sancer_term(nl, m_squared) + sancer_term(nv, m_squared))
}

/// Sancer's C at even steps of the angle from 0 to 90 degrees: one table serves both directions (book 2.2.7). It is linear in C/(1 + C)
/// between entries, which is finite up to grazing.
#[derive(Clone, Debug)]
pub struct SancerTable(Vec<f64>);

impl SancerTable {
    /// A table with `steps` ≥ 1 steps.
    #[must_use]
    pub fn new(m_squared: f64, steps: usize) -> Self {
        let steps = steps.max(1);
        let entry = |i: usize| {
            let c = sancer_term((std::f64::consts::FRAC_PI_2 * i as f64 / steps as f64).cos(), m_squared);
            if i == steps || c.is_infinite() { 1.0 } else { c / (1.0 + c) }
        };
        Self((0..=steps).map(entry).collect())
    }

    /// The masking of two cosines.
    ///
    /// ```
    /// use illuminant_optics::masking::{SancerTable, sancer};
    /// let table = SancerTable::new(0.25, 256);
    /// let (l, v) = ([0.8, 0.0, 0.6], [0.0, 0.6, 0.8]);
    /// assert!((table.masking(0.6, 0.8) - sancer([0.0, 0.0, 1.0], l, v, 0.25)).abs() < 1e-4);
    /// ```
    #[must_use]
    pub fn masking(&self, cos_l: f64, cos_v: f64) -> f64 {
        let term = |cos: f64| {
            let x = cos.clamp(0.0, 1.0).acos() / std::f64::consts::FRAC_PI_2 * (self.0.len() - 1) as f64;
            let i = (x as usize).min(self.0.len() - 2);
            let y = self.0[i] + (x - i as f64) * (self.0[i + 1] - self.0[i]);
            y / (1.0 - y)
        };
        1.0 / (1.0 + term(cos_l) + term(cos_v))
    }
}

/// Smith's masking of two directions that hide independently, G₁(v) G₁(l), by Λ of both ([`crate::facets::Facets::lambda`]).
#[must_use]
pub fn smith_separable<R: Real>(lambda_v: R, lambda_l: R) -> R {
    ((R::one() + lambda_v) * (R::one() + lambda_l)).recip()
}

/// Smith's masking of two directions on one side, heights correlated: 1/(1 + Λ(v) + Λ(l)) (Ross, Dion and Potvin 2005; Heitz 2014).
///
/// ```
/// use illuminant_optics::masking::{smith_correlated, smith_separable};
/// assert!(smith_correlated(0.5f64, 0.5) > smith_separable(0.5, 0.5)); // what both see is less hidden
/// ```
#[must_use]
pub fn smith_correlated<R: Real>(lambda_v: R, lambda_l: R) -> R {
    (R::one() + lambda_v + lambda_l).recip()
}
