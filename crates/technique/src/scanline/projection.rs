//! The perspective transform: from triangles in the world to polygons on the screen.

use super::surfaces::{Surfaces, Vertex};
use glam::{DMat4, Vec3};
use illuminant_scene::Camera;

/// Nothing nearer to the eye than this part of the distance to the farthest corner is seen.
const NEAR: f64 = 1e-5;

/// A corner on the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenCorner {
    /// Pixels from the upper left.
    pub x: f64,
    pub y: f64,
    /// Reciprocal of the distance along the direction of view: linear on the screen, and larger the nearer.
    pub q: f64,
}

/// A convex polygon on the screen: a triangle, or what the near plane leaves of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polygon {
    /// Where its corners begin among those of the projection, and how many they are.
    pub first: u32,
    pub count: u32,
    /// The triangle.
    pub face: u32,
    /// Whether the eye is on the side to which the normal points.
    pub front: bool,
    /// The rows that it covers, in pixels.
    pub top: f64,
    pub bottom: f64,
}

/// The polygons of a scene before a camera.
#[derive(Clone, Debug, Default)]
pub(crate) struct Projection {
    /// The vertices of the scene, then those that clipping made.
    pub vertices: Vec<Vertex>,
    pub screen: Vec<ScreenCorner>,
    /// Corners of the polygons: indices of vertices.
    pub corners: Vec<u32>,
    pub polygons: Vec<Polygon>,
    pub eye: Vec3,
}

fn project(matrix: &DMat4, position: Vec3) -> (glam::DVec4, ScreenCorner) {
    let p = *matrix * position.as_dvec3().extend(1.0);
    (p, ScreenCorner { x: p.x / p.w, y: p.y / p.w, q: 1.0 / p.w })
}

impl Projection {
    /// Projects all triangles, and cuts them at the near plane.
    pub fn new(surfaces: &Surfaces, camera: &Camera) -> Self {
        let matrix = camera.matrix();
        let mut clip: Vec<f64> = Vec::with_capacity(surfaces.vertices.len());
        let mut all =
            Self { vertices: surfaces.vertices.clone(), eye: camera.eye().as_vec3(), ..Self::default() };
        for vertex in &surfaces.vertices {
            let (p, corner) = project(&matrix, vertex.position);
            clip.push(p.w);
            all.screen.push(corner);
        }
        let near = NEAR * clip.iter().fold(0.0f64, |m, w| m.max(*w));
        for (number, face) in surfaces.faces.iter().enumerate() {
            let first = all.corners.len();
            let inside = face.corners.map(|i| clip[i as usize] > near);
            if inside == [true; 3] {
                all.corners.extend(face.corners);
            } else if inside != [false; 3] {
                for k in 0..3 {
                    let (a, b) = (face.corners[k], face.corners[(k + 1) % 3]);
                    let (wa, wb) = (clip[a as usize], clip[b as usize]);
                    if wa > near {
                        all.corners.push(a);
                    }
                    if (wa > near) != (wb > near) {
                        // The same point whichever way the edge is walked.
                        let (a, b, wa, wb) = if a < b { (a, b, wa, wb) } else { (b, a, wb, wa) };
                        let cut = all.cut(&matrix, a, b, ((near - wa) / (wb - wa)) as f32);
                        all.corners.push(cut);
                    }
                }
            }
            let count = all.corners.len() - first;
            if count < 3 {
                all.corners.truncate(first);
                continue;
            }
            let rows = all.corners[first..].iter().map(|&i| all.screen[i as usize].y);
            let (top, bottom) = rows.fold((f64::MAX, f64::MIN), |(t, b), y| (t.min(y), b.max(y)));
            let to_eye = all.eye - surfaces.vertices[face.corners[0] as usize].position;
            all.polygons.push(Polygon {
                first: first as u32,
                count: count as u32,
                face: number as u32,
                front: face.normal.dot(to_eye) > 0.0,
                top,
                bottom,
            });
        }
        all
    }

    fn cut(&mut self, matrix: &DMat4, a: u32, b: u32, t: f32) -> u32 {
        let (a, b) = (self.vertices[a as usize], self.vertices[b as usize]);
        let vertex = Vertex {
            position: a.position.lerp(b.position, t),
            normal: a.normal.lerp(b.normal, t).normalize_or(a.normal),
            uv: a.uv.lerp(b.uv, t),
        };
        self.vertices.push(vertex);
        self.screen.push(project(matrix, vertex.position).1);
        self.vertices.len() as u32 - 1
    }

    /// The corners of a polygon.
    pub fn corners_of(&self, polygon: &Polygon) -> &[u32] {
        &self.corners[polygon.first as usize..][..polygon.count as usize]
    }
}
