//! Directions over the hemisphere, by the cosine of their angle to the normal.

use crate::{Real, Vector};

/// A point on the unit disc, area-preserving (Shirley and Chiu 1997), of two numbers in [0, 1).
#[inline(always)]
#[must_use]
pub fn disc<R: Real>(u: [R; 2]) -> [R; 2] {
    let [a, b] = u.map(|v| R::of(2.0) * v - R::one());
    if a == R::zero() && b == R::zero() {
        return [R::zero(); 2];
    }
    let (radius, angle) = if a.abs() > b.abs() {
        (a, R::FRAC_PI_4() * (b / a))
    } else {
        (b, R::FRAC_PI_2() - R::FRAC_PI_4() * (a / b))
    };
    let (sin, cos) = angle.sin_cos();
    [radius * cos, radius * sin]
}

/// A direction with density cos θ / π.
#[inline(always)]
#[must_use]
pub fn cosine<R: Real>(u: [R; 2]) -> Vector<R> {
    let [x, y] = disc(u);
    [x, y, (R::one() - x * x - y * y).max(R::zero()).sqrt()]
}

/// A direction with the same density everywhere on the sphere.
#[inline(always)]
#[must_use]
pub fn sphere<R: Real>(u: [R; 2]) -> Vector<R> {
    let z = R::one() - R::of(2.0) * u[0];
    let r = (R::one() - z * z).max(R::zero()).sqrt();
    let (sin, cos) = (R::TAU() * u[1]).sin_cos();
    [r * cos, r * sin, z]
}
