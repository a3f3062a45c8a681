//! Form factors after an object has moved (Baum et al. 1986), and which sides light reaches.

use glam::{Affine3A, Mat3, Vec3, vec3};
use illuminant_radiosity::{Cancel, Elements, FormFactors, Looking, Method, Part, Refinement, reached};
use illuminant_scene::{Geometry, Mesh, Motion, Placement, Shape, embree};

/// A room with a ball in it.
fn room(ball: Vec3) -> Geometry {
    embree::load_from_environment().unwrap();
    let corner = |i: u32| vec3((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32) * 4.0;
    let quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let walls = Mesh {
        positions: (0..8).map(corner).collect(),
        indices: quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..Mesh::default()
    };
    let still = |at: Vec3| Motion::new(vec![Affine3A::from_translation(at)]).unwrap();
    let shapes =
        vec![Shape::Mesh(walls), Shape::Sphere { center: Vec3::ZERO, radius: 0.3, turn: Mat3::IDENTITY }];
    let placements =
        vec![Placement { shape: 0, motion: still(Vec3::ZERO) }, Placement { shape: 1, motion: still(ball) }];
    Geometry::new(shapes, placements, 1).unwrap()
}

#[test]
fn a_moved_object_changes_only_the_rows_that_see_it() {
    let cut = |geometry: &Geometry| {
        let refinement = Refinement { element: 0.3, patch: 0.3 };
        // Inside of the room, outside of the ball.
        Elements::new(geometry, &[Part::Surface; 2], refinement, &|object, back| (object == 1) != back)
    };
    let (before, after) = (room(vec3(1.0, 1.0, 1.0)), room(vec3(1.2, 1.0, 3.0)));
    let (old, new) = (cut(&before), cut(&after));
    assert!(new.is_alike(&old));
    let method = Method::Rays(64);
    let factors = FormFactors::new(&before, &old, method);
    let boxes = [(vec3(0.7, 0.7, 0.7), vec3(1.3, 1.3, 1.3)), (vec3(0.9, 0.7, 2.7), vec3(1.5, 1.3, 3.3))];
    let looking = Looking::new(method).unwrap();
    let cancel = Cancel::default();
    let (updated, rows) = factors.updated(&after, &new, &looking, method, &[1], &boxes, &cancel).unwrap();
    assert!(rows > 0 && rows < new.sides.len(), "{rows} of {}", new.sides.len());
    let whole = FormFactors::new(&after, &new, method);
    assert_eq!(updated.rows, whole.rows);
    cancel.cancel();
    assert!(factors.updated(&after, &new, &looking, method, &[1], &boxes, &cancel).is_err());
}

#[test]
fn light_reaches_the_sides_that_see_it() {
    let geometry = room(vec3(1.0, 1.0, 1.0));
    let coarse = Refinement { element: 0.5, patch: 1.0 };
    let elements = Elements::new(&geometry, &[Part::Surface; 2], coarse, &|_, _| true);
    // A lamp on the wall, inside.
    let lit = |side: u32| {
        let back = elements.sides[side as usize].back;
        let element = elements.element_of(side);
        element.object == 0 && !back && element.centre.z < 1e-3
    };
    let found = reached(&geometry, &elements, &[false; 2], &lit, &Cancel::default()).unwrap();
    let inside_of_room = !elements.sides.iter().enumerate().any(|(s, side)| {
        let element = elements.element_of(s as u32);
        element.object == 0 && !side.back && element.normal.dot(vec3(2.0, 2.0, 2.0) - element.centre) < 0.0
    });
    assert!(inside_of_room);
    // The room from inside, the ball from outside.
    assert_eq!(found, [[true, false], [true, false]]);
}
