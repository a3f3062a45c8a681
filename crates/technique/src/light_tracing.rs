//! Light tracing (Arvo 1986; Dutré, Lafortune and Willems 1993; Veach 1997, 10.2): paths that begin at lamps, for caustics.
//!
//! A path from the camera meets a lamp behind smooth glass or in a mirror by chance alone, and never one without size. So
//! the light that discrete lobes send on surfaces that scatter it is followed from the lamps: towards what mirrors or bends it, and from
//! there on; every surface that scatters it is joined to the camera. Paths from the camera leave out just those paths of light: whose
//! vertex next to the lamp is a discrete lobe, and whose vertex next to the camera is none. What discrete lobes show *of* caustics (one
//! that is seen in a mirror) is not joined to the camera, and stays with paths from there.
//!
//! Light goes both ways alike but for two factors (Veach 1997, 5.2, 5.3): radiance is squeezed by n² where it enters a medium and flux is not,
//! and a shading normal weighs the two directions otherwise than the surface does.

use crate::carried::{Carried, ROULETTE_FROM};
use crate::filter::FilterSampler;
use crate::interaction::{Interaction, next_surface};
use crate::lanes::Pass;
use crate::path::{OF_PIXEL, Probe};
use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Index, Prepare, Surface};
use illuminant_sampling::Lanes;
use illuminant_scene::{Hit, LampForm, Ray, Scene, SurfacePoint, Targets};
use illuminant_spectrum::Observer;
use std::f32::consts::{FRAC_1_SQRT_2, PI};

/// The part of paths that is shared out among lamps evenly, for those from which more comes than is expected.
const EVENLY: f64 = 0.1;

/// How paths from lamps are followed.
#[derive(Clone, Debug)]
pub(crate) struct LightTracer {
    /// The longest path from a lamp to the camera in segments.
    depth: u32,
    targets: Targets,
    /// Of each material whether its discrete lobes are followed.
    pub gathers: Vec<bool>,
    /// Running sums of the chances of lamps, from 0 to 1.
    chances: Vec<f64>,
}

/// Light on the film.
pub(crate) struct Splat<const N: usize> {
    pub pixel: [u32; 2],
    /// The bundle that it is of.
    pub bundle: usize,
    /// What it adds to the pixel, for one path from the lamps.
    pub radiance: Lanes<N>,
    /// How far away it is seen.
    pub distance: f32,
}

/// Of each material whether paths from lamps follow what it mirrors or lets through without scattering it. What parts the wavelengths at
/// facets is left out: which of its directions are discrete depends on what the path met before.
pub(crate) fn gathering<const N: usize, M: IlluminationModel<N>>(
    scene: &Scene,
    materials: &[M],
) -> Vec<bool> {
    let lanes = Lanes::splat(1.0);
    let index = Index { mean: 1.0, least: 1.0, lanes: &lanes };
    let at = Incidence {
        to_viewer: Vec3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2),
        near: index,
        far: index,
        hero_lane: None,
    };
    let parts = |surface: &Surface| matches!(surface, Surface::Dielectric { dispersion: true, finish, .. } if !finish.is_smooth());
    materials
        .iter()
        .zip(&scene.materials)
        .map(|(model, material)| !parts(&material.surface) && !model.discrete_lobes(&at).is_empty())
        .collect()
}

impl LightTracer {
    /// For a scene whose materials gather light as [`gathering`] says; `None` where nothing does.
    pub fn new(scene: &Scene, gathers: Vec<bool>, depth: u32) -> Option<Self> {
        let objects = (0..scene.objects.len()).filter(|&o| gathers[scene.objects[o].material]);
        let targets = Targets::new(&scene.geometry, objects)?;
        let observer = Observer::cie_1931_2deg();
        let weights: Vec<f64> = scene
            .lamps
            .iter()
            .map(|lamp| {
                let luminous = observer.luminance(&lamp.spectrum, scene.range);
                let caught = targets.sections().map(|(middle, section)| match lamp.form {
                    LampForm::Uniform => 4.0 * f64::from(PI * section) * luminous,
                    _ => f64::from(lamp.expected_illuminance(luminous as f32, middle) * section),
                });
                caught.sum()
            })
            .collect();
        let (sum, count) = (weights.iter().sum::<f64>(), weights.len() as f64);
        let mut running = 0.0;
        let chances = weights.iter().map(|w| {
            running +=
                EVENLY / count + if sum > 0.0 { (1.0 - EVENLY) * w / sum } else { (1.0 - EVENLY) / count };
            running
        });
        Some(Self { depth, targets, chances: chances.collect(), gathers })
    }

    /// A lamp and the probability with which it is chosen.
    fn lamp(&self, u: f32) -> (usize, f64) {
        let i = self.chances.partition_point(|&c| c <= f64::from(u)).min(self.chances.len() - 1);
        (i, self.chances[i] - if i == 0 { 0.0 } else { self.chances[i - 1] })
    }

