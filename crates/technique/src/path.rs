//! Path tracing (Kajiya 1986): next-event estimation with multiple importance sampling (Veach 1997, power heuristic),
//! Russian roulette by brightness, radiance in every lane.
//!
//! Where a path goes never depends on the lanes, only on seed, pixel, sample and the brightness of materials; so every
//! spectral sampling follows the same paths, and `1nm` may follow them pass by pass.

use crate::carried::{Carried, ROULETTE_FROM};
use crate::direct_light::way_to;
use crate::interaction::{Interaction, next_surface};
use crate::lanes::Pass;
use crate::participating::{Draws, MediumLanes};
use crate::radiosity;
use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare, Surface};
use illuminant_sampling::Lanes;
use illuminant_scene::{Hit, Ray, Scene, SurfacePoint};

/// The part of a pixel that one path sees of a texture: many paths share a pixel.
pub(crate) const OF_PIXEL: f32 = 0.5;
/// The part of a lobe that one path sees of a texture behind it.
pub(crate) const OF_LOBE: f32 = 0.125;

/// How paths are followed.
#[derive(Clone, Debug)]
pub struct PathTracer {
    /// The longest path in segments.
    pub depth: u32,
    /// Of each material whether what its discrete lobes make of lamps on a surface that scatters is left to paths from the lamps; `None`
    /// where there are no such paths.
    pub gathered: Option<Vec<bool>>,
}

/// What the camera sees first along a path.
#[derive(Clone, Copy, Debug, Default)]
pub struct Primary {
    /// Distance, object and shading normal, if anything is met.
    pub surface: Option<(f32, u32, Vec3)>,
    /// Whether the camera looks at light.
    pub emits: bool,
}

/// One vertex of a path, for replays.
#[derive(Clone, Debug)]
pub struct Vertex {
    /// Number of the object.
    pub object: u32,
    /// Number of its triangle.
    pub primitive: u32,
    /// Where.
    pub position: Vec3,
    /// Throughput on arrival, in every lane.
    pub throughput: Vec<f32>,
    /// What the vertex added to the radiance, in every lane.
    pub added: Vec<f32>,
}

/// Whoever watches a path: a counter, or a recorder. What is not watched costs nothing.
pub trait Probe {
    /// Whether vertices are wanted.
    const VERTICES: bool = false;

    /// The nearest surface along a ray is about to be asked for.
    fn closest(&mut self, ray: &Ray);

    /// Whether `origin` + `span` · (0, `tfar`) is free is about to be asked.
    fn occlusion(&mut self, origin: Vec3, span: Vec3, tfar: f32);

    /// A ray was not followed, because it weighs too little.
    fn pruned(&mut self) {}

    /// A vertex has been dealt with.
    fn vertex(&mut self, _vertex: Vertex) {}
}

/// Counts the queries of one path or many.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Closest-hit queries.
    pub closest: u64,
    /// Occlusion queries.
    pub occlusion: u64,
    /// Rays that were not followed, because they weigh too little.
    pub pruned: u64,
}

impl Probe for Counts {
    #[inline(always)]
    fn closest(&mut self, _ray: &Ray) {
        self.closest += 1;
    }

    #[inline(always)]
    fn occlusion(&mut self, _origin: Vec3, _span: Vec3, _tfar: f32) {
        self.occlusion += 1;
    }

    #[inline(always)]
    fn pruned(&mut self) {
        self.pruned += 1;
    }
}

/// A query as it was asked.
#[derive(Clone, Copy, Debug)]
pub enum Query {
    /// The nearest surface along a ray.
    Closest(Ray),
    /// Whether a span is free: origin, span, and how much of it counts.
    Occlusion(Vec3, Vec3, f32),
}

/// Keeps everything that happens.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    /// The queries, in order.
    pub queries: Vec<Query>,
    /// The vertices, in order.
    pub vertices: Vec<Vertex>,
}

