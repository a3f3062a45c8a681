//! What reaches a point from lamps, for techniques that ask lamps alone.

use super::shadows::Occlusion;
use crate::direct_light::{Arriving, add_around, arriving, middle};
use crate::lanes::Pass;
use crate::skins::{Mixture, perturbed};
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Prepare};
use illuminant_optics::frame::Frame;
use illuminant_sampling::Lanes;
use illuminant_scene::{Scene, TexturePoint};

/// The parts of a radiance: ambient, diffuse, specular, transmitted, emitted. Each has a bundle for every group of lamps.
pub(crate) const PARTS: usize = 5;

/// The lamps of a scene: where they are, or at infinity.
pub(super) struct Lamps {
    /// What arrives in the middle of the scene, where that is taken to arrive everywhere.
    everywhere: Option<Vec<Arriving>>,
}

impl Lamps {
    pub fn new(scene: &Scene, at_infinity: bool) -> Self {
        let in_the_middle = || {
            let mut all = Vec::new();
            arriving(scene, middle(scene), scene.camera.shutter[0], &mut |light| all.push(light));
            all
        };
        Self { everywhere: at_infinity.then(in_the_middle) }
    }

    /// Light that arrives at a point.
    pub fn arriving(&self, scene: &Scene, point: Vec3, each: &mut impl FnMut(Arriving)) {
        match &self.everywhere {
            Some(all) => all.iter().for_each(|light| each(*light)),
            None => arriving(scene, point, scene.camera.shutter[0], each),
        }
    }
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

impl<const N: usize, M: IlluminationModel<N> + Prepare> Lighting<'_, N, M> {
    /// Adds `weight` times the radiance of a cone in which nothing is followed.
    fn add_around(&self, direction: Vec3, radius: f32, weight: &Lanes<N>, to: &mut [Lanes<N>]) {
        let light = (self.group_of, self.ambient);
        add_around(self.scene, self.pass, light, direction, radius, weight, to);
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
        // Compiled once, not at every call.
        let model: &dyn IlluminationModel<N> = model;
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