    /// Follows one path from a lamp; `splat` is told of all light that it brings to the film.
    pub fn trace<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        filter: &FilterSampler,
        mut sequence: Sequence,
        probe: &mut P,
        splat: &mut impl FnMut(usize, Splat<N>),
    ) {
        let [u_lamp, u_time, place @ ..] = sequence.next4();
        let [u_choice, u_way @ .., _] = sequence.next4();
        let [open, close] = scene.camera.shutter;
        let time = open + (close - open) * u_time;
        let (lamp, chance) = self.lamp(u_lamp);
        let Some(emitted) =
            scene.lamps[lamp].emit(&scene.geometry, &self.targets, time, place, (u_choice, u_way))
        else {
            return;
        };
        let spectrum = if emitted.varies {
            pass.surroundings(scene, lamp, -emitted.ray.direction)
        } else {
            pass.emission[lamp]
        };
        let mut light = Carried::new(spectrum * (emitted.scale / chance as f32));
        let mut ray = emitted.ray;
        let mut gathered = false;
        // The last segment is the one to the camera.
        for segment in 1..self.depth {
            let Carried { media, throughput, .. } = &mut light;
            let Some((hit, point, _)) = next_surface(scene, pass, &mut ray, media, throughput, probe) else {
                return;
            };
            let material = scene.objects[hit.object as usize].material;
            let hero_lane = light.hero.and_then(|sample| pass.lane(sample));
            let met =
                Interaction::new(scene, pass, &ray, &hit, &point, light.media, 0.0, hero_lane, &mut sequence);
            let [u_lobe, u_survival, u_hero, u_pixel] = sequence.next4();
            let [u, v, u_lens @ ..] = sequence.next4();
            if gathered && met.model().is_continuous() {
                let beyond = met.beyond;
                let to_film = ToFilm { filter, u_lens, u_pixel };
                // Numbers of its own: what lies outside a crop must change nothing further on.
                let mut own = sequence.branch(u64::from(segment));
                let met = (&hit, &point);
                let found = to_film.join(scene, pass, &light, &ray, met, beyond, &mut own, probe);
                if let Some(found) = found {
                    splat(lamp, found);
                }
            }
            let Some(turn) = light.turn(pass, &met, &point, ray.direction, [u, v, u_lobe], u_hero) else {
                return;
            };
            gathered |= turn.pdf.is_none() && self.gathers[material];
            if !gathered {
                // The lamp's light on a surface that scatters it: the camera's paths ask for that.
                return;
            }
            if turn.transmitted && met.model().bounds_media() {
                let n = *met.at.far.lanes / *met.at.near.lanes;
                light.throughput *= n * n;
            }
            let (normal, geometric) = (met.normal, point.geometric_normal);
            let (to, from) = (turn.direction, ray.direction);
            let skew = (to.dot(geometric) * from.dot(normal)) / (from.dot(geometric) * to.dot(normal));
            if !skew.is_finite() {
                return;
            }
            light.throughput *= skew.abs();
            if segment >= ROULETTE_FROM && !light.survives(u_survival) {
                return;
            }
            ray = Ray { origin: point.offset(to), direction: to, time };
        }
    }
}

/// How a surface is joined to the film.
struct ToFilm<'a> {
    filter: &'a FilterSampler,
    u_lens: [f32; 2],
    u_pixel: f32,
}

impl ToFilm<'_> {
    /// What the camera sees of light that has reached a surface; `None` where it sees none. `beyond` are the media on the other side.
    #[inline(never)]
    fn join<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        light: &Carried<N>,
        arriving: &Ray,
        (hit, point): (&Hit, &SurfacePoint),
        beyond: crate::media::Media,
        sequence: &mut Sequence,
        probe: &mut P,
    ) -> Option<Splat<N>> {
        let seen = scene.camera.see(point.position, arriving.time, self.u_lens)?;
        let ([x, weight_x], [y, weight_y]) = {
            let u = self.u_pixel * 65_536.0;
            let (first, second) = (u.floor() / 65_536.0, u.fract());
            (self.filter.pixel(seen.pixel[0], first), self.filter.pixel(seen.pixel[1], second))
        };
        let [x0, y0, x1, y1] = scene.camera.crop.map(|v| v as f32);
        if !(x >= x0 && x < x1 && y >= y0 && y < y1) {
            return None;
        }
        let span = point.position - seen.origin;
        let distance = span.length();
        let from_eye = Ray { origin: seen.origin, direction: span / distance, time: arriving.time };
        let (in_cos, out_cos) =
            (arriving.direction.dot(point.geometric_normal), span.dot(point.geometric_normal) / distance);
        let media = if in_cos * out_cos > 0.0 { light.media } else { beyond };
        let hero_lane = light.hero.and_then(|sample| pass.lane(sample));
        let width = OF_PIXEL * scene.camera.pixel_angle() * distance;
        let met = Interaction::new(scene, pass, &from_eye, hit, point, media, width, hero_lane, sequence);
        let local = met.frame.to_local(-arriving.direction);
        // As where a lamp is asked: both normals must say on which side light arrives.
        if -in_cos * local.z <= 0.0 {
            return None;
        }
        let f = met.model().eval(&met.at, local);
        if f.is_zero() {
            return None;
        }
        let origin = point.offset(-from_eye.direction);
        probe.occlusion(origin, seen.origin - origin, 1.0);
        if scene.geometry.is_occluded(origin, seen.origin - origin, arriving.time, 1.0) {
            return None;
        }
        let area = seen.pixels * out_cos.abs() / (distance * distance);
        let mut radiance = light.throughput * f * (local.z / in_cos).abs() * (area * weight_x * weight_y);
        if let Some(kept) = pass.transmittance(media.innermost(), distance) {
            radiance *= kept;
        }
        Some(Splat { pixel: [x as u32, y as u32], bundle: light.bundle, radiance, distance })
    }
}
