//! What a cone meets (Amanatides 1984, "Ray tracing with cones"): every surface in it with the part of the cone that it covers.
//!
//! Of a cone with a circular section the projection from its apex makes a disc; a polygon stays one, and a sphere a disc again. So the
//! part that a triangle covers is the area of a polygon in a circle, and that of a sphere the area of two circles in common.

use crate::geometry::Geometry;
use glam::{Vec2, Vec3};
use illuminant_optics::frame::Frame;
use std::f32::consts::PI;
use std::sync::OnceLock;

/// Triangles of a leaf.
const LEAF: usize = 4;
/// Sides of the polygon that stands for a circle when triangles are cut; it has the circle's area.
const SIDES: usize = 24;

/// A cone, or what is cut off one by a plane across its axis.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Where its axis begins.
    pub origin: Vec3,
    /// Unit, along its axis.
    pub direction: Vec3,
    /// Its radius there.
    pub radius: f32,
    /// How the radius grows with distance; it may fall.
    pub spread: f32,
    /// Where it ends.
    pub length: f32,
}

impl Cone {
    fn radius_at(&self, distance: f32) -> f32 {
        self.radius + self.spread * distance
    }
}

/// A part of a surface in a cone.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    /// Which object, and of a mesh which triangle.
    pub object: u32,
    /// See `object`.
    pub primitive: u32,
    /// The middle of what is in the cone.
    pub point: Vec3,
    /// How far that is from where the cone begins.
    pub distance: f32,
    /// The part of the cone's section that it covers, nearer surfaces left out of account.
    pub cover: f32,
    /// Whether the cone meets the surface from outside.
    pub from_outside: bool,
}

/// A box of the tree, or its primitives.
#[derive(Clone, Copy, Debug)]
struct Node {
    low: Vec3,
    high: Vec3,
    /// Of a leaf the first primitive, else the second child; the first child follows its parent.
    next: u32,
    /// How many primitives; 0 for an inner box.
    count: u32,
}

/// A surface that can be met.
#[derive(Clone, Copy, Debug)]
enum Primitive {
    Triangle { corners: [Vec3; 3], object: u32, number: u32 },
    Sphere { center: Vec3, radius: f32, object: u32 },
}

impl Primitive {
    fn bounds(&self) -> (Vec3, Vec3) {
        match self {
            Self::Triangle { corners: [a, b, c], .. } => (a.min(*b).min(*c), a.max(*b).max(*c)),
            Self::Sphere { center, radius, .. } => (*center - *radius, *center + *radius),
        }
    }

    fn object(&self) -> u32 {
        match self {
            Self::Triangle { object, .. } | Self::Sphere { object, .. } => *object,
        }
    }
}

/// The surfaces of a scene at a moment, in a tree of boxes.
#[derive(Clone, Debug)]
pub struct ConeIndex {
    nodes: Vec<Node>,
    primitives: Vec<Primitive>,
}

/// The surface that a cone leaves, which is no part of what it meets: that object, seen from that side.
#[derive(Clone, Copy, Debug)]
pub struct Leaves {
    /// Which object.
    pub object: u32,
    /// Whether the cone goes off on its outside.
    pub outwards: bool,
}

impl ConeIndex {
    /// The surfaces of a geometry at a time.
    #[must_use]
    pub fn new(geometry: &Geometry, time: f32) -> Self {
        let mut primitives = Vec::with_capacity(geometry.triangles());
        for object in 0..geometry.objects() {
            if let Some((center, radius)) = geometry.sphere(object) {
                primitives.push(Primitive::Sphere { center, radius, object: object as u32 });
                continue;
            }
            let count = geometry.primitives(object);
            let of = |number| geometry.triangle(object, number, time);
            primitives.extend((0..count).filter_map(|number| {
                let corners = of(number)?;
                Some(Primitive::Triangle { corners, object: object as u32, number: number as u32 })
            }));
        }
        let mut nodes = Vec::new();
        let count = primitives.len();
        if count > 0 {
            build(&mut primitives, 0, &mut nodes);
        }
        Self { nodes, primitives }
    }

