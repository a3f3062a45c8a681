//! Emitting surfaces: how directions to them are drawn, and with what density.

use crate::geometry::Geometry;
use crate::lamp::LampSample;
use crate::light_tree::Extent;
use crate::surface::{Hit, SurfacePoint};
use glam::Vec3;
use illuminant_optics::goniometry::Distribution;
use illuminant_optics::spherical_rectangle::SphericalRectangle;
use illuminant_optics::spherical_triangle::SphericalTriangle;
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// An emitting object, in the form in which directions to it are drawn.
#[derive(Debug)]
pub struct SurfaceLamp {
    /// Which object.
    pub object: usize,
    /// Whether both sides emit.
    pub two_sided: bool,
    /// Area, m² (one side).
    pub area: f64,
    /// How intensity depends on the angle from the normal; `None` for Lambert's law.
    pub distribution: Option<Distribution>,
    /// Centre and radius of a sphere about the size of the lamp.
    center: Vec3,
    radius: f32,
    outline: Outline,
}

#[derive(Debug)]
enum Outline {
    Rectangle {
        corner: Vec3,
        x: Vec3,
        y: Vec3,
        size: [f32; 2],
        normal: Vec3,
    },
    Sphere {
        center: Vec3,
        radius: f32,
    },
    /// Triangles with running sums of their area, from 0 to 1.
    Triangles {
        sums: Vec<f32>,
        areas: Vec<f32>,
    },
}

/// Below about this solid angle (sr) a lamp is sampled by area: its cosine and distance hardly vary, and f32 is too
/// coarse for its angles.
const SMALL: f32 = 0.25;

/// Whether a lamp around `center` is so small from a point. A lamp that is seen edge-on counts by its whole area, so
/// that one which is near is not taken for small.
#[inline(always)]
fn is_small(from: Vec3, center: Vec3, area: f32) -> bool {
    area < SMALL * from.distance_squared(center)
}

impl SurfaceLamp {
    /// The lamp that an object is.
    #[must_use]
    pub fn new(geometry: &Geometry, object: usize, two_sided: bool) -> Self {
        if let Some((center, radius)) = geometry.sphere(object) {
            let area = 4.0 * std::f64::consts::PI * f64::from(radius) * f64::from(radius);
            return Self {
                object,
                two_sided,
                area,
                distribution: None,
                center,
                radius,
                outline: Outline::Sphere { center, radius },
            };
        }
        let count = geometry.primitives(object);
        let corners = |i: usize| geometry.triangle(object, i, 0.0).unwrap_or_default();
        let areas: Vec<f32> = (0..count)
            .map(|i| {
                let [a, b, c] = corners(i);
                0.5 * (b - a).cross(c - a).length()
            })
            .collect();
        let area: f64 = areas.iter().map(|&a| f64::from(a)).sum();
        let outline = (count == 2 && geometry.is_static(object))
            .then(|| rectangle(corners(0), corners(1)))
            .flatten()
            .unwrap_or_else(|| {
                let mut sum = 0.0f64;
                let sums = areas.iter().map(|&a| {
                    sum += f64::from(a);
                    (sum / area) as f32
                });
                Outline::Triangles { sums: sums.collect(), areas: areas.clone() }
            });
        let middles = (0..count).map(|i| corners(i).iter().sum::<Vec3>() / 3.0);
        let weighted: Vec3 = middles.zip(&areas).map(|(p, &a)| p * a).sum();
        let center = weighted / (area as f32).max(f32::MIN_POSITIVE);
        let farthest = (0..count).flat_map(corners).map(|p| p.distance(center)).fold(0.0, f32::max);
        Self { object, two_sided, area, distribution: None, center, radius: farthest, outline }
    }

