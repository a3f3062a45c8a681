//! The samples of a spectral sampling as bundles of lanes: which paths carry what.
//!
//! A basis of more samples than a bundle holds is followed in passes, over the same paths. In a scene with dispersing
//! materials each path carries, beside the samples of the basis, one wavelength of its own from the camera on. Light that
//! is not dispersed is seen by the samples; light that a dispersive refraction has bent, by that wavelength alone, whose
//! throughput before the refraction is known because it was carried.

use crate::direct_light::ambient;
use crate::film::{LayerPlan, TOO_LARGE, TileFilm};
use crate::filter::FilterSampler;
use crate::haze::Haze;
use crate::lanes::Pass;
use crate::light_tracing::{LightTracer, gathering};
use crate::path::{Counts, PathTracer, Primary, Probe, Query, Recorder, Vertex};
use crate::radiosity::{Field, Gather, RadiositySolution, View};
use crate::ray_tree::RayTree;
use crate::render::RenderError;
use crate::sampler::Numbers;
use crate::scanline::Scanline;
use crate::sequence::mix;
use crate::settings::Technique;
use crate::settings::{Layer, Settings};
use crate::wavelength::{Accompanied, Wavelength, wavelengths};
use illuminant_illumination::{General, Historic, Illumination, IlluminationModel, Prepare};
use illuminant_sampling::{Basis, Lanes, ToXyz, lanes_for};
use illuminant_scene::Scene;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// The stream of numbers of paths from lamps: that of no pixel.
const FROM_LAMPS: u64 = u64::MAX;

/// What a tile needs to know; generic code hides behind [`TileRenderer`].
pub(crate) struct Job {
    pub scene: Arc<Scene>,
    pub settings: Settings,
    pub filter: FilterSampler,
    pub numbers: Numbers,
    pub plan: Vec<LayerPlan>,
    pub channels: usize,
    /// The group of each lamp: lamps of a group share a bundle.
    pub group_of: Vec<usize>,
    pub albedo: Vec<[f32; 3]>,
    /// What the air leaves of what is seen.
    pub haze: Option<Haze>,
}

impl Job {
    /// Where in its pixel a sample lies that is at the same place in all of them.
    pub fn shared_offset(&self, index: u64, replicate: u64) -> [f32; 2] {
        let [u, v, ..] = self.numbers.sequence(self.settings.seed, 0, index, replicate).next4();
        [self.filter.offset(u), self.filter.offset(v)]
    }
}

#[derive(Default)]
pub(crate) struct TileCounts {
    pub counts: Counts,
    pub samples: u64,
    /// Runs of pixels that polygons cover in a row.
    pub spans: u64,
    pub dropped: Vec<([u32; 2], u64)>,
}

pub(crate) trait TileRenderer: Send + Sync {
    /// Adds samples to a tile.
    fn tile(&self, job: &Job, tile: &mut TileFilm, samples: Range<u64>) -> TileCounts;
    /// Follows paths from lamps, and hands on what they bring to the film: pixel and channels.
    fn paths_from_lamps(
        &self,
        _job: &Job,
        _paths: Range<u64>,
        _sample: u64,
        _splat: &mut dyn FnMut([u32; 2], &[f32]),
    ) -> TileCounts {
        TileCounts::default()
    }
    /// Follows one path again, and records all of it; a technique without paths has nothing to record.
    fn replay(&self, _job: &Job, _pixel: [u32; 2], _sample: u64) -> Replay {
        Replay::default()
    }
    /// Follows one path and adds, for each group of lamps, what every sample of the basis brings of undispersed light.
    fn follow(&self, _job: &Job, _pixel: [u32; 2], _sample: u64, _to: &mut Followed) {}
}

/// What paths have brought.
#[derive(Clone, Debug, Default)]
pub(crate) struct Followed {
    /// For each group of lamps the samples of the basis.
    pub samples: Vec<Vec<f32>>,
    /// The material that the camera saw last.
    pub material: Option<usize>,
    /// Whether the camera saw light.
    pub emits: bool,
}

