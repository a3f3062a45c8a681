//! A scene ready for rendering.

use crate::coefficients::overrides;
use crate::density::Density;
use crate::description::{
    AtmosphereData, CurveData, Description, DistributionData, FinishData, LightData, MaterialData, PhaseData,
    ShapeData, Sides, SurfaceData, UpAxis,
};
use crate::environment::EnvironmentImage;
use crate::lamp::{Lamp, LampForm, spot_solid_angle};
use crate::lamp_chooser::{LampChooser, chooser};
use crate::medium::{Medium, Phase};
use crate::photometry::{Source, absolute_spectrum};
use crate::skin::{Skin, Textures};
use crate::sky::{Sky, Sun, SunPosition};
use crate::surface_lamp::SurfaceLamp;
use crate::{Camera, Geometry, Lens};
use glam::{DVec3, Mat3, Vec3};
use illuminant_color::RgbSystem;
use illuminant_illumination::{Atmosphere, Film, Finish, Flakes, Material, Surface};
use illuminant_optics::facets::Shape;
use illuminant_optics::goniometry::Distribution;
use illuminant_optics::hosek_wilkie::HosekWilkie;
use illuminant_optics::photometric_web::PhotometricWeb;
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
    /// Where bodies overlap, that of the material of the highest priority is there: one for each material.
    pub priorities: Vec<u8>,
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
    /// What is in the air, if anything.
    pub medium: Option<Medium>,
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
            lamps.extend(sun(light, range)?);
        }
        let mut camera = camera(description)?;
        if !camera.is_moving() && (0..objects.len()).all(|object| geometry.is_static(object)) {
            // Time would be one more random number for nothing.
            camera.shutter = [camera.shutter[0]; 2];
        }
        let atmosphere = atmosphere(description, &curves, range)?;
        let medium = medium(description, &curves, images, range)?;
        let observer = Observer::cie_1931_2deg();
        let luminous: Vec<f64> = lamps.iter().map(|lamp| observer.luminance(&lamp.spectrum, range)).collect();
        let surroundings = (0..lamps.len()).filter(|&i| lamps[i].form.surrounds()).collect();
        let chooser = chooser(&geometry, &lamps, &luminous);
        Ok(Self {
            geometry,
            range,
            materials,
            priorities: description.materials.iter().map(|m| m.priority).collect(),
            skins,
            objects,
            lamps,
            chooser,
            surroundings,
            camera,
            atmosphere,
            medium,
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
        if !self.surroundings.is_empty() || self.medium.is_some() {
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

/// Above every index of a material, and of the perfect mirrors that tests make of a large one.
const MOST_INDEX: f64 = 1e5;

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

/// Refuses a reflectance and a transmittance of which more light leaves than came.
fn shares(
    place: &str,
    reflectance: &Curve,
    transmittance: &Curve,
    range: SpectralRange,
) -> Result<(), SceneError> {
    let sums = range.wavelengths().map(|w| (reflectance.at(w) + transmittance.at(w), w));
    let (most, w) = sums.fold((0.0, 0.0), |most, sum| if sum.0 > most.0 { sum } else { most });
    // Decimal fractions that add up to 1 may round to a little more.
    if most > 1.0 + 1e-9 {
        let problem = format!(
            "reflectance and transmittance must not exceed 1 together, and reach {most:.4} at {w} nm"
        );
        return Err(error(place, problem));
    }
    Ok(())
}

fn material(data: &MaterialData, curves: &[Curve], range: SpectralRange) -> Result<Material, SceneError> {
    let place = format!("materials.{}", data.name);
    let at_least = |what: &str, index: usize, least: f64| at_least(curves, &place, what, index, least, range);
    let index_of = |what: &str, index: usize, least: f64| {
        let curve = at_least(what, index, least)?;
        match curve.extent(range).1 {
            highest if highest > MOST_INDEX => {
                let problem = format!("{what} must not exceed {MOST_INDEX}, and it reaches {highest:.4e}");
                Err(error(&place, problem))
            }
            _ => Ok(curve),
        }
    };
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
        SurfaceData::Translucent { reflectance, transmittance } => {
            let reflectance = fraction("reflectance", *reflectance)?;
            let transmittance = fraction("transmittance", *transmittance)?;
            shares(&place, &reflectance, &transmittance, range)?;
            Surface::Translucent { reflectance, transmittance }
        }
        SurfaceData::Conductor { n, k, finish: relief } => {
            let (n, k) = (index_of("n", *n, 1e-4)?, index_of("k", *k, 0.0)?);
            Surface::Conductor { n, k, finish: finish(relief)? }
        }
        SurfaceData::Dielectric { n, finish: relief, absorption, dispersion } => Surface::Dielectric {
            n: index_of("n", *n, 0.1)?,
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
                    n: index_of("n", flakes.n, 1e-4)?,
                    k: index_of("k", flakes.k, 0.0)?,
                    slope: flakes.slope,
                    coverage: flakes.coverage,
                })
            });
            Surface::Coated {
                n: index_of("n", *n, 1.0)?,
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
        LightData::Luminaire {
            name,
            position,
            axis,
            across,
            planes_deg,
            angles_deg,
            values,
            spectrum,
            quantity,
        } => {
            let place = format!("lights.{name}");
            let axis = unit(&place, "axis", *axis)?;
            let across = Vec3::from(*across);
            let x = (across - axis * across.dot(axis)).try_normalize();
            let x = x.ok_or_else(|| error(&place, "the direction of C = 0 must not be along the axis"))?;
            let web = PhotometricWeb::new(planes_deg.clone(), angles_deg.clone(), values.clone());
            let web = web.map_err(|problem| error(&place, problem))?;
            let largest = web.largest();
            let web = web.over(largest);
            let source = Source::Point { solid_angle: web.flux() };
            let frame = [x, axis.cross(x), axis];
            let form = LampForm::Photometric { position: Vec3::from(*position), frame, web: Box::new(web) };
            finish(name, *spectrum, *quantity, source, form)
        }
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
        LightData::Sky { name, .. } => {
            let Some((model, position)) = clear_sky(data)? else {
                return Err(error(format!("lights.{name}"), "is no sky"));
            };
            let (sky, spectrum) = Sky::new(model, &position, range);
            Ok(Lamp { name: name.clone(), spectrum, form: LampForm::Sky(Box::new(sky)) })
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
            let image = EnvironmentImage::new(
                (*width, *height),
                rgb,
                &system,
                white.clone(),
                turn * to_y_up(*up),
                range,
            )
            .map_err(|text| error(&place, text))?;
            Ok(Lamp { name: name.clone(), spectrum: white, form: LampForm::Image(Box::new(image)) })
        }
    }
}