    /// The box around the surface, over its motion, and the cone around its normals.
    pub(crate) fn extent(&self, geometry: &Geometry, luminance: f32) -> Extent {
        let strength = luminance * self.area as f32;
        let all = |low: Vec3, high: Vec3, axis: Vec3, facing: f32| Extent {
            low,
            high,
            axis,
            facing,
            spread: FRAC_PI_2,
            two_sided: self.two_sided,
            strength,
        };
        if let Outline::Sphere { center, radius } = &self.outline {
            return all(*center - *radius, *center + *radius, Vec3::Z, PI);
        }
        let still = geometry.is_static(self.object);
        let (mut low, mut high, mut sum) = (Vec3::MAX, Vec3::MIN, Vec3::ZERO);
        let mut normals = Vec::new();
        // A body that moves is taken at several moments; it goes straight on between them, so its box grows no further than theirs.
        for moment in 0..if still { 1 } else { 33 } {
            let mesh = geometry.world_mesh(self.object, moment as f32 / 32.0);
            for face in &mesh.indices {
                let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
                low = low.min(a).min(b).min(c);
                high = high.max(a).max(b).max(c);
                let normal = (b - a).cross(c - a);
                sum += normal;
                normals.push(normal.normalize_or_zero());
            }
        }
        let Some(axis) = sum.try_normalize().filter(|_| still) else { return all(low, high, Vec3::Z, PI) };
        let widest = normals.iter().filter(|n| **n != Vec3::ZERO).map(|n| n.dot(axis)).fold(1.0, f32::min);
        all(low, high, axis, widest.clamp(-1.0, 1.0).acos())
    }

    /// A point of the surface that does not depend on where it is seen from: uniform over the area of what is flat, the centre of a
    /// sphere, and the middle of one of the triangles of a mesh. A moving lamp is taken where it is as its motion begins.
    #[must_use]
    pub fn place(&self, geometry: &Geometry, u: [f32; 2]) -> Vec3 {
        match &self.outline {
            Outline::Rectangle { corner, x, y, size, .. } => {
                *corner + *x * (u[0] * size[0]) + *y * (u[1] * size[1])
            }
            Outline::Sphere { center, .. } => *center,
            Outline::Triangles { sums, .. } => {
                let i = sums.partition_point(|&s| s <= u[0]).min(sums.len() - 1);
                geometry.triangle(self.object, i, 0.0).map_or(self.center, |c| c.iter().sum::<Vec3>() / 3.0)
            }
        }
    }

    /// A point of the surface, uniform over its area, and the normal there: where light that begins at the lamp begins.
    pub(crate) fn point(&self, geometry: &Geometry, time: f32, u: [f32; 2]) -> Option<(Vec3, Vec3)> {
        match &self.outline {
            Outline::Rectangle { corner, x, y, size, normal } => {
                Some((*corner + *x * (u[0] * size[0]) + *y * (u[1] * size[1]), *normal))
            }
            Outline::Sphere { center, radius } => {
                let normal = Vec3::from(illuminant_optics::hemisphere::sphere(u));
                Some((*center + normal * *radius, normal))
            }
            Outline::Triangles { sums, .. } => {
                let (i, _, u) = pick(sums, u);
                let [a, b, c] = geometry.triangle(self.object, i, time)?;
                Some((on_triangle([a, b, c], u), (b - a).cross(c - a).try_normalize()?))
            }
        }
    }

    /// About the solid angle under which a point sees the lamp, as if it faced the point; 0 behind a flat one.
    #[inline]
    pub(crate) fn expected_solid_angle(&self, from: Vec3) -> f32 {
        if let Outline::Rectangle { corner, normal, .. } = &self.outline {
            if !self.two_sided && normal.dot(from - *corner) <= 0.0 {
                return 0.0;
            }
        }
        self.area as f32 / (from.distance_squared(self.center) + self.radius * self.radius)
    }

    /// ∫ intensity dω of a side, relative to the radiance along the normal: π for Lambert's law.
    #[must_use]
    pub fn projected_solid_angle(&self) -> f64 {
        self.distribution.as_ref().map_or(std::f64::consts::PI, |d| d.flux() / d.value(1.0).max(1e-300))
    }

    /// The radiance under an angle to the normal relative to that along it.
    #[inline(always)]
    #[must_use]
    pub fn relative_radiance(&self, cos: f32) -> f32 {
        match &self.distribution {
            None => 1.0,
            Some(distribution) => distribution.radiance(f64::from(cos.abs())) as f32,
        }
    }

    pub(crate) fn emits_towards(&self, normal: Vec3, direction_from_point: Vec3) -> bool {
        self.two_sided || normal.dot(direction_from_point) < 0.0
    }

