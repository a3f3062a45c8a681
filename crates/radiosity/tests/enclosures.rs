//! Closed enclosures against their algebraic solutions.

mod still_scenes;

use glam::{Mat3, Vec3, vec3};
use illuminant_radiosity::{FormFactors, Looking, Method, Solver, progressive};
use illuminant_scene::{Mesh, Shape};
use still_scenes::{cut, geometry, inside_of_box, problem};

fn sphere(radius: f32) -> Shape {
    Shape::Sphere { center: vec3(1.0, -2.0, 0.5), radius, turn: Mat3::IDENTITY }
}

const METHODS: [Method; 4] =
    [Method::Rays(1024), Method::Hemicube(100), Method::Scanline(100), Method::Area(8)];

/// E_i and ρ_i of a sphere's parts: below, about and above the middle.
const PARTS: [(f32, f32); 3] = [(1.0, 0.2), (0.0, 0.8), (3.0, 0.5)];

#[test]
fn a_sphere_of_different_parts_is_lit_evenly() {
    let radius = 2.0f32;
    let geometry = geometry(vec![sphere(radius)]);
    let elements = cut(&geometry, 0.06, 0.06, &|_, back| back);
    let total: f64 = elements.total_area();
    let exact = 4.0 * std::f64::consts::PI * f64::from(radius * radius);
    assert!((total / exact - 1.0).abs() < 1e-5, "{total} {exact}");
    let part_of = |side: u32| {
        let z = elements.element_of(side).centre.z - 0.5;
        if z < -0.5 { 0 } else { usize::from(z > 0.8) + 1 }
    };
    let sides = 0..elements.sides.len() as u32;
    let mut fraction = [0f64; 3];
    sides.clone().for_each(|s| fraction[part_of(s)] += elements.area(s) / total);
    // All see the same: H = Σ a E / (1 − Σ a ρ).
    let (mut sent, mut kept) = (0.0, 0.0);
    for (part, a) in fraction.iter().enumerate() {
        sent += a * f64::from(PARTS[part].0);
        kept += a * f64::from(PARTS[part].1);
    }
    let irradiance = sent / (1.0 - kept);
    for method in METHODS {
        // The emission reaches others by form factors alone: the light of the first step.
        let factors = FormFactors::new(&geometry, &elements, method);
        assert!(factors.closure()[0] < 0.005, "{method}: {:?} {:?}", factors.closure(), &factors.open[..20]);
        let reflectance: Vec<f32> = sides.clone().map(|s| PARTS[part_of(s)].1).collect();
        let emission: Vec<f32> =
            (0..elements.patches.len()).map(|p| PARTS[part_of(elements.patches[p][0])].0).collect();
        let direct = factors.rows.times(&emission, 1);
        let problem = problem(&elements, &factors, (&reflectance, &direct), 1);
        let found = problem.solve(Solver::BiCgStab).unwrap().irradiance;
        let mut mean = [0f64; 3];
        for side in sides.clone() {
            mean[part_of(side)] += elements.area(side) / total * f64::from(found[side as usize]);
        }
        for part in 0..3 {
            let h = mean[part] / fraction[part];
            let (e, r) = (f64::from(PARTS[part].0), f64::from(PARTS[part].1));
            let (b, exact) = (e + r * h, e + r * irradiance);
            assert!((b / exact - 1.0).abs() < 0.005, "{method} part {part}: {b} {exact}");
        }
        assert!(factors.closure()[0] < 0.005, "{method}: {:?}", factors.closure());
    }
}

#[test]
fn a_closed_box_of_one_paint_holds_e_over_1_minus_rho() {
    let geometry = geometry(inside_of_box(vec3(3.0, 2.0, 1.0)));
    let elements = cut(&geometry, 0.2, 0.2, &|_, back| !back);
    for method in METHODS {
        let factors = FormFactors::new(&geometry, &elements, method);
        let sides = elements.sides.len();
        // Two spectral samples.
        let reflectance: Vec<f32> = (0..sides).flat_map(|_| [0.5, 0.9]).collect();
        let emission: Vec<f32> = (0..elements.patches.len()).flat_map(|_| [1.0, 2.0]).collect();
        let direct = factors.rows.times(&emission, 2);
        let problem = problem(&elements, &factors, (&reflectance, &direct), 2);
        for solver in Solver::ALL {
            let found = problem.solve(solver).unwrap();
            // Rows that miss a part e of 1 make an error of e/(1 − ρ).
            let closure = factors.closure()[1];
            for e in found.irradiance.chunks(2) {
                for (i, (h, exact)) in e.iter().zip([1.0 / 0.5, 2.0 / 0.1]).enumerate() {
                    let limit = 0.005f64.max(closure / [0.5, 0.1][i]);
                    assert!((f64::from(*h) / exact - 1.0).abs() < limit, "{method} {solver}: {h} {exact}");
                }
            }
            assert!(problem.imbalance(&found.irradiance) < 0.02, "{method} {solver}");
        }
    }
}

