//! A render: a scene, its settings, and a film that fills up.

use crate::film::{Film, TOO_LARGE, TileFilm};
use crate::filter::FilterSampler;
use crate::haze::Haze;
use crate::pairs;
use crate::part::{self, Part, PartError};
use crate::passes::{How, Job, Light, Replay, TileCounts, TileRenderer, group_lamps, renderer};
use crate::path::Query;
use crate::radiosity::{Given, RadiositySolution};
use crate::sampler::Numbers;
use crate::scanline::BAND;
use crate::scene_products::{basis, spectral_error};
use crate::settings::{Layer, LightCentres, Settings, Shadows, Technique};
use illuminant_illumination::Illumination;
use illuminant_radiosity::Cancel;
use illuminant_sampling::{Basis, SamplingError, SpectralError};
use illuminant_scene::Scene;
use illuminant_scene::embree::MOST_THREADS;
use illuminant_spectrum::{Curve, Observer};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
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
#[derive(Clone, Debug, Serialize, Deserialize)]
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
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Statistics {
    /// Time spent in [`Render::run`].
    pub elapsed: Duration,
    /// Samples, over all pixels, dropped ones included.
    pub samples: u64,
    /// Closest-hit queries.
    pub closest: u64,
    /// Occlusion queries.
    pub occlusion: u64,
    /// Rays that ray tracing did not follow, because they weigh too little.
    pub pruned: u64,
    /// Spans of polygons in rows of samples, hidden ones included, of scanline techniques.
    pub spans: u64,
    /// Samples left out because they were no radiance.
    pub dropped: u64,
    /// The first of them.
    pub details: Vec<Dropped>,
}

impl Statistics {
    /// Whether a render could have done so much: counts of a part may come from anywhere.
    pub(crate) fn is_plausible(&self) -> bool {
        let counts = [self.samples, self.closest, self.occlusion, self.pruned, self.spans, self.dropped];
        self.elapsed < Duration::from_secs(1 << 40)
            && counts.iter().all(|&count| count < 1 << 62)
            && self.details.len() <= DETAILS
    }

    /// Adds what another part of the render has done.
    pub(crate) fn join(&mut self, other: Self) {
        self.elapsed = self.elapsed.saturating_add(other.elapsed);
        let sums = [
            (&mut self.samples, other.samples),
            (&mut self.closest, other.closest),
            (&mut self.occlusion, other.occlusion),
            (&mut self.pruned, other.pruned),
            (&mut self.spans, other.spans),
            (&mut self.dropped, other.dropped),
        ];
        sums.into_iter().for_each(|(sum, more)| *sum = sum.saturating_add(more));
        self.details.extend(other.details);
        self.details.sort_by_key(|dropped| (dropped.sample, dropped.pixel[1], dropped.pixel[0]));
        self.details.truncate(DETAILS);
    }
}

/// A share of the work of a render: samples of the pixels of some tiles, and paths from lamps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Share {
    /// Which samples.
    pub samples: Range<u64>,
    /// Of which tiles, by number; of all where there is nothing.
    pub tiles: Option<Range<usize>>,
    /// Whether the paths from lamps that belong to these samples are followed, where the settings ask for such paths.
    pub from_lamps: bool,
}

impl From<Range<u64>> for Share {
    /// These samples of all pixels.
    fn from(samples: Range<u64>) -> Self {
        Self { samples, tiles: None, from_lamps: true }
    }
}

