//! Ray tracing with cones (Amanatides 1984) in place of rays: what of a pixel, of a lamp and of what is mirrored surfaces cover.

use crate::direct_light::Arriving;
use crate::path::{Primary, Probe};
use crate::ray_tree::{Branch, RayTree, Traced};
use illuminant_illumination::{IlluminationModel, Incidence, Prepare};
use illuminant_scene::{Cone, ConeIndex, Hit, LampForm, Layer, Leaves, Ray, Scene, SurfacePoint};
use std::f32::consts::FRAC_1_PI;

/// A smaller part of a cone is not looked at.
pub(crate) const LEAST_COVER: f32 = 1e-4;

/// What nearer surfaces leave free of a cone.
///
/// Of two objects it is not known how their parts lie to each other, and the further one is taken to be covered as the whole cone is. The
/// far side of a body is hidden by its near side.
struct Free {
    left: f32,
    /// The near sides that have been met: object, and the part of the cone.
    near: Vec<(u32, f32)>,
}

impl Default for Free {
    fn default() -> Self {
        Self { left: 1.0, near: Vec::new() }
    }
}

impl Free {
    /// The part of the cone in which a surface is seen.
    fn take(&mut self, layer: &Layer) -> f32 {
        let hidden = match layer.from_outside {
            true => 0.0,
            false => {
                self.near.iter().filter(|(object, _)| *object == layer.object).map(|(_, cover)| cover).sum()
            }
        };
        // Of what the body itself does not hide.
        let cover = ((layer.cover - hidden) / (1.0 - hidden).max(1e-6)).clamp(0.0, 1.0);
        if layer.from_outside {
            self.near.push((layer.object, layer.cover));
        }
        let visible = self.left * cover;
        self.left -= visible;
        visible
    }

    /// A surface was none.
    fn give_back(&mut self, layer: &Layer, visible: f32) {
        self.left += visible;
        if layer.from_outside {
            self.near.pop();
        }
    }
}

impl RayTree {
    /// Follows one cone (Amanatides 1984): every surface in it adds what it shows, weighed by the part of the cone that it covers and that
    /// nearer ones leave free.
    #[inline(never)]
    pub(crate) fn follow_cone<const N: usize, M: IlluminationModel<N> + Prepare, P: Probe>(
        &self,
        cones: &ConeIndex,
        traced: &mut Traced<'_, N, M, P>,
        mut branch: Branch<N>,
        sample: u64,
        left: &mut Vec<Branch<N>>,
    ) -> Primary {
        let (scene, pass) = (traced.scene, traced.pass);
        let cone = Cone {
            origin: branch.ray.origin,
            direction: branch.ray.direction,
            radius: 0.5 * branch.cone[0],
            spread: 0.5 * branch.cone[1],
            length: f32::MAX,
        };
        traced.probe.closest(&branch.ray);
        let mut primary = None;
        let mut free = Free::default();
        for layer in cones.meet(&cone, branch.leaves) {
            let visible = free.take(&layer);
            if visible < LEAST_COVER {
                continue;
            }
            let material = scene.objects[layer.object as usize].material;
            let priority = scene.priorities[material];
            if branch.media.hides(material, priority) && pass.materials[material].bounds_media() {
                // Where another body hides it, a boundary is passed; its part of the cone goes on.
                free.give_back(&layer, visible);
                let media = branch.media;
                branch.media =
                    if layer.from_outside { media.entered(material, priority) } else { media.left(material) };
                continue;
            }
            let direction = (layer.point - branch.ray.origin).normalize_or(branch.ray.direction);
            let ray = Ray { direction, ..branch.ray };
            let hit = scene.geometry.hit_at(&ray, layer.object, layer.primitive, layer.point);
            let point = scene.geometry.surface(&ray, &hit);
            let mut part = branch;
            part.ray = ray;
            part.throughput *= visible;
            let around = branch.media.innermost();
            if let Some(kept) = pass.transmittance(around, layer.distance) {
                part.throughput *= kept;
            }
            part.brightness *= visible * pass.brightness_after(around, layer.distance);
            let seen = self.arrive(traced, part, (&hit, &point, layer.distance), sample, left);
            primary.get_or_insert(seen);
            if free.left < LEAST_COVER {
                break;
            }
        }
        if free.left >= LEAST_COVER {
            branch.throughput *= free.left;
            let seen = self.miss(traced, &branch);
            primary.get_or_insert(seen);
        }
        primary.unwrap_or_default()
    }

    /// By how much more a cone spreads that a sphere mirrors or bends, as its normal turns over the width of the cone.
    pub(crate) fn bent<const N: usize>(
        &self,
        scene: &Scene,
        branch: &Branch<N>,
        hit: &Hit,
        at: &Incidence<'_, N>,
        transmitted: bool,
    ) -> f32 {
        let sphere = scene.geometry.sphere(hit.object as usize).filter(|_| self.cones.is_some());
        let Some((_, radius)) = sphere else { return 0.0 };
        let turn = if transmitted { (1.0 - at.near.mean / at.far.mean).abs() } else { 2.0 };
        turn * branch.cone[0] / radius
    }

    /// The part of a lamp that a part of a surface sees: of the cone from one to the other what nothing stands in.
    pub(crate) fn free_of<const N: usize>(
        &self,
        cones: &ConeIndex,
        scene: &Scene,
        branch: &Branch<N>,
        object: u32,
        point: &SurfacePoint,
        light: &Arriving,
    ) -> f32 {
        let own = match &scene.lamps[light.lamp].form {
            LampForm::Surface(surface) => Some(surface.object as u32),
            _ => None,
        };
        // A lamp is asked at some places, and each stands for its part.
        let places = self.fixed.as_ref().map_or(1, Vec::len) as f32;
        let tangent = light.pdf.map_or(0.0, |pdf| (FRAC_1_PI / (pdf * places)).sqrt());
        let radius = 0.5 * branch.cone[0];
        let length = light.target.map_or(f32::MAX, |target| target.distance(point.position));
        let spread = if length < f32::MAX { tangent - radius / length } else { tangent };
        let cone = Cone { origin: point.position, direction: light.direction, radius, spread, length };
        let outwards = light.direction.dot(point.geometric_normal) > 0.0;
        let mut free = Free::default();
        for layer in cones.meet(&cone, Some(Leaves { object, outwards })) {
            if Some(layer.object) != own {
                free.take(&layer);
            }
        }
        free.left
    }
}
