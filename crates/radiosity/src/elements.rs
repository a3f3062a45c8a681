//! The pieces of surface on which light is solved for: sides of elements receive it, patches of them send it on.

use crate::subdivision::Subdivision;
use glam::{DVec3, Vec3};
use illuminant_optics::spherical_triangle::SphericalTriangle;
use illuminant_scene::{Geometry, Hit, Ray, SurfacePoint, on_triangle};

const NONE: u32 = u32::MAX;

/// A leaf of the subdivision.
#[derive(Clone, Copy, Debug)]
pub struct Element {
    /// Its node.
    pub node: u32,
    /// Its object.
    pub object: u32,
    /// The primitive of the object.
    pub primitive: u32,
    /// Area, m²; of a sphere the exact part of it.
    pub area: f64,
    /// Its middle, on the surface.
    pub centre: Vec3,
    /// Unit normal there, to the outside.
    pub normal: Vec3,
}

/// One side of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// The element.
    pub element: u32,
    /// Whether it is the inside, to which the normal does not point.
    pub back: bool,
}

/// A place on a side.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The surface there.
    pub point: SurfacePoint,
    /// Unit normal of the side.
    pub normal: Vec3,
}

impl Place {
    /// The ray that leaves the place in a direction.
    #[inline]
    #[must_use]
    pub fn ray(&self, direction: Vec3) -> Ray {
        Ray { origin: self.point.offset(direction), direction, time: 0.0 }
    }
}

/// What an object is to the light that is solved for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Its surface is cut into elements.
    Surface,
    /// Light passes it as if it were not there.
    Clear,
    /// It stands in the way of light, and has no elements.
    Apart,
}

/// How fine surfaces are cut.
#[derive(Clone, Copy, Debug)]
pub struct Refinement {
    /// No element is larger, m².
    pub element: f64,
    /// No patch is larger, m², unless its element is.
    pub patch: f64,
}

/// All elements of a scene, their sides, and the patches that these make.
#[derive(Clone, Debug)]
pub struct Elements {
    /// The trees whose leaves they are.
    pub subdivision: Subdivision,
    /// The elements, in the order of the trees.
    pub all: Vec<Element>,
    /// The sides for which light is solved.
    pub sides: Vec<Side>,
    /// The patch of each side.
    pub patch_of: Vec<u32>,
    /// The sides of each patch.
    pub patches: Vec<Vec<u32>>,
    element_of: Vec<u32>,
    side_of: Vec<[u32; 2]>,
    /// What each object is.
    parts: Vec<Part>,
}

fn triangle_area([a, b, c]: [Vec3; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| p.as_dvec3());
    0.5 * (b - a).cross(c - a).length()
}

/// The part of a sphere in a triangle.
fn spherical_area(corners: [Vec3; 3], (center, radius): (Vec3, f32)) -> f64 {
    let corners = corners.map(|p| p.as_dvec3().to_array());
    let seen = SphericalTriangle::new(corners, center.as_dvec3().to_array());
    seen.map_or(0.0, |triangle| triangle.solid_angle()) * f64::from(radius) * f64::from(radius)
}

impl Elements {
    /// Cuts surfaces (`parts` tells of each object what it is), in such a way that no element is larger than `refinement` says; `lit` tells for an object and a side of it whether light is solved for there.
    #[must_use]
    pub fn new(
        geometry: &Geometry,
        parts: &[Part],
        refinement: Refinement,
        lit: &dyn Fn(usize, bool) -> bool,
    ) -> Self {
        let mut subdivision = Subdivision::new(geometry);
        let mut next = 0;
        while next < subdivision.len() {
            let node = next as u32;
            let large = parts[subdivision.object(node) as usize] == Part::Surface
                && area(&subdivision, node) > refinement.element * (1.0 + 1e-6);
            if large {
                subdivision.bisect(node);
            }
            next += 1;
        }
        Self::of(geometry, subdivision, parts, refinement.patch, lit)
    }

