//! Light as it leaves lamps towards chosen bodies: where paths that begin at lamps begin.

use crate::geometry::Geometry;
use crate::lamp::{Lamp, LampForm};
use crate::surface::Ray;
use crate::surface_lamp::cone;
use glam::Vec3;
use illuminant_optics::frame::Frame;
use illuminant_optics::hemisphere::{disc, sphere};
use std::f32::consts::{PI, TAU};

/// More bodies than so many are aimed at as one.
const APART: usize = 32;

/// Bodies at which light is aimed: a sphere around each, over its motion.
///
/// Directions from a point are drawn uniformly in the cones that spheres fill, a cone by its solid angle; parallel light uniformly over
/// the discs that they cover. What two of them share is counted in both densities, so that overlap changes no mean.
#[derive(Clone, Debug)]
pub struct Targets {
    spheres: Vec<(Vec3, f32)>,
    /// Further from a body than so far nothing lies.
    reach: f32,
}

/// A ray that leaves a lamp.
#[derive(Clone, Copy, Debug)]
pub struct Emitted {
    /// From the lamp.
    pub ray: Ray,
    /// What the lamp's spectrum is multiplied by to give the flux that the ray stands for, W/nm: 1 over densities, area, cosine, falloff.
    pub scale: f32,
    /// Whether the lamp's radiance depends on the direction.
    pub varies: bool,
}

/// The sphere around an object, over its motion.
fn around(geometry: &Geometry, object: usize) -> (Vec3, f32) {
    if let Some(found) = geometry.sphere(object) {
        return found;
    }
    let moments = if geometry.is_static(object) { 1 } else { 33 };
    let meshes: Vec<_> =
        (0..moments).map(|moment| geometry.world_mesh(object, moment as f32 / 32.0)).collect();
    let points = || meshes.iter().flat_map(|mesh| mesh.positions.iter().copied());
    let low = points().fold(Vec3::MAX, Vec3::min);
    let high = points().fold(Vec3::MIN, Vec3::max);
    let center = (low + high) * 0.5;
    // Corners of boxes between two moments lie a little further out than those at them.
    let margin = if moments > 1 { 1.01 } else { 1.000_01 };
    (center, points().map(|p| p.distance(center)).fold(0.0, f32::max) * margin)
}

/// The solid angle of a sphere from a point, sr; all of it from inside.
fn solid_angle(from: Vec3, (center, radius): (Vec3, f32)) -> f32 {
    let distance2 = from.distance_squared(center);
    if distance2 <= radius * radius { 4.0 * PI } else { TAU * cone(radius, distance2) }
}

impl Targets {
    /// The targets that objects are; `None` of no object.
    #[must_use]
    pub fn new(geometry: &Geometry, objects: impl IntoIterator<Item = usize>) -> Option<Self> {
        let mut spheres: Vec<(Vec3, f32)> = objects.into_iter().map(|o| around(geometry, o)).collect();
        spheres.retain(|(_, radius)| *radius > 0.0);
        if spheres.len() > APART {
            let low = spheres.iter().map(|(c, r)| *c - *r).fold(Vec3::MAX, Vec3::min);
            let high = spheres.iter().map(|(c, r)| *c + *r).fold(Vec3::MIN, Vec3::max);
            let center = (low + high) * 0.5;
            let radius = spheres.iter().map(|(c, r)| c.distance(center) + r).fold(0.0, f32::max);
            spheres = vec![(center, radius)];
        }
        let (low, high) = geometry.bounds();
        (!spheres.is_empty()).then(|| Self { spheres, reach: 1.01 * low.distance(high) })
    }

