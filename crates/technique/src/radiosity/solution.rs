//! The solution of a scene: irradiance of all sides for one unit of light from each lamp.

use super::direct;
use super::directional::{self, Directional};
use super::reflectance::{Counted, is_clear, of_materials, of_textured_side};
use super::settings::RadiositySettings;
use super::specular::{Followed, Mirrors, Scratch, Seen};
use crate::lanes::Pass;
use crate::passes::{Light, group_lamps, passes_of};
use crate::settings::{Settings, Technique};
use glam::Vec3;
use illuminant_illumination::{General, Historic, Illumination, IlluminationModel, Prepare, Surface};
use illuminant_radiosity::{
    Elements, FormFactors, Hemicube, Looking, Method, Part, Points, Problem, Refinement, Sparse,
    SpectralRows, Subdivision, reached,
};
use illuminant_sampling::{Basis, Role};
use illuminant_scene::Scene;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// The lanes in which scenes are solved, pass by pass.
const LANES: usize = 8;
/// With more lamps than this their light is not kept apart.
const MOST_LAMPS: usize = 32;
/// Elements that tell which sides of objects light reaches.
const COARSE: f64 = 3000.0;
/// How often elements may be cut again.
const ROUNDS: usize = 8;

/// How a solution came about.
#[derive(Clone, Debug, Default)]
pub struct RadiosityReport {
    /// Elements, sides and patches.
    pub elements: usize,
    /// Sides of elements that light reaches.
    pub sides: usize,
    /// Patches that sides make.
    pub patches: usize,
    /// Form factors that are not 0.
    pub factors: usize,
    /// How far rows of form factors are from 1, mean and worst.
    pub closure: [f64; 2],
    /// How far form factors are from reciprocity.
    pub reciprocity: f64,
    /// The relative residual after each step.
    pub history: Vec<f64>,
    /// The part of all light that is neither absorbed nor leaves.
    pub imbalance: f64,
    /// The most by which what leaves a patch exceeds what arrives, as a part of it, where that is solved for in all directions.
    pub creation: f64,
    /// Seconds for cutting surfaces, direct light, form factors, and solving.
    pub seconds: [f64; 4],
}

/// The solution of a scene.
#[derive(Clone, Debug)]
pub struct RadiositySolution {
    /// What the samples mean.
    pub basis: Arc<dyn Basis>,
    /// The sides.
    pub elements: Arc<Elements>,
    /// The corners between which values are interpolated.
    pub points: Arc<Points>,
    /// The form factors.
    pub factors: Arc<FormFactors>,
    /// Spectral samples.
    pub samples: usize,
    /// The column of each lamp; they share one where there are many.
    pub column_of: Vec<usize>,
    /// How many columns of lamps there are.
    pub columns: usize,
    /// Whether a column is for light of 1 in every sample; otherwise it is for what its lamps give.
    pub per_unit: bool,
    /// Form factors by way of mirrors and glass, where those are followed.
    pub specular: Option<Arc<SpectralRows>>,
    /// Whether what surfaces themselves reflect counts as diffuse: where it is not followed.
    pub(crate) counted: Counted,
    /// Of each side the reflectance in every sample.
    pub reflectance: Vec<f32>,
    /// Of each side the transmittance in every sample; nothing where no surface lets light through diffusely.
    pub transmittance: Vec<f32>,
    /// Of each side, for each column, the irradiance straight from lamps in every sample.
    pub direct: Vec<f32>,
    /// The part of it that came by way of mirrors and glass; nothing where that is not followed.
    pub caustics: Vec<f32>,
    /// The same with what other surfaces send.
    pub irradiance: Vec<f32>,
    /// What patches send into all directions, where that has been solved for instead.
    pub(crate) directional: Option<Arc<Directional>>,
    /// How it came about.
    pub report: RadiosityReport,
}

