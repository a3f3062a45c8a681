//! A scene ready for rendering.

use crate::coefficients::overrides;
use crate::description::{
    AtmosphereData, CurveData, Description, DistributionData, FinishData, LightData, MaterialData, ShapeData,
    Sides, SurfaceData, UpAxis,
};
use crate::environment::EnvironmentImage;
use crate::lamp::{Lamp, LampForm, SurfaceLamp, spot_solid_angle};
use crate::lamp_chooser::{LampChooser, chooser};
use crate::photometry::{Source, absolute_spectrum};
use crate::skin::{Skin, Textures};
use crate::{Camera, Geometry};
use glam::{DVec3, Mat3, Vec3};
use illuminant_color::RgbSystem;
use illuminant_illumination::{Atmosphere, Film, Finish, Flakes, Material, Surface};
use illuminant_optics::facets::Shape;
use illuminant_optics::goniometry::Distribution;
use illuminant_spectrum::{Curve, Observer, SpectralRange};
use std::collections::HashMap;
use std::sync::Arc;
use thiserror::Error;

/// A mistake in a description, with the place where it stands.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{place}: {problem}")]
pub struct SceneError {
    /// Which entry.
    pub place: String,
    /// What is wrong.
    pub problem: String,
}

pub(crate) fn error(place: impl Into<String>, problem: impl Into<String>) -> SceneError {
    SceneError { place: place.into(), problem: problem.into() }
}

/// An image that a scene refers to: width, height, and linear RGB in rows from the top.
pub type ImageData = (usize, usize, Vec<f32>);

/// An object as the techniques see it.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its name.
    pub name: String,
    /// Index of its material.
    pub material: usize,
    /// Index of the lamp that it is.
    pub lamp: Option<usize>,
}

/// A scene: geometry shared with others, and all that may change without building it again.
pub struct Scene {
    /// The ray structure.
    pub geometry: Arc<Geometry>,
    /// The wavelengths.
    pub range: SpectralRange,
    /// What surfaces are made of.
    pub materials: Vec<Material>,
    /// What images say of each material.
    pub skins: Vec<Skin>,
    /// What is where.
    pub objects: Vec<Object>,
    /// Where light comes from.
    pub lamps: Vec<Lamp>,
    /// Which lamp a point asks.
    pub chooser: Box<dyn LampChooser>,
    /// The lamps that surround the scene.
    pub surroundings: Vec<usize>,
    /// The camera.
    pub camera: Camera,
    /// What becomes of light on its way to the eye, and the radiance of the fog.
    pub atmosphere: (Atmosphere, Curve),
}