    /// A direction from a point to the lamp.
    #[inline]
    pub(crate) fn sample(
        &self,
        geometry: &Geometry,
        from: Vec3,
        time: f32,
        u: [f32; 2],
    ) -> Option<LampSample> {
        let (target, normal, pdf) = match &self.outline {
            Outline::Rectangle { corner, x, y, size, normal } => {
                if !self.two_sided && normal.dot(from - *corner) <= 0.0 {
                    return None;
                }
                match seen_rectangle(from, *corner, *x, *y, *size) {
                    Some(seen) => (Vec3::from(seen.sample(u)), *normal, seen.solid_angle().recip()),
                    None => {
                        let target = *corner + *x * (u[0] * size[0]) + *y * (u[1] * size[1]);
                        (target, *normal, by_area(from, target, *normal, size[0] * size[1])?)
                    }
                }
            }
            Outline::Sphere { center, radius } => {
                let (target, normal, pdf) = sample_sphere(*center, *radius, from, u)?;
                (target, normal, pdf)
            }
            Outline::Triangles { sums, areas } => {
                let (i, probability, u) = pick(sums, u);
                let [a, b, c] = geometry.triangle(self.object, i, time)?;
                let normal = (b - a).cross(c - a).normalize_or_zero();
                match seen_triangle(from, [a, b, c], areas[i]) {
                    Some(seen) => {
                        let direction = Vec3::from(seen.sample(u));
                        let distance = (a - from).dot(normal) / direction.dot(normal);
                        if !(distance > 0.0 && distance.is_finite()) {
                            return None;
                        }
                        (from + direction * distance, normal, probability / seen.solid_angle())
                    }
                    None => {
                        let target = on_triangle([a, b, c], u);
                        (target, normal, probability * by_area(from, target, normal, areas[i])?)
                    }
                }
            }
        };
        let span = target - from;
        let distance = span.length();
        let direction = span / distance;
        let cos = normal.dot(direction);
        if !(distance > 0.0) || !(self.two_sided || cos < 0.0) {
            return None;
        }
        // Stop short of the lamp's own surface.
        let short = 1e-5 * (target.abs().max_element() + distance);
        let target = target - normal * short.copysign(cos);
        let scale = self.relative_radiance(cos);
        Some(LampSample { direction, target: Some(target), pdf: Some(pdf), scale, varies: false })
    }

    /// The density, 1/sr, with which `sample` draws the direction in which a ray from a point has met the lamp.
    #[inline]
    pub(crate) fn pdf(
        &self,
        geometry: &Geometry,
        from: Vec3,
        time: f32,
        hit: &Hit,
        target: &SurfacePoint,
    ) -> f32 {
        match &self.outline {
            Outline::Rectangle { corner, x, y, size, normal } => seen_rectangle(from, *corner, *x, *y, *size)
                .map_or_else(
                    || by_area(from, target.position, *normal, size[0] * size[1]).unwrap_or(0.0),
                    |seen| seen.solid_angle().recip(),
                ),
            Outline::Sphere { center, radius } => sphere_pdf(*center, *radius, from, target),
            Outline::Triangles { sums, areas } => {
                let i = hit.primitive as usize;
                let probability = sums[i] - if i == 0 { 0.0 } else { sums[i - 1] };
                let Some(corners) = geometry.triangle(self.object, i, time) else { return 0.0 };
                probability
                    * seen_triangle(from, corners, areas[i]).map_or_else(
                        || by_area(from, target.position, target.geometric_normal, areas[i]).unwrap_or(0.0),
                        |seen| seen.solid_angle().recip(),
                    )
            }
        }
    }
}

/// A triangle chosen by area, its probability, and the numbers made uniform again.
#[inline(always)]
fn pick(sums: &[f32], u: [f32; 2]) -> (usize, f32, [f32; 2]) {
    let i = sums.partition_point(|&s| s <= u[0]).min(sums.len() - 1);
    let low = if i == 0 { 0.0 } else { sums[i - 1] };
    let probability = sums[i] - low;
    (i, probability, [((u[0] - low) / probability).clamp(0.0, 1.0 - f32::EPSILON), u[1]])
}

/// A point of a triangle, uniform over its area for two uniform numbers.
#[inline(always)]
#[must_use]
pub fn on_triangle([a, b, c]: [Vec3; 3], u: [f32; 2]) -> Vec3 {
    let s = u[0].sqrt();
    a * (1.0 - s) + b * (s * (1.0 - u[1])) + c * (s * u[1])
}

/// A rectangle on the sphere around a point; `None` where it is better sampled by area.
#[inline(always)]
fn seen_rectangle(
    from: Vec3,
    corner: Vec3,
    x: Vec3,
    y: Vec3,
    size: [f32; 2],
) -> Option<SphericalRectangle<f32>> {
    let center = corner + x * (0.5 * size[0]) + y * (0.5 * size[1]);
    if is_small(from, center, size[0] * size[1]) {
        return None;
    }
    let seen = SphericalRectangle::new(corner.to_array(), x.to_array(), y.to_array(), size, from.to_array());
    seen.filter(|s| s.solid_angle() > 0.02 * SMALL)
}

