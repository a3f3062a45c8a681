//! What reaches a point from lamps, for techniques that ask lamps alone.

use super::shadows::Occlusion;
use crate::lanes::Pass;
use crate::skins::{Mixture, perturbed};
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Prepare};
use illuminant_optics::frame::Frame;
use illuminant_sampling::Lanes;
use illuminant_scene::{LampForm, Scene, TexturePoint};
use std::f32::consts::FRAC_1_PI;

/// The parts of a radiance: ambient, diffuse, specular, transmitted, emitted. Each has a bundle for every group of lamps.
pub(crate) const PARTS: usize = 5;

/// Where an emitting surface is asked: the centres of four equal parts.
const ON_LAMP: [[f32; 2]; 4] = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]];

/// Light that arrives from a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arriving {
    pub lamp: usize,
    /// Which of the places on the lamp.
    pub place: usize,
    pub direction: Vec3,
    /// Irradiance at normal incidence relative to the lamp's spectrum.
    pub scale: f32,
    pub target: Option<Vec3>,
}

/// Where on a lamp it is asked, as many as there are; none for what is all around.
pub(super) fn places_on(form: &LampForm) -> &'static [[f32; 2]] {
    match form {
        LampForm::Uniform | LampForm::Image(_) => &[],
        LampForm::Surface(_) => &ON_LAMP,
        _ => &ON_LAMP[..1],
    }
}

/// Light that arrives at a point from lamps.
fn arriving(scene: &Scene, point: Vec3, each: &mut impl FnMut(Arriving)) {
    for (number, lamp) in scene.lamps.iter().enumerate() {
        let places = places_on(&lamp.form);
        for (place, &u) in places.iter().enumerate() {
            let Some(light) = lamp.sample(&scene.geometry, point, 0.0, u) else { continue };
            let scale = light.scale / light.pdf.unwrap_or(1.0) / places.len() as f32;
            let (direction, target) = (light.direction, light.target);
            each(Arriving { lamp: number, place, direction, scale, target });
        }
    }
}

/// The lamps of a scene: where they are, or at infinity.
pub(super) struct Lamps {
    /// What arrives in the middle of the scene, where that is taken to arrive everywhere.
    everywhere: Option<Vec<Arriving>>,
}

impl Lamps {
    pub fn new(scene: &Scene, at_infinity: bool) -> Self {
        let in_the_middle = || {
            let mut all = Vec::new();
            arriving(scene, middle(scene), &mut |light| all.push(light));
            all
        };
        Self { everywhere: at_infinity.then(in_the_middle) }
    }

    /// Light that arrives at a point.
    pub fn arriving(&self, scene: &Scene, point: Vec3, each: &mut impl FnMut(Arriving)) {
        match &self.everywhere {
            Some(all) => all.iter().for_each(|light| each(*light)),
            None => arriving(scene, point, each),
        }
    }
}

/// The middle of a scene.
fn middle(scene: &Scene) -> Vec3 {
    let (low, high) = scene.geometry.bounds();
    (low + high) * 0.5
}

/// A place to be shaded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub position: Vec3,
    /// For shading.
    pub normal: Vec3,
    pub object: usize,
    /// Unit vector to the viewer.
    pub to_viewer: Vec3,
    /// Whether the viewer is on the side of the geometric normal.
    pub front: bool,
    /// Unit geometric normal.
    pub geometric: Vec3,
    /// Where images are looked up, if they say something of the material.
    pub texture: Option<TexturePoint>,
    /// A colour, the same at all wavelengths, in place of what an image says.
    pub colour: Option<f32>,
}

/// The light of a scene in the lanes of one pass.
pub(crate) struct Lighting<'a, const N: usize, M> {
    pub scene: &'a Scene,
    pub pass: &'a Pass<N, M>,
    /// The group of each lamp.
    pub group_of: &'a [usize],
    /// Radiance from everywhere, of each group of lamps.
    pub ambient: &'a [Lanes<N>],
    pub lamps: &'a Lamps,
    /// What stands before lamps.
    pub shadows: &'a Occlusion,
}

