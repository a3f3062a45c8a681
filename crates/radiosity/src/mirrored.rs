//! The mirrored environment (Wallace, Cohen and Greenberg 1987; book appendix IV.4): what a hemi-cube sees in flat mirrors is the scene
//! reflected about their planes, seen through the mirrors as windows.

use crate::elements::Elements;
use crate::hemicube::Hemicube;
use crate::rays::turned;
use crate::scanline::Cells;
use glam::{Affine3A, Mat3, Vec3};
use illuminant_scene::Geometry;

/// A flat mirror.
#[derive(Clone, Debug)]
pub struct Mirror {
    /// Its object.
    pub object: u32,
    /// A point of its plane.
    pub point: Vec3,
    /// Unit normal.
    pub normal: Vec3,
    /// Its triangles.
    pub triangles: Vec<[Vec3; 3]>,
}

impl Mirror {
    /// The mirror that an object is; `None` where it is not flat.
    #[must_use]
    pub fn new(geometry: &Geometry, object: u32) -> Option<Self> {
        let count = geometry.primitives(object as usize);
        let triangles: Vec<[Vec3; 3]> =
            (0..count).filter_map(|i| geometry.triangle(object as usize, i, 0.0)).collect();
        let [a, b, c] = *triangles.first()?;
        let normal = (b - a).cross(c - a).normalize();
        let size = triangles.iter().flatten().map(|p| p.distance(a)).fold(0.0, f32::max);
        let flat = triangles.iter().flatten().all(|p| (*p - a).dot(normal).abs() < 1e-4 * size);
        flat.then_some(Self { object, point: a, normal, triangles })
    }

    /// The reflection about its plane.
    fn reflection(&self) -> Affine3A {
        let n = self.normal;
        let linear =
            Mat3::from_cols(Vec3::X - 2.0 * n.x * n, Vec3::Y - 2.0 * n.y * n, Vec3::Z - 2.0 * n.z * n);
        Affine3A::from_mat3_translation(linear, 2.0 * self.point.dot(n) * n)
    }
}

/// A mirror by way of which something is seen: its number, and the cosine of the angle at which light meets it.
pub type Reflection = (u32, f32);

/// What a cell of a hemi-cube sees in the end.
#[derive(Clone, Copy, Debug)]
pub enum Sight {
    /// An element, whether it is its back, and the direction in which it is seen.
    Element(u32, bool, Vec3),
    /// Nothing, in this direction.
    Open(Vec3),
}

/// Looks from the middle of a side through all cells, and by way of mirrors, so long as `goes_on` says of a chain of reflections that it
/// matters; `each` gets the chain, what is seen, and the delta form factor.
pub fn look_into_mirrors(
    geometry: &Geometry,
    elements: &Elements,
    mirrors: &[Mirror],
    side: u32,
    cube: &Hemicube,
    goes_on: &dyn Fn(&[Reflection]) -> bool,
    each: &mut dyn FnMut(&[Reflection], Sight, f32),
) {
    let place = elements.centre(geometry, side);
    let frame = turned(place.normal, side);
    let origin = elements.corners(elements.element_of(side)).iter().sum::<Vec3>() / 3.0;
    let turn = Mat3::from_cols(frame.tangent, frame.bitangent, frame.normal).transpose();
    let to_local = Affine3A::from_mat3_translation(turn, -(turn * origin));
    let look = Look {
        elements,
        mirrors,
        cube,
        goes_on,
        own: elements.sides[side as usize].element,
        near: 1e-3 * (elements.area(side).sqrt() as f32),
    };
    for face in 0..5 {
        let all: Vec<u32> = (0..cube.rows(face) * cube.resolution()).collect();
        let view = View { to_local, from: origin, eye: origin, window: None };
        look.through(face, &view, &all, &[], each);
    }
}

/// How the scene is seen, straight or as it is reflected.
struct View {
    /// From the scene to the axes of the hemi-cube.
    to_local: Affine3A,
    /// Where the window is seen from, and where what lies beyond it is seen from, as if there were no mirror.
    from: Vec3,
    eye: Vec3,
    window: Option<usize>,
}

