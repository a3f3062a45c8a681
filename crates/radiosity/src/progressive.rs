//! Progressive refinement without stored form factors (Cohen, Chen, Wallace and Greenberg 1988).

use crate::elements::Elements;
use crate::form_factors::{Looking, Row};
use crate::rays;
use illuminant_scene::Geometry;

/// How far shooting has come.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Irradiance of sides, direct light included.
    pub irradiance: Vec<f32>,
    /// The part of all light sent by patches that was still to be sent after each shot.
    pub history: Vec<f64>,
    /// What the light still to be sent would add evenly everywhere, in each column: the ambient estimate.
    pub ambient: Vec<f32>,
}

/// Shoots light from the patch that has most of it to all sides that it sees, until a part `tolerance` is left or `most` shots are done.
/// Form factors of one patch at a time are found and forgotten, so memory grows with the number of sides alone.
///
/// Rays of each shooting patch start from its sides by their areas; E_j += B_i A_i F_ij / A_j. `reflectance` has `samples` values for each
/// side, `direct` as many for each lamp.
#[must_use]
pub fn progressive(
    geometry: &Geometry,
    elements: &Elements,
    looking: &Looking,
    (reflectance, direct): (&[f32], &[f32]),
    samples: usize,
    (tolerance, most): (f64, usize),
) -> Shot {
    let columns = direct.len() / elements.sides.len().max(1);
    let patches = elements.patches.len();
    let areas: Vec<f64> = (0..patches as u32).map(|p| elements.patch_area(p)).collect();
    let mut irradiance = direct.to_vec();
    let mut unshot = vec![0f32; patches * columns];
    let mut waiting = vec![0f64; patches];
    let receive = |side: usize, arriving: &[f32], unshot: &mut [f32], waiting: &mut [f64]| {
        let patch = elements.patch_of[side] as usize;
        let share = (elements.area(side as u32) / areas[patch]) as f32;
        for (column, e) in arriving.iter().enumerate() {
            let sent = share * reflectance[side * samples + column % samples] * e;
            unshot[patch * columns + column] += sent;
            waiting[patch] += areas[patch] * f64::from(sent);
        }
    };
    for side in 0..elements.sides.len() {
        receive(side, &direct[side * columns..][..columns], &mut unshot, &mut waiting);
    }
    let all: f64 = waiting.iter().sum();
    let mut history = Vec::new();
    let mut row = Row::new(elements.sides.len());
    let mut arriving = vec![0f32; columns];
    while history.len() < most {
        let left: f64 = waiting.iter().sum();
        if left <= tolerance * all {
            break;
        }
        let Some(shooter) = (0..patches).max_by(|&a, &b| waiting[a].total_cmp(&waiting[b])) else { break };
        let shot: Vec<f32> = unshot[shooter * columns..][..columns].to_vec();
        unshot[shooter * columns..][..columns].fill(0.0);
        waiting[shooter] = 0.0;
        for &side in &elements.patches[shooter] {
            let share = (elements.area(side) / areas[shooter]) as f32;
            rays::directions(geometry, elements, side, looking, &mut |direction| {
                let met = elements.meet(geometry, direction.ray);
                if let Some(met) = met.and_then(|(ray, hit)| elements.side_at(&ray, &hit)) {
                    row.add(met, share * direction.part);
                }
            });
        }
        for (side, factor) in row.take() {
            let scale = (f64::from(factor) * areas[shooter] / elements.area(side)) as f32;
            for (column, (a, b)) in arriving.iter_mut().zip(&shot).enumerate() {
                *a = scale * b;
                irradiance[side as usize * columns + column] += *a;
            }
            receive(side as usize, &arriving, &mut unshot, &mut waiting);
        }
        history.push(if all > 0.0 { waiting.iter().sum::<f64>() / all } else { 0.0 });
    }
    let ambient = ambient(elements, &areas, &unshot, reflectance, (samples, columns));
    Shot { irradiance, history, ambient }
}

/// What unshot light would make of irradiance if it were sent evenly about: Σ ΔB_i A_i / Σ A_i, reflected again and again with the
/// mean reflectance (Cohen et al. 1988, eq 8).
fn ambient(
    elements: &Elements,
    areas: &[f64],
    unshot: &[f32],
    reflectance: &[f32],
    (samples, columns): (usize, usize),
) -> Vec<f32> {
    let total: f64 = areas.iter().sum();
    let mean = |sample: usize| {
        let sum: f64 = (0..elements.sides.len())
            .map(|side| elements.area(side as u32) * f64::from(reflectance[side * samples + sample]))
            .sum();
        sum / total.max(f64::MIN_POSITIVE)
    };
    let interreflected: Vec<f64> = (0..samples).map(|s| 1.0 / (1.0 - mean(s).min(0.99))).collect();
    (0..columns)
        .map(|column| {
            let sum: f64 =
                areas.iter().enumerate().map(|(p, a)| a * f64::from(unshot[p * columns + column])).sum();
            (interreflected[column % samples] * sum / total.max(f64::MIN_POSITIVE)) as f32
        })
        .collect()
}