impl Probe for Recorder {
    const VERTICES: bool = true;

    fn closest(&mut self, ray: &Ray) {
        self.queries.push(Query::Closest(*ray));
    }

    fn occlusion(&mut self, origin: Vec3, span: Vec3, tfar: f32) {
        self.queries.push(Query::Occlusion(origin, span, tfar));
    }

    fn vertex(&mut self, vertex: Vertex) {
        self.vertices.push(vertex);
    }
}

/// The weight of a direction drawn with density `mine` that could have been drawn with `other`.
#[inline(always)]
pub(crate) fn power_heuristic(mine: f32, other: f32) -> f32 {
    let ratio = other / mine;
    (1.0 + ratio * ratio).recip()
}

/// The light of all groups of lamps together.
pub(crate) fn sum<const N: usize>(radiance: &[Lanes<N>]) -> Lanes<N> {
    radiance.iter().fold(Lanes::default(), |sum, light| sum + *light)
}

/// The state of a path between two vertices.
struct State<const N: usize> {
    ray: Ray,
    light: Carried<N>,
    /// Where the last direction was drawn, with which normal and density; `None` after a discrete lobe or the camera.
    origin: Option<(Vec3, Vec3, f32)>,
    /// Where the next vertex looks on a lamp.
    u_lamp: [f32; 2],
    /// The cone of light that the path stands for (Amanatides 1984; Akenine-Möller et al. 2019): its width where the ray begins,
    /// and how it grows with distance.
    cone: [f32; 2],
    /// By what distances in the air are drawn, once they are.
    draws: Option<Draws>,
    /// Whether the first surface scattered the path.
    scattered_first: bool,
    /// Whether any surface did.
    looks_around: bool,
    /// Whether a diffuse surface was the first that did, so that what lamps send it by way of others is known.
    from_diffuse: bool,
    /// Whether the path has met another since.
    by_way: bool,
    /// Whether what a lamp sends along the path is found from the lamp.
    from_lamps: bool,
}

/// Whether all that a surface returns is diffuse.
fn is_diffuse(surface: &Surface) -> bool {
    matches!(surface, Surface::Diffuse { .. } | Surface::Translucent { .. })
}