/// As many threads as a setting asks for; 0 for as many as there are processors.
///
/// # Errors
/// [`RenderError::Setting`] when there are too many, or none can be started.
pub fn pool(threads: usize) -> Result<rayon::ThreadPool, RenderError> {
    if threads > MOST_THREADS {
        return Err(RenderError::Setting(format!("threads must be 0 to {MOST_THREADS}, not {threads}")));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|e| RenderError::Setting(format!("no threads can be started: {e}")))
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

/// A render under way: runs follow each other, and the film accumulates.
pub struct Render {
    job: Job,
    renderer: Box<dyn TileRenderer>,
    basis: Arc<dyn Basis>,
    film: Film,
    statistics: Statistics,
    solution: Option<Arc<RadiositySolution>>,
    pool: rayon::ThreadPool,
}

impl Render {
    /// A render of a scene, with an empty film.
    ///
    /// # Errors
    /// [`RenderError`] when a setting is unknown or out of range, or the scene has no light.
    pub fn new(scene: Arc<Scene>, settings: Settings) -> Result<Self, RenderError> {
        Self::of(scene, settings, None)
    }

    /// A render of a scene with light between its surfaces that has been solved for already.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of(
        scene: Arc<Scene>,
        settings: Settings,
        solution: Option<Arc<RadiositySolution>>,
    ) -> Result<Self, RenderError> {
        Self::unless_cancelled(scene, settings, solution, &Cancel::default())
    }

    /// The same; where the light between surfaces has to be solved for first, that stops when it is told to.
    ///
    /// # Errors
    /// As [`Self::new`]; what is cancelled is no render.
    pub fn unless_cancelled(
        scene: Arc<Scene>,
        settings: Settings,
        solution: Option<Arc<RadiositySolution>>,
        cancel: &Cancel,
    ) -> Result<Self, RenderError> {
        Self::with(scene, settings, solution, None, cancel)
    }

    /// A render of a scene that differs from this one's in its camera, or by other settings, in the same wavelengths: to fit
    /// them again would take longer than a first image of few pixels. They are fitted again where the sampling or the
    /// number of lamps differs.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn again(
        &self,
        scene: Arc<Scene>,
        settings: Settings,
        solution: Option<Arc<RadiositySolution>>,
    ) -> Result<Self, RenderError> {
        let same = settings.sampling == self.job.settings.sampling
            && scene.lamps.len() == self.job.scene.lamps.len()
            && scene.range == self.job.scene.range;
        Self::with(scene, settings, solution, same.then(|| Arc::clone(&self.basis)), &Cancel::default())
    }

    fn with(
        scene: Arc<Scene>,
        settings: Settings,
        solution: Option<Arc<RadiositySolution>>,
        wavelengths: Option<Arc<dyn Basis>>,
        cancel: &Cancel,
    ) -> Result<Self, RenderError> {
        let technique: Technique = settings.technique.parse().map_err(RenderError::Setting)?;
        let illumination: Illumination = settings.illumination.parse().map_err(RenderError::Setting)?;
        pairs::check(technique, illumination).map_err(RenderError::Setting)?;
        pairs::check_shading(&scene, &settings, technique, illumination).map_err(RenderError::Setting)?;
        pairs::check_rays(&scene, &settings, technique).map_err(RenderError::Setting)?;
        if technique.is_scanline() && settings.layers.contains(&Layer::Lamps) {
            return Err(RenderError::Setting(format!("{technique} does not keep lamps apart; path does")));
        }
        if !technique.is_scanline() && settings.layers.contains(&Layer::Terms) {
            return Err(RenderError::Setting(
                "only scanline techniques keep the terms of a model apart: constant, gouraud, phong".into(),
            ));
        }
        if !(0.0..=10.0).contains(&settings.ambient) {
            return Err(RenderError::Setting(format!(
                "ambient must lie between 0 and 10, not {}",
                settings.ambient
            )));
        }
        if settings.subdivide.is_some_and(|area| !(area >= 1.0 && area.is_finite())) {
            return Err(RenderError::Setting("subdivide must be an area of 1 pixel or more".into()));
        }
        if matches!(settings.shadows, Shadows::Maps(size) if !(64..=16384).contains(&size)) {
            return Err(RenderError::Setting("shadow maps must be 64 to 16384 texels wide".into()));
        }
        if !(settings.threshold >= 0.0 && settings.threshold < 1.0) {
            return Err(RenderError::Setting(format!(
                "threshold must lie from 0 to below 1, not {}",
                settings.threshold
            )));
        }
        if matches!(settings.light_centres, LightCentres::Fixed(count) if !(1..=4096).contains(&count)) {
            return Err(RenderError::Setting("fixed light centres must be 1 to 4096".into()));
        }
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
        let pool = pool(settings.threads)?;
        let basis: Arc<dyn Basis> = match (&solution, wavelengths) {
            // What was solved for in some samples is seen in those.
            (Some(solution), _) => Arc::clone(&solution.basis),
            (None, Some(given)) => given,
            (None, None) => pool.install(|| basis(&scene, &settings, cancel))?,
        };
        cancel.check().map_err(|e| RenderError::Setting(e.to_string()))?;
        let by_lamp = settings.layers.contains(&Layer::Lamps);
        let (groups, group_of) = group_lamps(&*basis, scene.lamps.len(), by_lamp);
        let names: Vec<String> = scene.lamps.iter().map(|lamp| lamp.name.clone()).collect();
        // A scanline keeps its width, so that edges and spans go on.
        let tile = if technique.is_scanline() { [u32::MAX, BAND] } else { [settings.tile.clamp(1, 4096); 2] };
        let film = Film::with_tiles(scene.camera.crop, tile, &settings, &names, basis.len());
        let solution = match (technique, solution) {
            (technique, None) if technique.is_solved() => {
                let solved = pool.install(|| {
                    let basis = Arc::clone(&basis);
                    RadiositySolution::new_unless_cancelled(&scene, &settings, basis, Given::Nothing, cancel)
                });
                Some(Arc::new(solved.map_err(RenderError::Setting)?))
            }
            (_, given) => given,
        };
        let (settings_of, solved) = (&settings, solution.as_deref());
        let how =
            How { technique, illumination, settings: settings_of, light: Light::Lamps, solution: solved };
        let renderer = pool.install(|| renderer(&scene, how, &*basis, (&groups, &group_of)))?;
        let white = Observer::cie_1931_2deg().xyz(&Curve::constant(1.0), scene.range);
        let albedo = scene.materials.iter().map(|material| {
            let reflectance = material.representative_reflectance(scene.range);
            let xyz = Observer::cie_1931_2deg().xyz(&reflectance, scene.range);
            xyz.map(|v| (v / white[1]) as f32)
        });
        let albedo = albedo.collect();
        let job = Job {
            albedo,
            haze: Haze::new(&scene, &film.plan, &*basis),
            filter: FilterSampler::new(&settings.filter),
            numbers: Numbers::new(settings.sampler, settings.strata),
            plan: film.plan.clone(),
            channels: film.channels(),
            group_of,
            scene,
            settings,
        };
        Ok(Self { job, renderer, basis, film, statistics: Statistics::default(), solution, pool })
    }

    /// Renders samples of every pixel, or another share of the work, without those that it holds already; false when it was
    /// cancelled. Tiles are taken in any order by any thread, and the bits do not depend on it.
    pub fn run(&mut self, share: impl Into<Share>, progress: &Progress) -> bool {
        let start = Instant::now();
        let Share { samples, tiles, from_lamps } = share.into();
        let count = samples.end.saturating_sub(samples.start);
        let most = self.film.tiles.len();
        let tiles = tiles.map_or(0..most, |tiles| tiles.start.min(most)..tiles.end.min(most));
        let (job, renderer) = (&self.job, &*self.renderer);
        let tiles = self.film.tiles.get_mut(tiles).unwrap_or_default();
        progress.done.store(0, Ordering::Relaxed);
        let pixels: usize = tiles.iter().map(|tile| tile.samples.len()).sum();
        let from_lamps = from_lamps && self.film.from_lamps.is_some();
        let of_lamps =
            self.film.from_lamps.as_ref().filter(|_| from_lamps).map_or(0, |film| film.samples.len());
        progress.total.store((pixels + of_lamps) as u64 * count, Ordering::Relaxed);
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
        let mut complete = results.iter().all(Option::is_some);
        let mut results: Vec<TileCounts> = results.into_iter().flatten().collect();
        complete &= !from_lamps || self.run_from_lamps(samples, progress, &mut results);
        for result in results {
            self.statistics.samples += result.samples;
            self.statistics.closest += result.counts.closest;
            self.statistics.occlusion += result.counts.occlusion;
            self.statistics.pruned += result.counts.pruned;
            self.statistics.spans += result.spans;
            self.statistics.dropped += result.dropped.len() as u64;
            for (pixel, sample) in result.dropped {
                if self.statistics.details.len() < DETAILS {
                    let details = self.blame(pixel, sample);
                    self.statistics.details.push(details);
                }
            }
        }
        self.statistics.elapsed = self.statistics.elapsed.saturating_add(start.elapsed());
        complete
    }

    /// Follows the paths from lamps that belong to samples, as many as the image has pixels to each; false when it was cancelled.
    fn run_from_lamps(
        &mut self,
        samples: Range<u64>,
        progress: &Progress,
        results: &mut Vec<TileCounts>,
    ) -> bool {
        /// Paths that are followed at once.
        const PATHS: u64 = 4096;
        let Some(film) = &mut self.film.from_lamps else { return true };
        let (job, renderer) = (&self.job, &*self.renderer);
        let paths: u64 = job.scene.camera.size.iter().map(|&v| u64::from(v)).product();
        let pixels = film.samples.len() as u64;
        // Few samples at a time, so that a cancelled run has not begun what it does not finish.
        let step = (16 * PATHS / paths).max(1);
        let mut from = samples.start;
        while from < samples.end {
            if progress.is_cancelled() {
                return false;
            }
            let part = from..(from + step).min(samples.end);
            from = part.end;
            let missing: Vec<u64> = film.claim(part.clone()).into_iter().flatten().collect();
            let work: Vec<(u64, Range<u64>)> = missing
                .iter()
                .flat_map(|&sample| {
                    (0..paths.div_ceil(PATHS)).map(move |i| (sample, i * PATHS..((i + 1) * PATHS).min(paths)))
                })
                .collect();
            let shared = Mutex::new(&mut *film);
            let found: Vec<TileCounts> = self.pool.install(|| {
                work.into_par_iter()
                    .with_max_len(1)
                    .map(|(sample, paths)| {
                        let (mut places, mut values) = (Vec::new(), Vec::new());
                        let counts = renderer.paths_from_lamps(job, paths, sample, &mut |pixel, channels| {
                            places.push(pixel);
                            values.extend_from_slice(channels);
                        });
                        let mut film = shared.lock().unwrap_or_else(PoisonError::into_inner);
                        for (pixel, channels) in places.iter().zip(values.chunks(job.channels)) {
                            film.splat(*pixel, channels);
                        }
                        counts
                    })
                    .collect()
            });
            film.count(missing.len() as u32);
            results.extend(found);
            progress.done.fetch_add(pixels * (part.end - part.start), Ordering::Relaxed);
        }
        true
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
            .map(|vertex| vertex.object)
            // Where no path is followed, it is what is seen there that was shaded.
            .or_else(|| replay.passes.is_empty().then(|| self.seen_first(pixel, sample)).flatten())
            .map(|object| &self.job.scene.objects[object as usize]);
        Dropped {
            pixel,
            sample,
            object: guilty.map(|o| o.name.clone()),
            material: guilty.map(|o| self.job.scene.materials[o.material].name.clone()),
        }
    }

    /// The object that a scanline technique sees in a pixel; with `antialiasing = coverage` one of those it sees.
    fn seen_first(&self, [x, y]: [u32; 2], sample: u64) -> Option<u32> {
        let Job { scene, settings, .. } = &self.job;
        let replicates = u64::from(settings.replicates.max(1));
        let [dx, dy] = self.job.shared_offset(sample / replicates, sample % replicates);
        let ray = scene.camera.ray(x as f32 + 0.5 + dx, y as f32 + 0.5 + dy, 0.0);
        scene.geometry.closest_hit(&ray).map(|hit| hit.object)
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

    /// What the film holds, as the bytes of a [`Part`], to be kept or sent.
    ///
    /// # Errors
    /// [`PartError::Damaged`] if it cannot be written, which does not happen.
    pub fn part(&self) -> Result<Vec<u8>, PartError> {
        part::bytes_of(&self.film, &self.statistics)
    }

    /// Adds what another render of the same scene with the same settings has found, all of it or nothing. That they are the same
    /// is the caller's to know.
    ///
    /// # Errors
    /// [`PartError`] when it does not fit, or holds samples that are here already.
    pub fn join(&mut self, part: Part) -> Result<(), PartError> {
        part.join(&mut self.film, &mut self.statistics)
    }

    /// Forgets all samples, but nothing that was prepared for them.
    pub fn clear(&mut self) {
        self.film.clear();
        self.statistics = Statistics::default();
    }

    /// The light between surfaces, where it has been solved for.
    #[must_use]
    pub fn solution(&self) -> Option<&Arc<RadiositySolution>> {
        self.solution.as_ref()
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

    /// What the spectral sampling costs in colour in this scene (CIEDE2000 against 1 nm), measured on paths of its own.
    #[must_use]
    pub fn spectral_error(&self, cancel: &Cancel) -> SpectralError {
        self.pool.install(|| spectral_error(&self.job.scene, &self.job.settings, &*self.basis, cancel))
    }

    /// Sentences on what the user should know before rendering this scene with this sampling.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let mut found = crate::warnings::warnings(&self.job.scene, &*self.basis, &self.job.settings.sampling);
        found.extend(pairs::warning(&self.job.settings));
        found.extend(pairs::misfits(&self.job.scene, &self.job.settings));
        found
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
