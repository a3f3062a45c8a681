//! Shapes, in their own coordinates and placed in the world.

use crate::Motion;
use glam::{Affine3A, Mat3, Vec2, Vec3};

/// A triangle mesh.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Corners.
    pub positions: Vec<Vec3>,
    /// Three corners to a face; counter-clockwise seen from outside.
    pub indices: Vec<[u32; 3]>,
    /// A normal at each corner, for smooth shading.
    pub normals: Option<Vec<Vec3>>,
    /// Texture coordinates at each corner.
    pub uvs: Option<Vec<Vec2>>,
}

/// A shape in its own coordinates.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Triangles.
    Mesh(Mesh),
    /// A sphere.
    Sphere {
        /// Centre.
        center: Vec3,
        /// Radius.
        radius: f32,
        /// How it is turned: from the axes of its texture to those in which it stands.
        turn: Mat3,
    },
}

/// A shape somewhere in the world.
#[derive(Clone, Debug)]
pub struct Placement {
    /// Which shape.
    pub shape: usize,
    /// Where, at every moment.
    pub motion: Motion,
}

/// A sentence on what is wrong with a shape, if anything is.
pub(crate) fn check_shape(shape: &Shape) -> Result<(), String> {
    match shape {
        Shape::Sphere { center, radius, .. } => {
            if center.is_finite() && radius.is_finite() && *radius > 0.0 {
                Ok(())
            } else {
                Err(format!("a sphere needs a finite centre and a radius above 0, not {radius}"))
            }
        }
        Shape::Mesh(mesh) => {
            let corners = mesh.positions.len();
            if mesh.indices.is_empty() {
                return Err("the mesh has no faces".into());
            }
            if let Some(i) = mesh.positions.iter().position(|p| !p.is_finite()) {
                return Err(format!("corner {i} of the mesh is not finite"));
            }
            if let Some(i) = mesh.indices.iter().position(|f| f.iter().any(|&c| c as usize >= corners)) {
                return Err(format!("face {i} names a corner beyond the {corners} that there are"));
            }
            let normals =
                mesh.normals.as_ref().is_none_or(|n| n.len() == corners && n.iter().all(|n| n.is_finite()));
            let uvs = mesh.uvs.as_ref().is_none_or(|t| t.len() == corners && t.iter().all(|t| t.is_finite()));
            if normals && uvs {
                Ok(())
            } else {
                Err(format!(
                    "normals and texture coordinates must be finite, one for each of the {corners} corners"
                ))
            }
        }
    }
}

/// A shape moved into the world.
pub(crate) fn bake(shape: &Shape, transform: &Affine3A) -> Result<Shape, String> {
    match shape {
        Shape::Sphere { center, radius, turn } => {
            let m = transform.matrix3;
            let scales = [m.x_axis.length(), m.y_axis.length(), m.z_axis.length()];
            let largest = scales[0].max(scales[1]).max(scales[2]);
            let skew = m
                .x_axis
                .dot(m.y_axis)
                .abs()
                .max(m.y_axis.dot(m.z_axis).abs())
                .max(m.z_axis.dot(m.x_axis).abs());
            if scales.iter().any(|s| (s - largest).abs() > 1e-4 * largest) || skew > 1e-4 * largest * largest
            {
                return Err("a sphere cannot be scaled unevenly; use a mesh".into());
            }
            // Whether mirrored or turned, evenly scaled axes stay at right angles.
            let turn = Mat3::from(m) * (1.0 / largest) * *turn;
            Ok(Shape::Sphere { center: transform.transform_point3(*center), radius: radius * largest, turn })
        }
        Shape::Mesh(mesh) if *transform == Affine3A::IDENTITY => Ok(Shape::Mesh(mesh.clone())),
        Shape::Mesh(mesh) => {
            let normals = glam::Mat3::from(transform.matrix3).inverse().transpose();
            let mirrored = transform.matrix3.determinant() < 0.0;
            Ok(Shape::Mesh(Mesh {
                positions: mesh.positions.iter().map(|p| transform.transform_point3(*p)).collect(),
                // A mirrored mesh is turned inside out again.
                indices: mesh
                    .indices
                    .iter()
                    .map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] })
                    .collect(),
                normals: mesh
                    .normals
                    .as_ref()
                    .map(|all| all.iter().map(|n| (normals * *n).normalize_or_zero()).collect()),
                uvs: mesh.uvs.clone(),
            }))
        }
    }
}

/// The largest sum of coordinates and edges of any face: what the rounding of a point on it is proportional to.
pub(crate) fn reach(shape: &Shape) -> f32 {
    let Shape::Mesh(mesh) = shape else { return 0.0 };
    let of_face = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|i| mesh.positions[i as usize]);
        (a.abs() + b.abs() + c.abs() + (b - a).abs() + (c - a).abs()).max_element()
    };
    mesh.indices.iter().map(of_face).fold(0.0, f32::max)
}

/// How far below a unit sphere the middle of a facet lies at most: its corners are 2.65° around it.
pub(crate) const FACET_DEPTH: f32 = 1.1e-3;

/// A sphere as facets: 48 parallels and 96 meridians, so that a chord strays from it by 0.05 % of the radius.
pub(crate) fn facets_of_sphere(center: Vec3, radius: f32, turn: Mat3) -> Mesh {
    const ROWS: u32 = 48;
    const COLUMNS: u32 = 96;
    let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    let mut indices = Vec::new();
    for row in 0..=ROWS {
        let (sin, cos) = (std::f32::consts::PI * row as f32 / ROWS as f32).sin_cos();
        for column in 0..=COLUMNS {
            let u = column as f32 / COLUMNS as f32;
            let (s, c) = (std::f32::consts::TAU * (column % COLUMNS) as f32 / COLUMNS as f32).sin_cos();
            let normal = turn * Vec3::new(sin * c, sin * s, cos);
            positions.push(center + normal * radius);
            normals.push(normal);
            uvs.push(Vec2::new(u, row as f32 / ROWS as f32));
        }
    }
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let a = row * (COLUMNS + 1) + column;
            let (b, c, d) = (a + COLUMNS + 1, a + COLUMNS + 2, a + 1);
            if row + 1 < ROWS {
                indices.push([a, b, c]);
            }
            if row > 0 {
                indices.push([a, c, d]);
            }
        }
    }
    if turn.determinant() < 0.0 {
        indices.iter_mut().for_each(|face: &mut [u32; 3]| face.swap(1, 2));
    }
    Mesh { positions, indices, normals: Some(normals), uvs: Some(uvs) }
}
