//! Light straight from lamps, and what stands for the light that is not followed.

use crate::lanes::Pass;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_sampling::Lanes;
use illuminant_scene::{LampForm, Scene};
use std::f32::consts::FRAC_1_PI;

/// Where an emitting surface is asked unless something else is wanted: the centres of four equal parts.
pub(crate) const ON_LAMP: [[f32; 2]; 4] = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]];

/// Light that arrives from a direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arriving {
    pub lamp: usize,
    /// Which of the places on the lamp.
    pub place: usize,
    pub direction: Vec3,
    /// Irradiance at normal incidence relative to the lamp's spectrum.
    pub scale: f32,
    pub target: Option<Vec3>,
    /// Density with which the direction was drawn, 1/sr, where a ray could meet the lamp too.
    pub pdf: Option<f32>,
}

/// Where a ray to a light must be free, from a point: its span, and the part of it that counts.
#[inline(always)]
pub(crate) fn way_to(origin: Vec3, direction: Vec3, target: Option<Vec3>) -> (Vec3, f32) {
    match target {
        Some(target) => (target - origin, 1.0),
        None => (direction, f32::INFINITY),
    }
}

/// Of places on an emitting surface those at which a lamp is asked: one is enough for what has no size, none for what is all around.
pub(crate) fn places_on<'a>(form: &LampForm, on_surface: &'a [[f32; 2]]) -> &'a [[f32; 2]] {
    match form {
        form if form.is_background() => &[],
        LampForm::Surface(_) | LampForm::Sun(_) => on_surface,
        _ => &on_surface[..1],
    }
}

/// Light that arrives at a point from one lamp, asked at these places.
pub(crate) fn arriving_from(
    scene: &Scene,
    lamp: usize,
    point: Vec3,
    time: f32,
    on_surface: &[[f32; 2]],
    each: &mut impl FnMut(Arriving),
) {
    let places = places_on(&scene.lamps[lamp].form, on_surface);
    for (place, &u) in places.iter().enumerate() {
        let Some(light) = scene.lamps[lamp].sample(&scene.geometry, point, time, u) else { continue };
        let scale = light.scale / light.pdf.unwrap_or(1.0) / places.len() as f32;
        let (direction, target, pdf) = (light.direction, light.target, light.pdf);
        each(Arriving { lamp, place, direction, scale, target, pdf });
    }
}

/// Light that arrives at a point from all lamps.
pub(crate) fn arriving(scene: &Scene, point: Vec3, time: f32, each: &mut impl FnMut(Arriving)) {
    for lamp in 0..scene.lamps.len() {
        arriving_from(scene, lamp, point, time, &ON_LAMP, each);
    }
}

/// The middle of a scene.
pub(crate) fn middle(scene: &Scene) -> Vec3 {
    let (low, high) = scene.geometry.bounds();
    (low + high) * 0.5
}

/// The radiance that stands for all light that is not followed: that of the surroundings, and a fraction of what lamps would make of a
/// white diffuser that faces them in the middle of the scene.
pub(crate) fn ambient<const N: usize, M>(
    scene: &Scene,
    pass: &Pass<N, M>,
    group_of: &[usize],
    fraction: f32,
) -> Vec<Lanes<N>> {
    let mut all = vec![Lanes::default(); group_of.iter().max().map_or(0, |last| last + 1)];
    arriving(scene, middle(scene), scene.camera.shutter[0], &mut |light| {
        all[group_of[light.lamp]] += pass.emission[light.lamp] * (light.scale * FRAC_1_PI * fraction);
    });
    for &lamp in &scene.surroundings {
        all[group_of[lamp]] += match &scene.lamps[lamp].form {
            LampForm::Image(image) => {
                pass.emission[lamp] * (image.integral() / (4.0 * std::f64::consts::PI)) as f32
            }
            // Half of all directions.
            LampForm::Sky(_) => pass.emission[lamp] * 0.5,
            // It is asked, as lamps with a place are.
            LampForm::Sun(_) => Lanes::default(),
            _ => pass.emission[lamp],
        };
    }
    all
}

/// Adds `weight` times the radiance of a cone in which nothing is followed: that of the surroundings (reflection mapping, Blinn and
/// Newell 1976; book figure 4.2), else what stands for all light.
pub(crate) fn add_around<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    pass: &Pass<N, M>,
    (group_of, ambient): (&[usize], &[Lanes<N>]),
    direction: Vec3,
    radius: f32,
    weight: &Lanes<N>,
    to: &mut [Lanes<N>],
) {
    if !scene.surroundings.iter().any(|&lamp| scene.lamps[lamp].form.is_background()) {
        to.iter_mut().zip(ambient).for_each(|(sum, light)| *sum += *weight * *light);
    }
    for &lamp in scene.surroundings.iter().filter(|&&lamp| scene.lamps[lamp].form.is_background()) {
        to[group_of[lamp]] += *weight * pass.surroundings_in_cone(scene, lamp, direction, radius);
    }
}