    /// What lies in a cone, from near to far: of an object what follows closely on itself is one layer.
    ///
    /// Surfaces of the object that the cone leaves are left out on the side on which it goes off.
    #[must_use]
    pub fn meet(&self, cone: &Cone, leaves: Option<Leaves>) -> Vec<Layer> {
        let frame = Frame::from_normal(cone.direction);
        let mut found: Vec<Layer> = Vec::new();
        let mut open = vec![0usize];
        while let Some(i) = open.pop() {
            let Some(node) = self.nodes.get(i) else { break };
            if !touches(cone, node.low, node.high) {
                continue;
            }
            if node.count == 0 {
                open.extend([node.next as usize, i + 1]);
                continue;
            }
            let first = node.next as usize;
            for primitive in &self.primitives[first..first + node.count as usize] {
                let own = leaves.filter(|leaves| leaves.object == primitive.object());
                let layer = match primitive {
                    Primitive::Triangle { corners, object, number } => {
                        triangle(cone, &frame, corners, (*object, *number))
                    }
                    Primitive::Sphere { center, radius, object } => {
                        sphere(cone, *center, *radius, *object, own)
                    }
                };
                // A cone that goes off on the outside of a surface would meet its neighbours from inside.
                let hidden = |layer: &Layer| own.is_some_and(|own| own.outwards != layer.from_outside);
                found.extend(layer.filter(|layer| !hidden(layer)));
            }
        }
        found.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        joined(found, cone)
    }
}

/// Boxes of the primitives that follow each other in the list; halves at the median of the longest axis.
fn build(primitives: &mut [Primitive], first: usize, nodes: &mut Vec<Node>) {
    let (low, high) = primitives
        .iter()
        .map(Primitive::bounds)
        .fold((Vec3::MAX, Vec3::MIN), |(low, high), (a, b)| (low.min(a), high.max(b)));
    let place = nodes.len();
    nodes.push(Node { low, high, next: first as u32, count: primitives.len() as u32 });
    if primitives.len() <= LEAF {
        return;
    }
    let axis = (high - low).max_position();
    let middle = |p: &Primitive| {
        let (low, high) = p.bounds();
        low[axis] + high[axis]
    };
    let half = primitives.len() / 2;
    primitives.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)));
    let (left, right) = primitives.split_at_mut(half);
    build(left, first, nodes);
    (nodes[place].next, nodes[place].count) = (nodes.len() as u32, 0);
    build(right, first + half, nodes);
}

/// Whether a box may lie in a cone: by the sphere around it.
fn touches(cone: &Cone, low: Vec3, high: Vec3) -> bool {
    let (middle, reach) = ((low + high) * 0.5, 0.5 * low.distance(high));
    let d = middle - cone.origin;
    let along = d.dot(cone.direction);
    if along < -reach || along > cone.length + reach {
        return false;
    }
    let [near, far] = [along - reach, along + reach].map(|v| v.clamp(0.0, cone.length));
    let widest = cone.radius_at(near).max(cone.radius_at(far));
    let across = (d - cone.direction * along).length();
    // A sphere touches the side of a cone a little before its middle is a radius away.
    across <= widest + reach * (1.0 + cone.spread * cone.spread).sqrt()
}

/// The normals of the sides of a polygon with the area of the unit circle, which stands for it, and how far they lie from its middle.
fn sides() -> &'static ([[f32; 2]; SIDES], f32) {
    static KNOWN: OnceLock<([[f32; 2]; SIDES], f32)> = OnceLock::new();
    KNOWN.get_or_init(|| {
        let angle = 2.0 * PI / SIDES as f32;
        let corner = (2.0 * PI / (SIDES as f32 * angle.sin())).sqrt();
        let mut normals = [[0.0; 2]; SIDES];
        for (i, normal) in normals.iter_mut().enumerate() {
            let (sin, cos) = (angle * i as f32).sin_cos();
            *normal = [cos, sin];
        }
        (normals, corner * (0.5 * angle).cos())
    })
}

/// The area that a polygon has in common with the unit circle, and its middle.
fn in_circle(polygon: &[Vec2]) -> (f32, Vec2) {
    let (sides, apothem) = sides();
    let mut points = polygon.to_vec();
    let mut cut = Vec::with_capacity(points.len() + SIDES);
    for [cos, sin] in sides {
        let outside = |p: Vec2| p.x * cos + p.y * sin - apothem;
        cut.clear();
        for (i, &p) in points.iter().enumerate() {
            let q = points[(i + 1) % points.len()];
            let (a, b) = (outside(p), outside(q));
            if a <= 0.0 {
                cut.push(p);
            }
            if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
                cut.push(p + (q - p) * (a / (a - b)));
            }
        }
        std::mem::swap(&mut points, &mut cut);
        if points.len() < 3 {
            return (0.0, Vec2::ZERO);
        }
    }
    let (mut area, mut middle) = (0.0, Vec2::ZERO);
    for i in 1..points.len() - 1 {
        let (a, b) = (points[i] - points[0], points[i + 1] - points[0]);
        let part = 0.5 * a.perp_dot(b);
        area += part;
        middle += (points[0] + points[i] + points[i + 1]) * (part / 3.0);
    }
    if area.abs() < 1e-9 { (0.0, Vec2::ZERO) } else { (area.abs(), middle / area) }
}

