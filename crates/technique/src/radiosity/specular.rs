//! Form factors by way of mirrors and glass (Wallace, Cohen and Greenberg 1987; book 4.5.1 and appendix IV.4).
//!
//! A ray by which a side looks around meets a patch, whose diffuse light is its form factor, and is mirrored or let through by it, again and
//! again, until it weighs too little. What it meets then is seen with a weight of its own in every spectral sample. Where a surface is
//! rough the ray goes on in one direction of its highlight, drawn by chance. Lamps that it meets so light the side too.

use super::direct::is_lit;
use crate::interaction::{Interaction, next_surface};
use crate::lanes::Pass;
use crate::media::Media;
use crate::path::Counts;
use crate::sequence::Sequence;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_radiosity::{Elements, Looking, Row, directions};
use illuminant_sampling::Lanes;
use illuminant_scene::{LampForm, Ray, Scene};
use std::f32::consts::PI;

/// The longest chain of rays.
const DEEPEST: u32 = 64;

/// What a side sees.
pub(super) struct Seen {
    /// Form factors of patches that are seen straight.
    pub straight: Vec<(u32, f32)>,
    /// Patches that are seen by way of others.
    pub columns: Vec<u32>,
    /// Their form factors in every sample.
    pub values: Vec<f32>,
    /// Irradiance by way of others of each column of lamps, in every sample.
    pub lamps: Vec<f32>,
}

/// Rows under way, for use again.
pub(super) struct Scratch {
    straight: Row,
    /// Where in `columns` a patch stands.
    place: Vec<u32>,
}

impl Scratch {
    pub fn new(patches: usize) -> Self {
        Self { straight: Row::new(patches), place: vec![u32::MAX; patches] }
    }
}

struct Branch<const N: usize> {
    ray: Ray,
    throughput: Lanes<N>,
    brightness: f32,
    media: Media,
    segment: u32,
}

