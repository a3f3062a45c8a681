//! Form factors by area integration: Lambert's formula for every pair, averaged over the side that receives.

use crate::elements::Elements;
use crate::form_factor::point_to_polygon;
use crate::sequence::Kronecker;
use glam::{DVec3, Vec3};
use illuminant_scene::{Geometry, on_triangle};

/// The part of a polygon above the horizon of a point.
fn above(polygon: &[DVec3], point: DVec3, normal: DVec3) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (a, b) = ((p - point).dot(normal), (q - point).dot(normal));
        if a > 0.0 {
            kept.push(p);
        }
        if (a > 0.0) != (b > 0.0) {
            kept.push(p + (q - p) * (a / (a - b)));
        }
    }
    kept
}

/// A place on the flat triangle of a side, and its normal.
fn flat(elements: &Elements, side: u32, u: [f32; 2]) -> (Vec3, Vec3) {
    let element = elements.element_of(side);
    let corners = elements.corners(element);
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).normalize();
    let towards = if elements.sides[side as usize].back { -element.normal } else { element.normal };
    (on_triangle(corners, u), normal * normal.dot(towards).signum())
}

/// What a side sees: every element whose sides it may face, at `count` places with a ray each to find what stands between.
pub(crate) fn look(
    geometry: &Geometry,
    elements: &Elements,
    side: u32,
    count: u32,
    each: &mut impl FnMut(u32, bool, f32),
) {
    let own = elements.sides[side as usize].element;
    let sequence = Kronecker::<4>::new(u64::from(side) ^ 0x6172_6561);
    let curved = elements.subdivision.sphere(elements.element_of(side).object).is_some();
    let hollow = curved && elements.sides[side as usize].back;
    for k in 0..count {
        let [a, b, u, v] = sequence.point(u64::from(k));
        let mut place = elements.place(geometry, side, [a, b]);
        if hollow {
            // Flat elements that enclose a room see no more and no less than all of it.
            (place.point.position, place.normal) = flat(elements, side, [a, b]);
        }
        let (point, normal) = (place.point.position.as_dvec3(), place.normal.as_dvec3());
        for (number, element) in elements.all.iter().enumerate() {
            if number as u32 == own {
                continue;
            }
            let corners = elements.corners(element).map(|p| p.as_dvec3());
            let plane = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let facing = plane.dot(point - corners[0]);
            if facing == 0.0 {
                continue;
            }
            let polygon = above(&corners, point, normal);
            if polygon.len() < 3 {
                continue;
            }
            let factor = point_to_polygon(point, normal, &polygon);
            if factor <= 0.0 {
                continue;
            }
            let back = facing < 0.0;
            // The surface of a curved element lies in front of its triangle, where a ray would end before it.
            let target = on_triangle(elements.corners(element), [u, v]);
            let towards = (target - place.point.position).normalize_or_zero();
            if towards.dot(place.normal) <= 0.0 {
                continue;
            }
            let ray = place.ray(towards);
            let met = elements.meet(geometry, ray).map(|(ray, hit)| {
                let far = hit.distance + ray.origin.distance(place.point.position);
                (hit, far)
            });
            let length = target.distance(place.point.position);
            let seen = met.is_none_or(|(hit, far)| {
                (hit.object == element.object && (far - length).abs() < 0.1 * (element.area.sqrt() as f32))
                    || far > length * (1.0 - 1e-4)
            });
            if seen {
                each(number as u32, back, (factor / f64::from(count)) as f32);
            }
        }
    }
}
