//! Form factors of every method against closed forms, and enclosures with closed-form factors.

mod still_scenes;

use glam::{Vec3, vec3};
use illuminant_radiosity::form_factor::{
    coaxial_discs, parallel_rectangles, perpendicular_rectangles, point_to_disc,
};
use illuminant_radiosity::{Elements, FormFactors, Method, Problem, Solver, Sparse};
use illuminant_scene::{Mesh, Shape};
use still_scenes::{cut, geometry, inside_of_box, problem, rectangle};

const SIZE: [f64; 3] = [3.0, 2.0, 1.0];

fn walls() -> Vec<Shape> {
    inside_of_box(Vec3::from(SIZE.map(|v| v as f32)))
}

/// The form factor from wall i to wall j.
fn exact(i: usize, j: usize) -> f64 {
    let axis = |wall: usize| 2 - wall / 2;
    if i == j {
        return 0.0;
    }
    let (a, b) = (axis(i), axis(j));
    if a == b {
        let [u, v] = [(a + 1) % 3, (a + 2) % 3];
        return parallel_rectangles(SIZE[u], SIZE[v], SIZE[a]);
    }
    // The common edge runs along the third axis.
    perpendicular_rectangles(SIZE[3 - a - b], SIZE[b], SIZE[a])
}

fn disc(radius: f32, z: f32) -> Shape {
    let count = 256u32;
    let mut positions = vec![vec3(0.0, 0.0, z)];
    positions.extend((0..count).map(|i| {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / count as f32).sin_cos();
        vec3(radius * cos, radius * sin, z)
    }));
    let indices = (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect();
    Shape::Mesh(Mesh { positions, indices, ..Mesh::default() })
}

/// Form factors between objects: means of their sides' rows by area.
fn between(elements: &Elements, factors: &FormFactors, objects: usize) -> Vec<Vec<f64>> {
    let mut sums = vec![vec![0.0; objects]; objects];
    let mut areas = vec![0.0; objects];
    for side in 0..elements.sides.len() as u32 {
        let (own, area) = (elements.element_of(side).object as usize, elements.area(side));
        areas[own] += area;
        let (columns, values) = factors.rows.row(side as usize);
        for (&patch, &value) in columns.iter().zip(values) {
            let other = elements.element_of(elements.patches[patch as usize][0]).object as usize;
            sums[own][other] += area * f64::from(value);
        }
    }
    sums.iter_mut().zip(&areas).for_each(|(row, area)| row.iter_mut().for_each(|f| *f /= area));
    sums
}

#[test]
fn a_finer_look_comes_nearer_to_the_closed_forms() {
    let geometry = geometry(walls());
    // Relative errors, root mean square over all pairs of walls, that each method keeps below.
    let bounds = [
        (Method::Rays(64), 0.02),
        (Method::Rays(1024), 0.004),
        (Method::Hemicube(20), 0.06),
        (Method::Hemicube(100), 0.03),
        (Method::Scanline(20), 0.06),
        (Method::Scanline(100), 0.03),
        (Method::Area(1), 0.03),
        (Method::Area(16), 0.005),
    ];
    let elements = cut(&geometry, 0.05, 0.05, &|_, back| !back);
    for (method, bound) in bounds {
        let found = between(&elements, &FormFactors::new(&geometry, &elements, method), 6);
        let mut square = 0.0;
        for (i, row) in found.iter().enumerate() {
            for (j, factor) in row.iter().enumerate().filter(|&(j, _)| j != i) {
                square += (factor / exact(i, j) - 1.0).powi(2) / 30.0;
            }
            assert!(row[i].abs() < 1e-6, "{method}: a flat wall sees itself");
        }
        assert!(square.sqrt() < bound, "{method}: {}", square.sqrt());
    }
}

#[test]
fn discs_see_each_other_by_the_closed_form() {
    // The polygon of 256 sides is 1e-4 smaller than the circle.
    let (a, b, d) = (1.0, 1.5, 0.8);
    let geometry = geometry(vec![disc(a, 0.0), disc(b, d)]);
    let elements = cut(&geometry, 0.02, 0.02, &|object, back| (object == 0) != back);
    let (a, b, d) = (f64::from(a), f64::from(b), f64::from(d));
    for method in [Method::Rays(512), Method::Area(4)] {
        let found = between(&elements, &FormFactors::new(&geometry, &elements, method), 2);
        let (up, down) = (coaxial_discs(a, b, d), coaxial_discs(b, a, d));
        assert!((found[0][1] / up - 1.0).abs() < 0.005, "{method}: {} {up}", found[0][1]);
        assert!((found[1][0] / down - 1.0).abs() < 0.005, "{method}: {} {down}", found[1][0]);
    }
    assert!((point_to_disc(b, d) - coaxial_discs(1e-5, b, d)).abs() < 1e-8);
}

