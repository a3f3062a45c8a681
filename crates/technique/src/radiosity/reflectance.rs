//! What diffuse surfaces return of diffuse light.

use crate::interaction::Interaction;
use crate::lanes::Pass;
use crate::media::Media;
use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Prepare, Surface};
use illuminant_optics::hemisphere;
use illuminant_radiosity::{Cancel, Cancelled, Elements, Kronecker};
use illuminant_sampling::Lanes;
use illuminant_scene::{Ray, Scene};
use rayon::prelude::*;
use std::f32::consts::PI;

/// Directions over which a model's reflectance is averaged.
const DIRECTIONS: u64 = 64;
/// Directions that are drawn for each of them.
const DRAWS: u32 = 256;
/// Places of a side at which a texture is looked at.
const PLACES: u64 = 16;

/// Whether a surface lets light through as it is: radiosity between diffuse surfaces passes it.
pub(crate) fn is_clear(surface: &Surface) -> bool {
    matches!(surface, Surface::Filter { .. } | Surface::Dielectric { .. })
}

/// Whether what a surface itself reflects counts as if it were diffuse too: where no rays follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counted {
    All,
    Diffuse,
}

/// What a surface returns of diffuse light where it is seen: reflected, and let through from the other side.
pub(crate) fn diffuse_at<const N: usize, M: IlluminationModel<N>>(
    model: &M,
    at: &Incidence<'_, N>,
    surface: &Surface,
    counted: Counted,
) -> [Lanes<N>; 2] {
    if matches!(surface, Surface::Translucent { .. }) {
        let straight = Vec3::Z * 1f32.copysign(at.to_viewer.z);
        // Lambert's law on either side.
        return [straight, -straight].map(|l| model.eval(at, l) * PI);
    }
    let found = model.ambient(at);
    let all = match counted {
        Counted::All => found.diffuse + found.specular,
        Counted::Diffuse => found.diffuse,
    };
    [all, Lanes::default()]
}

/// What a surface itself reflects of light from one direction, by reciprocity what it returns into it of even light: the mean weight of
/// directions drawn from its model, and its mirror's. (A model's ambient light is near it, and no more.)
pub(super) fn specular_albedo<const N: usize, M: IlluminationModel<N>>(
    model: &M,
    at: &Incidence<'_, N>,
    draws: u32,
) -> Lanes<N> {
    let mut sum = Lanes::default();
    if model.follows_gloss() {
        let sequence = Kronecker::<3>::new(0x616c_6265);
        for k in 0..draws {
            if let Some(drawn) = model.gloss_ray(at, sequence.point(u64::from(k))) {
                sum += if drawn.transmitted { Lanes::default() } else { drawn.weight };
            }
        }
        sum *= (draws as f32).recip();
    } else {
        sum = model.ambient(at).specular;
    }
    let mirrored = model.discrete_lobes(at).into_iter().filter(|lobe| !lobe.transmitted);
    mirrored.fold(sum, |sum, lobe| sum + lobe.weight)
}

/// What a surface returns of even light from everywhere, as the mean over all directions in which it is returned: its bihemispherical
/// reflectance and transmittance.
fn of_model<const N: usize, M: IlluminationModel<N>>(
    model: &M,
    at: &Incidence<'_, N>,
    surface: &Surface,
    counted: Counted,
) -> [Lanes<N>; 2] {
    let sequence = Kronecker::<2>::new(0);
    let mut sums = [Lanes::default(); 2];
    for k in 0..DIRECTIONS {
        let at = Incidence { to_viewer: Vec3::from(hemisphere::cosine(sequence.point(k))), ..*at };
        let found = diffuse_at(model, &at, surface, Counted::Diffuse);
        sums.iter_mut().zip(found).for_each(|(sum, f)| *sum += f);
        if counted == Counted::All {
            sums[0] += specular_albedo(model, &at, DRAWS);
        }
    }
    sums.map(|sum| (sum * (DIRECTIONS as f32).recip()).map(|r| r.min(1.0)))
}

/// The reflectance and transmittance of each material in the lanes of a pass.
pub(super) fn of_materials<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    pass: &Pass<N, M>,
    counted: Counted,
) -> Vec<[Lanes<N>; 2]> {
    let at = |material| Incidence {
        to_viewer: Vec3::Z,
        near: pass.index(None),
        far: pass.index(Some(material)),
        hero_lane: None,
    };
    let of = |m: usize| of_model(&pass.materials[m], &at(m), &scene.materials[m].surface, counted);
    (0..scene.materials.len()).map(of).collect()
}

/// The mean reflectance and transmittance of a side whose material has images.
pub(super) fn of_textured_side<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    elements: &Elements,
    pass: &Pass<N, M>,
    side: u32,
    counted: Counted,
) -> [Lanes<N>; 2] {
    let sequence = Kronecker::<2>::new(u64::from(side) ^ 0x736b_696e);
    let element = elements.element_of(side);
    let surface = &scene.materials[scene.objects[element.object as usize].material].surface;
    let mut sums = [Lanes::default(); 2];
    for k in 0..PLACES {
        let place = elements.place(&scene.geometry, side, sequence.point(k));
        let ray = Ray { origin: place.point.position + place.normal, direction: -place.normal, time: 0.0 };
        let hit = scene.geometry.hit_at(&ray, element.object, element.primitive, place.point.position);
        let width = (element.area / PLACES as f64).sqrt() as f32;
        let mut numbers = Sequence::new(0, u64::from(side), k, 0);
        let media = Media::default();
        let met = Interaction::new(scene, pass, &ray, &hit, &place.point, media, width, None, &mut numbers);
        let found = diffuse_at(met.model(), &met.at, surface, counted);
        sums.iter_mut().zip(found).for_each(|(sum, f)| *sum += f);
    }
    sums.map(|sum| (sum * (PLACES as f32).recip()).map(|r| r.min(1.0)))
}

/// Of each side the reflectance in every sample, and the transmittance, if any surface has one.
pub(super) fn of_sides<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    elements: &Elements,
    passes: &[Pass<N, M>],
    samples: usize,
    counted: Counted,
    cancel: &Cancel,
) -> Result<(Vec<f32>, Vec<f32>), Cancelled> {
    let of_materials: Vec<_> = passes.iter().map(|pass| of_materials(scene, pass, counted)).collect();
    let mut found = vec![0f32; 2 * elements.sides.len() * samples];
    found.par_chunks_mut(2 * samples).enumerate().try_for_each(|(side, rows)| {
        cancel.check()?;
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
        Ok(())
    })?;
    let rows = found.chunks(samples);
    let reflected: Vec<f32> = rows.clone().step_by(2).flatten().copied().collect();
    let mut transmitted: Vec<f32> = rows.skip(1).step_by(2).flatten().copied().collect();
    if transmitted.iter().all(|t| *t == 0.0) {
        transmitted.clear();
    }
    Ok((reflected, transmitted))
}