/// The model of a sky, and where its sun stands; `None` for other lights.
fn clear_sky(light: &LightData) -> Result<Option<(HosekWilkie, SunPosition)>, SceneError> {
    let LightData::Sky { name, turbidity, ground_albedo, elevation_deg, azimuth_deg, up, .. } = light else {
        return Ok(None);
    };
    let (elevation, azimuth) = (elevation_deg.to_radians(), azimuth_deg.to_radians());
    let model = HosekWilkie::new(*turbidity, *ground_albedo, elevation);
    let model = model.map_err(|problem| error(format!("lights.{name}"), problem))?;
    Ok(Some((model, SunPosition { elevation, azimuth, to_y_up: to_y_up(*up) })))
}

/// The sun of a sky that shows it, as a lamp of its own.
fn sun(light: &LightData, range: SpectralRange) -> Result<Option<Lamp>, SceneError> {
    let LightData::Sky { name, sun: true, .. } = light else { return Ok(None) };
    Ok(clear_sky(light)?.map(|(model, position)| {
        let (sun, spectrum) = Sun::new(model, &position, range);
        Lamp { name: format!("{name} sun"), spectrum, form: LampForm::Sun(Box::new(sun)) }
    }))
}

/// From the world to a y-up frame.
fn to_y_up(up: UpAxis) -> Mat3 {
    match up {
        UpAxis::Y => Mat3::IDENTITY,
        UpAxis::Z => Mat3::from_rotation_x(-std::f32::consts::FRAC_PI_2),
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

fn medium(
    description: &Description,
    curves: &[Curve],
    images: &HashMap<String, ImageData>,
    range: SpectralRange,
) -> Result<Option<Medium>, SceneError> {
    let Some(data) = &description.medium else { return Ok(None) };
    let place = "medium";
    let coefficient = |index: Option<usize>| {
        let curve = match index {
            Some(index) => get(curves, index, place)?.clone(),
            None => Curve::constant(0.0),
        };
        let (low, high) = curve.extent(range);
        if low >= 0.0 && high.is_finite() {
            Ok(curve)
        } else {
            Err(error(place, "coefficients must be finite and not negative"))
        }
    };
    let phase = match data.phase {
        PhaseData::HenyeyGreenberg(g) if g > -1.0 && g < 1.0 => Phase::HenyeyGreenberg(g as f32),
        PhaseData::HenyeyGreenberg(g) => {
            return Err(error(place, format!("the mean cosine must lie between -1 and 1, not {g}")));
        }
        PhaseData::Rayleigh => Phase::Rayleigh,
    };
    let bounds = data.bounds.map(|corners| corners.map(|c| DVec3::from(c).as_vec3()));
    if bounds.is_some_and(|[low, high]| !(low.is_finite() && high.is_finite() && low.cmplt(high).all())) {
        return Err(error(place, "the box must be finite and have an inside"));
    }
    let density = match &data.density {
        None => None,
        Some(_) if bounds.is_none() => return Err(error(place, "a density needs a box")),
        Some((name, size)) => {
            let image =
                images.get(name).ok_or_else(|| error(place, format!("there is no image {name:?}")))?;
            let density = Density::new(*size, image.2.chunks_exact(3).map(|texel| texel[0]).collect());
            let problem =
                "a density must have as many cells as its size says, finite, not negative, and not all 0";
            Some(density.ok_or_else(|| error(place, problem))?)
        }
    };
    let (absorption, scattering) = (coefficient(data.absorption)?, coefficient(data.scattering)?);
    Ok(Some(Medium { absorption, scattering, phase, bounds, density }))
}

fn camera(description: &Description) -> Result<Camera, SceneError> {
    let c = &description.camera;
    let [eye, target, up] = [c.eye, c.target, c.up].map(DVec3::from);
    let mut camera = Camera::new(eye, target, up, c.field_of_view_deg, c.size, c.crop, c.shutter)
        .map_err(|e| error("camera", e.to_string().trim_start_matches("camera: ")))?;
    if let Some(end) = &c.end {
        let [eye, target, up] = [end.eye, end.target, end.up].map(DVec3::from);
        let last = Camera::new(eye, target, up, c.field_of_view_deg, c.size, c.crop, c.shutter)
            .map_err(|e| error("camera", format!("at the end of its motion: {e}")))?;
        camera = camera.moving_to(&last);
    }
    if let Some(lens) = &c.lens {
        let sound =
            lens.radius >= 0.0 && lens.radius.is_finite() && lens.focus > 0.0 && lens.focus.is_finite();
        if !sound || !lens.turn_deg.is_finite() || lens.blades > 64 {
            return Err(error(
                "camera",
                "a lens has a radius of 0 or more, a focus above 0 and at most 64 blades",
            ));
        }
        camera.lens = Some(Lens {
            radius: lens.radius as f32,
            focus: lens.focus as f32,
            blades: lens.blades,
            turn: lens.turn_deg.to_radians() as f32,
        });
    }
    Ok(camera)
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_spectrum::Outside;

    #[test]
    fn a_sheet_that_would_make_light_is_refused() {
        let range = SpectralRange::default();
        let ramp = Curve::new(vec![400.0, 600.0], vec![0.2, 0.7], Outside::Hold).unwrap();
        let refused = shares("materials.paper", &ramp, &Curve::constant(0.4), range).unwrap_err().to_string();
        assert!(
            refused.contains("materials.paper") && refused.contains("reach 1.1000 at 600 nm"),
            "{refused}"
        );
        // In binary (0.33 + 0.56) + 0.11 is a little more than 1.
        shares("materials.paper", &Curve::constant(0.33 + 0.56), &Curve::constant(0.11), range).unwrap();
    }
}