impl Scene {
    /// A scene from geometry, a description and its images.
    ///
    /// # Errors
    /// [`SceneError`] that names the first entry that is wrong.
    pub fn new(
        geometry: Arc<Geometry>,
        description: &Description,
        images: &HashMap<String, ImageData>,
    ) -> Result<Self, SceneError> {
        let range = description.range;
        if range.min_nm < 1 || range.len() < 2 || range.len() > 20_000 {
            return Err(error("range", "must span from 2 to 20,000 wavelengths of 1 nm or more"));
        }
        let curves = description.curves.iter().enumerate().map(curve).collect::<Result<Vec<_>, _>>()?;
        let materials = description
            .materials
            .iter()
            .map(|m| material(m, &curves, range))
            .collect::<Result<Vec<_>, _>>()?;
        let skins = skins(description, &materials, &curves, images)?;
        if description.objects.len() != geometry.objects() {
            let problem = format!("{} described, {} placed", description.objects.len(), geometry.objects());
            return Err(error("objects", problem));
        }
        let mut lamps = Vec::new();
        let mut objects = Vec::with_capacity(description.objects.len());
        for (index, data) in description.objects.iter().enumerate() {
            let place = format!("objects.{}", data.name);
            if data.material >= materials.len() {
                return Err(error(place, format!("there is no material {}", data.material)));
            }
            let mut lamp = None;
            if let Some(emission) = &data.emission {
                let mut surface = SurfaceLamp::new(&geometry, index, emission.sides == Sides::Both);
                surface.distribution = distribution(emission.distribution.as_ref(), &place)?;
                if surface.distribution.as_ref().is_some_and(|d| d.value(1.0) <= 0.0) {
                    let problem = "the distribution of a surface must not be 0 along its normal";
                    return Err(error(place, problem));
                }
                let sides = if surface.two_sided { 2.0 } else { 1.0 };
                let area = surface.area * sides * surface.projected_solid_angle() / std::f64::consts::PI;
                let relative = get(&curves, emission.spectrum, &place)?;
                let spectrum =
                    absolute_spectrum(relative, emission.quantity, Source::Surface { area }, range)
                        .map_err(|problem| error(&place, problem))?;
                lamp = Some(lamps.len());
                lamps.push(Lamp { name: data.name.clone(), spectrum, form: LampForm::Surface(surface) });
            }
            objects.push(Object { name: data.name.clone(), material: data.material, lamp });
        }
        for light in &description.lights {
            lamps.push(self::lamp(light, &curves, images, range)?);
        }
        let camera = camera(description)?;
        let atmosphere = atmosphere(description, &curves, range)?;
        let (low, high) = geometry.bounds();
        let eye = camera.eye().as_vec3();
        let radius = f64::from((high.max(eye) - low.min(eye)).length() / 2.0).max(1e-6);
        let observer = Observer::cie_1931_2deg();
        let luminous: Vec<f64> = lamps.iter().map(|lamp| observer.luminance(&lamp.spectrum, range)).collect();
        let around = |l: &Lamp| matches!(l.form, LampForm::Uniform | LampForm::Image(_));
        let surroundings = (0..lamps.len()).filter(|&i| around(&lamps[i])).collect();
        let chooser = chooser(&lamps, &luminous, radius);
        Ok(Self {
            geometry,
            range,
            materials,
            skins,
            objects,
            lamps,
            chooser,
            surroundings,
            camera,
            atmosphere,
        })
    }

    /// The reflectances by which the scene's light is coloured: one for each material.
    #[must_use]
    pub fn reflectances(&self) -> Vec<Curve> {
        self.materials.iter().map(|m| m.representative_reflectance(self.range)).collect()
    }

    /// Whether any ray of a coarse grid over the image meets a surface or surroundings.
    #[must_use]
    pub fn sees_anything(&self) -> bool {
        if !self.surroundings.is_empty() {
            return true;
        }
        let [x0, y0, x1, y1] = self.camera.crop.map(|v| v as f32);
        const STEPS: u32 = 128;
        (0..STEPS * STEPS).any(|i| {
            let at = |n: u32, low: f32, high: f32| low + (n as f32 + 0.5) / STEPS as f32 * (high - low);
            let ray = self.camera.ray(at(i % STEPS, x0, x1), at(i / STEPS, y0, y1), 0.0);
            self.geometry.closest_hit(&ray).is_some()
        })
    }
}

fn curve((index, data): (usize, &CurveData)) -> Result<Curve, SceneError> {
    let place =
        if data.name.is_empty() { format!("curves[{index}]") } else { format!("spectrum {:?}", data.name) };
    Curve::new(data.wavelengths.clone(), data.values.clone(), data.outside)
        .map_err(|e| error(place, e.to_string()))
}

fn get<'a>(curves: &'a [Curve], index: usize, place: &str) -> Result<&'a Curve, SceneError> {
    curves.get(index).ok_or_else(|| error(place, format!("there is no curve {index}")))
}

/// A curve that does not fall below a bound.
fn at_least(
    curves: &[Curve],
    place: &str,
    what: &str,
    index: usize,
    least: f64,
    range: SpectralRange,
) -> Result<Curve, SceneError> {
    let curve = get(curves, index, place)?;
    if curve.extent(range).0 < least {
        return Err(error(
            place,
            format!("{what} must not fall below {least} over {}–{} nm", range.min_nm, range.max_nm),
        ));
    }
    Ok(curve.clone())
}

