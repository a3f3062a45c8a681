//! Reflected and refracted directions (book 2.2.5, eqs 2.11 and 2.12, III.6–III.10).

use crate::{Real, Vector};

/// The dot product.
#[inline(always)]
#[must_use]
pub fn dot<R: Real>(a: Vector<R>, b: Vector<R>) -> R {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}

/// A vector of unit length; zero stays zero.
#[inline(always)]
#[must_use]
pub fn normalize<R: Real>(v: Vector<R>) -> Vector<R> {
    let length = dot(v, v).sqrt();
    if length > R::zero() { v.map(|x| x / length) } else { v }
}

/// The mirror direction R = 2 N (N·V) − V (book eq III.6).
#[inline(always)]
#[must_use]
pub fn reflect<R: Real>(v: Vector<R>, n: Vector<R>) -> Vector<R> {
    let twice = R::of(2.0) * dot(v, n);
    std::array::from_fn(|i| twice.mul_add(n[i], -v[i]))
}

/// The refracted direction, and the cosine of its angle to −N; `None` beyond the critical angle.
///
/// `v` points away from the surface on the side of `n` (N·V ≥ 0); `eta` = n_t / n_i, the index on the far side over
/// that on the side of V (Snell, book eq 2.12: n_t sin θ_t = n_i sin θ_i).
///
/// ```
/// use illuminant_optics::vectors::refract;
/// // 30° in air goes to asin(sin 30° / 1.5) in glass.
/// let (s, c) = 30f64.to_radians().sin_cos();
/// let (t, cos_t) = refract([s, 0.0, c], [0.0, 0.0, 1.0], 1.5).unwrap();
/// assert!((t[0] + s / 1.5).abs() < 1e-12 && (t[2] + cos_t).abs() < 1e-12);
/// // Inside glass, 60° is beyond the critical angle.
/// assert!(refract([3f64.sqrt() / 2.0, 0.0, 0.5], [0.0, 0.0, 1.0], 1.0 / 1.5).is_none());
/// ```
#[inline(always)]
#[must_use]
pub fn refract<R: Real>(v: Vector<R>, n: Vector<R>, eta: R) -> Option<(Vector<R>, R)> {
    let cos_i = dot(v, n);
    let sin2_t = (R::one() - cos_i * cos_i).max(R::zero()) / (eta * eta);
    if sin2_t >= R::one() {
        return None;
    }
    let cos_t = (R::one() - sin2_t).sqrt();
    let along = cos_i / eta - cos_t;
    Some((std::array::from_fn(|i| along.mul_add(n[i], -v[i] / eta)), cos_t))
}
