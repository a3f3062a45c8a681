//! Recursive ray tracing (Whitted 1980; Hall and Greenberg 1983; book 4.3.1), and distributed ray tracing (Cook, Porter and Carpenter
//! 1984; book 4.3.2).
//!
//! Every surface asks all lamps, with shadow rays, and follows the rays that its model asks for: towards the mirror direction, and
//! through the surface. What lies beyond the last ray, and diffuse light from anything but lamps, is ambient light. A ray is not
//! followed where all that it could bring is weighed with less than a threshold (adaptive depth control; book figure 4.16).
//!
//! `raytrace` has no chance in it: lamps with an area are asked at fixed places. `distributed` follows the same tree, and spreads
//! over the samples of a pixel, one ray a query, what is asked for: where on a lamp, about which facet a rough surface mirrors, when
//! while the shutter is open, and through which point of the lens.

use crate::cone_tracing::LEAST_COVER;
use crate::direct_light::{Arriving, ON_LAMP, add_around, arriving_from, way_to};
use crate::frustum::frustum_about;
use crate::interaction::{Interaction, next_surface};
use crate::lanes::Pass;
use crate::media::Media;
use crate::path::{OF_LOBE, OF_PIXEL, Primary, Probe, Vertex, power_heuristic, sum};
use crate::radiosity::{Counted, Gather, Mechanisms, diffuse_at};
use crate::sequence::Sequence;
use crate::settings::{LightCentres, Settings, Technique};
use glam::Vec3;
use illuminant_illumination::{Blurred, IlluminationModel, Prepare};
use illuminant_sampling::Lanes;
use illuminant_scene::{ConeIndex, Hit, LampForm, Leaves, Ray, Scene, SurfacePoint};
use std::f32::consts::FRAC_2_SQRT_PI;

/// The longest chain of rays where no depth is stated: only perfect mirrors that face each other would go on.
const DEEPEST: u32 = 100;

/// What is followed beside a solution.
#[derive(Clone, Copy, Debug)]
struct Solved {
    /// Which ways of light.
    ways: Mechanisms,
    /// Rays along an edge of the frustum in which gloss is sampled; by chance where there is none.
    frustum: Option<u32>,
    /// Whether lamps are asked for diffuse light too.
    lamps: bool,
}

/// How trees of rays are followed.
#[derive(Clone, Debug)]
pub(crate) struct RayTree {
    /// The longest chain in segments.
    depth: u32,
    /// What a ray weighs at least.
    threshold: f32,
    /// Whether queries are spread over the samples of a pixel.
    distributed: bool,
    /// Where lamps with an area are asked, if that is fixed.
    pub(crate) fixed: Option<Vec<[f32; 2]>>,
    /// Whether places on lamps are drawn without regard to each other.
    random: bool,
    /// What cones meet, where rays are cones.
    pub(crate) cones: Option<ConeIndex>,
    /// What is followed where the light of diffuse surfaces has been solved for.
    solved: Option<Solved>,
}

/// The middles of so many equal parts of a square.
fn grid(count: u32) -> Vec<[f32; 2]> {
    if count == 4 {
        return ON_LAMP.to_vec();
    }
    let rows = (1..=count).rev().find(|rows| count % rows == 0 && rows * rows <= count).unwrap_or(1);
    let columns = count / rows;
    let middle = |i: u32, n: u32| (i as f32 + 0.5) / n as f32;
    (0..count).map(|i| [middle(i % columns, columns), middle(i / columns, rows)]).collect()
}

/// A ray to be followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Branch<const N: usize> {
    pub(crate) ray: Ray,
    /// What its radiance is multiplied by, in every lane.
    pub(crate) throughput: Lanes<N>,
    /// The same as one number, which decides whether it is followed.
    pub(crate) brightness: f32,
    pub(crate) media: Media,
    /// How many rays lead to its end.
    pub(crate) segment: u32,
    /// The cone of light that it stands for: its width at the origin, and how it grows with distance.
    pub(crate) cone: [f32; 2],
    /// Lamps that are met.
    pub(crate) lamps: Met,
    /// Its own numbers, so that what becomes of one branch changes nothing in another.
    pub(crate) sequence: Sequence,
    /// The surface that it leaves.
    pub(crate) leaves: Option<Leaves>,
}