/// A path followed again.
#[derive(Clone, Debug, Default)]
pub struct Replay {
    /// The vertices of each pass.
    pub passes: Vec<Vec<Vertex>>,
    /// XYZ of the sample.
    pub xyz: [f32; 3],
    /// Its spectral samples.
    pub spectrum: Vec<f32>,
    /// The ray queries that it asked.
    pub queries: Vec<Query>,
}

/// The light that lamps give in the lanes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Light<'a> {
    /// Their own.
    Lamps,
    /// A number for each lamp, the same in every lane: what arrives is then what a path leaves of any light.
    Flat(&'a [f32]),
}

/// The passes of a sampling in bundles of N lanes, through the model M.
struct Passes<const N: usize, M> {
    tracer: Tracer,
    /// How light is followed from lamps, if it is.
    lamps: Option<LightTracer>,
    /// One list of passes for each wavelength that a path may carry beside the samples; else one list.
    variants: Vec<Vec<Pass<N, M>>>,
}

/// How light is followed from the camera.
enum Tracer {
    Paths(PathTracer),
    Trees(RayTree),
    Solution(View),
}

/// What images are made by.
#[derive(Clone, Copy)]
pub(crate) struct How<'a> {
    pub technique: Technique,
    pub illumination: Illumination,
    pub settings: &'a Settings,
    pub light: Light<'a>,
    /// The light between surfaces, where it has been solved for.
    pub solution: Option<&'a RadiositySolution>,
}

