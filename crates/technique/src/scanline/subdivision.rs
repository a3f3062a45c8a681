//! Subdivision of polygons towards the size of a pixel: the remedy for what interpolation over large polygons misses (book 4.2.4).
//!
//! An edge that is long on the screen is cut in its middle, whichever triangle asks first, until none is longer than the square root
//! of twice the area; then no triangle has more than 0.87 of that area. Both triangles at an edge find the same middle, so no cracks
//! open. Triangles that the camera does not see stay whole. Normals and texture coordinates in the middle are the means of the
//! ends'; the middle of an edge of a sphere lies on the sphere.

use super::surfaces::{Face, Surfaces, Vertex};
use glam::{DMat4, DVec4};
use illuminant_scene::{Camera, Scene};
use std::collections::HashMap;

/// How often a triangle is halved at most: only one that goes through the eye itself would go on.
const MOST: u8 = 48;

/// What the camera sees of a vertex.
struct Seen {
    matrix: DMat4,
    /// The crop with a margin for the filter.
    area: [f64; 4],
    vertices: Vec<DVec4>,
}

impl Seen {
    /// Whether a triangle is wholly beyond one of the planes that bound what is seen.
    fn is_outside(&self, corners: [u32; 3]) -> bool {
        let [left, top, right, bottom] = self.area;
        let beyond =
            |plane: &dyn Fn(&DVec4) -> f64| corners.iter().all(|&i| plane(&self.vertices[i as usize]) < 0.0);
        beyond(&|p| p.w)
            || beyond(&|p| p.x - left * p.w)
            || beyond(&|p| right * p.w - p.x)
            || beyond(&|p| p.y - top * p.w)
            || beyond(&|p| bottom * p.w - p.y)
    }

    /// The squares of the length of an edge on the screen, infinite where it goes behind the eye, and of that before the perspective.
    fn lengths_squared(&self, a: u32, b: u32) -> [f64; 2] {
        let (a, b) = (self.vertices[a as usize], self.vertices[b as usize]);
        let before = a.distance_squared(b);
        if a.w <= 0.0 || b.w <= 0.0 {
            return [f64::INFINITY, before];
        }
        let [dx, dy] = [a.x / a.w - b.x / b.w, a.y / a.w - b.y / b.w];
        [dx * dx + dy * dy, before]
    }
}

impl Surfaces {
    /// Subdivides what a camera sees into triangles of at most `area` pixels.
    pub fn subdivide(&mut self, scene: &Scene, camera: &Camera, margin: f32, area: f64) {
        let matrix = camera.matrix();
        let project = |v: &Vertex| matrix * v.position.as_dvec3().extend(1.0);
        let vertices = self.vertices.iter().map(project).collect();
        let [left, top, right, bottom] = camera.crop.map(f64::from);
        let margin = f64::from(margin) + 1.0;
        let area_seen = [left - margin, top - margin, right + margin, bottom + margin];
        let mut seen = Seen { matrix, area: area_seen, vertices };
        let longest = 2.0 * area;
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut left: Vec<(Face, u8)> = std::mem::take(&mut self.faces).into_iter().map(|f| (f, 0)).collect();
        left.reverse();
        while let Some((face, times)) = left.pop() {
            let edge = |k: usize| {
                let (a, b) = (face.corners[k], face.corners[(k + 1) % 3]);
                (seen.lengths_squared(a, b), (a.min(b), a.max(b)), k)
            };
            let longer = |a: &([f64; 2], (u32, u32), usize), b: &([f64; 2], (u32, u32), usize)| {
                let [on_screen, before] = [0, 1].map(|i| a.0[i].total_cmp(&b.0[i]));
                on_screen.then(before).then(a.1.cmp(&b.1))
            };
            let longest_edge = [edge(0), edge(1), edge(2)].into_iter().max_by(longer);
            let Some(([length, _], ends, k)) = longest_edge else { continue };
            if times == MOST || length <= longest || seen.is_outside(face.corners) {
                self.faces.push(face);
                continue;
            }
            let sphere = scene.geometry.sphere(face.object as usize);
            let middle = *middles.entry(ends).or_insert_with(|| {
                let vertex = middle(&self.vertices[ends.0 as usize], &self.vertices[ends.1 as usize], sphere);
                seen.vertices.push(seen.matrix * vertex.position.as_dvec3().extend(1.0));
                self.vertices.push(vertex);
                self.vertices.len() as u32 - 1
            });
            let [a, b, c] = [0, 1, 2].map(|i| face.corners[(k + i) % 3]);
            // The second half first, so that halves are taken in their order.
            for corners in [[middle, b, c], [a, middle, c]] {
                let normal = match sphere {
                    Some(_) => {
                        let [p, q, r] = corners.map(|i| self.vertices[i as usize].position);
                        (q - p).cross(r - p).normalize_or(face.normal)
                    }
                    None => face.normal,
                };
                left.push((Face { corners, normal, ..face }, times + 1));
            }
        }
    }
}

/// The middle of an edge.
fn middle(a: &Vertex, b: &Vertex, sphere: Option<(glam::Vec3, f32)>) -> Vertex {
    let normal = (a.normal + b.normal).normalize_or(a.normal);
    let position = match sphere {
        Some((center, radius)) => center + normal * radius,
        None => (a.position + b.position) * 0.5,
    };
    Vertex { position, normal, uv: (a.uv + b.uv) * 0.5 }
}
