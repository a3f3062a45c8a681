//! Seconds of a relight: prints what one product with the form factors takes, and what other paints take.
//!
//!     cargo run --release -p illuminant-radiosity --example relight [SIDES] [LAMPS]

#![allow(clippy::print_stdout)]

#[path = "../tests/still_scenes/mod.rs"]
mod still_scenes;

use glam::{Vec3, vec3};
use illuminant_radiosity::{FormFactors, Method, Solver};
use illuminant_scene::{Mesh, Shape};
use std::time::Instant;
use still_scenes::{cut, geometry, inside_of_box, problem};

/// A block whose normals point outside.
fn block(low: Vec3, high: Vec3) -> Shape {
    let corner =
        |i: u32| Vec3::select(glam::BVec3::new(i & 1 == 1, i >> 1 & 1 == 1, i >> 2 & 1 == 1), high, low);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    Shape::Mesh(Mesh {
        positions: (0..8).map(corner).collect(),
        indices: quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect(),
        ..Mesh::default()
    })
}

/// Least, median and worst, ms.
fn timed<T>(times: usize, mut run: impl FnMut(usize) -> T) -> String {
    let mut spent: Vec<f64> = (0..times)
        .map(|i| {
            let start = Instant::now();
            std::hint::black_box(run(i));
            1e3 * start.elapsed().as_secs_f64()
        })
        .collect();
    spent.sort_by(f64::total_cmp);
    format!("{:.2} least, {:.2} median, {:.2} worst ms", spent[0], spent[times / 2], spent[times - 1])
}

fn main() {
    const SAMPLES: usize = 8;
    let number = |at: usize, default: usize| -> usize {
        std::env::args().nth(at).map_or(default, |text| text.parse().unwrap_or(default))
    };
    let (sides, lamps) = (number(1, 9572), number(2, 1));
    let mut shapes = inside_of_box(vec3(5.5, 5.5, 5.6));
    shapes.push(block(vec3(1.0, 0.0, 0.7), vec3(2.6, 1.65, 2.3)));
    shapes.push(block(vec3(3.0, 0.0, 2.5), vec3(4.6, 3.3, 4.1)));
    let geometry = geometry(shapes);
    let area = 6.0 * 5.5 * 5.5 + 35.0;
    let elements = cut(&geometry, area / 0.75 / sides as f64, 0.0, &|_, back| !back);
    let factors = FormFactors::new(&geometry, &elements, Method::Rays(1024));
    let (sides, columns) = (elements.sides.len(), SAMPLES * lamps);
    println!("{sides} sides, {} form factors, {columns} columns", factors.rows.values.len());
    // Sheets of lamps under the ceiling, all of one spectral sample each.
    let light: Vec<f32> = (0..sides as u32)
        .flat_map(|side| {
            let at = elements.element_of(side).centre;
            (0..columns).map(move |i| {
                let (x, lamp) = (at.x - 2.75, (i / SAMPLES) as f32);
                let lit = at.y > 5.49 && (at.z - 1.0 - lamp % 4.0).abs() < 0.5 && x.abs() < 0.7;
                if lit { 1.0 + (i % SAMPLES) as f32 } else { 0.0 }
            })
        })
        .collect();
    let direct = factors.rows.times(&light, columns);
    let paint = |white: f32| -> Vec<f32> {
        (0..sides as u32)
            .flat_map(|side| {
                let element = elements.element_of(side);
                (0..SAMPLES).map(move |i| match element.object {
                    4 => 0.05 + 0.08 * i as f32,
                    5 => 0.6 - 0.07 * i as f32,
                    _ => white + 0.01 * i as f32,
                })
            })
            .collect()
    };
    let spent = timed(30, |_| factors.rows.times(&light, columns));
    println!("product: {spent}");
    for tolerance in [1e-5, 1e-6] {
        let mut steps = Vec::new();
        let spent = timed(12, |i| {
            let reflectance = paint([0.3, 0.5, 0.7, 0.4][i % 4]);
            let mut problem = problem(&elements, &factors, (&reflectance, &direct), SAMPLES);
            problem.tolerance = tolerance;
            let found = problem.solve(Solver::BiCgStab).map(|found| found.history.len()).unwrap_or(0);
            steps.push(found);
        });
        println!("solved to {tolerance:e}: {spent}; steps {steps:?}");
    }
}
