//! The colours that a scene shows, for fitting a spectral sampling to it and for judging one.
//!
//! A few paths are followed through the scene at every nm, with the same light at every nm from each lamp. What arrives
//! at a pixel is then, for each kind of lamp, the sum of all products of reflectances, transmittances and absorptions
//! that its paths met, at the angles and depths at which they met them, each weighted by how likely a path makes it. A
//! sampling is fitted on one set of paths and judged on another.

use crate::filter::FilterSampler;
use crate::passes::{Followed, How, Job, Light, TileRenderer, group_lamps, renderer};
use crate::sampler::Numbers;
use crate::settings::{Layer, Settings, Technique};
use illuminant_color::{RgbSystem, Triple};
use illuminant_illumination::Illumination;
use illuminant_radiosity::Cancel;
use illuminant_sampling::{
    Basis, Comparison, OneNanometre, Part, Product, Products, SamplingError, SpectralError, SpectralSampling,
    xyz_by,
};
use illuminant_scene::Scene;
use illuminant_spectrum::{Curve, Observer, Outside, SpectralRange};
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Pixels along each side of the grid that is probed.
const GRID: u32 = 24;
/// Paths of each pixel.
const PATHS: u64 = 4;
/// The seed of the probes: the same for every render, so that the wavelengths depend on the scene, on how long its paths
/// are, and on the size of its image, but not on seed, threads or crop.
const SEED: u64 = 0x5eed;
/// What the products of the materials as such weigh beside those that paths make: they stand in for what the probes did
/// not see.
const STAND_IN: f64 = 0.1;
/// What materials that are not in the scene weigh: little, for a scene says what it is made of.
const UNKNOWN: f64 = 0.02;
/// The most products of materials as such, over all lamps.
const MOST_STAND_INS: usize = 400;
/// The most products of pixels that are fitted, each counted once for every lamp: with many lamps not all are needed.
const MOST_FITTED: usize = 1200;
/// A lamp that gives less than this fraction of a pixel's light is left out of its product.
const NEGLIGIBLE: f64 = 1e-3;
/// Where the white of the scene lies: this percentile of luminance is shown as this fraction of white, as in PNGs.
const WHITE: (f64, f64) = (0.98, 0.8);

/// Which paths.
#[derive(Clone, Copy, Debug)]
enum Set {
    /// To fit.
    Fitting = 0,
    /// To judge.
    Judging = 1,
}

/// What a pixel shows, by kind of lamp and at every nm that is seen.
struct Probe {
    pixel: [u32; 2],
    /// Where in the list of pixels it stands: its paths are numbered by that, so that cells that share a pixel differ.
    cell: usize,
    /// For each kind of lamp the filter, and the XYZ of its light.
    parts: Vec<(Vec<f64>, Triple)>,
    material: Option<usize>,
    emits: bool,
}

impl Probe {
    fn xyz(&self) -> Triple {
        std::array::from_fn(|a| self.parts.iter().map(|(_, xyz)| xyz[a]).sum())
    }
}

/// A job that follows paths outside a film.
fn job(scene: &Arc<Scene>, settings: &Settings, group_of: Vec<usize>) -> Job {
    let settings = Settings { seed: SEED, replicates: 1, ..settings.clone() };
    Job {
        filter: FilterSampler::new(&settings.filter),
        numbers: Numbers::new(settings.sampler, settings.strata),
        scene: Arc::clone(scene),
        settings,
        plan: Vec::new(),
        channels: 0,
        group_of,
        albedo: Vec::new(),
        haze: None,
    }
}

/// The pixels of a set: one in each cell of a grid over the whole image, wherever the crop lies.
fn pixels(scene: &Scene, set: Set) -> Vec<[u32; 2]> {
    let [width, height] = scene.camera.size;
    let at = |i: u32, size: u32, shift: f64| {
        (((f64::from(i) + shift) / f64::from(GRID) * f64::from(size)) as u32).min(size - 1)
    };
    // The second set lies between the points of the first.
    let shift = [0.25, 0.75][set as usize];
    (0..GRID * GRID).map(|i| [at(i % GRID, width, shift), at(i / GRID, height, shift)]).collect()
}

