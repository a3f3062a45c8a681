//! Specular radiosity (Immel, Cohen and Greenberg 1986; book 4.4.3 and appendix IV.3): every patch sends its own radiance into every cell
//! of a globally oriented cube, by any illumination model in equilibrium.
//!
//! Through each cell of its cube a patch sees another one, whose light through the opposite cell arrives. What the patch's surface itself
//! reflects is summed over directions drawn from its model for each cell, and scaled to what the model's albedo says it must be in all, so
//! that no energy is created. Diffuse light and lamps are dealt with as in radiosity.

use super::direct;
use super::global_cube::GlobalCube;
use super::reflectance::{Counted, of_materials, specular_albedo};
use crate::lanes::Pass;
use crate::passes::{Light, group_lamps, passes_of};
use crate::settings::Settings;
use glam::Vec3;
use illuminant_illumination::{Illumination, IlluminationModel, Incidence, Prepare};
use illuminant_optics::frame::Frame;
use illuminant_radiosity::{Cancel, Cancelled, Elements, Kronecker, Points};
use illuminant_sampling::{Basis, Lanes};
use illuminant_scene::{Hit, LampForm, Scene, SurfacePoint};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f32::consts::{FRAC_1_PI, PI};
use std::sync::Arc;

const LANES: usize = 8;
/// Directions drawn for each cell into which a patch sends light: patches that face one way share them, so that their errors do not
/// average out, and the more of them there are the more are drawn.
const DRAWN: [u32; 2] = [32, 512];
/// Bytes that directions once drawn may take; beyond, they are drawn again at every step.
const MOST_KEPT: usize = 1 << 29;
/// Steps of an albedo's table over the cosine.
const COSINES: usize = 64;
/// The most memory, bytes.
const MOST_MEMORY: usize = 4 << 30;
/// The longest time, s.
const LONGEST: f64 = 7200.0;
const STEPS: usize = 64;
const NOTHING: u32 = u32::MAX;

/// What patches send into all directions.
#[derive(Clone, Debug)]
pub(crate) struct Directional {
    elements: Arc<Elements>,
    points: Arc<Points>,
    cube: GlobalCube,
    samples: usize,
    groups: usize,
    /// Radiance without emission: of each side, each cell, each group of lamps, every sample.
    sent: Vec<f32>,
}

/// How good a solution is.
#[derive(Clone, Debug, Default)]
pub(super) struct Quality {
    pub history: Vec<f64>,
    /// The most by which what leaves a patch exceeds what arrives, as a part of it.
    pub creation: f64,
}

impl Directional {
    /// The radiance that a surface sends back along a ray that has met it; false where there is no solution.
    pub fn radiance<const N: usize>(
        &self,
        hit: &Hit,
        point: &SurfacePoint,
        direction: Vec3,
        own: std::ops::Range<usize>,
        mut each: impl FnMut(usize, Lanes<N>),
    ) -> bool {
        let Some((element, weights)) = self.elements.locate(hit, point.position) else { return false };
        let back = point.geometric_normal.dot(direction) > 0.0;
        if self.elements.side(element, back).is_none() {
            return false;
        }
        let about = self.cube.about(-direction);
        let stride = self.groups * self.samples;
        let mut sums = vec![Lanes::<N>::default(); self.groups];
        for (point, weight) in self.points.of_element[element as usize].into_iter().zip(weights) {
            let (near, shares) = self.points.weights.row(point as usize);
            // What lies on the other side, or is not solved for, leaves its share to the rest.
            let sides =
                near.iter().zip(shares).filter_map(|(&e, &w)| Some((self.elements.side(e, back)?, w)));
            let all: f32 = sides.clone().map(|(_, w)| w).sum();
            for (side, share) in sides {
                for (cell, part) in about {
                    let factor = weight * share / all * part;
                    let from = &self.sent[(side as usize * self.cube.len() + cell) * stride..][..stride];
                    for (group, sum) in sums.iter_mut().enumerate() {
                        let values = &from[group * self.samples..][own.clone()];
                        *sum += Lanes::from_fn(|i| values.get(i).copied().unwrap_or(0.0)) * factor;
                    }
                }
            }
        }
        for (group, sum) in sums.into_iter().enumerate() {
            each(group, sum.map(|v| v.max(0.0)));
        }
        true
    }