/// What becomes of lamps that a ray meets.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Met {
    /// They are seen.
    Seen,
    /// They were asked already.
    Asked,
    /// They were asked too: the place and the density, 1/sr, of the ray weigh the two.
    Both(Vec3, f32),
}

/// A scene in one pass, with what its tree is followed for.
pub(crate) struct Traced<'a, const N: usize, M, P> {
    pub(crate) scene: &'a Scene,
    pub(crate) pass: &'a Pass<N, M>,
    pub(crate) group_of: &'a [usize],
    pub(crate) radiance: &'a mut [Lanes<N>],
    pub(crate) probe: &'a mut P,
}

impl RayTree {
    /// What settings ask for; `None` for a technique that follows no trees.
    pub fn new(scene: &Scene, settings: &Settings, technique: Technique) -> Option<Self> {
        let distributed = match technique {
            Technique::Raytrace => false,
            Technique::Distributed | Technique::Hybrid => true,
            _ => return None,
        };
        let told = &settings.radiosity;
        let solved = (technique == Technique::Hybrid).then(|| Solved {
            ways: told.mechanisms,
            frustum: told.frustum,
            lamps: told.gather == Gather::Direct,
        });
        let fixed = match settings.light_centres {
            LightCentres::Fixed(count) => Some(grid(count)),
            // A cone sees all of a lamp from its middle.
            _ if settings.cones => Some(grid(1)),
            // Without chance there is nothing to jitter.
            _ if !distributed => Some(ON_LAMP.to_vec()),
            _ => None,
        };
        Some(Self {
            depth: settings.depth.unwrap_or(DEEPEST),
            threshold: settings.threshold as f32,
            distributed,
            fixed,
            random: settings.light_centres == LightCentres::Random,
            solved,
            cones: settings.cones.then(|| ConeIndex::new(&scene.geometry, scene.camera.shutter[0])),
        })
    }

    /// Whether rays are cones.
    pub fn has_cones(&self) -> bool {
        self.cones.is_some()
    }

    /// Whether anything is drawn.
    pub fn is_distributed(&self) -> bool {
        self.distributed
    }

