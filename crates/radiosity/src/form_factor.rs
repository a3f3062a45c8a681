//! Form factors in closed form (book 4.4.2, eq 4.29).

use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// The form factor from a small area at `point` with unit `normal` to a polygon, by Lambert's formula (1760):
/// F = 1/(2π) Σ Γᵢ·n, with Γᵢ the angle that edge i subtends, along the normal of the plane through edge and point.
///
/// The polygon must be planar, convex, wholly above the horizon of the point, and listed so that it is
/// counter-clockwise when seen from the point against its own normal; the sign is dropped.
///
/// ```
/// use glam::dvec3;
/// use illuminant_radiosity::form_factor::point_to_polygon;
/// // A vast ceiling fills the sky.
/// let s = 1e6;
/// let ceiling = [dvec3(-s, -s, 1.0), dvec3(s, -s, 1.0), dvec3(s, s, 1.0), dvec3(-s, s, 1.0)];
/// assert!((point_to_polygon(dvec3(0.0, 0.0, 0.0), dvec3(0.0, 0.0, 1.0), &ceiling) - 1.0).abs() < 1e-5);
/// ```
#[must_use]
pub fn point_to_polygon(point: DVec3, normal: DVec3, polygon: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    for (i, &corner) in polygon.iter().enumerate() {
        let a = corner - point;
        let b = polygon[(i + 1) % polygon.len()] - point;
        let cross = a.cross(b);
        let length = cross.length();
        if length > 0.0 {
            sum += length.atan2(a.dot(b)) * cross.dot(normal) / length;
        }
    }
    (sum / TAU).abs()
}

/// The form factor between two directly opposed equal rectangles a × b at distance c (Hottel 1931).
#[must_use]
pub fn parallel_rectangles(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (x2, y2) = (1.0 + x * x, 1.0 + y * y);
    let logarithm = (x2 * y2 / (x2 + y * y)).sqrt().ln();
    2.0 / (PI * x * y)
        * (logarithm + x * y2.sqrt() * (x / y2.sqrt()).atan() + y * x2.sqrt() * (y / x2.sqrt()).atan()
            - x * x.atan()
            - y * y.atan())
}

/// The form factor from a rectangle a × b to one a × c that meets it at a right angle along their common edge a (Hottel 1931; Howell's
/// catalogue, C-14).
///
/// ```
/// use illuminant_radiosity::form_factor::{parallel_rectangles, perpendicular_rectangles};
/// // A wall of a cube sees the opposite one and four others.
/// let sum = parallel_rectangles(1.0, 1.0, 1.0) + 4.0 * perpendicular_rectangles(1.0, 1.0, 1.0);
/// assert!((sum - 1.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn perpendicular_rectangles(a: f64, b: f64, c: f64) -> f64 {
    let (h, w) = (c / a, b / a);
    let (h2, w2) = (h * h, w * w);
    let both = h2 + w2;
    let logarithms = ((1.0 + w2) * (1.0 + h2) / (1.0 + both)).ln()
        + w2 * (w2 * (1.0 + both) / ((1.0 + w2) * both)).ln()
        + h2 * (h2 * (1.0 + both) / ((1.0 + h2) * both)).ln();
    (w * (1.0 / w).atan() + h * (1.0 / h).atan() - both.sqrt() * (1.0 / both.sqrt()).atan()
        + 0.25 * logarithms)
        / (PI * w)
}

/// The form factor from a disc to a parallel one on the same axis, of these radii, at a distance (Howell's catalogue, C-41).
///
/// ```
/// use illuminant_radiosity::form_factor::coaxial_discs;
/// // By reciprocity, and of a small disc below a large one sin² of the half-angle.
/// assert!((coaxial_discs(1.0, 2.0, 1.5) - 4.0 * coaxial_discs(2.0, 1.0, 1.5)).abs() < 1e-12);
/// assert!((coaxial_discs(1e-4, 1.0, 1.0) - 0.5).abs() < 1e-7);
/// ```
#[must_use]
pub fn coaxial_discs(from: f64, to: f64, distance: f64) -> f64 {
    let (r, s) = (from / distance, to / distance);
    let x = 1.0 + (1.0 + s * s) / (r * r);
    // The smaller root of F² − x F + (s/r)², without cancellation.
    let product = (s / r) * (s / r);
    2.0 * product / (x + (x * x - 4.0 * product).sqrt())
}

/// The form factor from a small area to a disc parallel to it whose middle lies on its normal: sin² of the half-angle.
#[must_use]
pub fn point_to_disc(radius: f64, distance: f64) -> f64 {
    let (r2, d2) = (radius * radius, distance * distance);
    r2 / (r2 + d2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn averaging_the_point_factor_gives_that_of_the_rectangles() {
        let (a, b, c) = (1.0, 2.0, 0.7);
        let other = [dvec3(0.0, 0.0, c), dvec3(a, 0.0, c), dvec3(a, b, c), dvec3(0.0, b, c)];
        let n = 200;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let point = dvec3(
                    a * (f64::from(i) + 0.5) / f64::from(n),
                    b * (f64::from(j) + 0.5) / f64::from(n),
                    0.0,
                );
                sum += point_to_polygon(point, DVec3::Z, &other);
            }
        }
        let mean = sum / f64::from(n * n);
        assert!((mean - parallel_rectangles(a, b, c)).abs() < 1e-5, "{mean}");
    }

    #[test]
    fn a_cube_sees_a_fifth_of_its_light_in_the_opposite_wall() {
        // The published value for a unit cube (Howell's catalogue, C-11): 0.1998.
        assert!((parallel_rectangles(1.0, 1.0, 1.0) - 0.1998).abs() < 5e-5);
    }
}