    /// Bytes that it takes.
    pub fn memory(&self) -> usize {
        4 * self.sent.len()
    }
}

/// Refuses what would take too much memory or time.
fn check(elements: &Elements, cube: GlobalCube, values: usize, glossy: usize) -> Result<(), String> {
    let cells = elements.sides.len() * cube.len();
    // What is sent, once more while it is found, and what is seen.
    let memory = cells * (2 * values * 4 + 4);
    let seconds = cells as f64 / 2.0 / 1.5e6
        + 8.0 * (glossy * cube.len()) as f64 / 2.0
            * f64::from(DRAWN[0])
            * values.div_ceil(LANES) as f64
            * 8e-9;
    if memory > MOST_MEMORY || seconds > LONGEST {
        return Err(format!(
            "specular radiosity of {} patches with {} directions each would take {:.1} GiB and about {:.0} s; it is \
             refused above {} GiB and {LONGEST:.0} s: use fewer elements or a coarser cube",
            elements.sides.len(),
            cube.len(),
            memory as f64 / f64::from(1 << 30),
            seconds,
            MOST_MEMORY >> 30
        ));
    }
    Ok(())
}

/// The surfaces of one material that face one way: what they make of light is the same.
struct Facing {
    material: usize,
    normal: Vec3,
    sides: Vec<u32>,
}

/// What a side sends into all cells, and by how much that exceeds what arrives.
type Reflected = (u32, Vec<Lanes<LANES>>, f64);

impl Facing {
    /// How many directions are drawn for a cell.
    fn draws(&self) -> u32 {
        let [least, most] = DRAWN;
        least.saturating_mul(self.sides.len() as u32).min(most)
    }
}

/// Where the light comes from that a surface itself sends into a cell, and its weight.
type Drawn<const N: usize> = Vec<(u32, Lanes<N>)>;

/// What surfaces that face one way themselves make of light.
struct Operator {
    /// For each cell above the horizon, from which cells the light comes that they send into it.
    drawn: Vec<Drawn<LANES>>,
    /// What they reflect under each cosine.
    albedo: Vec<Lanes<LANES>>,
}

/// Solves for the light of all patches in all directions.
pub(super) fn solve<M: IlluminationModel<LANES> + Prepare>(
    illumination: Illumination,
    scene: &Scene,
    settings: &Settings,
    basis: &dyn Basis,
    elements: &Arc<Elements>,
    points: &Arc<Points>,
    cancel: &Cancel,
) -> Result<(Directional, Quality), String> {
    let told = &settings.radiosity;
    let cube = GlobalCube::new(told.cube);
    let (groups_of, group_of) = group_lamps(basis, scene.lamps.len(), false);
    let groups = groups_of.len();
    let passes = passes_of::<LANES, M>(scene, illumination, basis, None, &[0], Light::Lamps);
    let facing = facing(scene, elements);
    let of_side = |side: u32| scene.objects[elements.element_of(side).object as usize].material;
    let glossy = (0..elements.sides.len() as u32).filter(|&s| is_glossy(&passes[0].materials[of_side(s)]));
    check(elements, cube, groups * basis.len(), glossy.count())?;
    let seen = look(scene, elements, cube, cancel)?;
    let mut found = Directional {
        elements: Arc::clone(elements),
        points: Arc::clone(points),
        cube,
        samples: basis.len(),
        groups,
        sent: vec![0.0; elements.sides.len() * cube.len() * groups * basis.len()],
    };
    let mut quality = Quality::default();
    for pass in &passes {
        let solver = Solver { scene, elements, cube, pass, groups, group_of: &group_of, seen: &seen, cancel };
        solver.solve(settings, &facing, &mut found, &mut quality)?;
    }
    Ok((found, quality))
}

/// Whether a surface reflects anything but diffuse light.
fn is_glossy<M: IlluminationModel<LANES>>(model: &M) -> bool {
    let lanes = Lanes::splat(1.0);
    let index = illuminant_illumination::Index { mean: 1.0, least: 1.0, lanes: &lanes };
    let at = Incidence { to_viewer: Vec3::Z, near: index, far: index, hero_lane: None };
    model.follows_gloss() || !model.discrete_lobes(&at).is_empty()
}

