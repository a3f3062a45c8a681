//! Vectors at a surface: reflected and refracted directions, the normals H and H′, trigonometry (book 2.2.1, 2.2.5, III.1).

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
    // No number where the square of the index is too small for one: beyond every angle.
    if !(sin2_t < R::one()) {
        return None;
    }
    let cos_t = (R::one() - sin2_t).sqrt();
    let along = cos_i / eta - cos_t;
    Some((std::array::from_fn(|i| along.mul_add(n[i], -v[i] / eta)), cos_t))
}

/// The cross product (book eq III.2).
#[must_use]
pub fn cross<R: Real>(a: Vector<R>, b: Vector<R>) -> Vector<R> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The unit direction from one point to another and their distance; `None` where they are one (book III.1.1).
///
/// ```
/// use illuminant_optics::vectors::line;
/// assert_eq!(line([1.0, 2.0, 3.0], [1.0, 2.0, 5.0]), Some(([0.0, 0.0, 1.0], 2.0)));
/// assert_eq!(line([1.0, 2.0, 3.0], [1.0, 2.0, 3.0]), None);
/// ```
#[must_use]
pub fn line<R: Real>(from: Vector<R>, to: Vector<R>) -> Option<(Vector<R>, R)> {
    let span: Vector<R> = std::array::from_fn(|i| to[i] - from[i]);
    let distance = dot(span, span).sqrt();
    (distance > R::zero()).then(|| (span.map(|c| c / distance), distance))
}

/// The refracted direction of a vector on either side of the surface: `n_front` is the index on the side to which the
/// normal points, `n_back` that on the other (book eqs III.7–III.10); `None` beyond the critical angle.
///
/// ```
/// use illuminant_optics::vectors::refract_either;
/// let (s, c) = 30f64.to_radians().sin_cos();
/// let normal = [0.0, 0.0, 1.0];
/// let inside = refract_either([s, 0.0, c], normal, 1.0, 1.5).unwrap();
/// // Light goes the same way back.
/// let back = refract_either(inside, normal, 1.0, 1.5).unwrap();
/// assert!((back[0] - s).abs() < 1e-12 && (back[2] - c).abs() < 1e-12);
/// ```
#[must_use]
pub fn refract_either<R: Real>(v: Vector<R>, n: Vector<R>, n_front: R, n_back: R) -> Option<Vector<R>> {
    let front = dot(v, n) >= R::zero();
    let (normal, eta) = if front { (n, n_back / n_front) } else { (n.map(|c| -c), n_front / n_back) };
    refract(v, normal, eta).map(|(t, _)| t)
}

/// The normal H of a facet that mirrors L to V, halfway between both (book eq III.11); `None` where they are opposite.
///
/// ```
/// use illuminant_optics::vectors::{half, reflect};
/// let (l, v) = ([0.6, 0.0, 0.8], [0.0, 0.6, 0.8]);
/// let r = reflect(l, half(l, v).unwrap());
/// assert!((r[1] - 0.6f64).abs() < 1e-12);
/// assert_eq!(half([1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), None);
/// ```
#[must_use]
pub fn half<R: Real>(l: Vector<R>, v: Vector<R>) -> Option<Vector<R>> {
    let sum: Vector<R> = std::array::from_fn(|i| l[i] + v[i]);
    let length = dot(sum, sum).sqrt();
    (length > R::of(8.0) * R::epsilon()).then(|| sum.map(|c| c / length))
}

/// The normal H′ of a facet that refracts L, in the index `ni`, to T, in `nt` (book eqs III.12–III.15): ±(n_i L + n_t T) on the side
/// of L. `None` where no facet does: beyond grazing incidence, that is, where −L·T < min(n_i/n_t, n_t/n_i); and between equal indices unless T goes straight on, when it is L.
///
/// ```
/// use illuminant_optics::vectors::{half_refracted, refract};
/// let l = [0.6f64, 0.0, 0.8];
/// let (t, _) = refract(l, [0.0, 0.0, 1.0], 1.5).unwrap();
/// let h = half_refracted(l, t, 1.0, 1.5).unwrap();
/// assert!(h[0].abs() < 1e-9 && (h[2] - 1.0).abs() < 1e-9);
/// assert_eq!(half_refracted(l, [0.6, 0.0, 0.8], 1.0, 1.5), None);
/// ```
#[must_use]
pub fn half_refracted<R: Real>(l: Vector<R>, t: Vector<R>, ni: R, nt: R) -> Option<Vector<R>> {
    let across = -dot(l, t);
    let tolerance = R::of(64.0) * R::epsilon();
    if (ni - nt).abs() <= tolerance * ni {
        return (across >= R::one() - tolerance).then_some(l);
    }
    if across < (ni / nt).min(nt / ni) {
        return None;
    }
    let sign = if nt > ni { -R::one() } else { R::one() };
    let sum: Vector<R> = std::array::from_fn(|i| sign * (ni * l[i] + nt * t[i]));
    let length = dot(sum, sum).sqrt();
    (length > R::zero()).then(|| sum.map(|c| c / length))
}

/// sin θ of a direction from cos θ = N·L (book eq 2.1b).
#[must_use]
pub fn sine<R: Real>(cos: R) -> R {
    (R::one() - cos * cos).max(R::zero()).sqrt()
}

/// tan θ from cos θ (book eq 2.1c); infinite at grazing.
#[must_use]
pub fn tangent<R: Real>(cos: R) -> R {
    sine(cos) / cos
}

/// cot θ from cos θ (book eq 2.1d); infinite along the normal.
#[must_use]
pub fn cotangent<R: Real>(cos: R) -> R {
    cos / sine(cos)
}
