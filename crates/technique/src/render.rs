//! A render: a scene, its settings, and a film that fills up.

use crate::film::{Film, TOO_LARGE, TileFilm};
use crate::filter::FilterSampler;
use crate::lanes::Pass;
use crate::path::{Counts, PathTracer, Primary, Probe, Query, Recorder, Vertex};
use crate::sequence::Sequence;
use crate::settings::{Layer, Settings, Technique};
use illuminant_illumination::{General, Illumination, IlluminationModel, Prepare};
use illuminant_sampling::{Basis, Lanes, SamplingError, SpectralSampling, lanes_for};
use illuminant_scene::Scene;
use illuminant_spectrum::{Curve, Observer};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use thiserror::Error;

/// Why settings make no render.
#[derive(Debug, Error)]
pub enum RenderError {
    /// The spectral sampling has no such name.
    #[error(transparent)]
    Sampling(#[from] SamplingError),
    /// Something else is not known or out of range.
    #[error("{0}")]
    Setting(String),
    /// There is no light.
    #[error("lights: the scene has no light: no lamp, no emitting object, no environment")]
    NoLight,
}

/// A sample that was not a radiance, and left out.
#[derive(Clone, Debug)]
pub struct Dropped {
    /// x and y in the whole image.
    pub pixel: [u32; 2],
    /// Its number.
    pub sample: u64,
    /// The object at which the path went wrong; none if the camera saw surroundings.
    pub object: Option<String>,
    /// The material of that object.
    pub material: Option<String>,
}

/// How many dropped samples are kept with their details; all are counted.
const DETAILS: usize = 100;

/// What a render has done so far.
#[derive(Clone, Debug, Default)]
pub struct Statistics {
    /// Time spent in [`Render::run`].
    pub elapsed: Duration,
    /// Samples, over all pixels, dropped ones included.
    pub samples: u64,
    /// Closest-hit queries.
    pub closest: u64,
    /// Occlusion queries.
    pub occlusion: u64,
    /// Samples left out because they were no radiance.
    pub dropped: u64,
    /// The first of them.
    pub details: Vec<Dropped>,
}

/// The progress of a run, shared with whoever watches it.
#[derive(Debug, Default)]
pub struct Progress {
    done: AtomicU64,
    total: AtomicU64,
    cancelled: AtomicBool,
}

impl Progress {
    /// The fraction that is done.
    #[must_use]
    pub fn fraction(&self) -> f64 {
        let total = self.total.load(Ordering::Relaxed);
        if total == 0 { 0.0 } else { self.done.load(Ordering::Relaxed) as f64 / total as f64 }
    }