/// Follows the paths of a pixel; the mean of what they bring.
fn follow(
    renderer: &dyn TileRenderer,
    job: &Job,
    (cell, pixel): (usize, [u32; 2]),
    set: Set,
    groups: usize,
    samples: usize,
) -> Followed {
    let mut sum = Followed { samples: vec![vec![0.0; samples]; groups], ..Followed::default() };
    let first = (2 * cell as u64 + set as u64) * PATHS;
    for path in first..first + PATHS {
        renderer.follow(job, pixel, path, &mut sum);
    }
    sum.samples.iter_mut().flatten().for_each(|v| *v /= PATHS as f32);
    sum
}

/// The model as paths see it. What a scanline technique shows are paths of two segments.
fn along_paths(settings: &Settings) -> Option<(Illumination, Settings)> {
    let technique: Technique = settings.technique.parse().ok()?;
    let illumination = settings.illumination.parse().ok()?;
    let mut settings = Settings { caustics: false, ..settings.clone() };
    if technique.is_scanline() {
        settings.depth = Some(settings.depth.unwrap_or(2).min(2));
    }
    Some((illumination, settings))
}

fn paths<'a>(illumination: Illumination, settings: &'a Settings, light: Light<'a>) -> How<'a> {
    How { technique: Technique::Path, illumination, settings, light, solution: None }
}

/// What the pixels of a set show at every nm, for the kinds of lamps in `known`; `None` where it is cancelled.
fn probe(
    scene: &Arc<Scene>,
    settings: &Settings,
    known: &Products,
    set: Set,
    cancel: &Cancel,
) -> Option<Vec<Probe>> {
    let basis = OneNanometre::new(scene.range);
    let kinds: Vec<usize> = known.representatives().collect();
    // A lamp of a kind gives its representative's light times the ratio of their luminances; a dark one gives none.
    let kind_of = |lamp: usize| known.kind(lamp).and_then(|kind| kinds.iter().position(|&k| k == kind));
    let luminance = |lamp: usize| known.xyz_of_lamp(lamp)[1];
    let lamps = 0..scene.lamps.len();
    let light: Vec<f32> = lamps
        .clone()
        .map(|l| known.kind(l).map_or(0.0, |kind| (luminance(l) / luminance(kind)) as f32))
        .collect();
    let group_of: Vec<usize> = lamps.map(|l| kind_of(l).unwrap_or(0)).collect();
    let (illumination, probing) = along_paths(settings)?;
    let how = paths(illumination, &probing, Light::Flat(&light));
    let renderer = renderer(scene, how, &basis, (&kinds, &group_of)).ok()?;
    let job = job(scene, settings, group_of);
    let range = known.range;
    let first = (range.min_nm - scene.range.min_nm) as usize;
    let weights: Vec<_> = kinds.iter().map(|&kind| known.weights_of_lamp(kind)).collect();
    let probes = pixels(scene, set).into_par_iter().enumerate().map(|(cell, pixel)| {
        if cancel.is_cancelled() {
            return None;
        }
        let found = follow(&*renderer, &job, (cell, pixel), set, kinds.len(), basis.len());
        let parts = found.samples.iter().zip(&weights).map(|(samples, weights)| {
            let filter: Vec<f64> =
                samples[first..first + range.len()].iter().map(|v| f64::from(*v)).collect();
            let xyz = xyz_by(weights, &filter);
            (filter, xyz)
        });
        Some(Probe { pixel, cell, parts: parts.collect(), material: found.material, emits: found.emits })
    });
    let mut probes: Vec<Probe> = probes.collect::<Option<_>>()?;
    // A path that is no radiance is no product either.
    probes.retain(|probe| probe.xyz().iter().all(|v| v.is_finite() && *v >= 0.0));
    Some(probes)
}