/// The radiance that stands for all light that is not followed: that of the surroundings, and a fraction of what lamps would make of a
/// white diffuser that faces them in the middle of the scene.
pub(crate) fn ambient<const N: usize, M>(
    scene: &Scene,
    pass: &Pass<N, M>,
    group_of: &[usize],
    fraction: f32,
) -> Vec<Lanes<N>> {
    let mut all = vec![Lanes::default(); group_of.iter().max().map_or(0, |last| last + 1)];
    arriving(scene, middle(scene), &mut |light| {
        all[group_of[light.lamp]] += pass.emission[light.lamp] * (light.scale * FRAC_1_PI * fraction);
    });
    for &lamp in &scene.surroundings {
        all[group_of[lamp]] += match &scene.lamps[lamp].form {
            LampForm::Image(image) => {
                pass.emission[lamp] * (image.integral() / (4.0 * std::f64::consts::PI)) as f32
            }
            _ => pass.emission[lamp],
        };
    }
    all
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Lighting<'_, N, M> {
    /// Adds `weight` times the radiance of a cone in which nothing is followed: that of the surroundings (reflection
    /// mapping, Blinn and Newell 1976; book figure 4.2), else what stands for all light.
    pub fn add_around(&self, direction: Vec3, radius: f32, weight: &Lanes<N>, to: &mut [Lanes<N>]) {
        if self.scene.surroundings.is_empty() {
            to.iter_mut().zip(self.ambient).for_each(|(sum, light)| *sum += *weight * *light);
        }
        for &lamp in &self.scene.surroundings {
            let light = self.pass.surroundings_in_cone(self.scene, lamp, direction, radius);
            to[self.group_of[lamp]] += *weight * light;
        }
    }

    /// Adds the radiance of the surroundings.
    pub fn add_background(&self, direction: Vec3, to: &mut [Lanes<N>]) {
        for &lamp in &self.scene.surroundings {
            to[self.group_of[lamp]] += self.pass.surroundings(self.scene, lamp, direction);
        }
    }

    /// Finds the parts of the radiance that a surface sends to the viewer, one after the other with a bundle for each group of
    /// lamps; returns what of the radiance behind it comes through.
    pub fn shade(&self, place: &Place, parts: &mut Vec<Lanes<N>>) -> Lanes<N> {
        let material = self.scene.objects[place.object].material;
        let base = &self.pass.materials[material];
        let Some(point) = &place.texture else { return self.shade_with(base, place, parts) };
        let normal = perturbed(self.scene, material, point, place.normal, place.to_viewer);
        let place = Place { normal, ..*place };
        let Some(lanes) = &self.pass.skins[material] else { return self.shade_with(base, &place, parts) };
        let skin = &self.scene.skins[material];
        let colour = match place.colour {
            Some(value) => Some((Lanes::splat(value), value)),
            None => lanes.colour(skin, point),
        };
        let mixture = lanes.mixture(skin, point);
        let of_rung = |rung: Option<usize>, parts: &mut Vec<Lanes<N>>| {
            self.shade_with(&lanes.model(base, rung, colour.as_ref()), &place, parts)
        };
        let through = of_rung(mixture.map(|m| m.lower), parts);
        let Some(Mixture { lower, part }) = mixture.filter(|m| m.part > 0.0) else { return through };
        let mut upper = Vec::new();
        let through_upper = of_rung(Some(lower + 1), &mut upper);
        let mix = |a: Lanes<N>, b: Lanes<N>| a * (1.0 - part) + b * part;
        parts.iter_mut().zip(upper).for_each(|(part, upper)| *part = mix(*part, upper));
        mix(through, through_upper)
    }

    /// Where between black and white a surface lies by what an image says of its colour: all that it does with light is linear in
    /// this.
    pub fn share_of_white(&self, place: &Place) -> Lanes<N> {
        let material = self.scene.objects[place.object].material;
        let (lanes, skin) = (&self.pass.skins[material], &self.scene.skins[material]);
        let colour =
            lanes.as_ref().zip(place.texture.as_ref()).and_then(|(lanes, at)| lanes.colour(skin, at));
        let air = self.pass.index(None);
        let at = Incidence { to_viewer: Vec3::Z, near: air, far: air, hero_lane: None };
        let model = &self.pass.materials[material];
        colour.map_or_else(|| Lanes::splat(1.0), |(colour, _)| model.share_of_white(&at, &colour))
    }

    /// The same with a model given.
    #[inline(never)]
    fn shade_with(&self, model: &M, place: &Place, parts: &mut Vec<Lanes<N>>) -> Lanes<N> {
        let groups = self.ambient.len();
        parts.clear();
        parts.resize(PARTS * groups, Lanes::default());
        let (scene, pass) = (self.scene, self.pass);
        let object = &scene.objects[place.object];
        // The normal on the side of the viewer; one that leans away from it is looked at along the surface.
        let frame = match scene.materials[object.material].grain {
            Some(grain) => Frame::along(place.normal, Vec3::from(grain)),
            None => Frame::from_normal(place.normal),
        };
        let mut local = frame.to_local(place.to_viewer);
        let side = if place.front { 1.0 } else { -1.0 };
        if local.z * side < 1e-3 {
            local.z = 1e-3 * side;
            local = local.normalize();
        }
        let medium = Some(object.material);
        let inside = !place.front && model.bounds_media();
        let (near, far) = if inside { (medium, None) } else { (None, medium) };
        let at =
            Incidence { to_viewer: local, near: pass.index(near), far: pass.index(far), hero_lane: None };
        if !inside {
            let returned = model.ambient(&at);
            parts.iter_mut().zip(self.ambient).for_each(|(part, light)| *part = returned.diffuse * *light);
            if !returned.specular.is_zero() {
                let mirrored = frame.to_world(Vec3::new(-local.x, -local.y, local.z));
                self.add_around(mirrored, model.gloss(), &returned.specular, &mut parts[..groups]);
            }
        }
        if let Some(lamp) =
            object.lamp.filter(|&lamp| scene.lamps[lamp].emits(place.geometric, -place.to_viewer))
        {
            let relative = scene.lamps[lamp].relative_radiance(place.geometric, -place.to_viewer);
            parts[4 * groups + self.group_of[lamp]] = pass.emission[lamp] * relative;
        }
        if model.is_continuous() {
            self.lamps.arriving(scene, place.position, &mut |light| {
                let l = frame.to_local(light.direction);
                let found = model.components(&at, l);
                if found.diffuse.is_zero() && found.specular.is_zero() {
                    return;
                }
                let visible = self.shadows.visible(scene, place, &light);
                if visible == 0.0 {
                    return;
                }
                let irradiance = pass.emission[light.lamp] * (light.scale * l.z.abs() * visible);
                let group = self.group_of[light.lamp];
                parts[groups + group] += found.diffuse * irradiance;
                let part = if l.z * local.z > 0.0 { 2 } else { 3 };
                parts[part * groups + group] += found.specular * irradiance;
            });
        }
        for lobe in model.discrete_lobes(&at) {
            if !lobe.transmitted {
                let direction = frame.to_world(lobe.direction);
                self.add_around(direction, model.gloss(), &lobe.weight, &mut parts[2 * groups..3 * groups]);
            }
        }
        model.see_through(&at)
    }
}