#[test]
fn closed_form_factors_make_exact_enclosures() {
    let geometry = geometry(walls());
    // The two triangles of each wall, as they are.
    let elements = cut(&geometry, 1e9, 1e9, &|_, back| !back);
    assert_eq!(elements.sides.len(), 12);
    let wall = |side: u32| elements.element_of(side).object as usize;
    let rows: Vec<Vec<(u32, f32)>> = (0..12u32)
        .map(|i| {
            let other = |j: u32| (j, (0.5 * exact(wall(i), wall(j))) as f32);
            (0..12u32).filter(|&j| wall(j) != wall(i)).map(other).collect()
        })
        .collect();
    let factors = FormFactors::from_rows(Sparse::from_rows(&rows, 12));
    assert!(factors.closure()[1] < 1e-6 && factors.reciprocity(&elements) < 1e-6);
    // B = E/(1 − ρ) where all is one paint, in two samples at once.
    let (rho, emitted) = ([0.3f32, 0.95], [2.0f32, 1.0]);
    let emission: Vec<f32> = (0..12).flat_map(|_| emitted).collect();
    let direct = factors.rows.times(&emission, 2);
    let reflectance: Vec<f32> = (0..12).flat_map(|_| rho).collect();
    let problem = problem(&elements, &factors, (&reflectance, &direct), 2);
    for solver in Solver::ALL {
        let found = problem.solve(solver).unwrap().irradiance;
        for h in found.chunks(2) {
            for s in 0..2 {
                let b = f64::from(emitted[s] + rho[s] * h[s]);
                let exact = f64::from(emitted[s]) / (1.0 - f64::from(rho[s]));
                assert!((b / exact - 1.0).abs() < 1e-4, "{solver}: {b} {exact}");
            }
        }
        assert!(problem.imbalance(&found) < 1e-4, "{solver}");
    }
}

#[test]
fn a_sheet_sends_to_either_side_what_the_other_lets_through() {
    // Two rooms of one paint with a sheet between them: light is made in the first alone.
    let mut shapes = walls();
    let middle = vec3(1.5, 0.0, 0.0);
    shapes.push(rectangle(middle, Vec3::Y * 2.0, Vec3::Z));
    let geometry = geometry(shapes);
    let elements = cut(&geometry, 0.2, 0.2, &|object, back| object == 6 || !back);
    let factors = FormFactors::new(&geometry, &elements, Method::Rays(1024));
    let (rho, through) = (0.6f32, 0.3f32);
    let sheet = |side: u32| elements.element_of(side).object == 6;
    let sides = 0..elements.sides.len() as u32;
    let first = |side: u32| {
        let (at, back) = (elements.element_of(side).centre.x, elements.sides[side as usize].back);
        if sheet(side) { back } else { at < 1.5 }
    };
    // Even light: what makes the irradiance of all sides of a room the same, and none in the other, at first.
    let direct: Vec<f32> = sides.clone().map(|s| f32::from(u8::from(first(s)))).collect();
    let reflectance = vec![rho; elements.sides.len()];
    let transmittance: Vec<f32> = sides.clone().map(|s| if sheet(s) { through } else { 0.0 }).collect();
    let without = problem(&elements, &factors, (&reflectance, &direct), 1);
    let problem = Problem { transmittance: &transmittance, ..without };
    let reference = problem.solve(Solver::Gauss).unwrap().irradiance;
    for solver in Solver::ALL {
        let found = problem.solve(solver).unwrap().irradiance;
        let worst = found.iter().zip(&reference).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-3, "{solver}: {worst}");
        assert!(problem.imbalance(&found) < 0.01, "{solver}: {}", problem.imbalance(&found));
    }
    // The other room has all of its light from the sheet.
    let dark: Vec<f32> = sides.filter(|&s| !first(s)).map(|s| reference[s as usize]).collect();
    assert!(dark.iter().all(|e| *e > 0.0));
    let without = without.solve(Solver::Gauss).unwrap().irradiance;
    assert!(elements.sides.iter().enumerate().all(|(s, _)| first(s as u32) || without[s] == 0.0));
}
