//! Solutions from older ones: of the same surfaces in other paints, and after objects have moved (Baum et al. 1986).

use super::cutting::cut;
use super::solution::{Given, LANES, RadiositySolution, prepared, solve};
use super::{direct, reflectance};
use crate::settings::Settings;
use glam::Vec3;
use illuminant_illumination::{Illumination, IlluminationModel, Prepare};
use illuminant_radiosity::{Cancel, Elements, Looking, Points};
use illuminant_scene::Scene;
use std::sync::Arc;
use std::time::Instant;

pub(super) fn repaint<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    old: &RadiositySolution,
    scene: &Scene,
    settings: &Settings,
    cancel: &Cancel,
) -> Result<RadiositySolution, String> {
    let (_, solver) = settings.radiosity.checked()?;
    let start = Instant::now();
    let (passes, ..) = prepared::<M>(illumination, scene, &*old.basis);
    let mut found = old.clone();
    (found.reflectance, found.transmittance) =
        reflectance::of_sides(scene, &old.elements, &passes, old.samples, old.counted, cancel)?;
    // Not from the old light: that would spare a product or two of ten, and the bits would depend on what was painted before.
    let problem = found.problem(settings.radiosity.tolerance);
    let solved = problem.solve_unless_cancelled(solver, cancel).map_err(|e| e.to_string())?;
    (found.irradiance, found.report.history) = (solved.irradiance, solved.history);
    found.report.seconds = [0.0, 0.0, 0.0, start.elapsed().as_secs_f64()];
    found.report.imbalance = found.problem(1e-5).imbalance(&found.irradiance);
    Ok(found)
}

/// The boxes about objects, as far as their elements reach.
fn boxes(elements: &Elements, objects: &[usize]) -> Vec<(Vec3, Vec3)> {
    objects
        .iter()
        .map(|&object| {
            let own = elements.all.iter().filter(|e| e.object as usize == object);
            let (low, high) = own
                .flat_map(|e| elements.corners(e))
                .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
            // What is curved bulges between its corners.
            let bulge = match elements.subdivision.sphere(object as u32) {
                Some((_, radius)) => radius,
                None => 1e-3 * (high - low).max_element(),
            };
            (low - bulge, high + bulge)
        })
        .collect()
}

pub(super) fn shift<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    old: &RadiositySolution,
    scene: &Scene,
    settings: &Settings,
    objects: &[usize],
    cancel: &Cancel,
) -> Result<(RadiositySolution, usize), String> {
    let told = &settings.radiosity;
    let (method, solver) = told.checked()?;
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
    let (passes, ..) = prepared::<M>(illumination, scene, &*old.basis);
    let elements = cut(scene, (told, old.counted), &passes, cancel)?;
    let looking = Looking::new(method).filter(|_| old.specular.is_none());
    let (Some(looking), true) = (looking, elements.is_alike(&old.elements)) else {
        // Elements are others, or ways of rays cannot be compared: all is new.
        let basis = Arc::clone(&old.basis);
        let found = solve::<M>(illumination, scene, settings, basis, Given::Nothing, cancel)?;
        let sides = found.elements.sides.len();
        return Ok((found, sides));
    };
    let mut touched = boxes(&old.elements, objects);
    touched.extend(boxes(&elements, objects));
    let mut found = old.clone();
    found.report.seconds[0] = lap();
    let of_lamps = (&old.column_of[..], old.columns);
    found.direct =
        direct::of_sides(scene, &elements, &passes, of_lamps, old.samples, told.light_samples, cancel)?;
    found.report.seconds[1] = lap();
    let (factors, again) =
        old.factors.updated(&scene.geometry, &elements, &looking, method, objects, &touched, cancel)?;
    found.report.seconds[2] = lap();
    found.points = Arc::new(Points::new(&scene.geometry, &elements));
    (found.elements, found.factors) = (Arc::new(elements), Arc::new(factors));
    let problem = found.problem(told.tolerance);
    let solved = problem.solve_unless_cancelled(solver, cancel).map_err(|e| e.to_string())?;
    (found.irradiance, found.report.history) = (solved.irradiance, solved.history);
    found.report.seconds[3] = lap();
    found.judge();
    Ok((found, again))
}
