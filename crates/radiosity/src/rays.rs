//! The rays by which a side looks around: each stands for an equal part of what it receives, or for its cell of a hemi-cube.

use crate::elements::Elements;
use crate::hemicube::Hemicube;
use crate::sequence::Kronecker;
use glam::Vec3;
use illuminant_optics::frame::Frame;
use illuminant_optics::hemisphere;
use illuminant_scene::{Geometry, Ray};

/// A ray from a side, and the part of what the side receives that comes along it.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// From the side.
    pub ray: Ray,
    /// The parts of all directions add up to 1.
    pub part: f32,
}

/// A frame about a side's normal, turned by a number of its own so that neighbours do not err alike.
pub(crate) fn turned(normal: Vec3, side: u32) -> Frame {
    let frame = Frame::from_normal(normal);
    let [turn] = Kronecker::<1>::new(u64::from(side) ^ 0x7475_726e).point(0);
    let (sin, cos) = (std::f32::consts::TAU * turn).sin_cos();
    Frame {
        tangent: frame.tangent * cos + frame.bitangent * sin,
        bitangent: frame.bitangent * cos - frame.tangent * sin,
        normal,
    }
}

/// Rays with the density of the cosine from all over a side (Malley's method; form factors from area to area), `count` of them.
pub(crate) fn cosine(
    geometry: &Geometry,
    elements: &Elements,
    side: u32,
    count: u32,
    each: &mut impl FnMut(Direction),
) {
    let sequence = Kronecker::<4>::new(u64::from(side));
    let part = (count as f32).recip();
    for k in 0..count {
        let [a, b, u, v] = sequence.point(u64::from(k));
        let place = elements.place(geometry, side, [a, b]);
        let frame = Frame::from_normal(place.normal);
        let direction = frame.to_world(Vec3::from(hemisphere::cosine([u, v])));
        if direction.dot(place.normal) > 0.0 {
            each(Direction { ray: place.ray(direction), part });
        }
    }
}

/// Rays through the cells of a hemi-cube on the middle of a side.
pub(crate) fn hemicube(
    geometry: &Geometry,
    elements: &Elements,
    side: u32,
    cube: &Hemicube,
    each: &mut impl FnMut(Direction),
) {
    let place = elements.centre(geometry, side);
    let frame = turned(place.normal, side);
    for (middle, part) in cube.cells() {
        let direction = frame.to_world(middle).normalize();
        each(Direction { ray: place.ray(direction), part });
    }
}

/// The rays of a method that follows rays from a side.
pub fn directions(
    geometry: &Geometry,
    elements: &Elements,
    side: u32,
    by: &crate::form_factors::Looking,
    each: &mut impl FnMut(Direction),
) {
    match by {
        crate::form_factors::Looking::Cosine(count) => cosine(geometry, elements, side, *count, each),
        crate::form_factors::Looking::Hemicube(cube) => hemicube(geometry, elements, side, cube, each),
    }
}