/// The passes of a basis in bundles of N lanes.
pub(crate) fn passes_of<const N: usize, M: Prepare>(
    scene: &Scene,
    illumination: Illumination,
    basis: &dyn Basis,
    companion: Option<Wavelength>,
    groups: &[usize],
    light: Light<'_>,
) -> Vec<Pass<N, M>> {
    let brightness: Vec<f32> =
        scene.materials.iter().map(|material| material.brightness(scene.range) as f32).collect();
    let total = basis.len();
    (0..total.div_ceil(N))
        .map(|i| i * N..((i + 1) * N).min(total))
        .map(|samples| Pass::new(scene, illumination, &brightness, basis, samples, groups, companion, light))
        .collect()
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Passes<N, M> {
    fn new(
        scene: &Scene,
        how: How<'_>,
        basis: &dyn Basis,
        companions: Option<&[Wavelength]>,
        (groups, group_of): (&[usize], &[usize]),
    ) -> Self {
        let How { technique, illumination, settings, light, solution } = how;
        let depth = settings.depth.unwrap_or(u32::MAX);
        let gather = settings.radiosity.gather;
        let paths = Tracer::Paths(PathTracer { depth, gathered: None });
        let mut tracer = match RayTree::new(scene, settings, technique) {
            _ if technique.is_solved() && gather == Gather::Full => paths,
            Some(tree) => Tracer::Trees(tree),
            None if technique.is_solved() => Tracer::Solution(View::new(gather)),
            None => paths,
        };
        let passes = |basis: &dyn Basis, companion| {
            let mut all = passes_of(scene, illumination, basis, companion, groups, light);
            if let Tracer::Trees(_) = tracer {
                let ambient = |pass: &Pass<N, M>| ambient(scene, pass, group_of, settings.ambient as f32);
                all.iter_mut().for_each(|pass| pass.ambient = ambient(pass));
            }
            if let Some(solution) = solution {
                for pass in &mut all {
                    pass.directional.clone_from(&solution.directional);
                    if pass.directional.is_some() {
                        continue;
                    }
                    pass.field = Some(Field::new(solution, scene, pass, group_of, settings));
                }
            }
            all
        };
        let variants = match companions {
            Some(all) => all.par_iter().map(|w| passes(&Accompanied::new(basis, *w), Some(*w))).collect(),
            None => vec![passes(basis, None)],
        };
        let materials = variants.first().and_then(|passes| passes.first()).map(|pass| &pass.materials[..]);
        let gathered = materials.filter(|_| settings.caustics).map(|materials| gathering(scene, materials));
        let lamps = gathered.and_then(|gathered| LightTracer::new(scene, gathered, depth));
        if let (Tracer::Paths(paths), Some(lamps)) = (&mut tracer, &lamps) {
            paths.gathered = Some(lamps.gathers.clone());
        }
        Self { tracer, lamps, variants }
    }

    /// The passes of a path. Neighbouring samples of a pixel take wavelengths far apart, neighbouring pixels others.
    fn variant(&self, job: &Job, stream: u64, sample: u64) -> &[Pass<N, M>] {
        let count = self.variants.len() as u64;
        if count == 1 {
            return &self.variants[0];
        }
        // 633 has no factor in common with their number, 1024, and is near its golden section.
        let place = mix(job.settings.seed, stream).wrapping_add(sample.wrapping_mul(633));
        &self.variants[(place % count) as usize]
    }

    /// Follows one sample through all passes; `each` gets what every pass brought. What is seen first, and what the sample counts.
    #[inline(always)]
    fn sample<P: Probe>(
        &self,
        job: &Job,
        pixel: [u32; 2],
        sample: u64,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
        mut each: impl FnMut(&Pass<N, M>, &[Lanes<N>], &mut P),
    ) -> (Primary, f32) {
        let [x, y] = pixel;
        let replicates = u64::from(job.settings.replicates.max(1));
        let stream = u64::from(y) << 32 | u64::from(x);
        let (index, replicate) = (sample / replicates, sample % replicates);
        let chance = !matches!(&self.tracer, Tracer::Trees(tree) if !tree.is_distributed());
        // Without chance all pixels are seen at the same places.
        let own = if chance { stream } else { 0 };
        let mut sequence = job.numbers.sequence(job.settings.seed, own, index, replicate);
        let [u, v, u_lamp @ ..] = sequence.next4();
        let camera = &job.scene.camera;
        let [open, close] = camera.shutter;
        let [u_time, u_lens @ .., _] =
            if chance && (close > open || camera.lens.is_some()) { sequence.next4() } else { [0.0; 4] };
        let (fx, fy) = match &self.tracer {
            // A cone is the whole pixel.
            Tracer::Trees(tree) if tree.has_cones() => (0.0, 0.0),
            _ => (job.filter.offset(u), job.filter.offset(v)),
        };
        let [px, py] = [x as f32 + 0.5 + fx, y as f32 + 0.5 + fy];
        let ray =
            if chance { camera.ray_through_lens(px, py, u_time, u_lens) } else { camera.ray(px, py, 0.0) };
        let mut primary = Primary::default();
        for pass in self.variant(job, stream, sample) {
            radiance.fill(Lanes::default());
            let (scene, group_of) = (&*job.scene, &job.group_of);
            primary = match &self.tracer {
                Tracer::Paths(paths) => {
                    paths.trace(scene, pass, group_of, ray, sequence, u_lamp, radiance, probe)
                }
                Tracer::Trees(trees) => {
                    trees.trace(scene, pass, group_of, ray, index, sequence, radiance, probe)
                }
                Tracer::Solution(view) => view.trace(scene, pass, group_of, ray, sequence, radiance, probe),
            };
            each(pass, radiance, probe);
        }
        (primary, job.filter.weight([fx, fy]))
    }

    /// An empty bundle for each group, and with dispersion another for what has been dispersed.
    fn bundles(&self) -> Vec<Lanes<N>> {
        vec![Lanes::default(); self.variants[0].first().map_or(0, |pass| pass.to_xyz.len())]
    }
}

#[inline(always)]
fn add_xyz<const N: usize, M>(pass: &Pass<N, M>, radiance: &[Lanes<N>], xyz: &mut [f32; 3]) -> bool {
    let mut sound = true;
    for (light, rows) in radiance.iter().zip(&pass.to_xyz) {
        sound &= light.is_radiance();
        for (sum, row) in xyz.iter_mut().zip(rows) {
            *sum += light.dot(row);
        }
    }
    sound
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> TileRenderer for Passes<N, M> {
    fn tile(&self, job: &Job, tile: &mut TileFilm, samples: Range<u64>) -> TileCounts {
        let mut result = TileCounts::default();
        let missing = tile.claim(samples);
        let mut radiance = self.bundles();
        let mut values = vec![0.0f32; job.channels];
        let plain = job.plan.len() == 1;
        let [x0, y0, ..] = tile.area;
        for i in 0..tile.samples.len() {
            let pixel = [x0 + i as u32 % tile.width(), y0 + i as u32 / tile.width()];
            for sample in missing.iter().cloned().flatten() {
                result.samples += 1;
                let mut xyz = [0.0f32; 3];
                let mut sound = true;
                if !plain {
                    values.fill(0.0);
                }
                let (primary, weight) =
                    self.sample(job, pixel, sample, &mut radiance, &mut result.counts, |pass, light, _| {
                        sound &= add_xyz(pass, light, &mut xyz);
                        if !plain {
                            spectral_layers(job, pass, light, &mut values);
                        }
                    });
                values[..3].copy_from_slice(&xyz);
                if let Some(haze) = &job.haze {
                    haze.apply(&primary, &mut values);
                }
                if !plain {
                    auxiliary_layers(job, &primary, sample, &mut values);
                }
                if !job.filter.is_positive() {
                    values.iter_mut().for_each(|v| *v *= weight);
                }
                // Every channel, not XYZ alone: a lane in the infrared may be vast where its XYZ is nothing.
                if sound && values.iter().all(|v| v.abs() < TOO_LARGE) {
                    tile.add(i, &values);
                } else {
                    result.dropped.push((pixel, sample));
                }
            }
        }
        result
    }

    fn paths_from_lamps(
        &self,
        job: &Job,
        paths: Range<u64>,
        sample: u64,
        splat: &mut dyn FnMut([u32; 2], &[f32]),
    ) -> TileCounts {
        let mut result = TileCounts::default();
        let Some(lamps) = &self.lamps else { return result };
        let replicates = u64::from(job.settings.replicates.max(1));
        let [width, height] = job.scene.camera.size.map(u64::from);
        let (first, replicate) = (sample / replicates * width * height, sample % replicates);
        // A sample of every pixel is shared out among as many paths as there are pixels.
        let share = ((width * height) as f32).recip();
        let mut bundles = self.bundles();
        let mut values = vec![0.0f32; job.channels];
        for path in paths {
            let sequence = job.numbers.sequence(job.settings.seed, FROM_LAMPS, first + path, replicate);
            for pass in self.variant(job, FROM_LAMPS, first + path) {
                let scene = &*job.scene;
                lamps.trace(scene, pass, &job.filter, sequence, &mut result.counts, &mut |lamp, found| {
                    values.fill(0.0);
                    bundles.fill(Lanes::default());
                    bundles[found.bundle + job.group_of[lamp]] = found.radiance * share;
                    let mut xyz = [0.0f32; 3];
                    let sound = add_xyz(pass, &bundles, &mut xyz);
                    values[..3].copy_from_slice(&xyz);
                    spectral_layers(job, pass, &bundles, &mut values);
                    if let Some(haze) = &job.haze {
                        haze.dim(found.distance, &mut values);
                    }
                    for layer in job.plan.iter().filter(|plan| plan.layer == Layer::Halves) {
                        values[layer.channels.start] = if sample % 2 == 1 { values[1] } else { 0.0 };
                    }
                    if sound && values.iter().all(|v| v.abs() < TOO_LARGE) {
                        splat(found.pixel, &values);
                    } else {
                        result.dropped.push((found.pixel, sample));
                    }
                });
            }
        }
        result
    }

    fn replay(&self, job: &Job, pixel: [u32; 2], sample: u64) -> Replay {
        let mut radiance = self.bundles();
        let (mut passes, mut xyz, mut spectrum, mut queries) = (Vec::new(), [0.0; 3], Vec::new(), Vec::new());
        self.sample(job, pixel, sample, &mut radiance, &mut Recorder::default(), |pass, light, recorder| {
            add_xyz(pass, light, &mut xyz);
            let sum = light.iter().fold(Lanes::default(), |sum: Lanes<N>, r| sum + *r);
            spectrum.extend_from_slice(&sum.0[..pass.samples.len()]);
            passes.push(std::mem::take(&mut recorder.vertices));
            queries.append(&mut recorder.queries);
        });
        Replay { passes, xyz, spectrum, queries }
    }

    fn follow(&self, job: &Job, pixel: [u32; 2], sample: u64, to: &mut Followed) {
        let mut radiance = self.bundles();
        let samples = &mut to.samples;
        let (primary, _) =
            self.sample(job, pixel, sample, &mut radiance, &mut Counts::default(), |pass, light, _| {
                for (light, all) in light.iter().zip(samples.iter_mut()) {
                    for (sum, value) in all[pass.own_samples()].iter_mut().zip(&light.0) {
                        *sum += value;
                    }
                }
            });
        to.material = primary.surface.map(|(_, object, _)| job.scene.objects[object as usize].material);
        to.emits |= primary.emits;
    }
}

/// The layers that come from lanes: each lamp by itself, and the lanes themselves.
fn spectral_layers<const N: usize, M>(job: &Job, pass: &Pass<N, M>, light: &[Lanes<N>], values: &mut [f32]) {
    let (mut lamp, mut lamp_of_lanes) = (0, 0);
    let undispersed = pass.dispersed.unwrap_or(light.len());
    for layer in &job.plan {
        match layer.layer {
            Layer::Lamps => {
                let group = job.group_of[lamp];
                lamp += 1;
                // The light of the lamp that was dispersed lies as many bundles further on.
                for bundle in [Some(group), pass.dispersed.map(|first| first + group)].into_iter().flatten() {
                    for (slot, row) in values[layer.channels.clone()].iter_mut().zip(&pass.to_xyz[bundle]) {
                        *slot += light[bundle].dot(row);
                    }
                }
            }
            Layer::Spectra => {
                let channels = &mut values[layer.channels.clone()];
                add_lanes(pass, &light[..undispersed], &light[undispersed..], channels);
            }
            Layer::LampSpectra => {
                let group = job.group_of[lamp_of_lanes];
                lamp_of_lanes += 1;
                let dispersed = pass.dispersed.map_or(&[][..], |first| &light[first + group..=first + group]);
                add_lanes(pass, &light[group..=group], dispersed, &mut values[layer.channels.clone()]);
            }
            _ => {}
        }
    }
}

/// Adds bundles to the channels of the lanes.
fn add_lanes<const N: usize, M>(
    pass: &Pass<N, M>,
    undispersed: &[Lanes<N>],
    dispersed: &[Lanes<N>],
    channels: &mut [f32],
) {
    for light in undispersed {
        for (slot, v) in channels[pass.own_samples()].iter_mut().zip(&light.0) {
            *slot += v;
        }
    }
    // A wavelength of its own is kept in the sample that stands for its part of the spectrum.
    if let Some(companion) = &pass.companion {
        for light in dispersed {
            channels[companion.stand_in] += light.0[companion.lane] * companion.share;
        }
    }
}

/// The layers that come from what the camera sees first, and the halves.
pub(crate) fn auxiliary_layers(job: &Job, primary: &Primary, sample: u64, values: &mut [f32]) {
    let y = values[1];
    for layer in &job.plan {
        let slots = &mut values[layer.channels.clone()];
        match (layer.layer, primary.surface) {
            (Layer::Halves, _) if sample % 2 == 1 => slots.copy_from_slice(&[y, 1.0]),
            (Layer::Depth, Some((distance, ..))) => slots.copy_from_slice(&[distance, 1.0]),
            (Layer::Normal, Some((.., normal))) => slots.copy_from_slice(&normal.to_array()),
            (Layer::Albedo, Some((_, object, _))) => {
                slots.copy_from_slice(&job.albedo[job.scene.objects[object as usize].material]);
            }
            (Layer::Emission, _) => slots[0] = f32::from(u8::from(primary.emits)),
            _ => {}
        }
    }
}

/// Lamps that share a map to XYZ share a bundle, unless each is wanted by itself: a lamp for each group, and the group
/// of each lamp.
pub(crate) fn group_lamps(basis: &dyn Basis, lamps: usize, by_lamp: bool) -> (Vec<usize>, Vec<usize>) {
    let mut groups: Vec<usize> = Vec::new();
    let mut maps: Vec<ToXyz> = Vec::new();
    let mut group_of = Vec::with_capacity(lamps);
    for lamp in 0..lamps {
        let map = basis.to_xyz(lamp);
        let shared = maps.iter().position(|m| !by_lamp && same(m, &map));
        group_of.push(shared.unwrap_or(groups.len()));
        if shared.is_none() {
            groups.push(lamp);
            maps.push(map);
        }
    }
    (groups, group_of)
}

/// Whether two maps are one but for rounding.
fn same(a: &ToXyz, b: &ToXyz) -> bool {
    let largest = a.iter().flatten().fold(0.0f64, |m, v| m.max(v.abs()));
    a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() <= 1e-9 * largest)
}

/// Renders what was asked for in bundles of N lanes.
fn of_lanes<const N: usize>(
    scene: &Scene,
    how: How<'_>,
    basis: &dyn Basis,
    companions: Option<&[Wavelength]>,
    groups: (&[usize], &[usize]),
) -> Box<dyn TileRenderer> {
    fn of_model<const N: usize, M: IlluminationModel<N> + Prepare + 'static>(
        scene: &Scene,
        how: How<'_>,
        basis: &dyn Basis,
        companions: Option<&[Wavelength]>,
        (groups, group_of): (&[usize], &[usize]),
    ) -> Box<dyn TileRenderer> {
        if how.technique.is_scanline() {
            let passes = passes_of::<N, M>(scene, how.illumination, basis, None, groups, how.light);
            return Box::new(Scanline::new(scene, how.settings, how.technique, group_of, passes));
        }
        Box::new(Passes::<N, M>::new(scene, how, basis, companions, (groups, group_of)))
    }
    match how.illumination {
        Illumination::General => of_model::<N, General<N>>(scene, how, basis, companions, groups),
        _ => of_model::<N, Historic<N>>(scene, how, basis, companions, groups),
    }
}

