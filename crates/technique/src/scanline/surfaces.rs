//! All surfaces of a scene as triangles in the world.

use glam::{Vec2, Vec3};
use illuminant_scene::Scene;

/// A corner in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub position: Vec3,
    /// Unit, for shading.
    pub normal: Vec3,
    /// Texture coordinates; 0 where there are none.
    pub uv: Vec2,
}

/// A triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    pub corners: [u32; 3],
    pub object: u32,
    /// Unit geometric normal, to the outside.
    pub normal: Vec3,
}

/// The triangles of a scene at one moment; spheres are cut into facets.
#[derive(Clone, Debug, Default)]
pub(crate) struct Surfaces {
    pub vertices: Vec<Vertex>,
    pub faces: Vec<Face>,
}

impl Surfaces {
    /// Gathers what a scene holds. A corner without a normal of its own takes that of its triangle.
    pub fn gather(scene: &Scene, time: f32) -> Self {
        let mut all = Self::default();
        for object in 0..scene.objects.len() {
            let mesh = scene.geometry.world_mesh(object, time);
            let first = all.vertices.len() as u32;
            let smooth = mesh.normals.as_ref();
            let uv = |i: usize| mesh.uvs.as_ref().map_or(Vec2::ZERO, |uvs| uvs[i]);
            if let Some(normals) = smooth {
                let vertices = mesh.positions.iter().zip(normals).enumerate();
                all.vertices.extend(vertices.map(|(i, (&position, &normal))| Vertex {
                    position,
                    normal,
                    uv: uv(i),
                }));
            }
            for face in &mesh.indices {
                let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
                let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
                let corners = if smooth.is_some() {
                    face.map(|i| first + i)
                } else {
                    let next = all.vertices.len() as u32;
                    all.vertices.extend(face.map(|i| Vertex {
                        position: mesh.positions[i as usize],
                        normal,
                        uv: uv(i as usize),
                    }));
                    [next, next + 1, next + 2]
                };
                all.faces.push(Face { corners, object: object as u32, normal });
            }
        }
        all
    }
}