    /// The elements of a subdivision that is given.
    #[must_use]
    pub fn of(
        geometry: &Geometry,
        subdivision: Subdivision,
        parts: &[Part],
        patch: f64,
        lit: &dyn Fn(usize, bool) -> bool,
    ) -> Self {
        let mut all = Self {
            element_of: vec![NONE; subdivision.len()],
            parts: parts.to_vec(),
            subdivision,
            all: Vec::new(),
            sides: Vec::new(),
            patch_of: Vec::new(),
            patches: Vec::new(),
            side_of: Vec::new(),
        };
        let lit: Vec<[bool; 2]> = (0..parts.len())
            .map(|object| [false, true].map(|back| parts[object] == Part::Surface && lit(object, back)))
            .collect();
        // The ancestor that was the last patch on each side: leaves of one ancestor follow each other.
        let mut last = [(NONE, 0u32); 2];
        for node in all.subdivision.leaves() {
            let object = all.subdivision.object(node);
            if parts[object as usize] != Part::Surface {
                continue;
            }
            let element = all.all.len() as u32;
            all.element_of[node as usize] = element;
            let found = all.element(geometry, node, object);
            all.all.push(found);
            let mut ancestor = node;
            while let Some(parent) = all.subdivision.parent(ancestor) {
                if area(&all.subdivision, parent) > patch {
                    break;
                }
                ancestor = parent;
            }
            let mut own = [NONE; 2];
            for back in [false, true] {
                // What has no area receives and sends nothing.
                if !lit[object as usize][usize::from(back)] || found.area <= 0.0 {
                    continue;
                }
                let side = all.sides.len() as u32;
                own[usize::from(back)] = side;
                all.sides.push(Side { element, back });
                let (of, patch) = &mut last[usize::from(back)];
                if *of != ancestor {
                    (*of, *patch) = (ancestor, all.patches.len() as u32);
                    all.patches.push(Vec::new());
                }
                all.patch_of.push(*patch);
                all.patches[*patch as usize].push(side);
            }
            all.side_of.push(own);
        }
        all
    }

    fn element(&self, geometry: &Geometry, node: u32, object: u32) -> Element {
        let primitive = self.subdivision.primitive(node);
        let mut found = Element {
            node,
            object,
            primitive,
            area: area(&self.subdivision, node),
            centre: Vec3::ZERO,
            normal: Vec3::Z,
        };
        let [a, b, c] = self.corners(&found);
        let middle = (a + b + c) / 3.0;
        found.centre = match self.subdivision.sphere(object) {
            Some((center, radius)) => center + (middle - center).normalize() * radius,
            None => middle,
        };
        let point = surface_at(geometry, object, primitive, found.centre, (b - a).cross(c - a));
        found.normal = point.geometric_normal;
        found
    }

    /// The corners of an element, in the world.
    #[must_use]
    pub fn corners(&self, element: &Element) -> [Vec3; 3] {
        self.subdivision.corners(element.node).map(|i| self.subdivision.position(i))
    }

    /// The element of a side.
    #[inline]
    #[must_use]
    pub fn element_of(&self, side: u32) -> &Element {
        &self.all[self.sides[side as usize].element as usize]
    }

    /// The other side of the same element, if light is solved for there.
    #[inline]
    #[must_use]
    pub fn opposite(&self, side: u32) -> Option<u32> {
        let Side { element, back } = self.sides[side as usize];
        self.side(element, !back)
    }

    /// The area of a side, m².
    #[must_use]
    pub fn area(&self, side: u32) -> f64 {
        self.element_of(side).area
    }

    /// The area of a patch, m².
    #[must_use]
    pub fn patch_area(&self, patch: u32) -> f64 {
        self.patches[patch as usize].iter().map(|&side| self.area(side)).sum()
    }

    /// The side of an element, if light is solved for there.
    #[inline]
    #[must_use]
    pub fn side(&self, element: u32, back: bool) -> Option<u32> {
        let side = self.side_of[element as usize][usize::from(back)];
        (side != NONE).then_some(side)
    }

    /// The surface of a side at a place of it that is uniform over its area for two uniform numbers.
    #[must_use]
    pub fn place(&self, geometry: &Geometry, side: u32, u: [f32; 2]) -> Place {
        let element = self.element_of(side);
        let corners = self.corners(element);
        let at = match self.subdivision.sphere(element.object) {
            Some((center, radius)) => {
                let seen = SphericalTriangle::new(corners.map(|p| p.to_array()), center.to_array());
                let direction = seen.map_or(element.normal, |t| Vec3::from(t.sample(u)));
                center + direction * radius
            }
            None => on_triangle(corners, u),
        };
        self.at(geometry, side, at)
    }