/// A curve from 0 to 1.
pub(crate) fn fraction(
    curves: &[Curve],
    place: &str,
    what: &str,
    index: usize,
    range: SpectralRange,
) -> Result<Curve, SceneError> {
    let curve = at_least(curves, place, what, index, 0.0, range)?;
    let highest = curve.extent(range).1;
    if highest > 1.0 {
        let problem = format!(
            "{what} must not exceed 1, and it reaches {highest:.4}; fractions are meant, not percent"
        );
        return Err(error(place, problem));
    }
    Ok(curve)
}

fn material(data: &MaterialData, curves: &[Curve], range: SpectralRange) -> Result<Material, SceneError> {
    let place = format!("materials.{}", data.name);
    let at_least = |what: &str, index: usize, least: f64| at_least(curves, &place, what, index, least, range);
    let fraction = |what: &str, index: usize| fraction(curves, &place, what, index, range);
    let finish = |finish: &FinishData| {
        if finish.slope.iter().any(|m| !(0.0..=1.0).contains(m)) {
            return Err(error(&place, format!("slopes must lie between 0 and 1, not {:?}", finish.slope)));
        }
        if finish.sigma_nm.is_some_and(|sigma| !(sigma >= 0.0 && sigma.is_finite())) {
            return Err(error(&place, "sigma_nm must not be negative"));
        }
        let shape = match finish.shape {
            ShapeData::Beckmann => Shape::Beckmann,
            ShapeData::Ggx => Shape::Ggx,
        };
        Ok(Finish { slope: finish.slope, sigma_nm: finish.sigma_nm, shape })
    };
    let surface = match &data.surface {
        SurfaceData::Diffuse { reflectance } => {
            Surface::Diffuse { reflectance: fraction("reflectance", *reflectance)? }
        }
        SurfaceData::Filter { transmittance } => {
            Surface::Filter { transmittance: fraction("transmittance", *transmittance)? }
        }
        SurfaceData::Conductor { n, k, finish: relief } => {
            let (n, k) = (at_least("n", *n, 1e-4)?, at_least("k", *k, 0.0)?);
            Surface::Conductor { n, k, finish: finish(relief)? }
        }
        SurfaceData::Dielectric { n, finish: relief, absorption, dispersion } => Surface::Dielectric {
            n: at_least("n", *n, 0.1)?,
            finish: finish(relief)?,
            absorption: absorption.map(|a| at_least("absorption", a, 0.0)).transpose()?,
            dispersion: *dispersion,
        },
        SurfaceData::Coated { n, finish: relief, film, pigment, flakes } => {
            let film = film.map(|film| {
                if !(film.thickness >= 0.0 && film.thickness.is_finite()) {
                    return Err(error(&place, "the thickness of a film must not be negative"));
                }
                let absorption = at_least("absorption", film.absorption, 0.0)?;
                Ok(Film { absorption, thickness: film.thickness })
            });
            let flakes = flakes.map(|flakes| {
                if !(0.0..=1.0).contains(&flakes.slope) || !(0.0..=1.0).contains(&flakes.coverage) {
                    let problem = "slope and coverage of flakes must lie between 0 and 1";
                    return Err(error(&place, problem));
                }
                Ok(Flakes {
                    n: at_least("n", flakes.n, 1e-4)?,
                    k: at_least("k", flakes.k, 0.0)?,
                    slope: flakes.slope,
                    coverage: flakes.coverage,
                })
            });
            Surface::Coated {
                n: at_least("n", *n, 1.0)?,
                finish: finish(relief)?,
                film: film.transpose()?,
                pigment: fraction("pigment", *pigment)?,
                flakes: flakes.transpose()?,
            }
        }
    };
    let grain = match &data.surface {
        SurfaceData::Conductor { finish, .. }
        | SurfaceData::Dielectric { finish, .. }
        | SurfaceData::Coated { finish, .. } => finish.grain,
        _ => None,
    };
    let grain = grain.map(|grain| unit(&place, "grain", grain)).transpose()?;
    let overrides = data
        .coefficients
        .iter()
        .map(|one| overrides(one, &place, curves, range))
        .collect::<Result<Vec<_>, _>>()?;
    let grain = grain.map(|grain| grain.to_array());
    Ok(Material { name: data.name.clone(), surface, grain, overrides })
}