    /// Asks the run to stop; tiles under way are finished.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

/// What a tile needs to know; generic code hides behind [`TileRenderer`].
struct Job {
    scene: Arc<Scene>,
    settings: Settings,
    filter: FilterSampler,
    plan: Vec<crate::film::LayerPlan>,
    channels: usize,
    group_of: Vec<usize>,
    albedo: Vec<[f32; 3]>,
}

#[derive(Default)]
struct TileCounts {
    counts: Counts,
    samples: u64,
    dropped: Vec<([u32; 2], u64)>,
}

trait TileRenderer: Send + Sync {
    fn tile(&self, job: &Job, tile: &mut TileFilm, samples: Range<u64>) -> TileCounts;
    fn replay(&self, job: &Job, pixel: [u32; 2], sample: u64) -> Replay;
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

/// The passes of a sampling in bundles of N lanes, through the model M.
struct Passes<const N: usize, M> {
    tracer: PathTracer,
    passes: Vec<Pass<N, M>>,
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Passes<N, M> {
    fn new(scene: &Scene, basis: &dyn Basis, depth: Option<u32>, groups: &[usize]) -> Self {
        let total = basis.len();
        let ranges = (0..total.div_ceil(N)).map(|i| i * N..((i + 1) * N).min(total));
        let passes = ranges.map(|samples| Pass::new(scene, basis, samples, groups)).collect();
        Self { tracer: PathTracer { depth: depth.unwrap_or(u32::MAX) }, passes }
    }

    /// Follows one sample through all passes; `each` gets what every pass brought.
    #[inline(always)]
    fn sample<P: Probe>(
        &self,
        job: &Job,
        pixel: [u32; 2],
        sample: u64,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
        mut each: impl FnMut(&Pass<N, M>, &[Lanes<N>], &mut P),
    ) -> Primary {
        let [x, y] = pixel;
        let replicates = u64::from(job.settings.replicates.max(1));
        let stream = u64::from(y) << 32 | u64::from(x);
        let mut sequence = Sequence::new(job.settings.seed, stream, sample / replicates, sample % replicates);
        let [u, v, u_lamp @ ..] = sequence.next4();
        let [open, close] = job.scene.camera.shutter;
        let u_time = if close > open { sequence.next4()[0] } else { 0.0 };
        let (fx, fy) = (job.filter.offset(u), job.filter.offset(v));
        let ray = job.scene.camera.ray(x as f32 + 0.5 + fx, y as f32 + 0.5 + fy, u_time);
        let mut primary = Primary::default();
        for pass in &self.passes {
            radiance.fill(Lanes::default());
            primary =
                self.tracer.trace(&job.scene, pass, &job.group_of, ray, sequence, u_lamp, radiance, probe);
            each(pass, radiance, probe);
        }
        primary
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
        let groups = self.passes.first().map_or(0, |pass| pass.to_xyz.len());
        let mut radiance = vec![Lanes::<N>::default(); groups];
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
                let primary =
                    self.sample(job, pixel, sample, &mut radiance, &mut result.counts, |pass, light, _| {
                        sound &= add_xyz(pass, light, &mut xyz);
                        if !plain {
                            spectral_layers(job, pass, light, &mut values);
                        }
                    });
                values[..3].copy_from_slice(&xyz);
                if !plain {
                    auxiliary_layers(job, &primary, sample, &mut values);
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

    fn replay(&self, job: &Job, pixel: [u32; 2], sample: u64) -> Replay {
        let groups = self.passes.first().map_or(0, |pass| pass.to_xyz.len());
        let mut radiance = vec![Lanes::<N>::default(); groups];
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
}

/// The layers that come from lanes: each lamp by itself, and the lanes themselves.
fn spectral_layers<const N: usize, M>(job: &Job, pass: &Pass<N, M>, light: &[Lanes<N>], values: &mut [f32]) {
    let mut lamp = 0;
    for layer in &job.plan {
        match layer.layer {
            Layer::Lamps => {
                let group = job.group_of[lamp];
                lamp += 1;
                for (slot, row) in values[layer.channels.clone()].iter_mut().zip(&pass.to_xyz[group]) {
                    *slot += light[group].dot(row);
                }
            }
            Layer::Spectra => {
                let channels = &mut values[layer.channels.clone()][pass.samples.clone()];
                for light in light {
                    for (slot, v) in channels.iter_mut().zip(&light.0) {
                        *slot += v;
                    }
                }
            }
            _ => {}
        }
    }
}

/// The layers that come from what the camera sees first, and the halves.
fn auxiliary_layers(job: &Job, primary: &Primary, sample: u64, values: &mut [f32]) {
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

/// A render under way: runs follow each other, and the film accumulates.
pub struct Render {
    job: Job,
    renderer: Box<dyn TileRenderer>,
    basis: Box<dyn Basis>,
    film: Film,
    statistics: Statistics,
    pool: rayon::ThreadPool,
}

impl Render {
    /// A render of a scene, with an empty film.
    ///
    /// # Errors
    /// [`RenderError`] when a setting is unknown or out of range, or the scene has no light.
    pub fn new(scene: Arc<Scene>, settings: Settings) -> Result<Self, RenderError> {
        let sampling: SpectralSampling = settings.sampling.parse()?;
        let technique: Technique = settings.technique.parse().map_err(RenderError::Setting)?;
        let illumination: Illumination = settings.illumination.parse().map_err(RenderError::Setting)?;
        if settings.depth == Some(0) {
            return Err(RenderError::Setting("depth must be 1 or more".into()));
        }
        let radius = settings.filter.radius();
        if !(radius > 0.0 && radius <= 16.0) {
            return Err(RenderError::Setting(format!(
                "the filter's radius must lie above 0 and up to 16 pixels, not {radius}"
            )));
        }
        if !(1..=2).contains(&settings.replicates) {
            return Err(RenderError::Setting(format!(
                "replicates must be 1 or 2, not {}",
                settings.replicates
            )));
        }
        if scene.lamps.is_empty() {
            return Err(RenderError::NoLight);
        }
        let basis = sampling.basis(scene.range);
        let by_lamp = settings.layers.contains(&Layer::Lamps);
        let (groups, group_of) = group_lamps(&*basis, scene.lamps.len(), by_lamp);
        let names: Vec<String> = scene.lamps.iter().map(|lamp| lamp.name.clone()).collect();
        let film = Film::new(scene.camera.crop, &settings, &names, basis.len());
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(settings.threads)
            .build()
            .map_err(|e| RenderError::Setting(format!("no threads can be started: {e}")))?;
        let renderer = renderer(&scene, &*basis, &settings, technique, illumination, &groups)?;
        let white = Observer::cie_1931_2deg().xyz(&Curve::constant(1.0), scene.range);
        let albedo = scene.materials.iter().map(|material| {
            let reflectance = material.representative_reflectance(scene.range);
            let xyz = Observer::cie_1931_2deg().xyz(&reflectance, scene.range);
            xyz.map(|v| (v / white[1]) as f32)
        });
        let albedo = albedo.collect();
        let job = Job {
            albedo,
            filter: FilterSampler::new(&settings.filter),
            plan: film.plan.clone(),
            channels: film.channels(),
            group_of,
            scene,
            settings,
        };
        Ok(Self { job, renderer, basis, film, statistics: Statistics::default(), pool })
    }

    /// Renders samples `samples` of every pixel, those left out that it holds already; false when it was cancelled. Tiles are taken in any order by any
    /// thread, and the bits do not depend on it.
    pub fn run(&mut self, samples: Range<u64>, progress: &Progress) -> bool {
        let start = Instant::now();
        let count = samples.end.saturating_sub(samples.start);
        let [w, h] = self.film.size();
        progress.done.store(0, Ordering::Relaxed);
        progress.total.store((w * h) as u64 * count, Ordering::Relaxed);
        let (job, renderer, tiles) = (&self.job, &*self.renderer, &mut self.film.tiles);
        let results: Vec<Option<TileCounts>> = self.pool.install(|| {
            tiles
                .par_iter_mut()
                .with_max_len(1)
                .map(|tile| {
                    if progress.is_cancelled() {
                        return None;
                    }
                    let result = renderer.tile(job, tile, samples.clone());
                    progress.done.fetch_add(result.samples, Ordering::Relaxed);
                    Some(result)
                })
                .collect()
        });
        let complete = results.iter().all(Option::is_some);
        for result in results.into_iter().flatten() {
            self.statistics.samples += result.samples;
            self.statistics.closest += result.counts.closest;
            self.statistics.occlusion += result.counts.occlusion;
            self.statistics.dropped += result.dropped.len() as u64;
            for (pixel, sample) in result.dropped {
                if self.statistics.details.len() < DETAILS {
                    let details = self.blame(pixel, sample);
                    self.statistics.details.push(details);
                }
            }
        }
        self.statistics.elapsed += start.elapsed();
        complete
    }

    /// Finds the first vertex at which a dropped sample was no radiance.
    fn blame(&self, pixel: [u32; 2], sample: u64) -> Dropped {
        let bad = |values: &[f32]| values.iter().any(|v| !(*v >= 0.0 && *v < TOO_LARGE));
        let replay = self.replay(pixel, sample);
        let guilty = replay
            .passes
            .iter()
            .filter_map(|vertices| {
                let first = vertices.iter().find(|v| bad(&v.added) || bad(&v.throughput));
                first.or(vertices.last())
            })
            .next()
            .map(|vertex| &self.job.scene.objects[vertex.object as usize]);
        Dropped {
            pixel,
            sample,
            object: guilty.map(|o| o.name.clone()),
            material: guilty.map(|o| self.job.scene.materials[o.material].name.clone()),
        }
    }

    /// Follows one path again: the very one that the film holds.
    #[must_use]
    pub fn replay(&self, pixel: [u32; 2], sample: u64) -> Replay {
        self.renderer.replay(&self.job, pixel, sample)
    }

    /// Asks the queries of these samples again, in the same order by the same threads, but without shading: how many they
    /// are and how long they take. It is the limit that the speed of a render is judged by.
    #[must_use]
    pub fn ray_rate(&self, samples: Range<u64>) -> (u64, Duration) {
        let of_tile = |tile: &TileFilm| {
            let [x0, y0, x1, y1] = tile.area;
            let pixels = (y0..y1).flat_map(|y| (x0..x1).map(move |x| [x, y]));
            let paths = pixels.flat_map(|pixel| samples.clone().map(move |sample| (pixel, sample)));
            paths.flat_map(|(pixel, sample)| self.replay(pixel, sample).queries).collect::<Vec<Query>>()
        };
        let geometry = &self.job.scene.geometry;
        let ask = |query: &Query| match query {
            Query::Closest(ray) => geometry.closest_hit(ray).is_some(),
            Query::Occlusion(origin, span, tfar) => geometry.is_occluded(*origin, *span, 0.0, *tfar),
        };
        self.pool.install(|| {
            let tiles: Vec<Vec<Query>> = self.film.tiles.par_iter().with_max_len(1).map(of_tile).collect();
            let count = tiles.iter().map(|queries| queries.len() as u64).sum();
            let start = Instant::now();
            let met: usize = tiles
                .par_iter()
                .with_max_len(1)
                .map(|queries| queries.iter().filter(|q| ask(q)).count())
                .sum();
            std::hint::black_box(met);
            (count, start.elapsed())
        })
    }

    /// The film.
    #[must_use]
    pub fn film(&self) -> &Film {
        &self.film
    }

    /// What has been done.
    #[must_use]
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// The spectral sampling.
    #[must_use]
    pub fn basis(&self) -> &dyn Basis {
        &*self.basis
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Arc<Scene> {
        &self.job.scene
    }
}

/// Lamps that share a map to XYZ share a bundle, unless each is wanted by itself: a lamp for each group, and the group
/// of each lamp.
fn group_lamps(basis: &dyn Basis, lamps: usize, by_lamp: bool) -> (Vec<usize>, Vec<usize>) {
    let mut groups: Vec<usize> = Vec::new();
    let mut maps: Vec<illuminant_sampling::ToXyz> = Vec::new();
    let mut group_of = Vec::with_capacity(lamps);
    for lamp in 0..lamps {
        let map = basis.to_xyz(lamp);
        let shared = maps.iter().position(|m| !by_lamp && *m == map);
        group_of.push(shared.unwrap_or(groups.len()));
        if shared.is_none() {
            groups.push(lamp);
            maps.push(map);
        }
    }
    (groups, group_of)
}

/// The one place where lane-generic code is instantiated.
fn renderer(
    scene: &Scene,
    basis: &dyn Basis,
    settings: &Settings,
    technique: Technique,
    illumination: Illumination,
    groups: &[usize],
) -> Result<Box<dyn TileRenderer>, RenderError> {
    let (Technique::Path, Illumination::General) = (technique, illumination);
    let depth = settings.depth;
    match lanes_for(basis.len()).unwrap_or(32) {
        8 => Ok(Box::new(Passes::<8, General<8>>::new(scene, basis, depth, groups))),
        #[cfg(not(feature = "only-8-lanes"))]
        4 => Ok(Box::new(Passes::<4, General<4>>::new(scene, basis, depth, groups))),
        #[cfg(not(feature = "only-8-lanes"))]
        16 => Ok(Box::new(Passes::<16, General<16>>::new(scene, basis, depth, groups))),
        #[cfg(not(feature = "only-8-lanes"))]
        32 => Ok(Box::new(Passes::<32, General<32>>::new(scene, basis, depth, groups))),
        other => Err(RenderError::Setting(format!("bundles of {other} lanes are not compiled in"))),
    }
}