fn triangle(cone: &Cone, frame: &Frame, corners: &[Vec3; 3], (object, number): (u32, u32)) -> Option<Layer> {
    let local = corners.map(|p| frame.to_local(p - cone.origin));
    // Cut off what lies before and behind, and where the cone is narrower than nothing.
    let mut points: Vec<Vec3> = local.to_vec();
    let closest = 1e-5 * cone.length.min(1.0 + cone.radius);
    for (sign, limit) in [(1.0f32, closest), (-1.0, -cone.length)] {
        let mut cut = Vec::with_capacity(points.len() + 1);
        for (i, &p) in points.iter().enumerate() {
            let q = points[(i + 1) % points.len()];
            let (a, b) = (sign * p.z - limit, sign * q.z - limit);
            if a >= 0.0 {
                cut.push(p);
            }
            if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
                cut.push(p + (q - p) * (a / (a - b)));
            }
        }
        points = cut;
        if points.len() < 3 {
            return None;
        }
    }
    let least = 1e-6 * (1.0 + cone.radius);
    let flat: Vec<Vec2> = points.iter().map(|p| p.truncate() / cone.radius_at(p.z).max(least)).collect();
    let (area, middle) = in_circle(&flat);
    if area <= 0.0 {
        return None;
    }
    let normal = (local[1] - local[0]).cross(local[2] - local[0]);
    // Where the line of the cone that goes through the middle meets the plane: x = m (r + s z).
    let way = Vec3::new(middle.x * cone.spread, middle.y * cone.spread, 1.0);
    let start = Vec3::new(middle.x * cone.radius, middle.y * cone.radius, 0.0);
    let z = normal.dot(local[0] - start) / normal.dot(way);
    if !(z > 0.0 && z <= cone.length * 1.001) {
        return None;
    }
    let p = start + way * z;
    Some(Layer {
        object,
        primitive: number,
        point: cone.origin + frame.to_world(p),
        distance: p.length(),
        cover: (area / PI).min(1.0),
        from_outside: normal.dot(way) < 0.0,
    })
}

/// The area that circles of radius 1 and `r` have in common at a distance. In doubles: of a large circle a small part counts.
fn lens(r: f64, d: f64) -> f64 {
    let pi = std::f64::consts::PI;
    if d >= 1.0 + r {
        return 0.0;
    }
    if d <= (1.0 - r).abs() {
        return pi * r.min(1.0).powi(2);
    }
    let a = ((d * d + 1.0 - r * r) / (2.0 * d)).clamp(-1.0, 1.0);
    let b = ((d * d + r * r - 1.0) / (2.0 * d * r)).clamp(-1.0, 1.0);
    let kite = (-d + 1.0 + r) * (d + 1.0 - r) * (d - 1.0 + r) * (d + 1.0 + r);
    a.acos() + r * r * b.acos() - 0.5 * kite.max(0.0).sqrt()
}

/// The circle that a sphere is in the section of a cone, whose radius is 1: its radius, and how far its middle lies from the axis.
///
/// From the apex of the cone both are circles on the sphere of directions, and their radii are angles; near a narrow cone that is exact
/// however large the other is.
fn as_circle(cone: &Cone, center: Vec3, radius: f32) -> (f64, f64) {
    let d = center - cone.origin;
    let along = d.dot(cone.direction);
    let width = f64::from(cone.radius_at(along.clamp(0.0, cone.length)).max(1e-9));
    let flat = (f64::from(radius) / width, f64::from((d - cone.direction * along).length()) / width);
    if cone.spread.abs() < 1e-7 {
        return flat;
    }
    let to_apex = cone.radius / cone.spread;
    let apex = cone.origin - cone.direction * to_apex;
    let (from_apex, axis) = (center - apex, cone.direction * cone.spread.signum());
    let distance = f64::from(from_apex.length());
    if distance <= f64::from(radius) {
        return flat;
    }
    let half = f64::from(cone.spread.abs()).atan();
    let off = f64::from(from_apex.cross(axis).length()).atan2(f64::from(from_apex.dot(axis)));
    ((f64::from(radius) / distance).asin() / half, off / half)
}