/// A triangle on the sphere around a point; `None` where it is better sampled by area.
#[inline(always)]
fn seen_triangle(from: Vec3, corners: [Vec3; 3], area: f32) -> Option<SphericalTriangle<f32>> {
    if is_small(from, (corners[0] + corners[1] + corners[2]) / 3.0, area) {
        return None;
    }
    let seen = SphericalTriangle::new(corners.map(|p| p.to_array()), from.to_array());
    seen.filter(|s| s.solid_angle() > 0.02 * SMALL)
}

/// Two triangles as a rectangle, if they are one.
fn rectangle(first: [Vec3; 3], second: [Vec3; 3]) -> Option<Outline> {
    let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).normalize_or_zero();
    let n = normal(first);
    if n == Vec3::ZERO || n.dot(normal(second)) < 1.0 - 1e-6 {
        return None;
    }
    // The corner of the first triangle with the right angle; the other two are the diagonal.
    let (i, _) = (0..3)
        .map(|i| {
            let (to_next, to_last) = (first[(i + 1) % 3] - first[i], first[(i + 2) % 3] - first[i]);
            (i, to_next.normalize_or_zero().dot(to_last.normalize_or_zero()).abs())
        })
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .filter(|(_, cos)| *cos < 1e-5)?;
    let [corner, p, q] = [first[i], first[(i + 1) % 3], first[(i + 2) % 3]];
    let opposite = p + q - corner;
    let size = (p - corner).length().max((q - corner).length());
    let same = |a: Vec3, b: Vec3| (a - b).length() < 1e-5 * size;
    let completes = [p, q, opposite].iter().all(|wanted| second.iter().any(|have| same(*have, *wanted)));
    let (x, y) = (p - corner, q - corner);
    completes.then(|| Outline::Rectangle {
        corner,
        x: x.normalize(),
        y: y.normalize(),
        size: [x.length(), y.length()],
        normal: n,
    })
}

/// Density of directions for points uniform over an area: r² / (A |cos|).
#[inline(always)]
fn by_area(from: Vec3, target: Vec3, normal: Vec3, area: f32) -> Option<f32> {
    let d = target - from;
    let r2 = d.length_squared();
    let cos = normal.dot(d).abs() / r2.sqrt();
    let pdf = r2 / (area * cos);
    pdf.is_finite().then_some(pdf)
}

/// 1 − cos of the half-angle of the cone around a sphere, without cancellation far away.
pub(crate) fn cone(radius: f32, distance2: f32) -> f32 {
    let sin2 = radius * radius / distance2;
    sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt())
}

fn sample_sphere(center: Vec3, radius: f32, from: Vec3, u: [f32; 2]) -> Option<(Vec3, Vec3, f32)> {
    let axis = center - from;
    let distance2 = axis.length_squared();
    if distance2 <= radius * radius * 1.0001 {
        // Inside, or on it: uniform over the area.
        let normal = Vec3::from(illuminant_optics::hemisphere::sphere(u));
        let target = center + normal * radius;
        let pdf = by_area(from, target, normal, 4.0 * PI * radius * radius)?;
        return Some((target, normal, pdf));
    }
    let one_minus_cos_max = cone(radius, distance2);
    let one_minus_cos = u[0] * one_minus_cos_max;
    let cos = 1.0 - one_minus_cos;
    let sin2 = one_minus_cos * (2.0 - one_minus_cos);
    let (sin_phi, cos_phi) = (TAU * u[1]).sin_cos();
    let frame = illuminant_optics::frame::Frame::from_normal(axis / distance2.sqrt());
    let sin = sin2.max(0.0).sqrt();
    let direction = frame.to_world(Vec3::new(sin * cos_phi, sin * sin_phi, cos));
    let along = distance2.sqrt() * cos;
    let half_chord = (radius * radius - distance2 * sin2).max(0.0).sqrt();
    let target = from + direction * (along - half_chord);
    let normal = (target - center).normalize_or(-direction);
    Some((center + normal * radius, normal, (TAU * one_minus_cos_max).recip()))
}

fn sphere_pdf(center: Vec3, radius: f32, from: Vec3, target: &SurfacePoint) -> f32 {
    let distance2 = (center - from).length_squared();
    if distance2 <= radius * radius * 1.0001 {
        let area = 4.0 * PI * radius * radius;
        return by_area(from, target.position, target.geometric_normal, area).unwrap_or(0.0);
    }
    (TAU * cone(radius, distance2)).recip()
}