/// What of a solution cannot be found again without much work: to be kept in files.
#[derive(Clone, Debug)]
pub struct RadiosityParts {
    /// The rows of form factors.
    pub rows: Sparse,
    /// As in [`RadiositySolution`].
    pub specular: Option<SpectralRows>,
    /// As in [`RadiositySolution`].
    pub caustics: Vec<f32>,
    /// As in [`RadiositySolution`].
    pub direct: Vec<f32>,
    /// As in [`RadiositySolution`].
    pub irradiance: Vec<f32>,
    /// As in [`RadiositySolution`].
    pub reflectance: Vec<f32>,
    /// As in [`RadiositySolution`].
    pub transmittance: Vec<f32>,
}

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

/// Whether what surfaces themselves reflect counts as diffuse, for a technique.
fn counted(settings: &Settings) -> Counted {
    if settings.technique == Technique::Hybrid.to_string() { Counted::Diffuse } else { Counted::All }
}

/// A generic step, for the illumination model that settings name.
macro_rules! with_model {
    ($settings:expr, $step:ident($($argument:expr),*)) => {{
        let illumination: Illumination = $settings.illumination.parse()?;
        match illumination {
            Illumination::General => $step::<General<LANES>>(illumination, $($argument),*),
            _ => $step::<Historic<LANES>>(illumination, $($argument),*),
        }
    }};
}

impl RadiositySolution {
    /// Solves for the light between the surfaces of a scene, in the samples of a basis.
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn new(scene: &Scene, settings: &Settings, basis: Arc<dyn Basis>) -> Result<Self, String> {
        with_model!(settings, solve(scene, settings, basis, None))
    }

    /// The solution of the same surfaces with other paints: the form factors and the light of lamps are kept, and the equations solved again.
    /// Other spectra of lamps need no solution at all ([`Self::light`]).
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn repainted(&self, scene: &Scene, settings: &Settings) -> Result<Self, String> {
        with_model!(settings, repaint(self, scene, settings))
    }

    /// The solution after objects have moved (Baum et al. 1986): only rows of form factors that see a moved object, where it was or where
    /// it is, are found again. With the number of those rows.
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn moved(
        &self,
        before: &Scene,
        scene: &Scene,
        settings: &Settings,
        objects: &[usize],
    ) -> Result<(Self, usize), String> {
        with_model!(settings, shift(self, before, scene, settings, objects))
    }

    /// A solution from its parts, for the scene and settings that it was made for.
    ///
    /// # Errors
    /// A sentence on what does not fit.
    pub fn restored(
        scene: &Scene,
        settings: &Settings,
        basis: Arc<dyn Basis>,
        parts: RadiosityParts,
    ) -> Result<Self, String> {
        with_model!(settings, solve(scene, settings, basis, Some(parts)))
    }

    /// Of each column of lamps the light in every sample by which its irradiance is multiplied, if the lamps are those of `scene`.
    #[must_use]
    pub fn light(&self, scene: &Scene) -> Vec<Vec<f32>> {
        if !self.per_unit {
            return vec![vec![1.0; self.samples]; self.columns];
        }
        let reduce =
            |spectrum| self.basis.reduce(spectrum, Role::Emission).iter().map(|v| *v as f32).collect();
        scene.lamps.iter().map(|lamp| reduce(&lamp.spectrum)).collect()
    }

    /// The radiosity of patches, of each column of lamps in every sample.
    pub(super) fn radiosity(&self) -> Vec<f32> {
        self.problem(1e-5).restricted(&self.irradiance)
    }

    /// Whether it holds what patches send into all directions, and no irradiance.
    #[must_use]
    pub fn is_directional(&self) -> bool {
        self.directional.is_some()
    }

    /// Bytes that it takes.
    #[must_use]
    pub fn memory(&self) -> usize {
        let specular = self.specular.as_ref().map_or(0, |rows| rows.memory());
        let directional = self.directional.as_ref().map_or(0, |sent| sent.memory());
        let values = self.direct.len() + self.caustics.len() + self.irradiance.len() + self.reflectance.len();
        self.factors.rows.memory() + specular + directional + 4 * values
    }

