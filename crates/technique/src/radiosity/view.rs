//! The solution as the camera sees it.

use super::direct;
use super::field::Field;
use super::reflectance::{diffuse_at, is_clear};
use super::settings::Gather;
use crate::interaction::Interaction;
use crate::lanes::Pass;
use crate::media::Media;
use crate::path::{OF_PIXEL, Primary, Probe, Vertex, sum};
use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_radiosity::Place;
use illuminant_sampling::Lanes;
use illuminant_scene::{Hit, Ray, Scene, SurfacePoint};
use std::f32::consts::FRAC_1_PI;

/// What a surface returns of even light where a ray meets it, and its normal for shading on that side.
#[inline(never)]
pub(crate) fn seen<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    pass: &Pass<N, M>,
    field: &Field<N>,
    (ray, hit, point): (&Ray, &Hit, &SurfacePoint),
    width: f32,
    sequence: &mut Sequence,
) -> ([Lanes<N>; 2], Vec3) {
    let material = scene.objects[hit.object as usize].material;
    let towards = |normal: Vec3| if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
    if scene.skins[material].is_bare() {
        return (field.reflectance[material], towards(point.normal));
    }
    let media = Media::default();
    let met = Interaction::new(scene, pass, ray, hit, point, media, width, None, sequence);
    let surface = &scene.materials[material].surface;
    (diffuse_at(met.model(), &met.at, surface, field.counted), towards(met.normal))
}

/// How the camera sees a solution between diffuse surfaces: the first surface that is not transparent.
#[derive(Clone, Debug)]
pub(crate) struct View {
    /// Whether lamps are asked at every pixel.
    direct: bool,
}

impl View {
    pub fn new(gather: Gather) -> Self {
        Self { direct: gather == Gather::Direct }
    }

    /// Follows a ray to what it sees.
    pub fn trace<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        mut ray: Ray,
        mut sequence: Sequence,
        radiance: &mut [Lanes<N>],
        probe: &mut P,
    ) -> Primary {
        let mut distance = 0.0;
        let (hit, point) = loop {
            probe.closest(&ray);
            let Some(hit) = scene.geometry.closest_hit(&ray) else {
                for &lamp in &scene.surroundings {
                    radiance[group_of[lamp]] += pass.surroundings(scene, lamp, ray.direction);
                }
                return Primary { surface: None, emits: !scene.surroundings.is_empty() };
            };
            let point = scene.geometry.surface(&ray, &hit);
            distance += hit.distance;
            if !is_clear(&scene.materials[scene.objects[hit.object as usize].material].surface) {
                break (hit, point);
            }
            ray.origin = point.offset(ray.direction);
        };
        let before = if P::VERTICES { sum(radiance) } else { Lanes::default() };
        let object = &scene.objects[hit.object as usize];
        let lamp = object.lamp.filter(|&l| scene.lamps[l].emits(point.geometric_normal, ray.direction));
        if let Some(lamp) = lamp {
            let relative = scene.lamps[lamp].relative_radiance(point.geometric_normal, ray.direction);
            radiance[group_of[lamp]] += pass.emission[lamp] * relative;
        }
        let width = distance * OF_PIXEL * scene.camera.pixel_angle();
        if let Some(sent) = &pass.directional {
            let each = |group, light| radiance[group] += light;
            sent.radiance(&hit, &point, ray.direction, pass.own_samples(), each);
        }
        if let Some(field) = &pass.field {
            let (reflectance, normal) = seen(scene, pass, field, (&ray, &hit, &point), width, &mut sequence);
            field.radiance(reflectance, &hit, &point, ray.direction, |group, sent| radiance[group] += sent);
            if self.direct {
                let place = Place { point, normal };
                for lamp in 0..scene.lamps.len() {
                    let [u, v, ..] = sequence.next4();
                    let from = |place: &Place| {
                        direct::irradiance(scene, field.elements(), pass, lamp, place, [u, v]) * FRAC_1_PI
                    };
                    radiance[group_of[lamp]] += reflectance[0] * from(&place);
                    if !reflectance[1].is_zero() {
                        let behind = Place { normal: -normal, ..place };
                        radiance[group_of[lamp]] += reflectance[1] * from(&behind);
                    }
                }
            }
        }
        if P::VERTICES {
            probe.vertex(Vertex {
                object: hit.object,
                primitive: hit.primitive,
                position: point.position,
                throughput: vec![1.0; N],
                added: (sum(radiance) - before).0.to_vec(),
            });
        }
        Primary { surface: Some((distance, hit.object, point.normal)), emits: lamp.is_some() }
    }
}
