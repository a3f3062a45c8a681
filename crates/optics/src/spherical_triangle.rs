//! A triangle seen from a point: its solid angle, and directions uniform over it (Arvo 1995).

use crate::vectors::{dot, normalize};
use crate::{Real, Vector};

fn cross<R: Real>(a: Vector<R>, b: Vector<R>) -> Vector<R> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dihedral<R: Real>(a: Vector<R>, b: Vector<R>) -> R {
    // atan2 keeps its digits where acos of a dot product would lose them.
    dot(cross(a, b), cross(a, b)).sqrt().atan2(dot(a, b))
}

/// The projection of a triangle on the unit sphere around a point.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle<R> {
    corners: [Vector<R>; 3],
    alpha: R,
    solid_angle: R,
}

impl<R: Real> SphericalTriangle<R> {
    /// The triangle with these corners, seen from `point`; `None` when it is seen edge-on or the point is a corner.
    #[must_use]
    pub fn new(corners: [Vector<R>; 3], point: Vector<R>) -> Option<Self> {
        let [a, b, c] = corners.map(|p| normalize(std::array::from_fn(|i| p[i] - point[i])));
        let (ab, bc, ca) = (cross(a, b), cross(b, c), cross(c, a));
        if [ab, bc, ca].iter().any(|n| dot(*n, *n) <= R::min_positive_value()) {
            return None;
        }
        let opposite = |n: Vector<R>| n.map(|v| -v);
        let alpha = dihedral(ab, opposite(ca));
        // van Oosterom and Strackee (1983): stable for small triangles, where the sum of angles is not.
        let volume = dot(a, bc).abs();
        let denominator = R::one() + dot(a, b) + dot(b, c) + dot(c, a);
        let solid_angle = R::of(2.0) * volume.atan2(denominator);
        (solid_angle > R::zero()).then_some(Self { corners: [a, b, c], alpha, solid_angle })
    }

    /// The solid angle, sr.
    #[must_use]
    pub fn solid_angle(&self) -> R {
        self.solid_angle
    }

    /// A unit direction uniform over the solid angle, from two numbers in [0, 1).
    #[must_use]
    pub fn sample(&self, u: [R; 2]) -> Vector<R> {
        let [a, b, c] = self.corners;
        let one = R::one();
        // Cut off a part of the wanted area by moving C along the edge AC, then go from B towards it.
        let area = u[0] * self.solid_angle;
        let (sin_alpha, cos_alpha) = self.alpha.sin_cos();
        let (s, t) = (area - self.alpha).sin_cos();
        let cos_c = dot(a, b);
        let (p, q) = (t - cos_alpha, s + sin_alpha * cos_c);
        let numerator = (q * t - p * s) * cos_alpha - q;
        let denominator = (q * s + p * t) * sin_alpha;
        let cos_b = if denominator.abs() > R::min_positive_value() { numerator / denominator } else { one };
        // On the edge AC, where rounding may have left it: nearly edge-on, little is left of numerator and denominator.
        let cos_b = cos_b.max(dot(a, c)).max(-one).min(one);
        let sin_b = (one - cos_b * cos_b).max(R::zero()).sqrt();
        let along = |from: Vector<R>, to: Vector<R>| {
            let d = dot(from, to);
            normalize(std::array::from_fn(|i| to[i] - d * from[i]))
        };
        let ac = along(a, c);
        let moved: Vector<R> = std::array::from_fn(|i| cos_b * a[i] + sin_b * ac[i]);
        let z = one - u[1] * (one - dot(moved, b));
        let sin_z = (one - z * z).max(R::zero()).sqrt();
        let towards = along(b, moved);
        let direction: Vector<R> = std::array::from_fn(|i| z * b[i] + sin_z * towards[i]);
        if dot(direction, direction) > R::min_positive_value() { normalize(direction) } else { b }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_octant_is_an_eighth_of_the_sphere() {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let octant = SphericalTriangle::new(axes, [0.0f64; 3]).unwrap();
        assert!((octant.solid_angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }

    #[test]
    fn slivers_give_unit_directions_near_them() {
        for (width, height) in [(1e-6f32, 1.0), (1e-6, 1e-6), (1.0, 1e6), (1e-3, 1e6)] {
            for step in 0..200 {
                let tilt = step as f32 * 1e-8;
                let corners = [[0.0, 0.0, 1.0], [width, tilt, 1.0], [width * 0.5, height * 1e-6, 1.0 + tilt]];
                let Some(seen) = SphericalTriangle::new(corners, [0.0; 3]) else { continue };
                for u in [[0.5, 0.5], [0.0, 0.5], [0.999_999_94, 0.5], [0.5, 0.999_999_94], [0.3, 0.0]] {
                    let d = seen.sample(u);
                    assert!((dot(d, d) - 1.0).abs() < 1e-5, "{corners:?} {u:?}: {d:?}");
                    let least = corners.iter().map(|c| normalize(*c)[2]).fold(1.0f32, f32::min);
                    assert!(d[2] > least - 1e-5, "{corners:?} {u:?}: {d:?}");
                }
            }
        }
    }

    #[test]
    fn directions_are_uniform_and_inside() {
        let corners = [[0.3, -0.2, 1.0], [1.2, 0.1, 0.8], [0.4, 0.9, 1.3]];
        let seen = SphericalTriangle::new(corners, [0.0f64; 3]).unwrap();
        let [a, b, c] = corners;
        let f = |d: Vector<f64>| d[0] * d[2].powi(2);
        let normal = cross(std::array::from_fn(|i| b[i] - a[i]), std::array::from_fn(|i| c[i] - a[i]));
        let n = 300;
        let (mut by_angle, mut by_area) = (0.0, 0.0);
        for i in 0..n {
            for j in 0..n {
                let u = [(f64::from(i) + 0.5) / f64::from(n), (f64::from(j) + 0.5) / f64::from(n)];
                let d = seen.sample(u);
                for (p, q) in [(a, b), (b, c), (c, a)] {
                    assert!(dot(cross(p, q), d) * dot(cross(a, b), c) > -1e-9);
                }
                by_angle += f(d);
                let s = u[0].sqrt();
                let p: Vector<f64> =
                    std::array::from_fn(|k| (1.0 - s) * a[k] + s * (1.0 - u[1]) * b[k] + s * u[1] * c[k]);
                let r2 = dot(p, p);
                by_area += f(normalize(p)) * dot(normal, normalize(p)).abs() / 2.0 / r2;
            }
        }
        let cells = f64::from(n * n);
        let (by_angle, by_area) = (by_angle / cells * seen.solid_angle(), by_area / cells);
        assert!((by_angle / by_area - 1.0).abs() < 1e-4, "{by_angle} {by_area}");
    }
}