    fn problem(&self, tolerance: f64) -> Problem<'_> {
        Problem {
            elements: &self.elements,
            factors: &self.factors,
            specular: self.specular.as_deref(),
            reflectance: &self.reflectance,
            transmittance: &self.transmittance,
            direct: &self.direct,
            samples: self.samples,
            tolerance,
        }
    }
}

/// The mean irradiance of every side straight from each column's lamps, in the samples of all passes.
fn direct_light<M: IlluminationModel<LANES> + Prepare>(
    scene: &Scene,
    elements: &Elements,
    passes: &[Pass<LANES, M>],
    (column_of, columns): (&[usize], usize),
    samples: usize,
    count: u32,
) -> Vec<f32> {
    let width = columns * samples;
    let mut found = vec![0f32; elements.sides.len() * width];
    found.par_chunks_mut(width.max(1)).enumerate().for_each(|(side, row)| {
        for pass in passes {
            for (lamp, &column) in column_of.iter().enumerate() {
                let light = direct::mean(scene, elements, pass, lamp, side as u32, count);
                let slots = &mut row[column * samples + pass.samples.start..];
                for (slot, v) in slots.iter_mut().zip(&light.0[..pass.samples.len()]) {
                    *slot += v;
                }
            }
        }
    });
    found
}

/// Cuts elements again where the light of lamps changes fast from corner to corner (Cohen et al. 1986), down to a 64th of their area.
fn refined<M: IlluminationModel<LANES> + Prepare>(
    scene: &Scene,
    mut elements: Elements,
    passes: &[Pass<LANES, M>],
    threshold: f64,
    (parts, patch, lit): (&[Part], f64, &dyn Fn(usize, bool) -> bool),
    (count, most): (u32, usize),
) -> Elements {
    let smallest = elements.all.iter().map(|e| e.area).fold(0.0, f64::max) / 64.0;
    let lamps: Vec<usize> = (0..scene.lamps.len()).collect();
    for _ in 0..ROUNDS {
        let all = (&lamps[..], lamps.len());
        let light = direct_light(scene, &elements, &passes[..1], all, LANES, count);
        let width = LANES * lamps.len();
        // Lamps of the scene's own strength, so that weak ones do not matter.
        let strength: Vec<f32> = scene.lamps.iter().map(|l| l.spectrum.area(scene.range) as f32).collect();
        let of_side = |side: u32| -> f32 {
            let row = &light[side as usize * width..][..width];
            row.chunks(LANES).zip(&strength).map(|(row, s)| row[0] * s).sum()
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
    elements
}

/// The elements of a scene.
fn cut<M: IlluminationModel<LANES> + Prepare>(
    scene: &Scene,
    (told, counted): (&RadiositySettings, Counted),
    passes: &[Pass<LANES, M>],
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
            let of = |lamp| direct::mean(scene, &coarse, &passes[0], lamp, side, 4);
            (0..lamps).map(|lamp| of(lamp).0.iter().sum()).collect()
        })
        .collect();
    let largest: Vec<f32> =
        (0..lamps).map(|lamp| light.iter().map(|row| row[lamp]).fold(0.0, f32::max)).collect();
    // What is less than this is the rounding of a lamp that lies in the plane of a side.
    let lit = reached(geometry, &coarse, &sheets, &|side| {
        (0..lamps).any(|lamp| light[side as usize][lamp] > 1e-5 * largest[lamp])
    });
    let lit = |object: usize, back: bool| lit[object][usize::from(back)];
    // A cut halves, so elements end between half the limit and the limit: three quarters of it on average.
    let element = total / (0.75 * f64::from(told.elements));
    let patch = told.patches.map_or(0.0, |patches| total / (0.75 * f64::from(patches)));
    let mut elements = Elements::new(geometry, &parts, Refinement { element, patch }, &lit);
    if let Some(threshold) = told.adaptive {
        let most = 16 * told.elements as usize;
        elements =
            refined(scene, elements, passes, threshold, (&parts, patch, &lit), (told.light_samples, most));
    }
    if elements.sides.is_empty() {
        return Err("no light reaches any surface that is diffuse".into());
    }
    Ok(elements)
}

