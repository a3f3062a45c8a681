//! Other paints on form factors that are known, and work that is told to stop.

mod still_scenes;

use glam::vec3;
use illuminant_radiosity::{Cancel, Cancelled, Elements, FormFactors, Method, SolveError, Solver};
use illuminant_scene::Geometry;
use still_scenes::{cut, geometry, inside_of_box, problem};

const SAMPLES: usize = 8;
/// Two lamps in the samples of a register, and one sample that is left over.
const WIDTHS: [usize; 2] = [2 * SAMPLES, 1];

fn room() -> (Geometry, Elements) {
    let geometry = geometry(inside_of_box(vec3(3.0, 2.0, 2.5)));
    let elements = cut(&geometry, 0.02, 0.06, &|_, back| !back);
    (geometry, elements)
}

/// Walls of the first object in a paint of their own.
fn paint(elements: &Elements, samples: usize, own: f32) -> Vec<f32> {
    let of = |side| if elements.element_of(side).object == 0 { own } else { 0.75 };
    let row = |side| (0..samples).map(move |i| (side, i as f32 / samples as f32));
    (0..elements.sides.len() as u32).flat_map(row).map(|(side, part)| of(side) * (1.0 - 0.5 * part)).collect()
}

/// A lamp under the ceiling, and another one in a corner.
fn light(elements: &Elements, columns: usize) -> Vec<f32> {
    let lit = |side: u32, column: usize| {
        let at = elements.element_of(side).centre;
        let near = if column < SAMPLES { vec3(1.5, 2.0, 1.2) } else { vec3(0.0, 0.0, 0.0) };
        (1.0 - at.distance(near)).max(0.0)
    };
    (0..elements.sides.len() as u32)
        .flat_map(|side| (0..columns).map(move |column| lit(side, column)))
        .collect()
}

#[test]
fn a_relit_solution_is_that_of_new_form_factors_on_any_number_of_threads() {
    let (geometry, elements) = room();
    let method = Method::Rays(256);
    let kept = FormFactors::new(&geometry, &elements, method);
    for columns in WIDTHS {
        let samples = columns.min(SAMPLES);
        let direct = light(&elements, columns);
        let before = paint(&elements, samples, 0.8);
        problem(&elements, &kept, (&before, &direct), samples).solve(Solver::BiCgStab).unwrap();
        let after = paint(&elements, samples, 0.3);
        let relit = problem(&elements, &kept, (&after, &direct), samples).solve(Solver::BiCgStab).unwrap();
        assert!(relit.history[0] == 1.0 && relit.history[relit.history.len() - 1] <= 1e-6);
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let fresh = pool.install(|| {
                let factors = FormFactors::new(&geometry, &elements, method);
                problem(&elements, &factors, (&after, &direct), samples).solve(Solver::BiCgStab).unwrap()
            });
            assert_eq!(fresh.history, relit.history, "{threads} threads");
            let same =
                fresh.irradiance.iter().zip(&relit.irradiance).all(|(a, b)| a.to_bits() == b.to_bits());
            assert!(same, "{columns} columns, {threads} threads");
        }
        // And it is the solution: E = H + F P ρ E, in numbers of 64 bits.
        let (sides, width) = (elements.sides.len(), columns);
        let mut sent = vec![0f64; elements.patches.len() * width];
        for side in 0..sides {
            let patch = elements.patch_of[side];
            let share = elements.area(side as u32) / elements.patch_area(patch);
            for column in 0..width {
                let reflected =
                    after[side * samples + column % samples] * relit.irradiance[side * width + column];
                sent[patch as usize * width + column] += share * f64::from(reflected);
            }
        }
        for side in 0..sides {
            let (patches, values) = kept.rows.row(side);
            for column in 0..width {
                let seen = patches.iter().zip(values);
                let light =
                    seen.map(|(&p, &f)| f64::from(f) * sent[p as usize * width + column]).sum::<f64>();
                let exact = f64::from(direct[side * width + column]) + light;
                let found = f64::from(relit.irradiance[side * width + column]);
                assert!(
                    (found - exact).abs() < 1e-5 * exact,
                    "side {side}, column {column}: {found} {exact}"
                );
            }
        }
    }
}

#[test]
fn no_light_is_no_light() {
    let (geometry, elements) = room();
    let factors = FormFactors::new(&geometry, &elements, Method::Rays(16));
    let direct = vec![0.0; elements.sides.len() * SAMPLES];
    let paint = paint(&elements, SAMPLES, 0.5);
    for solver in [Solver::GaussSeidel, Solver::Progressive, Solver::BiCgStab] {
        let found = problem(&elements, &factors, (&paint, &direct), SAMPLES).solve(solver).unwrap();
        assert!(found.irradiance.iter().all(|e| *e == 0.0), "{solver}");
    }
}

#[test]
fn what_is_cancelled_has_no_result() {
    let (geometry, elements) = room();
    let method = Method::Rays(64);
    let cancel = Cancel::default();
    let factors = FormFactors::unless_cancelled(&geometry, &elements, method, &cancel).unwrap();
    let (direct, paint) = (light(&elements, SAMPLES), paint(&elements, SAMPLES, 0.5));
    let problem = problem(&elements, &factors, (&paint, &direct), SAMPLES);
    let whole = problem.solve_unless_cancelled(Solver::BiCgStab, &cancel).unwrap();
    assert_eq!(whole.irradiance, problem.solve(Solver::BiCgStab).unwrap().irradiance);
    // From another thread, by a clone.
    let other = cancel.clone();
    std::thread::spawn(move || other.cancel()).join().unwrap();
    for solver in Solver::ALL {
        let refused = problem.solve_unless_cancelled(solver, &cancel).unwrap_err();
        assert_eq!(refused, SolveError::Cancelled(Cancelled), "{solver}");
        assert_eq!(refused.to_string(), "the solution was cancelled");
    }
    for method in [method, Method::Hemicube(64), Method::Scanline(64), Method::Area(16)] {
        assert!(FormFactors::unless_cancelled(&geometry, &elements, method, &cancel).is_err(), "{method}");
    }
}

#[test]
fn long_work_stops_soon_after_it_is_cancelled() {
    let (geometry, elements) = room();
    let cancel = Cancel::default();
    let other = cancel.clone();
    let waiting = std::thread::spawn(move || {
        std::thread::sleep(std::time::Duration::from_millis(50));
        other.cancel();
        std::time::Instant::now()
    });
    // Minutes of work.
    let refused = FormFactors::unless_cancelled(&geometry, &elements, Method::Rays(1 << 17), &cancel);
    let stopped = std::time::Instant::now();
    assert!(refused.is_err());
    let late = stopped.duration_since(waiting.join().unwrap()).as_secs_f64();
    assert!(late < 5.0, "{late} s");
}
