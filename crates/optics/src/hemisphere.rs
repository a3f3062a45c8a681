//! Directions over the hemisphere, by the cosine of their angle to the normal.

use crate::{Real, Vector};

/// sin x and cos x for |x| ≤ π/4, by their series: exact to the rounding of f32, and the same on every machine.
#[inline(always)]
fn sin_cos_small<R: Real>(x: R) -> (R, R) {
    let x2 = x * x;
    let series = |coefficients: [f64; 5]| {
        coefficients.into_iter().rev().fold(R::zero(), |sum, c| sum.mul_add(x2, R::of(c)))
    };
    let sin = x * series([1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0]);
    let cos = series([1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0]);
    (sin, cos)
}

/// A point on the unit disc, area-preserving (Shirley and Chiu 1997), of two numbers in [0, 1).
#[inline(always)]
#[must_use]
pub fn disc<R: Real>(u: [R; 2]) -> [R; 2] {
    let [a, b] = u.map(|v| R::of(2.0) * v - R::one());
    if a == R::zero() && b == R::zero() {
        return [R::zero(); 2];
    }
    if a.abs() > b.abs() {
        let (sin, cos) = sin_cos_small(R::FRAC_PI_4() * (b / a));
        [a * cos, a * sin]
    } else {
        let (sin, cos) = sin_cos_small(R::FRAC_PI_4() * (a / b));
        [b * sin, b * cos]
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_are_sine_and_cosine() {
        for i in -100..=100 {
            let x = f64::from(i) / 100.0 * std::f64::consts::FRAC_PI_4;
            let (sin, cos) = sin_cos_small(x);
            assert!((sin - x.sin()).abs() < 2e-9 && (cos - x.cos()).abs() < 3e-8, "{x}");
        }
    }
}