/// How many groups of lamps there are that share a map to XYZ, and the group of each lamp.
pub(super) fn columns_of(scene: &Scene, basis: &dyn Basis) -> (usize, Vec<usize>) {
    let (groups, group_of) = group_lamps(basis, scene.lamps.len(), false);
    (groups.len(), group_of)
}

/// The passes for solving, with the column of each lamp and how many there are.
fn prepared<M: Prepare>(
    illumination: Illumination,
    scene: &Scene,
    basis: &dyn Basis,
) -> (Vec<Pass<LANES, M>>, Vec<usize>, usize) {
    let lamps = scene.lamps.len();
    let per_unit = lamps <= MOST_LAMPS;
    let (column_of, columns) =
        if per_unit { ((0..lamps).collect::<Vec<_>>(), lamps) } else { (vec![0; lamps], 1) };
    let ones = vec![1.0; lamps];
    let light = if per_unit { Light::Flat(&ones) } else { Light::Lamps };
    (passes_of::<LANES, M>(scene, illumination, basis, None, &[0], light), column_of, columns)
}

fn solve<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    scene: &Scene,
    settings: &Settings,
    basis: Arc<dyn Basis>,
    parts: Option<RadiosityParts>,
) -> Result<RadiositySolution, String> {
    let told = &settings.radiosity;
    let (method, solver) = told.checked()?;
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
    let (passes, column_of, columns) = prepared::<M>(illumination, scene, &*basis);
    let counted = counted(settings);
    let elements = cut(scene, (told, counted), &passes)?;
    let points = Points::new(&scene.geometry, &elements);
    let (samples, sides) = (basis.len(), elements.sides.len());
    let report = RadiosityReport {
        elements: elements.all.len(),
        sides,
        patches: elements.patches.len(),
        ..RadiosityReport::default()
    };
    let mut found = RadiositySolution {
        points: Arc::new(points),
        factors: Arc::new(FormFactors::from_rows(Sparse::default())),
        elements: Arc::new(elements),
        samples,
        column_of,
        columns,
        per_unit: scene.lamps.len() <= MOST_LAMPS,
        specular: None,
        counted,
        reflectance: Vec::new(),
        transmittance: Vec::new(),
        direct: Vec::new(),
        caustics: Vec::new(),
        irradiance: Vec::new(),
        directional: None,
        report,
        basis,
    };
    found.report.seconds[0] = lap();
    if settings.technique == Technique::SpecularRadiosity.to_string() {
        let (elements, points) = (Arc::clone(&found.elements), Arc::clone(&found.points));
        let (sent, quality) =
            directional::solve::<M>(illumination, scene, settings, &*found.basis, &elements, &points)?;
        found.directional = Some(Arc::new(sent));
        (found.report.history, found.report.creation) = (quality.history, quality.creation);
        found.report.seconds[3] = lap();
        return Ok(found);
    }
    if let Some(parts) = parts {
        let fits = parts.rows.height() == sides
            && parts.rows.width == found.elements.patches.len()
            && parts.direct.len() == sides * columns * samples
            && parts.irradiance.len() == parts.direct.len()
            && parts.reflectance.len() == sides * samples
            && (parts.caustics.is_empty() || parts.caustics.len() == parts.direct.len())
            && (parts.transmittance.is_empty() || parts.transmittance.len() == sides * samples)
            && parts
                .specular
                .as_ref()
                .is_none_or(|rows| rows.starts.len() == sides + 1 && rows.samples == samples);
        if !fits {
            return Err(
                "the solution does not fit its scene: it was made by another version, or is damaged".into()
            );
        }
        found.factors = Arc::new(FormFactors::from_rows(parts.rows));
        found.specular = parts.specular.map(Arc::new);
        found.caustics = parts.caustics;
        (found.direct, found.irradiance) = (parts.direct, parts.irradiance);
        (found.reflectance, found.transmittance) = (parts.reflectance, parts.transmittance);
    } else {
        let of_lamps = (&found.column_of[..], columns);
        found.direct = direct_light(scene, &found.elements, &passes, of_lamps, samples, told.light_samples);
        (found.reflectance, found.transmittance) =
            reflectances(scene, &found.elements, &passes, samples, counted);
        found.report.seconds[1] = lap();
        match counted {
            Counted::All => {
                found.factors = Arc::new(FormFactors::new(&scene.geometry, &found.elements, method));
            }
            Counted::Diffuse => found.look_around(scene, settings, &passes, method)?,
        }
        found.report.seconds[2] = lap();
        let solved = found.problem(told.tolerance).solve(solver).map_err(|e| e.to_string())?;
        (found.irradiance, found.report.history) = (solved.irradiance, solved.history);
        found.report.seconds[3] = lap();
    }
    found.judge();
    Ok(found)
}