impl PathTracer {
    /// Follows one path and adds the radiance that it brings to `radiance`, one bundle for each group of lamps.
    ///
    /// `u_lamp` is where the first vertex looks on a lamp: it is drawn together with the place in the pixel, as every
    /// later one with the direction that leads to it, so that the four numbers are spread jointly.
    #[inline]
    pub fn trace<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        ray: Ray,
        mut sequence: Sequence,
        u_lamp: [f32; 2],
        radiance: &mut [Lanes<N>],
        probe: &mut P,
    ) -> Primary {
        let mut primary = Primary::default();
        let mut path = State {
            ray,
            light: Carried::new(Lanes::splat(1.0)),
            origin: None,
            u_lamp,
            cone: [0.0, OF_PIXEL * scene.camera.pixel_angle()],
            draws: None,
            scattered_first: false,
            looks_around: false,
            from_diffuse: false,
            by_way: false,
            from_lamps: false,
        };
        for segment in 1..=self.depth {
            let (before, open) = (path.ray, path.light.media.innermost().is_none());
            let State { ray, light: Carried { media, throughput, .. }, .. } = &mut path;
            let met = next_surface(scene, pass, ray, media, throughput, probe);
            if let Some(medium) = pass.medium.as_ref().filter(|_| open) {
                let length = met.as_ref().map_or(f32::INFINITY, |(.., distance)| *distance);
                let draws = path.draws.get_or_insert_with(|| Draws::new(sequence.next4()[0]));
                let found = medium.travel(before.origin, before.direction, length, draws, &mut sequence);
                path.light.throughput *= found.weight;
                path.light.brightness *= found.brightness;
                if let Some(distance) = found.scattered {
                    path.ray = before;
                    path.cone[0] += path.cone[1] * distance;
                    let place = before.origin + before.direction * distance;
                    let (lamps, far) = ((group_of, segment), segment < self.depth);
                    if far
                        && self.scatter_in_air(
                            scene,
                            pass,
                            medium,
                            lamps,
                            &mut path,
                            place,
                            &mut sequence,
                            radiance,
                            probe,
                        )
                    {
                        continue;
                    }
                    break;
                }
            }
            let Some((hit, point, distance)) = met else {
                if !path.by_way {
                    self.add_surroundings(scene, pass, group_of, &path, radiance);
                }
                primary.emits |= segment == 1 && !scene.surroundings.is_empty();
                break;
            };
            path.cone[0] += path.cone[1] * distance;
            let object = &scene.objects[hit.object as usize];
            let before = if P::VERTICES { sum(radiance) } else { Lanes::default() };
            let arriving = path.light.throughput;
            let emits = |l: &usize| scene.lamps[*l].emits(point.geometric_normal, path.ray.direction);
            if let Some(lamp) = object.lamp.filter(emits).filter(|_| !path.by_way) {
                let weight = self.weight_of_hit(scene, &path, lamp, &hit, &point)
                    * scene.lamps[lamp].relative_radiance(point.geometric_normal, path.ray.direction);
                radiance[path.light.bundle + group_of[lamp]] +=
                    path.light.throughput * pass.emission[lamp] * weight;
                primary.emits |= segment == 1;
            }
            if segment == 1 {
                primary.surface = Some((distance, hit.object, point.normal));
            }
            let goes_on = segment < self.depth
                && !(pass.field.is_some()
                    && self.gather(scene, pass, &path, (&hit, &point, distance), &mut sequence, radiance))
                && self.scatter(
                    scene,
                    pass,
                    group_of,
                    &mut path,
                    &hit,
                    &point,
                    segment,
                    &mut sequence,
                    radiance,
                    probe,
                );
            if P::VERTICES {
                probe.vertex(Vertex {
                    object: hit.object,
                    primitive: hit.primitive,
                    position: point.position,
                    throughput: arriving.0.to_vec(),
                    added: (sum(radiance) - before).0.to_vec(),
                });
            }
            if !goes_on {
                break;
            }
        }
        primary
    }

    /// Takes what has been solved for where a path that looks around from a surface meets a diffuse one (final gather): whether it did.
    #[inline(never)]
    fn gather<const N: usize, M: IlluminationModel<N> + Prepare>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        path: &State<N>,
        (hit, point, distance): (&Hit, &SurfacePoint, f32),
        sequence: &mut Sequence,
        radiance: &mut [Lanes<N>],
    ) -> bool {
        let Some(field) = &pass.field else { return false };
        let material = scene.objects[hit.object as usize].material;
        if !is_diffuse(&scene.materials[material].surface) {
            return false;
        }
        // Nearer than the solution is detailed the path itself knows better.
        let gathers = path.looks_around && distance >= field.detail(hit, point.position);
        let by_others = field.has_caustics() && (path.from_diffuse || !path.looks_around);
        if !gathers && !by_others {
            return false;
        }
        let (returned, _) =
            radiosity::seen(scene, pass, field, (&path.ray, hit, point), path.cone[0], sequence);
        let mut add = |group: usize, sent: Lanes<N>| {
            radiance[path.light.bundle + group] += path.light.throughput * sent;
        };
        if gathers {
            return field.radiance(returned, hit, point, path.ray.direction, &mut add);
        }
        field.caustic(returned, hit, point, path.ray.direction, &mut add);
        false
    }

    /// Asks a lamp, then draws the next direction; whether the path goes on.
    #[inline(always)]
    fn scatter<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        path: &mut State<N>,
        hit: &Hit,
        point: &SurfacePoint,
        segment: u32,
        sequence: &mut Sequence,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
    ) -> bool {
        let hero_lane = path.light.hero.and_then(|sample| pass.lane(sample));
        let [width, _] = path.cone;
        let met = Interaction::new(
            scene,
            pass,
            &path.ray,
            hit,
            point,
            path.light.media,
            width,
            hero_lane,
            sequence,
        );
        let model = met.model();
        let [u_lobe, u_survival, u_choice, u_hero] = sequence.next4();
        let [u, v, next_lamp @ ..] = sequence.next4();
        if model.is_continuous() {
            self.ask_lamp(scene, pass, group_of, path, point, &met, u_choice, sequence, radiance, probe);
        }
        let Some(drawn) = path.light.turn(pass, &met, point, path.ray.direction, [u, v, u_lobe], u_hero)
        else {
            return false;
        };
        let direction = drawn.direction;
        if segment >= ROULETTE_FROM && !path.light.survives(u_survival) {
            return false;
        }
        path.u_lamp = next_lamp;
        let gathers = self.gathered.as_ref().is_some_and(|gathered| {
            drawn.pdf.is_none() && gathered[scene.objects[hit.object as usize].material]
        });
        path.scattered_first |= segment == 1 && !gathers;
        path.from_lamps = gathers && path.scattered_first;
        path.ray = Ray { origin: point.offset(direction), direction, time: path.ray.time };
        if let Some(field) = &pass.field {
            let surface = &scene.materials[scene.objects[hit.object as usize].material].surface;
            path.by_way |= path.from_diffuse;
            path.from_diffuse |= !path.looks_around && is_diffuse(surface) && field.has_caustics();
        }
        path.looks_around |= drawn.pdf.is_some();
        path.origin = drawn.pdf.map(|pdf| (point.position, met.normal, pdf));
        // A drawn direction stands for 1/pdf of solid angle.
        path.cone[1] += drawn.pdf.map_or(0.0, |pdf| OF_LOBE * pdf.max(1e-3).sqrt().recip());
        true
    }

    /// Next-event estimation: one lamp, one direction, one shadow ray.
    #[inline(always)]
    fn ask_lamp<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        path: &State<N>,
        point: &SurfacePoint,
        met: &Interaction<'_, N, M>,
        u_choice: f32,
        sequence: &mut Sequence,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
    ) {
        let geometry = &*scene.geometry;
        let (model, at) = (met.model(), &met.at);
        let Some((lamp, probability)) =
            scene.chooser.choose(&scene.lamps, point.position, met.normal, u_choice)
        else {
            return;
        };
        let time = path.ray.time;
        let Some(light) = scene.lamps[lamp].sample(geometry, point.position, time, path.u_lamp) else {
            return;
        };
        let local = met.frame.to_local(light.direction);
        let outward = light.direction.dot(point.geometric_normal);
        if outward * local.z <= 0.0 {
            return;
        }
        // Of what the surface itself sends on from a lamp to a diffuse surface all is known.
        let known = path.from_diffuse;
        let f = if known { model.components(at, local).diffuse } else { model.eval(at, local) };
        if f.is_zero() {
            return;
        }
        let mut weight = light.scale * local.z.abs() / probability;
        if let Some(pdf) = light.pdf {
            let pdf = pdf * probability;
            let other = if known { 0.0 } else { model.pdf(at, local) };
            weight = light.scale * local.z.abs() / pdf * power_heuristic(pdf, other);
        }
        let origin = point.offset(light.direction);
        let (span, tfar) = way_to(origin, light.direction, light.target);
        probe.occlusion(origin, span, tfar);
        if geometry.is_occluded(origin, span, time, tfar) {
            return;
        }
        let emission = pass.emission_to(scene, lamp, &light);
        let mut arriving = path.light.throughput * f * emission * weight;
        let medium = if local.z * at.to_viewer.z > 0.0 { path.light.media } else { met.beyond };
        if let Some(kept) = pass.transmittance(medium.innermost(), span.length().min(f32::MAX)) {
            arriving *= kept;
        }
        if let Some(air) = pass.medium.as_ref().filter(|_| medium.innermost().is_none()) {
            arriving *= air.left_of(origin, span, tfar, sequence);
        }
        radiance[path.light.bundle + group_of[lamp]] += arriving;
    }

    /// Asks a lamp where a medium scatters, then draws the next direction; whether the path goes on.
    #[inline(never)]
    fn scatter_in_air<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        medium: &MediumLanes<N>,
        (group_of, segment): (&[usize], u32),
        path: &mut State<N>,
        place: Vec3,
        sequence: &mut Sequence,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
    ) -> bool {
        let (along, time, phase) = (path.ray.direction, path.ray.time, medium.phase());
        let [u_choice, u_survival, u, v] = sequence.next4();
        let [x, y, ..] = sequence.next4();
        let asked = scene.chooser.choose(&scene.lamps, place, along, u_choice);
        let light = asked.and_then(|(lamp, probability)| {
            let light = scene.lamps[lamp].sample(&scene.geometry, place, time, path.u_lamp)?;
            Some((lamp, probability, light))
        });
        if let Some((lamp, probability, light)) = light {
            let p = phase.value(along.dot(light.direction));
            let weight = match light.pdf.map(|pdf| pdf * probability) {
                Some(pdf) => light.scale / pdf * power_heuristic(pdf, p),
                None => light.scale / probability,
            };
            let (span, tfar) = way_to(place, light.direction, light.target);
            probe.occlusion(place, span, tfar);
            if !scene.geometry.is_occluded(place, span, time, tfar) {
                let emission = pass.emission_to(scene, lamp, &light);
                let left = medium.left_of(place, span, tfar, sequence);
                radiance[path.light.bundle + group_of[lamp]] +=
                    path.light.throughput * emission * left * (weight * p);
            }
        }
        if segment >= ROULETTE_FROM && !path.light.survives(u_survival) {
            return false;
        }
        let direction = phase.sample(along, [u, v]);
        let pdf = phase.value(along.dot(direction));
        path.u_lamp = [x, y];
        path.ray = Ray { origin: place, direction, time };
        path.origin = Some((place, along, pdf));
        path.cone[1] += OF_LOBE * pdf.max(1e-3).sqrt().recip();
        true
    }

    /// How much a lamp counts that a drawn direction has met, beside being asked directly.
    #[inline(always)]
    fn weight_of_hit<const N: usize>(
        &self,
        scene: &Scene,
        path: &State<N>,
        lamp: usize,
        hit: &Hit,
        point: &SurfacePoint,
    ) -> f32 {
        let Some((from, normal, pdf)) = path.origin else {
            return f32::from(u8::from(!path.from_lamps));
        };
        let asked = scene.chooser.probability(&scene.lamps, from, normal, lamp)
            * scene.lamps[lamp].pdf_of_hit(&scene.geometry, from, path.ray.time, hit, point);
        power_heuristic(pdf, asked)
    }

    #[inline]
    fn add_surroundings<const N: usize, M: IlluminationModel<N> + Prepare>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        path: &State<N>,
        radiance: &mut [Lanes<N>],
    ) {
        if path.from_lamps {
            return;
        }
        for &lamp in &scene.surroundings {
            let light = pass.surroundings(scene, lamp, path.ray.direction);
            if light.is_zero() {
                continue;
            }
            let weight = match (path.origin, scene.lamps[lamp].pdf_of_direction(path.ray.direction)) {
                (Some((from, normal, pdf)), Some(asked)) => {
                    let chance = scene.chooser.probability(&scene.lamps, from, normal, lamp);
                    power_heuristic(pdf, asked * chance)
                }
                _ => 1.0,
            };
            radiance[path.light.bundle + group_of[lamp]] += path.light.throughput * light * weight;
        }
    }
}