fn sphere(cone: &Cone, center: Vec3, radius: f32, object: u32, own: Option<Leaves>) -> Option<Layer> {
    if own.is_some_and(|own| own.outwards) {
        // What leaves a sphere does not meet it again.
        return None;
    }
    let d = center - cone.origin;
    let inside = match own {
        Some(own) => !own.outwards,
        None => d.length() < radius,
    };
    let layer = |way: Vec3, distance: f32, cover: f32| {
        let distance = distance.max(1e-6);
        (distance <= cone.length).then(|| Layer {
            object,
            primitive: 0,
            point: cone.origin + way * distance,
            distance,
            cover: cover.min(1.0),
            from_outside: !inside,
        })
    };
    let along = d.dot(cone.direction);
    if inside {
        // All of the cone meets the far side.
        let half = (radius * radius - (d.length_squared() - along * along)).max(0.0).sqrt();
        return layer(cone.direction, along + half, 1.0);
    }
    if along <= 0.0 || along - radius > cone.length {
        return None;
    }
    let (circle, off) = as_circle(cone, center, radius);
    let cover = (lens(circle, off) / std::f64::consts::PI) as f32;
    if cover <= 0.0 {
        return None;
    }
    // The middle of what they share, on the line of centres.
    let shared = 0.5 * ((off - circle).max(-1.0) + (off + circle).min(1.0)) as f32;
    let across = (d - cone.direction * along).normalize_or_zero();
    // The line of the cone through it, where it meets the sphere.
    let start = cone.origin + across * (shared * cone.radius);
    let way = (cone.direction + across * (shared * cone.spread)).normalize();
    let to = center - start;
    let b = to.dot(way);
    let root = (b * b - to.length_squared() + radius * radius).max(0.0).sqrt();
    let point = start + way * (b - root);
    let span = point - cone.origin;
    layer(span.normalize_or(cone.direction), span.length(), cover)
}

/// Layers of one object and one side that follow each other within the width of the cone are one.
fn joined(found: Vec<Layer>, cone: &Cone) -> Vec<Layer> {
    let mut layers: Vec<Layer> = Vec::new();
    let mut heaviest: Vec<f32> = Vec::new();
    for layer in found {
        let near = 6.0 * cone.radius_at(layer.distance).max(0.0) + 1e-4 * layer.distance;
        let same = layers.iter().rposition(|l| {
            l.object == layer.object
                && l.from_outside == layer.from_outside
                && layer.distance - l.distance <= near
        });
        match same {
            Some(i) => {
                if layer.cover > heaviest[i] {
                    // Where most of it is; its place in the order stays that of the nearest.
                    heaviest[i] = layer.cover;
                    layers[i] = Layer { cover: layers[i].cover, ..layer };
                }
                layers[i].cover = (layers[i].cover + layer.cover).min(1.0);
            }
            None => {
                heaviest.push(layer.cover);
                layers.push(layer);
            }
        }
    }
    layers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_in_a_circle_have_the_area_that_they_have() {
        let square = |x: f32, s: f32| {
            [Vec2::new(x - s, -s), Vec2::new(x + s, -s), Vec2::new(x + s, s), Vec2::new(x - s, s)]
        };
        assert!((in_circle(&square(0.0, 0.3)).0 - 0.36).abs() < 1e-5);
        assert!((in_circle(&square(0.0, 9.0)).0 - PI).abs() < 1e-4);
        // Half of the circle.
        let (half, middle) = in_circle(&square(9.0, 9.0));
        assert!((half - 0.5 * PI).abs() < 0.01);
        assert!((middle - Vec2::new(4.0 / (3.0 * PI), 0.0)).length() < 5e-3);
        assert_eq!(in_circle(&square(9.0, 1.0)).0, 0.0);
    }

    #[test]
    fn two_circles_share_what_the_closed_form_says() {
        let pi = std::f64::consts::PI;
        assert!((lens(1.0, 0.0) - pi).abs() < 1e-12);
        assert_eq!(lens(0.5, 1.6), 0.0);
        assert!((lens(0.5, 0.2) - 0.25 * pi).abs() < 1e-12);
        // Unit circles at distance 1: 2π/3 − √3/2.
        assert!((lens(1.0, 1.0) - (2.0 * pi / 3.0 - 0.75f64.sqrt())).abs() < 1e-12);
        // A circle so large that its edge is a line through the middle of the other.
        assert!((lens(1e4, 1e4) - 0.5 * pi).abs() < 1e-4);
    }

    #[test]
    fn an_edge_covers_the_part_that_it_cuts_off() {
        // A half-plane at distance 5, its edge at x = 0.05, in a cone of radius 0.1 there.
        let corners = [Vec3::new(0.05, -50.0, 5.0), Vec3::new(99.0, 0.0, 5.0), Vec3::new(0.05, 50.0, 5.0)];
        let cone = Cone { origin: Vec3::ZERO, direction: Vec3::Z, radius: 0.0, spread: 0.02, length: 100.0 };
        let frame = Frame::from_normal(Vec3::Z);
        let layer = triangle(&cone, &frame, &corners, (0, 0)).unwrap();
        let expected = (0.5f32.acos() - 0.5 * 0.75f32.sqrt()) / PI;
        assert!((layer.cover - expected).abs() < 4e-3, "{} {expected}", layer.cover);
        assert!((layer.distance - 5.0).abs() < 0.01);
    }
}