fn facing(scene: &Scene, elements: &Elements) -> Vec<Facing> {
    let mut found: BTreeMap<(usize, [i32; 3]), Facing> = BTreeMap::new();
    for side in 0..elements.sides.len() as u32 {
        let element = elements.element_of(side);
        let normal = if elements.sides[side as usize].back { -element.normal } else { element.normal };
        let material = scene.objects[element.object as usize].material;
        let key = (material, (normal * 1e5).round().as_ivec3().to_array());
        found.entry(key).or_insert_with(|| Facing { material, normal, sides: Vec::new() }).sides.push(side);
    }
    found.into_values().collect()
}

/// The side that each side sees through each cell: the visibility buffers.
fn look(
    scene: &Scene,
    elements: &Elements,
    cube: GlobalCube,
    cancel: &Cancel,
) -> Result<Vec<u32>, Cancelled> {
    let mut seen = vec![NOTHING; elements.sides.len() * cube.len()];
    seen.par_chunks_mut(cube.len()).enumerate().try_for_each(|(side, cells)| {
        cancel.check()?;
        let sequence = Kronecker::<4>::new(side as u64 ^ 0x6375_6265);
        for (cell, seen) in cells.iter_mut().enumerate() {
            let [a, b, u, v] = sequence.point(cell as u64);
            let place = elements.place(&scene.geometry, side as u32, [a, b]);
            let direction = cube.direction(cell, [u, v]);
            if direction.dot(place.normal) <= 0.0 {
                continue;
            }
            let met = elements.meet(&scene.geometry, place.ray(direction));
            if let Some((ray, hit)) = met {
                *seen = elements.side_at(&ray, &hit).unwrap_or(NOTHING);
            }
        }
        Ok(())
    })?;
    Ok(seen)
}

struct Solver<'a, M> {
    scene: &'a Scene,
    elements: &'a Elements,
    cube: GlobalCube,
    pass: &'a Pass<LANES, M>,
    groups: usize,
    group_of: &'a [usize],
    seen: &'a [u32],
    cancel: &'a Cancel,
}

