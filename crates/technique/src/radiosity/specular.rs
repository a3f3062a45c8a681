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
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Prepare, Surface};
use illuminant_radiosity::{
    Direction, Elements, Hemicube, Looking, Mirror, Reflection, Row, Sight, directions, look_into_mirrors,
};
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

    /// Hands over the row, and is ready for the next.
    fn finish(&mut self, seen: &mut Seen) {
        for &patch in &seen.columns {
            self.place[patch as usize] = u32::MAX;
        }
        seen.straight = self.straight.take();
    }
}

/// The flat mirrors of a scene, and what each reflects under how many cosines, in the lanes of each pass.
pub(super) struct Mirrors<const N: usize> {
    all: Vec<Mirror>,
    /// For each pass, each mirror.
    reflectance: Vec<Vec<Vec<Lanes<N>>>>,
    /// The most that each reflects.
    brightest: Vec<f32>,
}

/// Steps of a mirror's reflectance over the cosine.
const COSINES: usize = 256;

impl<const N: usize> Mirrors<N> {
    /// The mirrors of a scene, for the mirrored environment.
    ///
    /// # Errors
    /// A sentence on what is neither diffuse nor a flat mirror.
    pub fn new<M: IlluminationModel<N> + Prepare>(
        scene: &Scene,
        passes: &[Pass<N, M>],
    ) -> Result<Self, String> {
        let mut found =
            Self { all: Vec::new(), reflectance: vec![Vec::new(); passes.len()], brightest: Vec::new() };
        for (number, object) in scene.objects.iter().enumerate() {
            let material = &scene.materials[object.material];
            let mirror = match &material.surface {
                Surface::Diffuse { .. } | Surface::Translucent { .. } => continue,
                Surface::Conductor { finish, .. } if finish.is_smooth() => {
                    Mirror::new(&scene.geometry, number as u32)
                }
                _ => None,
            };
            let Some(mirror) = mirror else {
                return Err(format!(
                    "scanline sees flat mirrors as windows into a mirrored scene, and {:?} is no flat mirror: use rays or \
                     hemicube",
                    object.name
                ));
            };
            found.all.push(mirror);
            let mut brightest = 0f32;
            for (pass, tables) in passes.iter().zip(&mut found.reflectance) {
                let under = |i: usize| {
                    let cos = (i as f32 + 0.5) / COSINES as f32;
                    let at = Incidence {
                        to_viewer: Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos),
                        near: pass.index(None),
                        far: pass.index(Some(object.material)),
                        hero_lane: None,
                    };
                    let lobes = pass.materials[object.material].discrete_lobes(&at);
                    let reflected = lobes.into_iter().filter(|lobe| !lobe.transmitted);
                    reflected.fold((Lanes::default(), 0f32), |(sum, bright), lobe| {
                        (sum + lobe.weight, bright + lobe.brightness)
                    })
                };
                let table: Vec<(Lanes<N>, f32)> = (0..COSINES).map(under).collect();
                brightest = table.iter().map(|(_, bright)| *bright).fold(brightest, f32::max);
                tables.push(table.into_iter().map(|(lanes, _)| lanes).collect());
            }
            found.brightest.push(brightest);
        }
        Ok(found)
    }
}

struct Branch<const N: usize> {
    ray: Ray,
    throughput: Lanes<N>,
    brightness: f32,
    media: Media,
    segment: u32,
}

/// Where the samples of a patch stand among those that are seen by way of others.
fn slots_of<'a>(
    scratch: &mut Scratch,
    columns: &mut Vec<u32>,
    values: &'a mut Vec<f32>,
    patch: u32,
    samples: usize,
) -> &'a mut [f32] {
    let place = &mut scratch.place[patch as usize];
    if *place == u32::MAX {
        *place = columns.len() as u32;
        columns.push(patch);
        values.resize(values.len() + samples, 0.0);
    }
    &mut values[*place as usize * samples..][..samples]
}