/// What images say of each material.
fn skins(
    description: &Description,
    materials: &[Material],
    curves: &[Curve],
    images: &HashMap<String, ImageData>,
) -> Result<Vec<Skin>, SceneError> {
    if description.skins.is_empty() {
        return Ok(vec![Skin::default(); materials.len()]);
    }
    if description.skins.len() != materials.len() {
        let problem = format!("{} described, for {} materials", description.skins.len(), materials.len());
        return Err(error("skins", problem));
    }
    let mut textures = Textures::default();
    let pairs = description.skins.iter().zip(materials);
    pairs
        .map(|(data, material)| {
            textures
                .skin(data, &material.surface, curves, images)
                .map_err(|problem| error(format!("materials.{}", material.name), problem))
        })
        .collect()
}

fn unit(place: &str, key: &str, v: [f32; 3]) -> Result<Vec3, SceneError> {
    Vec3::from(v)
        .try_normalize()
        .ok_or_else(|| error(place, format!("{key} must be a finite vector that is not zero")))
}

/// A distribution of intensity, checked.
fn distribution(data: Option<&DistributionData>, place: &str) -> Result<Option<Distribution>, SceneError> {
    match data {
        None => Ok(None),
        Some(DistributionData::CosinePower(p)) if (0.0..=1000.0).contains(p) => {
            Ok(Some(Distribution::CosinePower(*p)))
        }
        Some(DistributionData::CosinePower(p)) => {
            Err(error(place, format!("cosine_power must lie between 0 and 1000, not {p}")))
        }
        Some(DistributionData::Table(pairs)) => {
            Distribution::table(pairs.clone()).map(Some).map_err(|problem| error(place, problem))
        }
    }
}