    /// The flux per unit of illuminance, m², that each target catches, with its middle.
    pub fn sections(&self) -> impl Iterator<Item = (Vec3, f32)> + '_ {
        self.spheres.iter().map(|(center, radius)| (*center, PI * radius * radius))
    }

    /// A direction from a point towards a target, and its density, 1/sr.
    #[must_use]
    pub fn towards(&self, from: Vec3, choice: f32, u: [f32; 2]) -> (Vec3, f32) {
        let total: f32 = self.spheres.iter().map(|s| solid_angle(from, *s)).sum();
        let mut left = choice * total;
        let chosen = self.spheres.iter().position(|s| {
            left -= solid_angle(from, *s);
            left < 0.0
        });
        let (center, radius) = self.spheres[chosen.unwrap_or(self.spheres.len() - 1)];
        let angle = solid_angle(from, (center, radius));
        let direction = if angle >= 4.0 * PI {
            Vec3::from(sphere(u))
        } else {
            let down = u[0] * angle / TAU;
            let sin = (down * (2.0 - down)).max(0.0).sqrt();
            let (sin_phi, cos_phi) = (TAU * u[1]).sin_cos();
            let axis = Frame::from_normal((center - from).normalize_or(Vec3::Z));
            axis.to_world(Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - down))
        };
        let covers = |(center, radius): &(Vec3, f32)| {
            let d = *center - from;
            let (distance2, along) = (d.length_squared(), d.dot(direction));
            distance2 <= radius * radius
                || (along > 0.0 && d.cross(direction).length_squared() <= radius * radius)
        };
        // The direction was drawn in one cone at least, whatever rounding says of its edge.
        let count = self.spheres.iter().filter(|s| covers(s)).count().max(1);
        (direction, count as f32 / total)
    }

    /// A place in front of the scene from which parallel light goes to a target, and its density, 1/m².
    #[must_use]
    pub fn across(&self, direction: Vec3, choice: f32, u: [f32; 2]) -> (Vec3, f32) {
        let total: f32 = self.spheres.iter().map(|(_, r)| PI * r * r).sum();
        let mut left = choice * total;
        let chosen = self.spheres.iter().position(|(_, r)| {
            left -= PI * r * r;
            left < 0.0
        });
        let (center, radius) = self.spheres[chosen.unwrap_or(self.spheres.len() - 1)];
        let [x, y] = disc(u);
        let place = center + Frame::from_normal(direction).to_world(Vec3::new(x, y, 0.0)) * radius;
        let covers = |(center, radius): &(Vec3, f32)| {
            (*center - place).cross(direction).length_squared() <= radius * radius
        };
        let count = self.spheres.iter().filter(|s| covers(s)).count().max(1);
        (place - direction * self.reach, count as f32 / total)
    }
}

