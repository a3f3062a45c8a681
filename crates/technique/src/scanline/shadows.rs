//! What stands between a surface and a lamp.

use super::lighting::Place;
use super::shadow_map::ShadowMaps;
use super::surfaces::Surfaces;
use crate::direct_light::Arriving;
use crate::settings::Shadows;
use illuminant_scene::Scene;

/// How lamps are looked for.
pub(crate) enum Occlusion {
    /// Every lamp is seen.
    None,
    /// With a ray.
    Rays,
    /// In images of what lamps see.
    Maps(ShadowMaps),
}

impl Occlusion {
    /// Prepares what the settings ask for.
    pub fn new(scene: &Scene, surfaces: &Surfaces, shadows: Shadows) -> Self {
        match shadows {
            Shadows::None => Self::None,
            Shadows::Rays => Self::Rays,
            Shadows::Maps(size) => Self::Maps(ShadowMaps::new(scene, surfaces, size)),
        }
    }

    /// The part of a place on a lamp that is seen.
    #[inline]
    pub fn visible(&self, scene: &Scene, place: &Place, light: &Arriving) -> f32 {
        match self {
            Self::None => 1.0,
            Self::Rays => f32::from(u8::from(!is_hidden(scene, place, light))),
            Self::Maps(maps) => maps.visible(place, light),
        }
    }
}

fn is_hidden(scene: &Scene, place: &Place, light: &Arriving) -> bool {
    let reach = place.position.abs().max_element() + place.to_viewer.abs().max_element();
    // Rays meet spheres themselves, and facets lie below.
    let depth = scene.geometry.facet_depth(place.object, scene.camera.shutter[0]);
    let away = place.geometric * (2e-5 * reach + depth).copysign(place.geometric.dot(light.direction));
    let origin = place.position + away;
    let (span, tfar) = match light.target {
        Some(target) => (target - origin, 0.999),
        None => (light.direction, f32::INFINITY),
    };
    scene.geometry.is_occluded(origin, span, scene.camera.shutter[0], tfar)
}