#[test]
fn solvers_agree() {
    let geometry = geometry(inside_of_box(vec3(3.0, 2.0, 1.0)));
    let elements = cut(&geometry, 0.1, 0.5, &|_, back| !back);
    assert!(elements.patches.len() * 3 < elements.sides.len());
    let factors = FormFactors::new(&geometry, &elements, Method::Rays(256));
    let sides = elements.sides.len();
    let reflectance: Vec<f32> = (0..sides).flat_map(|s| [0.2 + 0.6 * (s % 7) as f32 / 7.0, 0.9]).collect();
    // Two lamps of two samples.
    let direct: Vec<f32> = (0..4 * sides).map(|i| if i % 11 == 0 { 3.0 } else { 0.1 }).collect();
    let problem = problem(&elements, &factors, (&reflectance, &direct), 2);
    let exact = problem.solve(Solver::Gauss).unwrap().irradiance;
    for solver in Solver::ALL {
        let found = problem.solve(solver).unwrap();
        let worst = found.irradiance.iter().zip(&exact).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-4, "{solver}: {worst}");
    }
    // Shooting without stored form factors has form factors of its own.
    let looking = Looking::new(Method::Rays(512)).unwrap();
    let shot = progressive(&geometry, &elements, &looking, (&reflectance, &direct), 2, (1e-4, 100_000));
    let sums = |values: &[f32]| -> f64 {
        (0..sides).map(|s| elements.area(s as u32) * f64::from(values[4 * s + 1])).sum()
    };
    assert!((sums(&shot.irradiance) / sums(&exact) - 1.0).abs() < 0.01);
    // What is left, taken for ambient light, is small beside what has been shot; early it is most of the rest.
    let early = progressive(&geometry, &elements, &looking, (&reflectance, &direct), 2, (1e-4, 20));
    let estimate = sums(&early.irradiance) + f64::from(early.ambient[1]) * elements.total_area();
    let without = (sums(&early.irradiance) / sums(&exact) - 1.0).abs();
    let with = (estimate / sums(&exact) - 1.0).abs();
    assert!(with < 0.3 * without, "{with} {without}");
}

#[test]
fn a_surface_that_creates_light_is_refused() {
    let geometry = geometry(vec![sphere(1.0)]);
    let elements = cut(&geometry, 1.0, 1.0, &|_, back| back);
    let factors = FormFactors::new(&geometry, &elements, Method::Rays(16));
    let sides = elements.sides.len();
    let (reflectance, direct) = (vec![1.2; sides], vec![1.0; sides]);
    let problem = problem(&elements, &factors, (&reflectance, &direct), 1);
    assert!(problem.solve(Solver::BiCgStab).unwrap_err().to_string().contains("more light"));
}

#[test]
fn triangles_without_area_are_nothing() {
    // A wall in three triangles of which one is a line and one a point.
    let mut shapes = inside_of_box(vec3(3.0, 2.0, 1.0));
    let positions = vec![Vec3::ZERO, Vec3::X * 3.0, vec3(3.0, 2.0, 0.0), Vec3::Y * 2.0, Vec3::X];
    let indices = vec![[0, 1, 2], [0, 4, 1], [3, 3, 3], [0, 2, 3], [1, 1, 2]];
    shapes[0] = Shape::Mesh(Mesh { positions, indices, ..Mesh::default() });
    let geometry = geometry(shapes);
    let elements = cut(&geometry, 0.1, 0.1, &|_, back| !back);
    assert!((elements.total_area() - 22.0).abs() < 1e-4);
    let factors = FormFactors::new(&geometry, &elements, Method::Rays(64));
    let (reflectance, direct) = (vec![0.5; elements.sides.len()], vec![1.0; elements.sides.len()]);
    let found = problem(&elements, &factors, (&reflectance, &direct), 1).solve(Solver::BiCgStab).unwrap();
    assert!(found.irradiance.iter().all(|e| (e - 2.0).abs() < 0.02));
}