/// XYZ of the white beside which the scene is seen: D65 of the luminance that a PNG maps to 1; `None` in the dark.
fn white(probes: &[Probe]) -> Option<Triple> {
    let mut luminances: Vec<f64> = probes.iter().filter(|p| !p.emits).map(|p| p.xyz()[1]).collect();
    if luminances.iter().all(|y| *y <= 0.0) {
        luminances = probes.iter().map(|p| p.xyz()[1]).collect();
    }
    luminances.sort_by(f64::total_cmp);
    let (percentile, level) = WHITE;
    let at = ((luminances.len() as f64 * percentile) as usize).min(luminances.len().checked_sub(1)?);
    let luminance = luminances[at] / level;
    let d65 = RgbSystem::named("sRGB")?.to_xyz([1.0; 3]);
    (luminance > 0.0).then(|| d65.map(|v| v * luminance))
}

/// The lamps of a scene, with no product yet; `None` where the observer sees nothing of their light.
fn known(scene: &Scene) -> Option<Products> {
    Products::new(scene.range, scene.lamps.iter().map(|lamp| lamp.spectrum.clone()).collect())
}

/// The lamps of a scene, and behind them those under which its image shall be seen later, each as bright as the brightest of
/// the scene.
fn known_with_later_ones(scene: &Scene, settings: &Settings) -> Option<Products> {
    let own = known(scene)?;
    if settings.develop_for.is_empty() {
        return Some(own);
    }
    let together = own.lamps.len();
    let brightest = (0..together).map(|lamp| own.xyz_of_lamp(lamp)[1]).fold(0.0, f64::max);
    let observed = SpectralRange { min_nm: 360, max_nm: 830 };
    let later =
        settings.develop_for.iter().filter(|values| values.len() == observed.len()).filter_map(|values| {
            let curve = Curve::tabulated(observed, values.clone(), Outside::Zero);
            let luminance = Observer::cie_1931_2deg().xyz(&curve, own.range)[1];
            (luminance > 0.0).then(|| curve.scaled(brightest / luminance))
        });
    let lamps = own.lamps.iter().cloned().chain(later).collect();
    let mut products = Products::new(scene.range, lamps)?;
    products.together = together;
    Some(products)
}

/// The reflectances of what stands in the scene: each once, and none that changes no colour.
#[must_use]
pub fn reflectances(scene: &Scene) -> Vec<Curve> {
    let used: BTreeSet<usize> = scene.objects.iter().map(|object| object.material).collect();
    let mut found: Vec<Curve> = Vec::new();
    for material in used {
        let curve = scene.materials[material].representative_reflectance(scene.range);
        let (low, high) = curve.extent(scene.range);
        if high > low && !found.contains(&curve) {
            found.push(curve);
        }
    }
    found
}

/// The products of a scene: what its pixels show, and with little weight those of its materials as such, one and two
/// reflections under each lamp. `None` where the observer sees nothing of the light, or it is cancelled.
fn products(scene: &Arc<Scene>, settings: &Settings, cancel: &Cancel) -> Option<Products> {
    let own = known(scene)?;
    let kinds: Vec<usize> = own.representatives().collect();
    let mut products = known_with_later_ones(scene, settings)?;
    let later: Vec<usize> = products.representatives().filter(|&lamp| lamp >= products.together).collect();
    let lights = kinds.len() + later.len();
    products.add_reflectances(&reflectances(scene), 2, MOST_STAND_INS / lights.max(1), SEED);
    products.unknown = UNKNOWN;
    products.one_map = settings.layers.contains(&Layer::Spectra);
    let probes = probe(scene, settings, &own, Set::Fitting, cancel)?;
    let Some(white) = white(&probes) else { return Some(products) };
    let stand_ins = products.items.len();
    let stride = (probes.len() * lights).div_ceil(MOST_FITTED).max(1);
    for probe in probes.iter().step_by(stride) {
        let total = probe.xyz()[1];
        if total <= 0.0 {
            continue;
        }
        let counts = |xyz: &Triple| xyz[1] > NEGLIGIBLE * total;
        let parts = kinds.iter().zip(&probe.parts).filter(|(_, (_, xyz))| counts(xyz));
        let parts = parts.map(|(&lamp, (filter, _))| Part { lamp, filter: filter.clone() }).collect();
        products.items.push(Product { parts, white, weight: 1.0, factors: None });
        // Under another lamp the pixel shows what its path leaves of that one's light.
        let brightest = probe.parts.iter().max_by(|(_, a), (_, b)| a[1].total_cmp(&b[1]));
        for (&lamp, (filter, _)) in later.iter().flat_map(|lamp| brightest.map(|part| (lamp, part))) {
            let parts = vec![Part { lamp, filter: filter.clone() }];
            products.items.push(Product { parts, white, weight: 1.0, factors: None });
        }
    }
    let shown = products.items.len() - stand_ins;
    if shown > 0 {
        let weight = STAND_IN * shown as f64 / stand_ins.max(1) as f64;
        products.items[..stand_ins].iter_mut().for_each(|item| item.weight = weight);
    }
    Some(products)
}

