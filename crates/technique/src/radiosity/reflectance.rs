//! What diffuse surfaces return of diffuse light.

use crate::interaction::Interaction;
use crate::lanes::Pass;
use crate::media::Media;
use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Prepare, Surface};
use illuminant_optics::hemisphere;
use illuminant_radiosity::{Elements, Kronecker};
use illuminant_sampling::Lanes;
use illuminant_scene::{Ray, Scene};

/// Directions over which a model's reflectance is averaged.
const DIRECTIONS: u64 = 64;
/// Places of a side at which a texture is looked at.
const PLACES: u64 = 16;

/// Whether a surface lets light through as it is: radiosity between diffuse surfaces passes it.
pub(crate) fn is_clear(surface: &Surface) -> bool {
    matches!(surface, Surface::Filter { .. } | Surface::Dielectric { .. })
}

/// The part of even light from everywhere that a surface returns on the same side: its bihemispherical reflectance.
pub(super) fn of_model<const N: usize, M: IlluminationModel<N>>(
    model: &M,
    at: &Incidence<'_, N>,
) -> Lanes<N> {
    let sequence = Kronecker::<2>::new(0);
    let mut sum = Lanes::default();
    for k in 0..DIRECTIONS {
        let at = Incidence { to_viewer: Vec3::from(hemisphere::cosine(sequence.point(k))), ..*at };
        let found = model.ambient(&at);
        sum += found.diffuse + found.specular;
        for lobe in model.discrete_lobes(&at).into_iter().filter(|lobe| !lobe.transmitted) {
            sum += lobe.weight;
        }
    }
    (sum * (DIRECTIONS as f32).recip()).map(|r| r.min(1.0))
}

/// The reflectance of each material in the lanes of a pass.
pub(super) fn of_materials<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    pass: &Pass<N, M>,
) -> Vec<Lanes<N>> {
    let at = |material| Incidence {
        to_viewer: Vec3::Z,
        near: pass.index(None),
        far: pass.index(Some(material)),
        hero_lane: None,
    };
    (0..scene.materials.len()).map(|m| of_model(&pass.materials[m], &at(m))).collect()
}

/// The mean reflectance of a side whose material has images.
pub(super) fn of_textured_side<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    elements: &Elements,
    pass: &Pass<N, M>,
    side: u32,
) -> Lanes<N> {
    let sequence = Kronecker::<2>::new(u64::from(side) ^ 0x736b_696e);
    let element = elements.element_of(side);
    let mut sum = Lanes::default();
    for k in 0..PLACES {
        let place = elements.place(&scene.geometry, side, sequence.point(k));
        let ray = Ray { origin: place.point.position + place.normal, direction: -place.normal, time: 0.0 };
        let hit = scene.geometry.hit_at(&ray, element.object, element.primitive, place.point.position);
        let width = (element.area / PLACES as f64).sqrt() as f32;
        let mut numbers = Sequence::new(0, u64::from(side), k, 0);
        let media = Media::default();
        let met = Interaction::new(scene, pass, &ray, &hit, &place.point, media, width, None, &mut numbers);
        let found = met.model().ambient(&met.at);
        sum += found.diffuse + found.specular;
    }
    (sum * (PLACES as f32).recip()).map(|r| r.min(1.0))
}