impl RadiositySolution {
    /// Fills in how good form factors and solution are.
    fn judge(&mut self) {
        self.report.factors = self.factors.rows.values.len();
        self.report.closure = self.factors.closure();
        self.report.reciprocity = self.factors.reciprocity(&self.elements);
        self.report.imbalance = self.problem(1e-5).imbalance(&self.irradiance);
    }

    /// Finds form factors by way of mirrors and glass too, and adds the light of lamps that comes so.
    fn look_around<M: IlluminationModel<LANES> + Prepare>(
        &mut self,
        scene: &Scene,
        settings: &Settings,
        passes: &[Pass<LANES, M>],
        method: Method,
    ) -> Result<(), String> {
        let looking = Looking::new(method);
        let mirrored = match method {
            Method::Scanline(n) => Some((Hemicube::new(n), Mirrors::new(scene, passes)?)),
            Method::Area(_) => {
                return Err(format!(
                    "hybrid follows light from mirror to mirror, and {method} does not: use rays or hemicube"
                ));
            }
            _ => None,
        };
        let (elements, mechanisms) = (Arc::clone(&self.elements), settings.radiosity.mechanisms);
        let followed = Followed {
            scene,
            elements: &elements,
            passes,
            looking: looking.as_ref(),
            threshold: settings.threshold as f32,
            column_of: &self.column_of,
            columns: self.columns,
            samples: self.samples,
            straight: mechanisms.diffuse_to_diffuse,
            specular: mechanisms.specular_to_diffuse,
        };
        let patches = elements.patches.len();
        let seen: Vec<Seen> = (0..elements.sides.len() as u32)
            .into_par_iter()
            .map_init(
                || Scratch::new(patches),
                |scratch, side| match &mirrored {
                    Some((cube, mirrors)) => followed.look_into_mirrors(side, cube, mirrors, scratch),
                    None => followed.look(side, scratch),
                },
            )
            .collect();
        if !mechanisms.diffuse_to_diffuse {
            self.direct.fill(0.0);
        }
        let (mut straight, mut specular) = (Vec::with_capacity(seen.len()), Vec::with_capacity(seen.len()));
        let width = self.columns * self.samples;
        for (direct, seen) in self.direct.chunks_mut(width.max(1)).zip(seen) {
            direct.iter_mut().zip(&seen.lamps).for_each(|(sum, v)| *sum += v);
            self.caustics.extend(&seen.lamps);
            straight.push(seen.straight);
            specular.push((seen.columns, seen.values));
        }
        self.factors = Arc::new(FormFactors::from_rows(Sparse::from_rows(&straight, patches)));
        let specular = SpectralRows::from_rows(&specular, self.samples);
        self.specular = (!specular.columns.is_empty()).then(|| Arc::new(specular));
        Ok(())
    }
}

