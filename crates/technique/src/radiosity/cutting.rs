//! How the surfaces of a scene are cut into elements, and on which of their sides light is solved for.

use super::direct::{self, of_sides};
use super::reflectance::{Counted, is_clear};
use super::settings::RadiositySettings;
use crate::lanes::Pass;
use illuminant_illumination::{IlluminationModel, Prepare, Surface};
use illuminant_radiosity::{Cancel, Cancelled, Elements, Part, Refinement, Subdivision, reached};
use illuminant_scene::Scene;
use rayon::prelude::*;

/// Elements that tell which sides of objects light reaches.
const COARSE: f64 = 3000.0;
/// How often elements may be cut again.
const ROUNDS: usize = 8;

/// What each object is to the exchange of light: where mirrors and glass are followed, what has nothing diffuse stands apart.
fn parts(scene: &Scene, counted: Counted) -> Vec<Part> {
    let part = |o: &illuminant_scene::Object| match (&scene.materials[o.material].surface, counted) {
        (surface, Counted::All) if is_clear(surface) => Part::Clear,
        (
            Surface::Filter { .. } | Surface::Dielectric { .. } | Surface::Conductor { .. },
            Counted::Diffuse,
        ) => Part::Apart,
        _ => Part::Surface,
    };
    scene.objects.iter().map(part).collect()
}

/// Cuts elements again where the light of lamps changes fast from corner to corner (Cohen et al. 1986), down to a 64th of their area.
fn refined<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    mut elements: Elements,
    passes: &[Pass<N, M>],
    threshold: f64,
    (parts, patch, lit): (&[Part], f64, &dyn Fn(usize, bool) -> bool),
    (count, most): (u32, usize),
    cancel: &Cancel,
) -> Result<Elements, Cancelled> {
    let smallest = elements.all.iter().map(|e| e.area).fold(0.0, f64::max) / 64.0;
    let lamps: Vec<usize> = (0..scene.lamps.len()).collect();
    for _ in 0..ROUNDS {
        let all = (&lamps[..], lamps.len());
        let light = of_sides(scene, &elements, &passes[..1], all, N, count, cancel)?;
        let width = N * lamps.len();
        // Lamps of the scene's own strength, so that weak ones do not matter.
        let strength: Vec<f32> = scene.lamps.iter().map(|l| l.spectrum.area(scene.range) as f32).collect();
        let of_side = |side: u32| -> f32 {
            let row = &light[side as usize * width..][..width];
            row.chunks(N).zip(&strength).map(|(row, s)| row[0] * s).sum()
        };
        let mean = {
            let sides = 0..elements.sides.len() as u32;
            let area: f64 = sides.clone().map(|s| elements.area(s)).sum();
            sides.map(|s| elements.area(s) * f64::from(of_side(s))).sum::<f64>() / area.max(f64::MIN_POSITIVE)
        };
        // How the light of an element differs from that of those about its corners.
        let corners = elements.subdivision.count_of_corners();
        let mut extent = vec![[[f32::INFINITY, f32::NEG_INFINITY]; 2]; corners];
        for side in 0..elements.sides.len() as u32 {
            let back = usize::from(elements.sides[side as usize].back);
            let value = of_side(side);
            for corner in elements.subdivision.corners(elements.element_of(side).node) {
                let [low, high] = &mut extent[corner as usize][back];
                (*low, *high) = (low.min(value), high.max(value));
            }
        }
        let cut: Vec<u32> = (0..elements.sides.len() as u32)
            .filter(|&side| {
                let element = elements.element_of(side);
                let back = usize::from(elements.sides[side as usize].back);
                let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
                for corner in elements.subdivision.corners(element.node) {
                    let [l, h] = extent[corner as usize][back];
                    (low, high) = (low.min(l), high.max(h));
                }
                let apart = f64::from(high - low);
                element.area > smallest && apart > threshold * mean.max(f64::from(0.5 * (low + high)))
            })
            .map(|side| elements.element_of(side).node)
            .collect();
        if cut.is_empty() || elements.all.len() >= most {
            break;
        }
        let mut subdivision: Subdivision = elements.subdivision.clone();
        cut.into_iter().for_each(|node| subdivision.bisect(node));
        elements = Elements::of(&scene.geometry, subdivision, parts, patch, lit);
    }
    Ok(elements)
}

/// The elements of a scene.
pub(super) fn cut<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    (told, counted): (&RadiositySettings, Counted),
    passes: &[Pass<N, M>],
    cancel: &Cancel,
) -> Result<Elements, String> {
    let (geometry, lamps) = (&*scene.geometry, scene.lamps.len());
    let parts = parts(scene, counted);
    let whole = Elements::of(geometry, Subdivision::new(geometry), &parts, f64::INFINITY, &|_, _| true);
    let total = whole.total_area();
    if total <= 0.0 {
        return Err("radiosity needs a surface that is diffuse: the scene has none".into());
    }
    let coarse = Refinement { element: total / COARSE, patch: f64::INFINITY };
    let coarse = Elements::new(geometry, &parts, coarse, &|_, _| true);
    let is_sheet = |o: &illuminant_scene::Object| {
        matches!(scene.materials[o.material].surface, Surface::Translucent { .. })
    };
    let sheets: Vec<bool> = scene.objects.iter().map(is_sheet).collect();
    let light: Vec<Vec<f32>> = (0..coarse.sides.len() as u32)
        .into_par_iter()
        .map(|side| {
            cancel.check()?;
            let of = |lamp| direct::mean(scene, &coarse, &passes[0], lamp, side, 4);
            Ok((0..lamps).map(|lamp| of(lamp).0.iter().sum()).collect())
        })
        .collect::<Result<_, Cancelled>>()?;
    let largest: Vec<f32> =
        (0..lamps).map(|lamp| light.iter().map(|row| row[lamp]).fold(0.0, f32::max)).collect();
    // What is less than this is the rounding of a lamp that lies in the plane of a side.
    let is_lit = |side: u32| (0..lamps).any(|lamp| light[side as usize][lamp] > 1e-5 * largest[lamp]);
    let lit = reached(geometry, &coarse, &sheets, &is_lit, cancel)?;
    let lit = |object: usize, back: bool| lit[object][usize::from(back)];
    // A cut halves, so elements end between half the limit and the limit: three quarters of it on average.
    let element = total / (0.75 * f64::from(told.elements));
    let patch = told.patches.map_or(0.0, |patches| total / (0.75 * f64::from(patches)));
    let mut elements = Elements::new(geometry, &parts, Refinement { element, patch }, &lit);
    if let Some(threshold) = told.adaptive {
        let most = 16 * told.elements as usize;
        let (kinds, counts) =
            ((&parts[..], patch, &lit as &dyn Fn(usize, bool) -> bool), (told.light_samples, most));
        elements = refined(scene, elements, passes, threshold, kinds, counts, cancel)?;
    }
    if elements.sides.is_empty() {
        return Err("no light reaches any surface that is diffuse".into());
    }
    Ok(elements)
}