impl<M: IlluminationModel<LANES> + Prepare> Solver<'_, M> {
    fn solve(
        &self,
        settings: &Settings,
        facing: &[Facing],
        to: &mut Directional,
        quality: &mut Quality,
    ) -> Result<(), Cancelled> {
        let (cells, groups) = (self.cube.len(), self.groups);
        let sides = self.elements.sides.len();
        let told = &settings.radiosity;
        let lamps: Vec<Vec<Lanes<LANES>>> = (0..sides as u32)
            .into_par_iter()
            .map(|side| {
                self.cancel.check()?;
                let mut sums = vec![Lanes::default(); groups];
                for (lamp, &group) in self.group_of.iter().enumerate() {
                    let count = told.light_samples;
                    sums[group] += direct::mean(self.scene, self.elements, self.pass, lamp, side, count);
                }
                Ok(sums)
            })
            .collect::<Result<_, Cancelled>>()?;
        let diffuse = of_materials(self.scene, self.pass, Counted::Diffuse);
        let mut sent = vec![Lanes::<LANES>::default(); sides * cells * groups];
        let kept: Vec<Option<Operator>> = if self.memory_of_operators(facing) <= MOST_KEPT {
            facing.iter().enumerate().map(|(number, facing)| self.operator(number, facing)).collect()
        } else {
            Vec::new()
        };
        let mut history: Vec<f64> = Vec::new();
        let mut creation = 0.0f64;
        while history.len() < STEPS {
            let results: Vec<Vec<Reflected>> = facing
                .par_iter()
                .enumerate()
                .map(|(number, facing)| {
                    let drawn_again = kept.is_empty().then(|| self.operator(number, facing)).flatten();
                    let operator = kept.get(number).map_or(drawn_again.as_ref(), Option::as_ref);
                    let of = |&side: &u32| {
                        self.cancel.check()?;
                        let (new, creation) = self.reflect(side, facing, operator, &sent, &lamps, &diffuse);
                        Ok((side, new, creation))
                    };
                    facing.sides.par_iter().map(of).collect()
                })
                .collect::<Result<_, Cancelled>>()?;
            let (mut changed, mut all) = (0.0f64, 0.0f64);
            creation = 0.0;
            for sides in results {
                for (side, new, created) in sides {
                    let area = self.elements.area(side);
                    let old = &mut sent[side as usize * cells * groups..][..cells * groups];
                    for (old, new) in old.iter_mut().zip(&new) {
                        let (a, b): (f32, f32) =
                            ((0..LANES).map(|i| (old.0[i] - new.0[i]).abs()).sum(), new.0.iter().sum());
                        changed += area * f64::from(a);
                        all += area * f64::from(b);
                    }
                    old.copy_from_slice(&new);
                    creation = creation.max(created);
                }
            }
            history.push(if all > 0.0 { changed / all } else { 0.0 });
            if history[history.len() - 1] < told.tolerance.max(1e-4) {
                break;
            }
        }
        quality.creation = quality.creation.max(creation);
        if quality.history.len() < history.len() {
            quality.history = history;
        }
        let own = self.pass.samples.clone();
        let stride = to.samples;
        for (lanes, values) in sent.iter().zip(to.sent.chunks_mut(stride)) {
            values[own.clone()].copy_from_slice(&lanes.0[..own.len()]);
        }
        Ok(())
    }

    fn incidence(&self, material: usize, to_viewer: Vec3) -> Incidence<'_, LANES> {
        Incidence {
            to_viewer,
            near: self.pass.index(None),
            far: self.pass.index(Some(material)),
            hero_lane: None,
        }
    }

    fn frame(&self, facing: &Facing) -> Frame {
        match self.scene.materials[facing.material].grain {
            Some(grain) => Frame::along(facing.normal, Vec3::from(grain)),
            None => Frame::from_normal(facing.normal),
        }
    }

    /// About how many bytes the operators of all surfaces take.
    fn memory_of_operators(&self, facing: &[Facing]) -> usize {
        let glossy = facing.iter().filter(|f| is_glossy(&self.pass.materials[f.material]));
        let entries = |f: &Facing| (f.draws() as usize).min(self.cube.len() / 8);
        glossy.map(|f| self.cube.len() / 2 * entries(f) * size_of::<(u32, Lanes<LANES>)>()).sum()
    }

    /// What surfaces that face one way themselves make of light; `None` where they are diffuse alone.
    fn operator(&self, number: usize, facing: &Facing) -> Option<Operator> {
        let model = &self.pass.materials[facing.material];
        if !is_glossy(model) {
            return None;
        }
        let frame = self.frame(facing);
        let of = |cell: usize| {
            // Of its own for each cell, so that not all highlights lean the same way.
            let sequence = Kronecker::<5>::new((number as u64) << 32 ^ cell as u64 ^ 0x6472_6177);
            let mut found: Drawn<LANES> = Vec::new();
            let draws = facing.draws();
            for k in 0..draws {
                let [a, b, u, v, choice] = sequence.point(u64::from(k));
                // All over the cell, so that a mirror sends all that belongs into it.
                let to_viewer = frame.to_local(self.cube.direction(cell, [a, b]));
                if to_viewer.z <= 1e-3 {
                    continue;
                }
                let at = self.incidence(facing.material, to_viewer);
                let mut add = |local: Vec3, weight: Lanes<LANES>| {
                    let from = self.cube.cell(frame.to_world(local)) as u32;
                    let weight = weight * (draws as f32).recip();
                    match found.iter_mut().find(|(cell, _)| *cell == from) {
                        Some((_, sum)) => *sum += weight,
                        None => found.push((from, weight)),
                    }
                };
                for lobe in model.discrete_lobes(&at).iter().filter(|lobe| !lobe.transmitted) {
                    add(lobe.direction, lobe.weight);
                }
                if model.follows_gloss() {
                    if let Some(drawn) = model.gloss_ray(&at, [u, v, choice]).filter(|d| !d.transmitted) {
                        add(drawn.direction, drawn.weight);
                    }
                }
            }
            found
        };
        let of = |cell| if self.cancel.is_cancelled() { Drawn::new() } else { of(cell) };
        let drawn = (0..self.cube.len()).into_par_iter().map(of).collect();
        Some(Operator { drawn, albedo: self.albedo(facing.material) })
    }

    /// The light that comes to a side through a cell: of other surfaces' reflection, and of lamps and surroundings that are seen there.
    fn arriving(
        &self,
        side: u32,
        cell: usize,
        direction: Vec3,
        sent: &[Lanes<LANES>],
        each: &mut dyn FnMut(usize, Lanes<LANES>, Lanes<LANES>),
    ) {
        let seen = self.seen[side as usize * self.cube.len() + cell];
        if seen == NOTHING {
            for &lamp in &self.scene.surroundings {
                let light = self.pass.surroundings(self.scene, lamp, direction);
                each(self.group_of[lamp], Lanes::default(), light);
            }
            return;
        }
        let from = (seen as usize * self.cube.len() + self.cube.inverse(cell)) * self.groups;
        let element = self.elements.element_of(seen);
        let lamp = self.scene.objects[element.object as usize].lamp;
        let emits = |l: &usize| self.scene.lamps[*l].emits(element.normal, direction);
        for group in 0..self.groups {
            let mut emitted = Lanes::default();
            if let Some(lamp) = lamp.filter(emits).filter(|&l| self.group_of[l] == group) {
                emitted = self.pass.emission[lamp]
                    * self.scene.lamps[lamp].relative_radiance(element.normal, direction);
            }
            each(group, sent[from + group], emitted);
        }
    }

    /// What a side sends into all cells, and by how much that exceeds what arrives.
    fn reflect(
        &self,
        side: u32,
        facing: &Facing,
        operator: Option<&Operator>,
        sent: &[Lanes<LANES>],
        lamps: &[Vec<Lanes<LANES>>],
        diffuse: &[[Lanes<LANES>; 2]],
    ) -> (Vec<Lanes<LANES>>, f64) {
        let (cells, groups) = (self.cube.len(), self.groups);
        let normal = facing.normal;
        let model = &self.pass.materials[facing.material];
        let frame = self.frame(facing);
        let mut arriving =
            vec![Lanes::<LANES>::default(); if operator.is_some() { cells * groups } else { 0 }];
        let mut irradiance = vec![Lanes::<LANES>::default(); groups];
        // What arrives, and what of it the surface itself must send on.
        let mut came = vec![Lanes::<LANES>::default(); groups];
        let mut owed = vec![Lanes::<LANES>::default(); groups];
        let mut whole = 0.0;
        for cell in 0..cells {
            let direction = self.cube.direction(cell, [0.5; 2]);
            let cos = direction.dot(normal);
            if cos <= 0.0 {
                continue;
            }
            let part = cos * self.cube.solid_angle(cell);
            whole += part;
            self.arriving(side, cell, direction, sent, &mut |group, reflected, emitted| {
                irradiance[group] += reflected * part;
                if let Some(Operator { albedo, .. }) = operator {
                    let all = reflected + emitted;
                    arriving[cell * groups + group] += all;
                    came[group] += all * part;
                    owed[group] += all * albedo[((cos * COSINES as f32) as usize).min(COSINES - 1)] * part;
                }
            });
        }
        // The cells above the horizon stand for all of it.
        let full = PI / whole;
        let [reflectance, transmittance] = diffuse[facing.material];
        let behind = self.elements.opposite(side).filter(|_| !transmittance.is_zero());
        let base: Vec<Lanes<LANES>> = (0..groups)
            .map(|group| {
                let e = irradiance[group] * full + lamps[side as usize][group];
                let mut sum = reflectance * e;
                if let Some(behind) = behind {
                    sum += transmittance * (lamps[behind as usize][group] + self.others(behind, sent, group));
                }
                sum * FRAC_1_PI
            })
            .collect();
        let mut new = vec![Lanes::<LANES>::default(); cells * groups];
        let mut went = vec![Lanes::<LANES>::default(); groups];
        for cell in 0..cells {
            let direction = self.cube.direction(cell, [0.5; 2]);
            let cos = direction.dot(normal);
            let Some(Operator { drawn, .. }) = operator.filter(|_| cos > 0.0) else { continue };
            for (from, weight) in &drawn[cell] {
                for group in 0..groups {
                    new[cell * groups + group] += *weight * arriving[*from as usize * groups + group];
                }
            }
            for group in 0..groups {
                went[group] += new[cell * groups + group] * (cos * self.cube.solid_angle(cell));
            }
        }
        let mut creation = f64::NEG_INFINITY;
        for group in 0..groups {
            let factor =
                owed[group].zip(went[group], |o, w| if w > 0.0 { (o / w).clamp(0.0, 4.0) } else { 1.0 });
            for cell in 0..cells {
                new[cell * groups + group] *= factor;
            }
            let brings = irradiance[group] * full + lamps[side as usize][group];
            for lane in 0..self.pass.samples.len() {
                let e = f64::from(brings.0[lane].max(came[group].0[lane]));
                let b = f64::from(base[group].0[lane] * PI + went[group].0[lane] * factor.0[lane]);
                if e > 0.0 && behind.is_none() {
                    creation = creation.max(b / e - 1.0);
                }
            }
        }
        self.highlights(side, model, facing.material, &frame, &mut new);
        for cell in 0..cells {
            if self.cube.direction(cell, [0.5; 2]).dot(normal) > 0.0 {
                for group in 0..groups {
                    new[cell * groups + group] += base[group];
                }
            }
        }
        (new, creation)
    }

    /// The irradiance of a side by what others reflect, without lamps.
    fn others(&self, side: u32, sent: &[Lanes<LANES>], wanted: usize) -> Lanes<LANES> {
        let element = self.elements.element_of(side);
        let normal = if self.elements.sides[side as usize].back { -element.normal } else { element.normal };
        let (mut sum, mut whole) = (Lanes::default(), 0.0);
        for cell in 0..self.cube.len() {
            let direction = self.cube.direction(cell, [0.5; 2]);
            let part = direction.dot(normal).max(0.0) * self.cube.solid_angle(cell);
            if part > 0.0 {
                whole += part;
                self.arriving(side, cell, direction, sent, &mut |group, reflected, _| {
                    if group == wanted {
                        sum += reflected * part;
                    }
                });
            }
        }
        sum * (PI / whole)
    }

    /// Adds the highlights of lamps that have no size, which no cell sees.
    fn highlights(&self, side: u32, model: &M, material: usize, frame: &Frame, new: &mut [Lanes<LANES>]) {
        if !model.follows_gloss() {
            return;
        }
        let place = self.elements.centre(&self.scene.geometry, side);
        for (lamp, data) in self.scene.lamps.iter().enumerate() {
            if data.form.surrounds() || matches!(data.form, LampForm::Surface(_)) {
                continue;
            }
            let geometry = &self.scene.geometry;
            let Some(light) = data.sample(geometry, place.point.position, 0.0, [0.5; 2]) else { continue };
            let local = frame.to_local(light.direction);
            if local.z <= 0.0 || !direct::is_lit(self.scene, self.elements, &place.point, &light) {
                continue;
            }
            let arriving = self.pass.emission[lamp] * (light.scale * local.z);
            for cell in 0..self.cube.len() {
                let to_viewer = frame.to_local(self.cube.direction(cell, [0.5; 2]));
                if to_viewer.z > 0.0 {
                    let at = self.incidence(material, to_viewer);
                    let f = model.components(&at, local).specular;
                    new[cell * self.groups + self.group_of[lamp]] += f * arriving;
                }
            }
        }
    }

    /// What a material itself reflects of light under each cosine.
    fn albedo(&self, material: usize) -> Vec<Lanes<LANES>> {
        let under = |i: usize| {
            let cos = (i as f32 + 0.5) / COSINES as f32;
            let at = self.incidence(material, Vec3::new((1.0 - cos * cos).sqrt(), 0.0, cos));
            specular_albedo(&self.pass.materials[material], &at, 1024)
        };
        (0..COSINES).into_par_iter().map(under).collect()
    }
}
