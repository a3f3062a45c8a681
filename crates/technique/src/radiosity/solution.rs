//! The solution of a scene: irradiance of all sides for one unit of light from each lamp.

use super::cutting::cut;
use super::directional::{self, Directional};
use super::reflectance::Counted;
use super::specular::{Followed, Mirrors, Scratch, Seen};
use super::update::{repaint, shift};
use super::{direct, reflectance};
use crate::lanes::Pass;
use crate::passes::{Light, passes_of};
use crate::settings::{Settings, Technique};
use illuminant_illumination::{General, Historic, Illumination, IlluminationModel, Prepare};
use illuminant_radiosity::{
    Cancel, Cancelled, Elements, FormFactors, Hemicube, Looking, Method, Points, Problem, Sparse,
    SpectralRows,
};
use illuminant_sampling::{Basis, Role};
use illuminant_scene::Scene;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// The lanes in which scenes are solved, pass by pass.
pub(super) const LANES: usize = 8;
/// With more lamps than this their light is not kept apart.
const MOST_LAMPS: usize = 32;

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

/// Whether what surfaces themselves reflect counts as diffuse, for a technique.
pub(super) fn counted(settings: &Settings) -> Counted {
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
pub(super) use with_model;

/// What of a solution is known already.
#[derive(Clone, Debug, Default)]
pub enum Given {
    /// Nothing.
    #[default]
    Nothing,
    /// All rows of form factors ([`RowFinder`](super::RowFinder)), for `radiosity`.
    Rows(Sparse),
    /// All of it.
    All(Box<RadiosityParts>),
}

impl RadiositySolution {
    /// Solves for the light between the surfaces of a scene, in the samples of a basis.
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn new(scene: &Scene, settings: &Settings, basis: Arc<dyn Basis>) -> Result<Self, String> {
        Self::new_unless_cancelled(scene, settings, basis, Given::Nothing, &Cancel::default())
    }

    /// The same, of which something may be known already, and which stops within a few rows of form factors or steps of the solver when
    /// it is told to.
    ///
    /// # Errors
    /// As [`Self::new`]; what is cancelled has no result.
    pub fn new_unless_cancelled(
        scene: &Scene,
        settings: &Settings,
        basis: Arc<dyn Basis>,
        given: Given,
        cancel: &Cancel,
    ) -> Result<Self, String> {
        with_model!(settings, solve(scene, settings, basis, given, cancel))
    }

    /// The solution of the same surfaces with other paints: the form factors and the light of lamps are kept, and the equations solved again.
    /// Other spectra of lamps need no solution at all ([`Self::light`]).
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn repainted(&self, scene: &Scene, settings: &Settings) -> Result<Self, String> {
        self.repainted_unless_cancelled(scene, settings, &Cancel::default())
    }

    /// The same, which stops when it is told to.
    ///
    /// # Errors
    /// As [`Self::repainted`]; what is cancelled has no result.
    pub fn repainted_unless_cancelled(
        &self,
        scene: &Scene,
        settings: &Settings,
        cancel: &Cancel,
    ) -> Result<Self, String> {
        with_model!(settings, repaint(self, scene, settings, cancel))
    }

    /// The solution after objects have moved (Baum et al. 1986): only rows of form factors that see a moved object, where it was or where
    /// it is, are found again. With the number of those rows.
    ///
    /// # Errors
    /// A sentence on what cannot be.
    pub fn moved(
        &self,
        scene: &Scene,
        settings: &Settings,
        objects: &[usize],
    ) -> Result<(Self, usize), String> {
        self.moved_unless_cancelled(scene, settings, objects, &Cancel::default())
    }

    /// The same, which stops when it is told to.
    ///
    /// # Errors
    /// As [`Self::moved`]; what is cancelled has no result.
    pub fn moved_unless_cancelled(
        &self,
        scene: &Scene,
        settings: &Settings,
        objects: &[usize],
        cancel: &Cancel,
    ) -> Result<(Self, usize), String> {
        with_model!(settings, shift(self, scene, settings, objects, cancel))
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
        let (given, cancel) = (Given::All(Box::new(parts)), Cancel::default());
        with_model!(settings, solve(scene, settings, basis, given, &cancel))
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

    pub(super) fn problem(&self, tolerance: f64) -> Problem<'_> {
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

/// Whether the light of each lamp is kept apart.
fn keeps_apart(scene: &Scene) -> bool {
    scene.lamps.len() <= MOST_LAMPS
}

/// The passes for solving, with the column of each lamp and how many there are.
pub(super) fn prepared<M: Prepare>(
    illumination: Illumination,
    scene: &Scene,
    basis: &dyn Basis,
) -> (Vec<Pass<LANES, M>>, Vec<usize>, usize) {
    let (lamps, per_unit) = (scene.lamps.len(), keeps_apart(scene));
    let (column_of, columns) =
        if per_unit { ((0..lamps).collect::<Vec<_>>(), lamps) } else { (vec![0; lamps], 1) };
    let ones = vec![1.0; lamps];
    let light = if per_unit { Light::Flat(&ones) } else { Light::Lamps };
    (passes_of::<LANES, M>(scene, illumination, basis, None, &[0], light), column_of, columns)
}

pub(super) fn solve<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    scene: &Scene,
    settings: &Settings,
    basis: Arc<dyn Basis>,
    given: Given,
    cancel: &Cancel,
) -> Result<RadiositySolution, String> {
    let told = &settings.radiosity;
    let (method, solver) = told.checked()?;
    let mut clock = Instant::now();
    let mut lap = || std::mem::replace(&mut clock, Instant::now()).elapsed().as_secs_f64();
    let (passes, column_of, columns) = prepared::<M>(illumination, scene, &*basis);
    let counted = counted(settings);
    let elements = cut(scene, (told, counted), &passes, cancel)?;
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
        per_unit: keeps_apart(scene),
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
        let (sent, quality) = directional::solve::<M>(
            illumination,
            scene,
            settings,
            &*found.basis,
            &elements,
            &points,
            cancel,
        )?;
        found.directional = Some(Arc::new(sent));
        (found.report.history, found.report.creation) = (quality.history, quality.creation);
        found.report.seconds[3] = lap();
        return Ok(found);
    }
    if let Given::All(parts) = given {
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
        found.direct =
            direct::of_sides(scene, &found.elements, &passes, of_lamps, samples, told.light_samples, cancel)?;
        (found.reflectance, found.transmittance) =
            reflectance::of_sides(scene, &found.elements, &passes, samples, counted, cancel)?;
        found.report.seconds[1] = lap();
        match counted {
            Counted::All => {
                let (geometry, elements) = (&*scene.geometry, &found.elements);
                found.factors = Arc::new(match given {
                    Given::Rows(rows) if rows.height() == sides && rows.width == elements.patches.len() => {
                        FormFactors::from_rows(rows)
                    }
                    Given::Rows(_) => {
                        return Err("the rows of form factors are not those of this scene".into());
                    }
                    _ => FormFactors::unless_cancelled(geometry, elements, method, cancel)?,
                });
            }
            Counted::Diffuse => found.look_around(scene, settings, &passes, method, cancel)?,
        }
        found.report.seconds[2] = lap();
        let problem = found.problem(told.tolerance);
        let solved = problem.solve_unless_cancelled(solver, cancel).map_err(|e| e.to_string())?;
        (found.irradiance, found.report.history) = (solved.irradiance, solved.history);
        found.report.seconds[3] = lap();
    }
    found.judge();
    Ok(found)
}

impl RadiositySolution {
    /// Fills in how good form factors and solution are.
    pub(super) fn judge(&mut self) {
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
        cancel: &Cancel,
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
                |scratch, side| {
                    cancel.check()?;
                    Ok(match &mirrored {
                        Some((cube, mirrors)) => followed.look_into_mirrors(side, cube, mirrors, scratch),
                        None => followed.look(side, scratch),
                    })
                },
            )
            .collect::<Result<_, Cancelled>>()?;
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