    /// The middle of a side.
    #[must_use]
    pub fn centre(&self, geometry: &Geometry, side: u32) -> Place {
        self.at(geometry, side, self.element_of(side).centre)
    }

    fn at(&self, geometry: &Geometry, side: u32, at: Vec3) -> Place {
        let element = self.element_of(side);
        let point = surface_at(geometry, element.object, element.primitive, at, element.normal);
        let back = self.sides[side as usize].back;
        Place { point, normal: if back { -point.geometric_normal } else { point.geometric_normal } }
    }

    /// The surface that a ray meets, with what is clear passed.
    #[inline]
    #[must_use]
    pub fn meet(&self, geometry: &Geometry, mut ray: Ray) -> Option<(Ray, Hit)> {
        loop {
            let hit = geometry.closest_hit(&ray)?;
            if self.parts[hit.object as usize] != Part::Clear {
                return Some((ray, hit));
            }
            ray.origin = geometry.surface(&ray, &hit).offset(ray.direction);
        }
    }

    /// Whether a span from a place is free, but for what is clear.
    #[must_use]
    pub fn is_free(&self, geometry: &Geometry, origin: Vec3, span: Vec3, tfar: f32) -> bool {
        if !geometry.is_occluded(origin, span, 0.0, tfar) {
            return true;
        }
        if !self.parts.contains(&Part::Clear) {
            return false;
        }
        let length = span.length();
        let ray = Ray { origin, direction: span / length, time: 0.0 };
        // The end itself left out by a hair.
        self.meet(geometry, ray).is_none_or(|(ray, hit)| {
            ray.origin.distance(origin) + hit.distance >= length * tfar * (1.0 - 1e-4)
        })
    }

    /// What an object is.
    #[must_use]
    pub fn part(&self, object: u32) -> Part {
        self.parts[object as usize]
    }

    /// The side that a ray meets at a hit, if light is solved for there.
    #[inline]
    #[must_use]
    pub fn side_at(&self, ray: &Ray, hit: &Hit) -> Option<u32> {
        let position = ray.origin + ray.direction * hit.distance;
        let at = self.subdivision.locate(hit.object, hit.primitive, hit.barycentric, position);
        let number = self.element_of[at.node as usize];
        let element = self.all.get(number as usize)?;
        let normal = match self.subdivision.sphere(hit.object) {
            Some((center, _)) => position - center,
            None => element.normal,
        };
        self.side(number, normal.dot(ray.direction) > 0.0)
    }

    /// The element at a hit, and how much each of its corners counts there.
    #[inline]
    #[must_use]
    pub fn locate(&self, hit: &Hit, position: Vec3) -> Option<(u32, [f32; 3])> {
        let at = self.subdivision.locate(hit.object, hit.primitive, hit.barycentric, position);
        let element = self.element_of[at.node as usize];
        (element != NONE).then_some((element, at.weights))
    }

    /// Whether the elements of two states of a scene are the same but for where they stand.
    #[must_use]
    pub fn is_alike(&self, other: &Self) -> bool {
        let same = |(a, b): (&Element, &Element)| (a.node, a.object) == (b.node, b.object);
        self.sides == other.sides
            && self.patch_of == other.patch_of
            && self.all.len() == other.all.len()
            && self.all.iter().zip(&other.all).all(same)
    }

    /// The area of all elements, m², one side of each.
    #[must_use]
    pub fn total_area(&self) -> f64 {
        self.all.iter().map(|element| element.area).sum()
    }
}

/// The area of a node, m².
pub(crate) fn area(subdivision: &Subdivision, node: u32) -> f64 {
    let corners = subdivision.corners(node).map(|i| subdivision.position(i));
    match subdivision.sphere(subdivision.object(node)) {
        Some(sphere) => spherical_area(corners, sphere),
        None => triangle_area(corners),
    }
}

/// The surface at a point of an object that is known to lie on it.
fn surface_at(geometry: &Geometry, object: u32, primitive: u32, at: Vec3, normal: Vec3) -> SurfacePoint {
    let normal = normal.as_dvec3().try_normalize().unwrap_or(DVec3::Z).as_vec3();
    let ray = Ray { origin: at + normal, direction: -normal, time: 0.0 };
    let hit = geometry.hit_at(&ray, object, primitive, at);
    geometry.surface(&ray, &hit)
}