impl Lamp {
    /// A ray from the lamp to a target, from a place on it (two numbers in [0, 1)), a choice and a direction; `None` when no light goes
    /// there.
    #[must_use]
    pub fn emit(
        &self,
        geometry: &Geometry,
        targets: &Targets,
        time: f32,
        place: [f32; 2],
        (choice, u): (f32, [f32; 2]),
    ) -> Option<Emitted> {
        let leaves = |origin: Vec3, direction: Vec3, scale: f32, varies: bool| {
            let ray = Ray { origin, direction, time };
            (scale > 0.0 && scale.is_finite()).then_some(Emitted { ray, scale, varies })
        };
        let from_afar = |to_light: Vec3, scale: f32, varies: bool| {
            let (origin, pdf) = targets.across(-to_light, choice, u);
            leaves(origin, -to_light, scale / pdf, varies)
        };
        match &self.form {
            LampForm::Surface(surface) => {
                let (origin, normal) = surface.point(geometry, time, place)?;
                let (direction, pdf) = targets.towards(origin, choice, u);
                let cos = normal.dot(direction);
                if !(surface.two_sided || cos > 0.0) {
                    return None;
                }
                let scale = surface.area as f32 * cos.abs() * surface.relative_radiance(cos) / pdf;
                // Off the lamp's own surface, which may be that of facets below a sphere.
                let off = 1e-5 * (origin.abs().max_element() + (surface.area as f32).sqrt());
                leaves(origin + normal * off.copysign(cos), direction, scale, false)
            }
            LampForm::Point { position }
            | LampForm::Luminaire { position, .. }
            | LampForm::Photometric { position, .. }
            | LampForm::Spot { position, .. } => {
                let (direction, pdf) = targets.towards(*position, choice, u);
                leaves(*position, direction, self.falloff(direction) / pdf, false)
            }
            LampForm::Parallel { direction } => from_afar(-*direction, 1.0, false),
            LampForm::Uniform => from_afar(Vec3::from(sphere(place)), 4.0 * PI, false),
            LampForm::Image(image) => {
                let (uv, pdf) = image.sample(place)?;
                from_afar(image.direction(uv), pdf.recip(), true)
            }
            LampForm::Sky(sky) => {
                let (direction, pdf) = sky.sample(place)?;
                from_afar(direction, pdf.recip(), true)
            }
            LampForm::Sun(sun) => {
                let (direction, pdf) = sun.sample(place);
                from_afar(direction, pdf.recip(), true)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn targets() -> Targets {
        let spheres = vec![
            (Vec3::new(0.0, 0.0, 2.0), 0.5),
            (Vec3::new(0.4, 0.0, 3.0), 0.8),
            (Vec3::new(-2.0, 1.0, 1.0), 0.3),
        ];
        Targets { spheres, reach: 10.0 }
    }

    /// Draws of a grid: choice, and two numbers.
    fn draws() -> impl Iterator<Item = (f32, [f32; 2])> {
        (0..1u32 << 15).map(|i| {
            let a = (i as f32 + 0.5) / (1u32 << 15) as f32;
            let b = (i as f32 * 0.754_877_7) % 1.0;
            let c = (i as f32 * 0.569_840_3) % 1.0;
            (a, [b, c])
        })
    }

    #[test]
    fn densities_are_one_over_the_measure_of_the_union() {
        let targets = targets();
        // Of the cones: by a fine grid of directions.
        let inside = |d: Vec3| {
            targets.spheres.iter().any(|(c, r)| c.dot(d) > 0.0 && c.cross(d).length_squared() <= r * r)
        };
        let n = 1u32 << 20;
        let hits = (0..n)
            .filter(|i| {
                let z = 1.0 - 2.0 * (*i as f32 + 0.5) / n as f32;
                let phi = *i as f32 * 2.399_963_2;
                let s = (1.0 - z * z).sqrt();
                inside(Vec3::new(s * phi.cos(), s * phi.sin(), z))
            })
            .count();
        let union = 4.0 * PI * hits as f32 / n as f32;
        let mean: f32 = draws()
            .map(|(choice, u)| {
                let (direction, pdf) = targets.towards(Vec3::ZERO, choice, u);
                assert!(inside(direction) || pdf > 0.0);
                pdf.recip()
            })
            .sum::<f32>()
            / (1u32 << 15) as f32;
        assert!((mean / union - 1.0).abs() < 5e-3, "{mean} {union}");
        // Of the discs across a direction along which two of them overlap.
        let mean: f32 = draws().map(|(choice, u)| targets.across(Vec3::Z, choice, u).1.recip()).sum::<f32>()
            / (1u32 << 15) as f32;
        // The disc of 0.5 lies within that of 0.8 but for a lens: circles at a distance of 0.4.
        let lens = {
            let (r, s, d) = (0.5f32, 0.8f32, 0.4f32);
            let a = r * r * ((d * d + r * r - s * s) / (2.0 * d * r)).acos();
            let b = s * s * ((d * d + s * s - r * r) / (2.0 * d * s)).acos();
            a + b - 0.5 * ((-d + r + s) * (d + r - s) * (d - r + s) * (d + r + s)).sqrt()
        };
        let union = PI * (0.25 + 0.64 + 0.09) - lens;
        assert!((mean / union - 1.0).abs() < 5e-3, "{mean} {union}");
    }

    #[test]
    fn from_inside_a_target_all_directions_are_one() {
        let targets = Targets { spheres: vec![(Vec3::ZERO, 2.0)], reach: 1.0 };
        let (_, pdf) = targets.towards(Vec3::X, 0.3, [0.2, 0.9]);
        assert!((pdf * 4.0 * PI - 1.0).abs() < 1e-6);
    }
}