fn repaint<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    old: &RadiositySolution,
    scene: &Scene,
    settings: &Settings,
) -> Result<RadiositySolution, String> {
    let (_, solver) = settings.radiosity.checked()?;
    let start = Instant::now();
    let (passes, ..) = prepared::<M>(illumination, scene, &*old.basis);
    let mut found = old.clone();
    (found.reflectance, found.transmittance) =
        reflectances(scene, &old.elements, &passes, old.samples, old.counted);
    let solved = found.problem(settings.radiosity.tolerance).solve(solver).map_err(|e| e.to_string())?;
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

fn shift<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    old: &RadiositySolution,
    before: &Scene,
    scene: &Scene,
    settings: &Settings,
    objects: &[usize],
) -> Result<(RadiositySolution, usize), String> {
    let told = &settings.radiosity;
    let (method, solver) = told.checked()?;
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
    let (passes, ..) = prepared::<M>(illumination, scene, &*old.basis);
    let elements = cut(scene, (told, old.counted), &passes)?;
    let looking = Looking::new(method).filter(|_| old.specular.is_none());
    let (Some(looking), true) = (looking, elements.is_alike(&old.elements)) else {
        // Elements are others, or ways of rays cannot be compared: all is new.
        let basis = Arc::clone(&old.basis);
        let found = solve::<M>(illumination, scene, settings, basis, None)?;
        let sides = found.elements.sides.len();
        return Ok((found, sides));
    };
    debug_assert_eq!(before.objects.len(), scene.objects.len());
    let mut touched = boxes(&old.elements, objects);
    touched.extend(boxes(&elements, objects));
    let mut found = old.clone();
    found.report.seconds[0] = lap();
    let of_lamps = (&old.column_of[..], old.columns);
    found.direct = direct_light(scene, &elements, &passes, of_lamps, old.samples, told.light_samples);
    found.report.seconds[1] = lap();
    let (factors, again) =
        old.factors.updated(&scene.geometry, &elements, &looking, method, objects, &touched);
    found.report.seconds[2] = lap();
    found.points = Arc::new(Points::new(&scene.geometry, &elements));
    (found.elements, found.factors) = (Arc::new(elements), Arc::new(factors));
    let solved = found.problem(told.tolerance).solve(solver).map_err(|e| e.to_string())?;
    (found.irradiance, found.report.history) = (solved.irradiance, solved.history);
    found.report.seconds[3] = lap();
    found.judge();
    Ok((found, again))
}

/// Of each side the reflectance in every sample, and the transmittance, if any surface has one.
fn reflectances<M: IlluminationModel<LANES> + Prepare>(
    scene: &Scene,
    elements: &Elements,
    passes: &[Pass<LANES, M>],
    samples: usize,
    counted: Counted,
) -> (Vec<f32>, Vec<f32>) {
    let of_materials: Vec<_> = passes.iter().map(|pass| of_materials(scene, pass, counted)).collect();
    let mut found = vec![0f32; 2 * elements.sides.len() * samples];
    found.par_chunks_mut(2 * samples).enumerate().for_each(|(side, rows)| {
        let object = elements.element_of(side as u32).object;
        let material = scene.objects[object as usize].material;
        let (reflected, transmitted) = rows.split_at_mut(samples);
        for (pass, of_materials) in passes.iter().zip(&of_materials) {
            let skin = &scene.skins[material];
            let [r, t] = if skin.colour.is_some() || skin.slope.is_some() {
                of_textured_side(scene, elements, pass, side as u32, counted)
            } else {
                of_materials[material]
            };
            reflected[pass.samples.clone()].copy_from_slice(&r.0[..pass.samples.len()]);
            transmitted[pass.samples.clone()].copy_from_slice(&t.0[..pass.samples.len()]);
        }
    });
    let rows = found.chunks(samples);
    let reflected: Vec<f32> = rows.clone().step_by(2).flatten().copied().collect();
    let mut transmitted: Vec<f32> = rows.skip(1).step_by(2).flatten().copied().collect();
    if transmitted.iter().all(|t| *t == 0.0) {
        transmitted.clear();
    }
    (reflected, transmitted)
}