    /// Follows the tree of a ray and adds the radiance that it brings to `radiance`, one bundle for each group of lamps. `sample` is
    /// the number of the sample in its pixel.
    #[inline(never)]
    pub fn trace<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        ray: Ray,
        sample: u64,
        sequence: Sequence,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
    ) -> Primary {
        // A cone stands for a pixel: the circle of its area.
        let across = if self.cones.is_some() { FRAC_2_SQRT_PI } else { OF_PIXEL };
        let mut traced = Traced { scene, pass, group_of, radiance, probe };
        let mut primary = None;
        let mut left = vec![Branch {
            ray,
            throughput: Lanes::splat(1.0),
            brightness: 1.0,
            media: Media::default(),
            segment: 1,
            cone: [0.0, across * scene.camera.pixel_angle()],
            lamps: Met::Seen,
            sequence,
            leaves: None,
        }];
        while let Some(branch) = left.pop() {
            let seen = match &self.cones {
                Some(cones) => self.follow_cone(cones, &mut traced, branch, sample, &mut left),
                None => self.follow(&mut traced, branch, sample, &mut left),
            };
            primary.get_or_insert(seen);
        }
        primary.unwrap_or_default()
    }

    /// Follows one ray; what it asks for is left to be followed.
    fn follow<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        traced: &mut Traced<'_, N, M, P>,
        mut branch: Branch<N>,
        sample: u64,
        left: &mut Vec<Branch<N>>,
    ) -> Primary {
        let around = branch.media.innermost();
        let Branch { ray, media, throughput, .. } = &mut branch;
        let met = next_surface(traced.scene, traced.pass, ray, media, throughput, traced.probe);
        let Some((hit, point, distance)) = met else { return self.miss(traced, &branch) };
        branch.brightness *= traced.pass.brightness_after(around, distance);
        self.arrive(traced, branch, (&hit, &point, distance), sample, left)
    }

    /// Adds the surroundings where nothing else is met.
    pub(crate) fn miss<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        traced: &mut Traced<'_, N, M, P>,
        branch: &Branch<N>,
    ) -> Primary {
        let (scene, pass) = (traced.scene, traced.pass);
        let shows = branch.segment == 1 || self.solved.is_none_or(|s| s.ways.diffuse_to_specular);
        for &lamp in scene.surroundings.iter().filter(|_| shows) {
            let data = &scene.lamps[lamp];
            let weight = match branch.lamps {
                // What is all around is not asked.
                _ if data.form.is_background() => 1.0,
                Met::Seen => 1.0,
                Met::Asked => 0.0,
                Met::Both(_, pdf) => {
                    power_heuristic(pdf, data.pdf_of_direction(branch.ray.direction).unwrap_or(0.0))
                }
            };
            let light = pass.surroundings(scene, lamp, branch.ray.direction);
            traced.radiance[traced.group_of[lamp]] += branch.throughput * light * weight;
        }
        Primary { surface: None, emits: !scene.surroundings.is_empty() }
    }

    /// Adds what a surface sends along a branch that has met it at a distance, and leaves the rays that it asks for.
    pub(crate) fn arrive<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        traced: &mut Traced<'_, N, M, P>,
        mut branch: Branch<N>,
        (hit, point, distance): (&Hit, &SurfacePoint, f32),
        sample: u64,
        left: &mut Vec<Branch<N>>,
    ) -> Primary {
        let (scene, pass) = (traced.scene, traced.pass);
        branch.cone[0] += branch.cone[1] * distance;
        let before = if P::VERTICES { sum(traced.radiance) } else { Lanes::default() };
        let object = &scene.objects[hit.object as usize];
        let lamp =
            object.lamp.filter(|&l| scene.lamps[l].emits(point.geometric_normal, branch.ray.direction));
        let shows = branch.segment == 1 || self.solved.is_none_or(|s| s.ways.diffuse_to_specular);
        if let Some(lamp) = lamp.filter(|_| shows) {
            let weight = match branch.lamps {
                Met::Seen => 1.0,
                Met::Asked => 0.0,
                Met::Both(from, pdf) => power_heuristic(
                    pdf,
                    scene.lamps[lamp].pdf_of_hit(&scene.geometry, from, branch.ray.time, hit, point),
                ),
            } * scene.lamps[lamp]
                .relative_radiance(point.geometric_normal, branch.ray.direction);
            traced.radiance[traced.group_of[lamp]] += branch.throughput * pass.emission[lamp] * weight;
        }
        if branch.segment < self.depth {
            self.shade(traced, &branch, hit, point, sample, left);
        }
        if P::VERTICES {
            traced.probe.vertex(Vertex {
                object: hit.object,
                primitive: hit.primitive,
                position: point.position,
                throughput: branch.throughput.0.to_vec(),
                added: (sum(traced.radiance) - before).0.to_vec(),
            });
        }
        Primary { surface: Some((distance, hit.object, point.normal)), emits: lamp.is_some() }
    }

    /// Adds the light of lamps and ambient light at a surface, and leaves the rays that it asks for.
    fn shade<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        traced: &mut Traced<'_, N, M, P>,
        branch: &Branch<N>,
        hit: &Hit,
        point: &SurfacePoint,
        sample: u64,
        left: &mut Vec<Branch<N>>,
    ) {
        let mut own_numbers = branch.sequence;
        let sequence = &mut own_numbers;
        let (scene, pass) = (traced.scene, traced.pass);
        let met = Interaction::new(
            scene,
            pass,
            &branch.ray,
            hit,
            point,
            branch.media,
            branch.cone[0],
            None,
            sequence,
        );
        // Compiled once, not at every call.
        let model: &dyn IlluminationModel<N> = met.model();
        let glossy = self.distributed && model.follows_gloss();
        let first = branch.segment == 1;
        let shows = first || self.solved.is_none_or(|s| s.ways.diffuse_to_specular);
        let goes_on = first || self.solved.is_none_or(|s| s.ways.specular_to_specular);
        if let Some(field) = pass.field.as_ref().filter(|_| shows) {
            let surface = &scene.materials[scene.objects[hit.object as usize].material].surface;
            let returned = diffuse_at(met.model(), &met.at, surface, Counted::Diffuse);
            field.radiance(returned, hit, point, branch.ray.direction, |group, sent| {
                traced.radiance[group] += branch.throughput * sent;
            });
        } else if pass.field.is_none() && (met.outside || !model.bounds_media()) {
            let returned = model.ambient(&met.at);
            for (sum, light) in traced.radiance.iter_mut().zip(&pass.ambient) {
                *sum += branch.throughput * returned.diffuse * *light;
            }
            if !glossy && !returned.specular.is_zero() {
                let v = met.at.to_viewer;
                let mirrored = met.frame.to_world(Vec3::new(-v.x, -v.y, v.z));
                let weight = branch.throughput * returned.specular;
                let light = (traced.group_of, &pass.ambient[..]);
                add_around(scene, pass, light, mirrored, model.gloss(), &weight, traced.radiance);
            }
        }
        // What is diffuse has been solved for, so that only gloss asks.
        let asks = self.solved.is_none_or(|s| s.lamps || model.follows_gloss());
        if model.is_continuous() && shows && asks {
            for lamp in 0..scene.lamps.len() {
                self.ask(traced, branch, (hit.object, point), &met, lamp, glossy, sample, sequence);
            }
        }
        if !goes_on {
            return;
        }
        let to_viewer = -branch.ray.direction;
        let mut go = |direction: Vec3,
                      weight: (Lanes<N>, f32),
                      transmitted: bool,
                      spread: f32,
                      lamps: Met,
                      probe: &mut P| {
            let outward = direction.dot(point.geometric_normal);
            // Light must leave on the side on which the model says it does.
            if (outward * to_viewer.dot(point.geometric_normal) > 0.0) == transmitted {
                return;
            }
            let (throughput, brightness) = (branch.throughput * weight.0, branch.brightness * weight.1);
            if throughput.is_zero() {
                return;
            }
            // By one number for all lanes, so that every spectral sampling follows the same rays.
            if brightness <= self.threshold {
                probe.pruned();
                return;
            }
            let number = match lamps {
                Met::Both(..) => 2,
                _ => u64::from(transmitted),
            };
            let media = if transmitted && model.bounds_media() { met.beyond } else { branch.media };
            left.push(Branch {
                ray: Ray { origin: point.offset(direction), direction, time: branch.ray.time },
                throughput,
                brightness,
                media,
                segment: branch.segment + 1,
                cone: [branch.cone[0], branch.cone[1] + spread],
                lamps,
                sequence: branch.sequence.branch(number),
                leaves: Some(Leaves { object: hit.object, outwards: outward > 0.0 }),
            });
        };
        for lobe in model.discrete_lobes(&met.at) {
            let mut direction = lobe.direction;
            let mut spread = self.bent(scene, branch, hit, &met.at, lobe.transmitted);
            let mut lamps = Met::Seen;
            if self.distributed {
                let [u, v, ..] = sequence.next4();
                match model.blurred(&met.at, &lobe, [u, v]) {
                    Blurred::Sharp => {}
                    Blurred::To(about) => {
                        (direction, spread, lamps) = (about, OF_LOBE * model.gloss(), Met::Asked);
                    }
                    Blurred::Lost => continue,
                }
            }
            let weight = (lobe.weight, lobe.brightness);
            go(met.frame.to_world(direction), weight, lobe.transmitted, spread, lamps, traced.probe);
        }
        let frustum = self.solved.and_then(|s| s.frustum).filter(|_| glossy);
        if let Some(edge) = frustum {
            let returned = model.ambient(&met.at).specular;
            let spread = OF_LOBE * model.gloss() / edge as f32;
            for (local, part) in frustum_about(met.at.to_viewer, model.gloss(), edge) {
                // No surface returns more than all, which is one number for all lanes.
                let weight = (returned * part, part);
                go(met.frame.to_world(local), weight, false, spread, Met::Seen, traced.probe);
            }
        } else if glossy {
            let [u, v, choice, _] = sequence.next4();
            if let Some(drawn) = model.gloss_ray(&met.at, [u, v, choice]) {
                let spread = drawn.pdf.map_or(0.0, |pdf| OF_LOBE * pdf.max(1e-3).sqrt().recip());
                let lamps = drawn.pdf.map_or(Met::Seen, |pdf| Met::Both(point.position, pdf));
                let direction = met.frame.to_world(drawn.direction);
                let weight = (drawn.weight, drawn.brightness);
                go(direction, weight, drawn.transmitted, spread, lamps, traced.probe);
            }
        }
    }

    /// Adds the light of a lamp at a surface.
    fn ask<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        traced: &mut Traced<'_, N, M, P>,
        branch: &Branch<N>,
        (object, point): (u32, &SurfacePoint),
        met: &Interaction<'_, N, M>,
        lamp: usize,
        glossy: bool,
        sample: u64,
        sequence: &mut Sequence,
    ) {
        let scene = traced.scene;
        let own;
        let places: &[[f32; 2]] = match &self.fixed {
            Some(fixed) if self.distributed => {
                let place = (sample % fixed.len() as u64) as usize;
                &fixed[place..=place]
            }
            Some(fixed) => fixed,
            None if matches!(scene.lamps[lamp].form, LampForm::Surface(_) | LampForm::Sun(_)) => {
                let [u, v, ..] = if self.random { sequence.independent4() } else { sequence.next4() };
                own = [[u, v]];
                &own
            }
            None => &ON_LAMP[..1],
        };
        let time = branch.ray.time;
        arriving_from(scene, lamp, point.position, time, places, &mut |light| {
            self.receive(traced, branch, (object, point), met, glossy, &light);
        });
    }

    /// Adds light that arrives, if nothing stands in its way.
    fn receive<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        traced: &mut Traced<'_, N, M, P>,
        branch: &Branch<N>,
        (object, point): (u32, &SurfacePoint),
        met: &Interaction<'_, N, M>,
        glossy: bool,
        light: &Arriving,
    ) {
        let (scene, pass) = (traced.scene, traced.pass);
        let local = met.frame.to_local(light.direction);
        if light.direction.dot(point.geometric_normal) * local.z <= 0.0 {
            return;
        }
        let model: &dyn IlluminationModel<N> = met.model();
        let found = model.components(&met.at, local);
        let specular = match light.pdf.filter(|_| glossy && branch.segment + 1 < self.depth) {
            Some(pdf) => found.specular * power_heuristic(pdf, model.pdf(&met.at, local)),
            None => found.specular,
        };
        let f = match self.solved {
            // In a frustum lamps that have a size are met.
            Some(Solved { frustum: Some(_), .. }) if light.pdf.is_some() => Lanes::default(),
            // What is diffuse has been solved for.
            Some(Solved { lamps: false, .. }) => specular,
            _ => found.diffuse + specular,
        };
        if f.is_zero() {
            return;
        }
        let origin = point.offset(light.direction);
        let (span, tfar) = way_to(origin, light.direction, light.target);
        traced.probe.occlusion(origin, span, tfar);
        let free = match &self.cones {
            Some(cones) => self.free_of(cones, scene, branch, object, point, light),
            None => f32::from(u8::from(!scene.geometry.is_occluded(origin, span, branch.ray.time, tfar))),
        };
        if free < LEAST_COVER {
            return;
        }
        let scale = free * light.scale * local.z.abs();
        let mut arriving = branch.throughput * f * pass.emission[light.lamp] * scale;
        let medium = if local.z * met.at.to_viewer.z > 0.0 { branch.media } else { met.beyond };
        if let Some(kept) = pass.transmittance(medium.innermost(), span.length().min(f32::MAX)) {
            arriving *= kept;
        }
        traced.radiance[traced.group_of[light.lamp]] += arriving;
    }
}

#[cfg(test)]
mod tests {
    use super::grid;

    #[test]
    fn places_are_the_middles_of_equal_parts() {
        assert_eq!(grid(1), [[0.5, 0.5]]);
        assert_eq!(grid(4), [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]);
        assert_eq!(grid(6).len(), 6);
        assert_eq!(grid(6)[5], [5.0 / 6.0, 0.75]);
        assert_eq!(grid(7)[6], [6.5 / 7.0, 0.5]);
    }
}
