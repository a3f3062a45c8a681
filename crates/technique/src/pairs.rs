//! Which technique goes with which illumination model (book table 4.1, section 4.7).

use crate::radiosity::Gather;
use crate::settings::{Settings, Shading, Shadows, Technique};
use illuminant_illumination::{CoefficientCurves, Illumination, Surface};
use illuminant_optics::distribution::Distribution;
use illuminant_scene::{LampForm, Scene};

/// What is to be said of a pair.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Pair {
    /// It belongs together.
    Sensible(&'static str),
    /// It works, but the image is no truth; the reason is told.
    Warned(&'static str),
    /// It has no meaning.
    Refused(&'static str),
}

/// The verdict on a pair, with its reason.
///
/// ```
/// use illuminant_technique::{Technique, pairs::{Pair, pair}};
/// use illuminant_illumination::Illumination;
/// assert!(matches!(pair(Technique::Gouraud, Illumination::Phong), Pair::Sensible(_)));
/// assert!(matches!(pair(Technique::Gouraud, Illumination::Whitted), Pair::Refused(_)));
/// ```
#[must_use]
pub fn pair(technique: Technique, illumination: Illumination) -> Pair {
    use Illumination as I;
    use Technique as T;
    match (technique, illumination) {
        (T::Path, I::General) => Pair::Sensible("follows all light, in energy equilibrium"),
        (T::Path, I::Bouknight) => {
            Pair::Warned("what is not diffuse is lost: metal and glass return less light than they receive")
        }
        (T::Path, I::CookTorrance) => {
            Pair::Warned("towards grazing light rough metal returns more than it receives")
        }
        (T::Path, I::Phong | I::Blinn) => Pair::Warned(
            "a model made for lamps alone: as a function of two directions it is not reciprocal, and can create energy",
        ),
        (T::Path, I::Whitted | I::Hall) => Pair::Warned(
            "its highlights of lamps come on top of rays that meet the lamps too, so energy is created",
        ),
        (T::Raytrace, I::Whitted | I::Hall) => {
            Pair::Sensible("rays towards the mirror direction and through glass, as its authors meant it")
        }
        (T::Raytrace, I::General) => Pair::Sensible(
            "what stays coherent is followed; what rough surfaces show of others is that of the surroundings",
        ),
        (T::Raytrace | T::Distributed, I::Bouknight | I::Phong | I::Blinn | I::CookTorrance) => {
            Pair::Sensible(
                "lamps with their shadows; the model asks for no rays but through what is transparent",
            )
        }
        (T::Distributed, I::Whitted | I::Hall) => {
            Pair::Sensible("its rays, blurred as the highlight is wide, and soft shadows")
        }
        (T::Distributed, I::General) => Pair::Sensible(
            "soft shadows, gloss and translucency; diffuse light from anything but lamps is ambient",
        ),
        (T::Constant | T::Gouraud, I::Whitted | I::Hall) => Pair::Refused(
            "the model asks for the radiance from the mirror direction of every point, and this technique shades no \
             points between corners; use phong (with a reflection map) or path",
        ),
        (T::Phong, I::Whitted | I::Hall) => {
            Pair::Sensible("the mirror direction is looked up in the surroundings: reflection mapping")
        }
        (T::Radiosity, I::General) => Pair::Sensible(
            "each surface is a diffuser of the same reflectance, and all light between them is solved for",
        ),
        (T::Hybrid, I::General) => Pair::Sensible(
            "all light between surfaces is solved for, by way of mirrors and glass too, and rays follow what these show",
        ),
        (T::SpecularRadiosity, I::General) => Pair::Sensible(
            "every patch sends light into every direction as its model says; memory and time grow with patches times \
             directions",
        ),
        (T::Radiosity | T::SpecularRadiosity | T::Hybrid, I::Bouknight) => {
            Pair::Warned("what is not diffuse is lost: metal and glass return less light than they receive")
        }
        (T::Radiosity | T::SpecularRadiosity | T::Hybrid, _) => Pair::Refused(
            "the model can return more light than it receives, and what surfaces send each other again and again would \
             grow; use general or bouknight, or path, which warns",
        ),
        (T::Constant, _) => Pair::Sensible("evaluated once for each polygon"),
        (T::Gouraud, _) => Pair::Sensible("evaluated at corners; the light between them is interpolated"),
        (T::Phong, _) => Pair::Sensible("evaluated at every pixel, with interpolated normals"),
    }
}

/// Refuses a pair that has no meaning.
///
/// # Errors
/// The reason.
pub fn check(technique: Technique, illumination: Illumination) -> Result<(), String> {
    match pair(technique, illumination) {
        Pair::Refused(reason) => Err(format!("{technique} does not go with {illumination}: {reason}")),
        _ => Ok(()),
    }
}

/// Refuses a fast form of Phong's shading where it has no meaning.
///
/// # Errors
/// The reason.
pub fn check_shading(
    scene: &Scene,
    settings: &Settings,
    technique: Technique,
    illumination: Illumination,
) -> Result<(), String> {
    let shading = settings.shading;
    if shading == Shading::Full {
        return Ok(());
    }
    if technique != Technique::Phong {
        return Err(format!(
            "shading {shading} goes with phong alone, which finds the illumination at every pixel; {technique} does not"
        ));
    }
    match illumination {
        Illumination::Bouknight | Illumination::Phong => {}
        Illumination::Whitted | Illumination::Hall => {
            return Err(format!(
                "shading {shading} does not go with {illumination}: it asks for the mirror direction at every pixel"
            ));
        }
        _ => {
            return Err(format!(
                "shading {shading} does not go with {illumination}: its highlight is no power of a cosine; use \
                 bouknight or phong"
            ));
        }
    }
    if settings.shadows != Shadows::None {
        return Err(format!("shading {shading} finds no shadows: it looks at lamps once a polygon"));
    }
    for object in &scene.objects {
        let material = &scene.materials[object.material];
        if matches!(material.surface, Surface::Filter { .. } | Surface::Dielectric { .. }) {
            return Err(format!(
                "shading {shading} needs opaque materials, and one sees through {:?}",
                material.name
            ));
        }
        if !scene.skins[object.material].is_bare() {
            return Err(format!(
                "shading {shading} looks up no images, and material {:?} has one",
                material.name
            ));
        }
        let curves = CoefficientCurves::new(material, illumination, scene.range);
        let power = matches!(curves.highlight.distribution, Distribution::Phong | Distribution::Blinn);
        if curves.terminator != 1.0 || (illumination == Illumination::Phong && !power) {
            return Err(format!(
                "shading {shading} needs N·L and the power of a cosine, and material {:?} overrides them",
                material.name
            ));
        }
    }
    Ok(())
}

/// Refuses cones, paths from lamps, and what belongs to solutions, where they have no meaning.
///
/// # Errors
/// The reason.
pub fn check_rays(scene: &Scene, settings: &Settings, technique: Technique) -> Result<(), String> {
    if settings.radiosity.gather != Gather::None
        && !matches!(technique, Technique::Radiosity | Technique::Hybrid)
    {
        return Err(format!(
            "gather goes with radiosity and hybrid, whose irradiance it takes; {technique} has none"
        ));
    }
    if settings.radiosity.frustum.is_some() && technique != Technique::Hybrid {
        return Err(format!(
            "a frustum goes with hybrid alone, whose gloss it samples; {technique} does not"
        ));
    }
    if settings.cones && technique != Technique::Raytrace {
        return Err(format!("cones go with raytrace alone, whose rays they widen; {technique} has others"));
    }
    if !settings.caustics {
        return Ok(());
    }
    if technique != Technique::Path {
        return Err(format!("caustics go with path alone, which follows all light; {technique} does not"));
    }
    if scene.medium.is_some() {
        return Err("caustics are not followed through what is in the air: the scene has a medium".into());
    }
    Ok(())
}

/// What a technique will not show of a scene.
pub(crate) fn misfits(scene: &Scene, settings: &Settings) -> Vec<String> {
    let mut found = Vec::new();
    let Ok(technique) = settings.technique.parse::<Technique>() else { return found };
    let used = |material: &usize| scene.objects.iter().any(|object| object.material == *material);
    let of_glass = |smooth: bool, disperses: bool| {
        (0..scene.materials.len()).filter(used).find(|&m| match &scene.materials[m].surface {
            Surface::Dielectric { finish, dispersion, .. } => {
                (!smooth || finish.is_smooth()) && (!disperses || *dispersion)
            }
            _ => false,
        })
    };
    let without_size =
        scene.lamps.iter().find(|lamp| !(lamp.form.surrounds() || matches!(lamp.form, LampForm::Surface(_))));
    let lamp = without_size.filter(|_| !settings.caustics);
    if let (Technique::Path, Some(lamp), Some(glass)) = (technique, lamp, of_glass(true, false)) {
        found.push(format!(
            "path does not find the light that {:?} sends through {:?}: a lamp without size is never met behind smooth \
             glass, so what it gathers is missing and its shadow is black; --caustics follows it from the lamp",
            lamp.name, scene.materials[glass].name
        ));
    }
    if scene.medium.is_some() && technique != Technique::Path {
        found.push(format!("{technique} does not see what is in the air: path follows light in the medium"));
    }
    if technique.is_solved() {
        found.extend(unsolved(scene, technique, &used));
    }
    let trees = matches!(technique, Technique::Raytrace | Technique::Distributed | Technique::Hybrid);
    if let (true, Some(glass)) = (trees, of_glass(false, true)) {
        found.push(format!(
            "{technique} bends all wavelengths alike, as 589.3 nm; path shows how {:?} disperses them",
            scene.materials[glass].name
        ));
    }
    found
}

/// What a solution of the light between surfaces leaves out.
fn unsolved(scene: &Scene, technique: Technique, used: &dyn Fn(&usize) -> bool) -> Vec<String> {
    let mut found = Vec::new();
    let named = |wanted: &dyn Fn(&Surface) -> bool| {
        let material = scene.materials.iter().enumerate().find(|(i, m)| used(i) && wanted(&m.surface));
        material.map(|(_, material)| &material.name)
    };
    if technique == Technique::Radiosity {
        let shiny = |s: &Surface| matches!(s, Surface::Conductor { .. } | Surface::Coated { .. });
        if let Some(name) = named(&shiny) {
            found.push(format!(
                "radiosity takes {name:?} for a diffuser of the same reflectance; hybrid follows what it mirrors"
            ));
        }
    }
    if technique != Technique::Hybrid {
        let clear = |s: &Surface| matches!(s, Surface::Filter { .. } | Surface::Dielectric { .. });
        if let Some(name) = named(&clear) {
            found.push(format!("{technique} leaves {name:?} out: light passes it as if it were not there"));
        }
    }
    let moves = (0..scene.objects.len()).find(|&object| !scene.geometry.is_static(object));
    if let Some(object) = moves {
        found.push(format!(
            "{technique} solves for the light as it is when the shutter opens: {:?} moves",
            scene.objects[object].name
        ));
    }
    found
}

/// What a user should know of the pair that settings name.
pub(crate) fn warning(settings: &Settings) -> Option<String> {
    let (technique, illumination) = (settings.technique.parse().ok()?, settings.illumination.parse().ok()?);
    match pair(technique, illumination) {
        Pair::Warned(reason) => Some(format!("{technique} with {illumination}: {reason}")),
        _ => None,
    }
}