/// How rays are followed.
pub(super) struct Followed<'a, const N: usize, M> {
    pub scene: &'a Scene,
    pub elements: &'a Elements,
    pub passes: &'a [Pass<N, M>],
    pub looking: Option<&'a Looking>,
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
    fn nothing(&self) -> Seen {
        Seen {
            straight: Vec::new(),
            columns: Vec::new(),
            values: Vec::new(),
            lamps: vec![0.0; self.columns * self.samples],
        }
    }

    /// What a side sees.
    pub fn look(&self, side: u32, scratch: &mut Scratch) -> Seen {
        let mut rays = Vec::new();
        if let Some(looking) = self.looking {
            directions(&self.scene.geometry, self.elements, side, looking, &mut |direction| {
                rays.push(direction)
            });
        }
        self.look_along(&rays, u64::from(side), scratch)
    }

    /// What is seen along rays, which draw where they go on from the numbers of `stream`.
    pub fn look_along(&self, rays: &[Direction], stream: u64, scratch: &mut Scratch) -> Seen {
        let mut seen = self.nothing();
        for (number, pass) in self.passes.iter().enumerate() {
            for (k, Direction { ray, part }) in rays.iter().enumerate() {
                let sequence = Sequence::new(0, stream, k as u64, 0);
                self.follow(pass, number == 0, *ray, *part, sequence, scratch, &mut seen);
            }
        }
        scratch.finish(&mut seen);
        seen
    }

    /// What a side sees, with the scene reflected about the planes of flat mirrors.
    pub fn look_into_mirrors(
        &self,
        side: u32,
        cube: &Hemicube,
        mirrors: &Mirrors<N>,
        scratch: &mut Scratch,
    ) -> Seen {
        let mut seen = self.nothing();
        let scene = self.scene;
        let goes_on = |chain: &[Reflection]| {
            let weight: f32 = chain.iter().map(|(k, _)| mirrors.brightest[*k as usize]).product();
            self.specular && weight > self.threshold && chain.len() < DEEPEST as usize
        };
        let mut each = |chain: &[Reflection], sight: Sight, part: f32| {
            for (number, pass) in self.passes.iter().enumerate() {
                let own = pass.samples.clone();
                let mut weight = Lanes::splat(part);
                for (mirror, cos) in chain {
                    let table = &mirrors.reflectance[number][*mirror as usize];
                    weight *= table[((cos * COSINES as f32) as usize).min(COSINES - 1)];
                }
                let by_way = !chain.is_empty();
                let mut shine = |lamp: usize, light: Lanes<N>| {
                    let slots = &mut seen.lamps[self.column_of[lamp] * self.samples..][own.clone()];
                    slots.iter_mut().zip(&light.0).for_each(|(sum, v)| *sum += v);
                };
                match sight {
                    Sight::Open(direction) => {
                        for &lamp in scene.surroundings.iter().filter(|_| by_way) {
                            shine(lamp, weight * pass.surroundings(scene, lamp, direction) * PI);
                        }
                    }
                    Sight::Element(number_of, back, direction) => {
                        let element = &self.elements.all[number_of as usize];
                        let lamp = scene.objects[element.object as usize].lamp;
                        let lamp =
                            lamp.filter(|&l| by_way && scene.lamps[l].emits(element.normal, direction));
                        if let Some(lamp) = lamp {
                            let relative = scene.lamps[lamp].relative_radiance(element.normal, direction);
                            shine(lamp, weight * pass.emission[lamp] * (PI * relative));
                        }
                        let Some(met) = self.elements.side(number_of, back) else { continue };
                        let patch = self.elements.patch_of[met as usize];
                        if by_way {
                            let slots =
                                slots_of(scratch, &mut seen.columns, &mut seen.values, patch, self.samples);
                            slots[own.clone()].iter_mut().zip(&weight.0).for_each(|(sum, v)| *sum += v);
                        } else if number == 0 && self.straight {
                            scratch.straight.add(patch, part);
                        }
                    }
                }
            }
        };
        look_into_mirrors(&scene.geometry, self.elements, &mirrors.all, side, cube, &goes_on, &mut each);
        scratch.finish(&mut seen);
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
                    let slots = slots_of(scratch, &mut seen.columns, &mut seen.values, patch, self.samples);
                    let weight = branch.throughput * part;
                    slots[own.clone()].iter_mut().zip(&weight.0).for_each(|(sum, v)| *sum += v);
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