fn lamp(
    data: &LightData,
    curves: &[Curve],
    images: &HashMap<String, ImageData>,
    range: SpectralRange,
) -> Result<Lamp, SceneError> {
    let finish = |name: &str, relative: usize, quantity, source, form| {
        let place = format!("lights.{name}");
        let spectrum = absolute_spectrum(get(curves, relative, &place)?, quantity, source, range)
            .map_err(|problem| error(&place, problem))?;
        Ok(Lamp { name: name.into(), spectrum, form })
    };
    match data {
        LightData::Point { name, position, axis, distribution: Some(data), spectrum, quantity } => {
            let place = format!("lights.{name}");
            let Some(mut distribution) = distribution(Some(data), &place)? else {
                return Err(error(place, "a luminaire needs a distribution"));
            };
            let axis = unit(&place, "axis", axis.unwrap_or([0.0, -1.0, 0.0]))?;
            // Along the axis intensity is what is stated.
            if let Distribution::Table(pairs) = &mut distribution {
                let largest = pairs.iter().map(|pair| pair[1]).fold(0.0, f64::max);
                let unit = if pairs[0][1] > 0.0 { pairs[0][1] } else { largest };
                pairs.iter_mut().for_each(|pair| pair[1] /= unit);
            }
            let source = Source::Point { solid_angle: distribution.flux() };
            let form = LampForm::Luminaire { position: Vec3::from(*position), axis, distribution };
            finish(name, *spectrum, *quantity, source, form)
        }
        LightData::Point { name, position, distribution: None, spectrum, quantity, .. } => {
            let source = Source::Point { solid_angle: 4.0 * std::f64::consts::PI };
            finish(name, *spectrum, *quantity, source, LampForm::Point { position: Vec3::from(*position) })
        }
        LightData::Spot { name, position, direction, half_angle_deg, penumbra_deg, spectrum, quantity } => {
            let place = format!("lights.{name}");
            if !(*half_angle_deg > 0.0 && *half_angle_deg <= 180.0) {
                return Err(error(
                    place,
                    format!("half_angle must lie above 0 and up to 180 degrees, not {half_angle_deg}"),
                ));
            }
            if !(0.0..=*half_angle_deg).contains(penumbra_deg) {
                return Err(error(
                    place,
                    format!("penumbra must lie between 0 and the half_angle, not {penumbra_deg}"),
                ));
            }
            let cos_end = half_angle_deg.to_radians().cos();
            let cos_full = (half_angle_deg - penumbra_deg).to_radians().cos();
            let form = LampForm::Spot {
                position: Vec3::from(*position),
                axis: unit(&place, "direction", *direction)?,
                cos_full: cos_full as f32,
                cos_end: cos_end as f32,
            };
            let source = Source::Point { solid_angle: spot_solid_angle(cos_full, cos_end) };
            finish(name, *spectrum, *quantity, source, form)
        }
        LightData::Directional { name, direction, spectrum, quantity } => {
            let direction = unit(&format!("lights.{name}"), "direction", *direction)?;
            finish(name, *spectrum, *quantity, Source::Parallel, LampForm::Parallel { direction })
        }
        LightData::Environment { name, spectrum, quantity, image: None, .. } => {
            let place = format!("lights.{name}");
            let spectrum =
                spectrum.ok_or_else(|| error(&place, "an environment needs a spectrum or an image"))?;
            finish(name, spectrum, *quantity, Source::Surround, LampForm::Uniform)
        }
        LightData::Environment {
            name,
            spectrum,
            quantity,
            image: Some(key),
            rgb_system,
            up,
            rotation_deg,
        } => {
            let place = format!("lights.{name}");
            let problem = |text: String| error(&place, text);
            let (width, height, rgb) =
                images.get(key).ok_or_else(|| problem(format!("there is no image {key:?}")))?;
            let system = RgbSystem::named(rgb_system)
                .ok_or_else(|| problem(format!("no RGB system {rgb_system:?}")))?;
            if matches!(quantity, crate::photometry::Quantity::IlluminanceLx(_)) {
                return Err(problem(
                    "illuminance_lx does not fit an image; state luminance_cd_m2 of RGB (1, 1, 1)".into(),
                ));
            }
            let relative = match spectrum {
                Some(index) => get(curves, *index, &place)?.clone(),
                None => {
                    let white = system.white_curve();
                    // A scale then multiplies values that are already cd/m².
                    let luminance = Observer::cie_1931_2deg().luminance(&white, range);
                    white.scaled(1.0 / luminance)
                }
            };
            let white = absolute_spectrum(&relative, *quantity, Source::Surround, range).map_err(problem)?;
            let turn = Mat3::from_rotation_y(-(rotation_deg.to_radians() as f32));
            let to_y_up = match up {
                UpAxis::Y => Mat3::IDENTITY,
                UpAxis::Z => Mat3::from_rotation_x(-std::f32::consts::FRAC_PI_2),
            };
            let image =
                EnvironmentImage::new((*width, *height), rgb, &system, white.clone(), turn * to_y_up, range)
                    .map_err(|text| error(&place, text))?;
            Ok(Lamp { name: name.clone(), spectrum: white, form: LampForm::Image(Box::new(image)) })
        }
    }
}

fn atmosphere(
    description: &Description,
    curves: &[Curve],
    range: SpectralRange,
) -> Result<(Atmosphere, Curve), SceneError> {
    let place = "atmosphere";
    let dark = Curve::constant(0.0);
    match description.atmosphere {
        None => Ok((Atmosphere::Clear, dark)),
        Some(AtmosphereData::Distance { power, unit }) => {
            if !(power > 0.0 && power.is_finite() && unit > 0.0 && unit.is_finite()) {
                return Err(error(place, "power and unit must be above 0"));
            }
            Ok((Atmosphere::InversePower { power, unit }, dark))
        }
        Some(AtmosphereData::Fog { start, end, spectrum, quantity }) => {
            if !(start >= 0.0 && end > start && end.is_finite()) {
                return Err(error(place, "fog needs 0 ≤ start < end"));
            }
            let fog = absolute_spectrum(get(curves, spectrum, place)?, quantity, Source::Surround, range)
                .map_err(|problem| error(place, problem))?;
            Ok((Atmosphere::Fog { start, end }, fog))
        }
    }
}

fn camera(description: &Description) -> Result<Camera, SceneError> {
    let c = &description.camera;
    let [eye, target, up] = [c.eye, c.target, c.up].map(DVec3::from);
    Camera::new(eye, target, up, c.field_of_view_deg, c.size, c.crop, c.shutter)
        .map_err(|e| error("camera", e.to_string().trim_start_matches("camera: ")))
}
