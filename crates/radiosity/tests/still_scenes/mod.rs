//! Scenes of shapes that stand as they are, and problems of radiosity on them.

use glam::{Affine3A, Vec3};
use illuminant_radiosity::{Elements, FormFactors, Part, Problem, Refinement};
use illuminant_scene::{Geometry, Mesh, Motion, Placement, Shape, embree};

#[allow(dead_code)] // not every test needs all
pub fn geometry(shapes: Vec<Shape>) -> Geometry {
    embree::load_from_environment().unwrap();
    let still = || Motion::new(vec![Affine3A::IDENTITY]).unwrap();
    let placements = (0..shapes.len()).map(|shape| Placement { shape, motion: still() }).collect();
    Geometry::new(shapes, placements, 1).unwrap()
}

/// A rectangle from a corner along two edges; its normal is their cross product.
#[allow(dead_code)] // not every test needs all
pub fn rectangle(corner: Vec3, a: Vec3, b: Vec3) -> Shape {
    Shape::Mesh(Mesh {
        positions: vec![corner, corner + a, corner + a + b, corner + b],
        indices: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    })
}

/// A box of six rectangles whose normals point inside: pairs along z, y and x.
#[allow(dead_code)] // not every test needs all
pub fn inside_of_box(size: Vec3) -> Vec<Shape> {
    let [x, y, z] = [Vec3::X * size.x, Vec3::Y * size.y, Vec3::Z * size.z];
    vec![
        rectangle(Vec3::ZERO, x, y),
        rectangle(z, y, x),
        rectangle(Vec3::ZERO, z, x),
        rectangle(y, x, z),
        rectangle(Vec3::ZERO, y, z),
        rectangle(x, z, y),
    ]
}

#[allow(dead_code)] // not every test needs all
pub fn cut(geometry: &Geometry, element: f64, patch: f64, lit: &dyn Fn(usize, bool) -> bool) -> Elements {
    let parts = vec![Part::Surface; geometry.objects()];
    Elements::new(geometry, &parts, Refinement { element, patch }, lit)
}

/// A problem of surfaces that let nothing through, without mirrors.
#[allow(dead_code)] // not every test needs all
pub fn problem<'a>(
    elements: &'a Elements,
    factors: &'a FormFactors,
    (reflectance, direct): (&'a [f32], &'a [f32]),
    samples: usize,
) -> Problem<'a> {
    Problem {
        elements,
        factors,
        specular: None,
        reflectance,
        transmittance: &[],
        direct,
        samples,
        tolerance: 1e-6,
    }
}