struct Look<'a> {
    elements: &'a Elements,
    mirrors: &'a [Mirror],
    cube: &'a Hemicube,
    goes_on: &'a dyn Fn(&[Reflection]) -> bool,
    own: u32,
    near: f32,
}

impl Look<'_> {
    /// Draws the scene as a view has it, in these cells; behind a mirror, what lies before it.
    fn through(
        &self,
        face: u32,
        view: &View,
        cells: &[u32],
        chain: &[(usize, Vec<f32>)],
        each: &mut dyn FnMut(&[Reflection], Sight, f32),
    ) {
        let mut drawn = Cells::new(self.cube);
        drawn.open(cells);
        let plane = view.window.map(|w| {
            let Mirror { point, normal, .. } = self.mirrors[w];
            (point, normal * (view.from - point).dot(normal).signum())
        });
        let mut draw = |corners: [Vec3; 3], item: u32| {
            let before = match plane {
                None => corners.to_vec(),
                Some((point, normal)) => cut(&corners, point, normal),
            };
            let mut local: Vec<Vec3> = before.iter().map(|p| view.to_local.transform_point3(*p)).collect();
            drawn.draw(self.cube, face, &mut local, self.near, item);
        };
        for (number, element) in self.elements.all.iter().enumerate() {
            // Straight on, the side itself is not in its own way.
            if view.window.is_some() || number as u32 != self.own {
                draw(self.elements.corners(element), number as u32);
            }
        }
        let first = self.elements.all.len() as u32;
        for (k, mirror) in self.mirrors.iter().enumerate() {
            if view.window != Some(k) {
                mirror.triangles.iter().for_each(|corners| draw(*corners, first + k as u32));
            }
        }
        let to_world = Mat3::from(view.to_local.matrix3).transpose();
        let mut windows: Vec<Vec<(u32, usize)>> = vec![Vec::new(); self.mirrors.len()];
        for (at, &cell) in cells.iter().enumerate() {
            let (i, j) = (cell % self.cube.resolution(), cell / self.cube.resolution());
            let direction = to_world * self.cube.middle(face, i, j);
            let sight = match drawn.item(cell) {
                Some(item) if item >= first => {
                    windows[(item - first) as usize].push((cell, at));
                    continue;
                }
                Some(item) => {
                    let back = self.elements.all[item as usize].normal.dot(direction) > 0.0;
                    Sight::Element(item, back, direction.normalize())
                }
                None => Sight::Open(direction.normalize()),
            };
            let met: Vec<Reflection> = chain.iter().map(|(k, cosines)| (*k as u32, cosines[at])).collect();
            each(&met, sight, self.cube.delta(face, i, j));
        }
        for (k, cells) in windows.into_iter().enumerate().filter(|(_, cells)| !cells.is_empty()) {
            let normal = self.mirrors[k].normal;
            let cos = |cell: u32| {
                let (i, j) = (cell % self.cube.resolution(), cell / self.cube.resolution());
                (to_world * self.cube.middle(face, i, j)).normalize().dot(normal).abs()
            };
            // The cosines of the cells that are seen through this window, at all mirrors so far.
            let mut longer: Vec<(usize, Vec<f32>)> = chain
                .iter()
                .map(|(mirror, cosines)| (*mirror, cells.iter().map(|(_, at)| cosines[*at]).collect()))
                .collect();
            longer.push((k, cells.iter().map(|(cell, _)| cos(*cell)).collect()));
            let steepest: Vec<Reflection> = longer.iter().map(|(mirror, _)| (*mirror as u32, 1.0)).collect();
            if (self.goes_on)(&steepest) {
                let reflection = self.mirrors[k].reflection();
                let beyond = View {
                    to_local: view.to_local * reflection,
                    from: view.eye,
                    eye: reflection.transform_point3(view.eye),
                    window: Some(k),
                };
                let cells: Vec<u32> = cells.into_iter().map(|(cell, _)| cell).collect();
                self.through(face, &beyond, &cells, &longer, each);
            }
        }
    }
}

/// The part of a triangle in front of a plane.
fn cut(corners: &[Vec3; 3], point: Vec3, normal: Vec3) -> Vec<Vec3> {
    let mut kept = Vec::with_capacity(4);
    for i in 0..3 {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
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