/// The one place where lane-generic code is instantiated.
pub(crate) fn renderer(
    scene: &Scene,
    how: How<'_>,
    basis: &dyn Basis,
    groups: (&[usize], &[usize]),
) -> Result<Box<dyn TileRenderer>, RenderError> {
    // Only what bends light disperses it: general alone, along paths.
    let bends = (how.technique, how.illumination) == (Technique::Path, Illumination::General);
    let companions = wavelengths(scene, basis).filter(|_| bends);
    let companions = companions.as_deref();
    let samples = basis.len() + usize::from(companions.is_some());
    // Any number of samples fits bundles of any size, in passes.
    let lanes = if cfg!(feature = "only-8-lanes") { 8 } else { lanes_for(samples).unwrap_or(32) };
    match lanes {
        8 => Ok(of_lanes::<8>(scene, how, basis, companions, groups)),
        #[cfg(not(feature = "only-8-lanes"))]
        4 => Ok(of_lanes::<4>(scene, how, basis, companions, groups)),
        #[cfg(not(feature = "only-8-lanes"))]
        16 => Ok(of_lanes::<16>(scene, how, basis, companions, groups)),
        #[cfg(not(feature = "only-8-lanes"))]
        32 => Ok(of_lanes::<32>(scene, how, basis, companions, groups)),
        other => Err(RenderError::Setting(format!("bundles of {other} lanes are not compiled in"))),
    }
}
