//! What a ray meets, ready for the illumination model.

use crate::lanes::Pass;
use crate::media::Media;
use crate::path::Probe;
use crate::sequence::Sequence;
use crate::skins::perturbed;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Incidence, Prepare};
use illuminant_optics::frame::Frame;
use illuminant_sampling::Lanes;
use illuminant_scene::{Hit, Ray, Scene, SurfacePoint, TexturePoint};

/// The next surface along a ray, with the distance to it. What the media on the way absorb is taken off the throughput, and boundaries
/// that another body hides are passed. `None` where nothing is met.
#[inline(always)]
pub(crate) fn next_surface<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
    scene: &Scene,
    pass: &Pass<N, M>,
    ray: &mut Ray,
    media: &mut Media,
    throughput: &mut Lanes<N>,
    probe: &mut P,
) -> Option<(Hit, SurfacePoint, f32)> {
    let mut distance = 0.0;
    loop {
        probe.closest(ray);
        let hit = scene.geometry.closest_hit(ray)?;
        if let Some(kept) = pass.transmittance(media.innermost(), hit.distance) {
            *throughput *= kept;
        }
        let point = scene.geometry.surface(ray, &hit);
        distance += hit.distance;
        let material = scene.objects[hit.object as usize].material;
        let priority = scene.priorities[material];
        if !(media.hides(material, priority) && pass.materials[material].bounds_media()) {
            return Some((hit, point, distance));
        }
        let enters = ray.direction.dot(point.geometric_normal) < 0.0;
        *media = if enters { media.entered(material, priority) } else { media.left(material) };
        ray.origin = point.offset(ray.direction);
    }
}

/// The surface at a hit as a model sees it.
pub(crate) struct Interaction<'a, const N: usize, M> {
    /// The normal for shading.
    pub normal: Vec3,
    pub frame: Frame,
    pub at: Incidence<'a, N>,
    /// The media beyond the surface.
    pub beyond: Media,
    /// Whether the viewer is on the side to which the normal points.
    pub outside: bool,
    /// What images make of the material, if they say anything.
    own: Option<M>,
    base: &'a M,
}

impl<'a, const N: usize, M: IlluminationModel<N> + Prepare> Interaction<'a, N, M> {
    /// The surface at a hit; `width` is that of the cone of light there, `hero_lane` the one lane that is still carried.
    #[inline(always)]
    pub fn new(
        scene: &'a Scene,
        pass: &'a Pass<N, M>,
        ray: &Ray,
        hit: &Hit,
        point: &SurfacePoint,
        around: Media,
        width: f32,
        hero_lane: Option<usize>,
        sequence: &mut Sequence,
    ) -> Self {
        let material = scene.objects[hit.object as usize].material;
        let to_viewer = -ray.direction;
        // A shading normal that faces away where the surface faces the viewer is no normal to shade with.
        let facing = point.normal.dot(to_viewer) * point.geometric_normal.dot(to_viewer) > 0.0;
        let mut normal = if facing { point.normal } else { point.geometric_normal };
        let mut own = None;
        if !scene.skins[material].is_bare() {
            let along = scene.geometry.along(ray, hit);
            let solid = scene.geometry.at_rest(hit.object as usize, ray.time, point.position);
            let geometric = point.geometric_normal;
            let seen = TexturePoint::new(point.uv, along, solid, width, ray.direction, geometric);
            normal = perturbed(scene, material, &seen, normal, to_viewer);
            own = pass.textured(scene, material, &seen, sequence);
        }
        let base = &pass.materials[material];
        let frame = match scene.materials[material].grain {
            Some(grain) => Frame::along(normal, Vec3::from(grain)),
            None => Frame::from_normal(normal),
        };
        let local = frame.to_local(to_viewer);
        let outside = local.z > 0.0;
        // An opaque surface, or a thin sheet, has the same media on both sides.
        let beyond = if !base.bounds_media() {
            around
        } else if outside {
            around.entered(material, scene.priorities[material])
        } else {
            around.left(material)
        };
        let (near, far) = if outside || !base.bounds_media() {
            (around.innermost(), Some(material))
        } else {
            (Some(material), beyond.innermost())
        };
        let at = Incidence { to_viewer: local, near: pass.index(near), far: pass.index(far), hero_lane };
        Self { normal, frame, at, beyond, outside, own, base }
    }

    /// The model, with what images say of the material.
    #[inline(always)]
    pub fn model(&self) -> &M {
        self.own.as_ref().unwrap_or(self.base)
    }
}
