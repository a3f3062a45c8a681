//! A rectangle seen from a point: its solid angle, and directions uniform over it (Ureña, Fajardo and King 2013).

use crate::vectors::dot;
use crate::{Real, Vector};

/// The projection of a rectangle on the unit sphere around a point.
#[derive(Clone, Copy, Debug)]
pub struct SphericalRectangle<R> {
    axes: [Vector<R>; 3],
    origin: Vector<R>,
    low: [R; 2],
    high: [R; 2],
    distance: R,
    b0: R,
    b1: R,
    k: R,
    solid_angle: R,
}

impl<R: Real> SphericalRectangle<R> {
    /// The rectangle with one corner at `corner` and orthogonal edges along the unit vectors `x` and `y`, of lengths
    /// `size`, seen from `point`. `None` from a point in its plane.
    #[inline(always)]
    #[must_use]
    pub fn new(
        corner: Vector<R>,
        x: Vector<R>,
        y: Vector<R>,
        size: [R; 2],
        point: Vector<R>,
    ) -> Option<Self> {
        let mut z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
        let d: Vector<R> = std::array::from_fn(|i| corner[i] - point[i]);
        let mut distance = dot(d, z);
        if distance > R::zero() {
            z = z.map(|v| -v);
            distance = -distance;
        }
        let low = [dot(d, x), dot(d, y)];
        let high = [low[0] + size[0], low[1] + size[1]];
        // Normals of the planes through the four edges; only one component of each enters the angles.
        let z2 = distance * distance;
        let edge = |v: R| v / (v * v + z2).sqrt();
        let n = [edge(low[1]), edge(high[0]), edge(high[1]), edge(low[0])];
        let clamp = |v: R| v.max(-R::one()).min(R::one());
        let (g0, g1, g2, g3) = (
            clamp(n[0] * n[1]).arc_cos(),
            clamp(-n[1] * n[2]).arc_cos(),
            clamp(n[2] * n[3]).arc_cos(),
            clamp(-n[3] * n[0]).arc_cos(),
        );
        let k = R::TAU() - g2 - g3;
        let solid_angle = g0 + g1 - k;
        (distance < R::zero() && solid_angle > R::zero()).then_some(Self {
            axes: [x, y, z],
            origin: point,
            low,
            high,
            distance,
            b0: -n[0],
            b1: n[2],
            k,
            solid_angle,
        })
    }

    /// The solid angle, sr.
    #[inline(always)]
    #[must_use]
    pub fn solid_angle(&self) -> R {
        self.solid_angle
    }

    /// The point of the rectangle in a direction uniform over the solid angle, from two numbers in [0, 1).
    #[inline(always)]
    #[must_use]
    pub fn sample(&self, u: [R; 2]) -> Vector<R> {
        let one = R::one();
        let au = u[0].mul_add(self.solid_angle, self.k);
        let (sin_au, cos_au) = au.sin_cos();
        let fu = (cos_au * self.b0 - self.b1) / sin_au;
        let cu = ((fu * fu + self.b0 * self.b0).sqrt().recip().copysign(fu)).max(-one).min(one);
        let z2 = self.distance * self.distance;
        let xu = -(cu * self.distance) / (one - cu * cu).max(R::of(1e-12)).sqrt();
        let xu = xu.max(self.low[0]).min(self.high[0]);
        let d2 = xu * xu + z2;
        let h0 = self.low[1] / (d2 + self.low[1] * self.low[1]).sqrt();
        let h1 = self.high[1] / (d2 + self.high[1] * self.high[1]).sqrt();
        let hv = u[1].mul_add(h1 - h0, h0);
        let hv2 = hv * hv;
        let yv = if hv2 < one - R::of(1e-6) { hv * (d2 / (one - hv2)).sqrt() } else { self.high[1] };
        let yv = yv.max(self.low[1]).min(self.high[1]);
        let [x, y, z] = self.axes;
        std::array::from_fn(|i| {
            xu.mul_add(x[i], yv.mul_add(y[i], self.distance.mul_add(z[i], self.origin[i])))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vectors::normalize;

    /// ω = 4 atan(ab / (d √(a² + b² + d²)))  of a centred rectangle 2a × 2b at distance d.
    #[test]
    fn solid_angle_of_a_centred_rectangle() {
        let (a, b, d) = (0.7f64, 1.3, 0.9);
        let seen = SphericalRectangle::new(
            [-a, -b, d],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [2.0 * a, 2.0 * b],
            [0.0; 3],
        )
        .unwrap();
        let exact = 4.0 * (a * b / (d * (a * a + b * b + d * d).sqrt())).atan();
        assert!((seen.solid_angle() - exact).abs() < 1e-12, "{} {exact}", seen.solid_angle());
    }

    #[test]
    fn directions_are_uniform() {
        let corner = [0.2, -0.4, 1.0];
        let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        let seen = SphericalRectangle::new(corner, x, y, [1.5, 0.8], [0.0; 3]).unwrap();
        // Any smooth function of direction integrates to the same by area.
        let f = |p: Vector<f64>| normalize(p)[2].powi(3);
        let n = 400;
        let (mut by_angle, mut by_area) = (0.0, 0.0);
        for i in 0..n {
            for j in 0..n {
                let u = [(f64::from(i) + 0.5) / f64::from(n), (f64::from(j) + 0.5) / f64::from(n)];
                by_angle += f(seen.sample(u));
                let p = [corner[0] + 1.5 * u[0], corner[1] + 0.8 * u[1], 1.0];
                let r2 = dot(p, p);
                by_area += f(p) * normalize(p)[2] / r2;
            }
        }
        let cells = f64::from(n * n);
        let (by_angle, by_area) = (by_angle / cells * seen.solid_angle(), by_area / cells * 1.5 * 0.8);
        assert!((by_angle / by_area - 1.0).abs() < 1e-4, "{by_angle} {by_area}");
    }
}