/// The spectral sampling that settings name, fitted to a scene if it is one that is fitted; what is cancelled fits nothing.
///
/// # Errors
/// [`SamplingError`] when there is no such sampling.
pub fn basis(
    scene: &Arc<Scene>,
    settings: &Settings,
    cancel: &Cancel,
) -> Result<Arc<dyn Basis>, SamplingError> {
    let sampling: SpectralSampling = settings.sampling.parse()?;
    Ok(sampling.basis(scene.range, &|| products(scene, settings, cancel))?.into())
}

/// What a sampling costs in colour: ΔE00 between pixels integrated at 1 nm and the same paths in its samples, on paths
/// that no fit has looked at. Zero where the observer sees nothing, or it is cancelled.
#[must_use]
pub fn spectral_error(
    scene: &Arc<Scene>,
    settings: &Settings,
    basis: &dyn Basis,
    cancel: &Cancel,
) -> SpectralError {
    SpectralError::over(&comparisons(scene, settings, basis, cancel).unwrap_or_default())
}

fn comparisons(
    scene: &Arc<Scene>,
    settings: &Settings,
    basis: &dyn Basis,
    cancel: &Cancel,
) -> Option<Vec<Comparison>> {
    if basis.is_spectral() && basis.len() == scene.range.len() {
        return None; // the reference itself
    }
    let known = known(scene)?;
    let kinds: Vec<usize> = known.representatives().collect();
    let probes = probe(scene, settings, &known, Set::Judging, cancel)?;
    let white = white(&probes)?;
    let (groups, group_of) = group_lamps(basis, scene.lamps.len(), false);
    let (illumination, probing) = along_paths(settings)?;
    let how = paths(illumination, &probing, Light::Lamps);
    let renderer = renderer(scene, how, basis, (&groups, &group_of)).ok()?;
    let job = job(scene, settings, group_of);
    let maps: Vec<_> = groups.iter().map(|&lamp| basis.to_xyz(lamp)).collect();
    let of = |probe: &Probe| {
        if cancel.is_cancelled() {
            return None;
        }
        let found =
            follow(&*renderer, &job, (probe.cell, probe.pixel), Set::Judging, groups.len(), basis.len());
        let mut sampled = [0.0; 3];
        for (samples, map) in found.samples.iter().zip(&maps) {
            let samples: Vec<f64> = samples.iter().map(|v| f64::from(*v)).collect();
            sampled.iter_mut().zip(xyz_by(map, &samples)).for_each(|(sum, v)| *sum += v);
        }
        let brightest =
            probe.parts.iter().enumerate().max_by(|(_, (_, a)), (_, (_, b))| a[1].total_cmp(&b[1]));
        Some(Comparison {
            exact: probe.xyz(),
            sampled,
            white,
            weight: 1.0,
            lamp: brightest.map_or(0, |(kind, _)| kinds[kind]),
            materials: probe.material.into_iter().collect(),
        })
    };
    probes.par_iter().map(of).collect()
}