/// How rays are followed.
pub(super) struct Followed<'a, const N: usize, M> {
    pub scene: &'a Scene,
    pub elements: &'a Elements,
    pub passes: &'a [Pass<N, M>],
    pub looking: &'a Looking,
    /// What a ray weighs at least.
    pub threshold: f32,
    pub column_of: &'a [usize],
    pub columns: usize,
    pub samples: usize,
    /// Whether what comes straight counts, and what comes by way of mirrors and glass.
    pub straight: bool,
    pub specular: bool,
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Followed<'_, N, M> {
    /// What a side sees.
    pub fn look(&self, side: u32, scratch: &mut Scratch) -> Seen {
        let mut seen = Seen {
            straight: Vec::new(),
            columns: Vec::new(),
            values: Vec::new(),
            lamps: vec![0.0; self.columns * self.samples],
        };
        for (number, pass) in self.passes.iter().enumerate() {
            let mut k = 0;
            directions(&self.scene.geometry, self.elements, side, self.looking, &mut |direction| {
                let sequence = Sequence::new(0, u64::from(side), k, 0);
                k += 1;
                self.follow(pass, number == 0, direction.ray, direction.part, sequence, scratch, &mut seen);
            });
        }
        for &patch in &seen.columns {
            scratch.place[patch as usize] = u32::MAX;
        }
        seen.straight = scratch.straight.take();
        seen
    }

    fn follow(
        &self,
        pass: &Pass<N, M>,
        first: bool,
        ray: Ray,
        part: f32,
        mut sequence: Sequence,
        scratch: &mut Scratch,
        seen: &mut Seen,
    ) {
        let (scene, own) = (self.scene, pass.samples.clone());
        let mut left = vec![Branch {
            ray,
            throughput: Lanes::splat(1.0),
            brightness: 1.0,
            media: Media::default(),
            segment: 1,
        }];
        while let Some(mut branch) = left.pop() {
            let Branch { ray, throughput, media, .. } = &mut branch;
            let met = next_surface(scene, pass, ray, media, throughput, &mut Counts::default());
            let by_way = branch.segment > 1;
            let mut shine = |lamp: usize, light: Lanes<N>| {
                let slots = &mut seen.lamps[self.column_of[lamp] * self.samples..][own.clone()];
                slots.iter_mut().zip(&light.0).for_each(|(sum, v)| *sum += v);
            };
            let Some((hit, point, _)) = met else {
                for &lamp in scene.surroundings.iter().filter(|_| by_way) {
                    let light = pass.surroundings(scene, lamp, branch.ray.direction);
                    shine(lamp, branch.throughput * light * (PI * part));
                }
                continue;
            };
            let lamp = scene.objects[hit.object as usize].lamp;
            let direction = branch.ray.direction;
            let lamp = lamp.filter(|&l| scene.lamps[l].emits(point.geometric_normal, direction));
            if let Some(lamp) = lamp.filter(|_| by_way) {
                let relative = scene.lamps[lamp].relative_radiance(point.geometric_normal, direction);
                shine(lamp, branch.throughput * pass.emission[lamp] * (PI * part * relative));
            }
            if let Some(met) = self.elements.side_at(&branch.ray, &hit) {
                let patch = self.elements.patch_of[met as usize];
                if by_way {
                    let place = &mut scratch.place[patch as usize];
                    if *place == u32::MAX {
                        *place = seen.columns.len() as u32;
                        seen.columns.push(patch);
                        seen.values.resize(seen.values.len() + self.samples, 0.0);
                    }
                    let slots = &mut seen.values[*place as usize * self.samples..][own.clone()];
                    let weight = branch.throughput * part;
                    slots.iter_mut().zip(&weight.0).for_each(|(sum, v)| *sum += v);
                } else if first && self.straight {
                    scratch.straight.add(patch, part);
                }
            }
            if !self.specular || branch.segment >= DEEPEST {
                continue;
            }
            let met = Interaction::new(
                scene,
                pass,
                &branch.ray,
                &hit,
                &point,
                branch.media,
                0.0,
                None,
                &mut sequence,
            );
            let model = met.model();
            let mut go = |local: glam::Vec3, weight: Lanes<N>, brightness: f32, transmitted: bool| {
                let onwards = met.frame.to_world(local);
                let outward = onwards.dot(point.geometric_normal);
                let brightness = branch.brightness * brightness;
                if (outward * direction.dot(point.geometric_normal) < 0.0) == transmitted
                    || brightness <= self.threshold
                {
                    return;
                }
                left.push(Branch {
                    ray: Ray { origin: point.offset(onwards), direction: onwards, time: 0.0 },
                    throughput: branch.throughput * weight,
                    brightness,
                    media: if transmitted && model.bounds_media() { met.beyond } else { branch.media },
                    segment: branch.segment + 1,
                });
            };
            for lobe in model.discrete_lobes(&met.at) {
                go(lobe.direction, lobe.weight, lobe.brightness, lobe.transmitted);
            }
            if model.follows_gloss() {
                let [u, v, choice, _] = sequence.next4();
                if let Some(drawn) = model.gloss_ray(&met.at, [u, v, choice]) {
                    go(drawn.direction, drawn.weight, drawn.brightness, drawn.transmitted);
                }
                // A lamp without size is never met: it is asked.
                for lamp in 0..scene.lamps.len() {
                    let data = &scene.lamps[lamp];
                    if data.form.surrounds() || matches!(data.form, LampForm::Surface(_)) {
                        continue;
                    }
                    let Some(light) = data.sample(&scene.geometry, point.position, 0.0, [0.5; 2]) else {
                        continue;
                    };
                    let local = met.frame.to_local(light.direction);
                    let f = model.components(&met.at, local).specular;
                    let same_side = light.direction.dot(point.geometric_normal) * local.z > 0.0;
                    if same_side && !f.is_zero() && is_lit(scene, self.elements, &point, &light) {
                        let scale = light.scale * local.z.abs() * PI * part;
                        shine(lamp, branch.throughput * f * pass.emission[lamp] * scale);
                    }
                }
            }
        }
    }
}
