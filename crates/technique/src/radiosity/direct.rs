//! Irradiance of sides straight from lamps.

use crate::direct_light::way_to;
use crate::lanes::Pass;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_optics::frame::Frame;
use illuminant_optics::hemisphere;
use illuminant_radiosity::{Cancel, Cancelled, Elements, Kronecker, Place};
use illuminant_sampling::Lanes;
use illuminant_scene::{LampForm, LampSample, Ray, Scene, SurfacePoint};
use rayon::prelude::*;
use std::f32::consts::PI;

/// Whether nothing stands between a point and a lamp that it has asked.
pub(super) fn is_lit(scene: &Scene, elements: &Elements, point: &SurfacePoint, light: &LampSample) -> bool {
    let origin = point.offset(light.direction);
    let (span, tfar) = way_to(origin, light.direction, light.target);
    elements.is_free(&scene.geometry, origin, span, tfar)
}

/// The irradiance of a lamp at a place, from two numbers in [0, 1).
pub(super) fn irradiance<const N: usize, M>(
    scene: &Scene,
    elements: &Elements,
    pass: &Pass<N, M>,
    lamp: usize,
    place: &Place,
    u: [f32; 2],
) -> Lanes<N> {
    let data = &scene.lamps[lamp];
    if matches!(data.form, LampForm::Uniform) {
        // Met by chance alone.
        let direction = Frame::from_normal(place.normal).to_world(Vec3::from(hemisphere::cosine(u)));
        let Ray { origin, .. } = place.ray(direction);
        let free = elements.is_free(&scene.geometry, origin, direction, f32::INFINITY);
        return if free { pass.emission[lamp] * PI } else { Lanes::default() };
    }
    let Some(light) = data.sample(&scene.geometry, place.point.position, 0.0, u) else {
        return Lanes::default();
    };
    let cos = light.direction.dot(place.normal);
    if !(cos > 0.0) {
        return Lanes::default();
    }
    if !is_lit(scene, elements, &place.point, &light) {
        return Lanes::default();
    }
    pass.emission_to(scene, lamp, &light) * (light.scale * cos / light.pdf.unwrap_or(1.0))
}

/// The mean irradiance of a lamp over a side, asked at `count` places.
pub(super) fn mean<const N: usize, M>(
    scene: &Scene,
    elements: &Elements,
    pass: &Pass<N, M>,
    lamp: usize,
    side: u32,
    count: u32,
) -> Lanes<N> {
    let sequence = Kronecker::<4>::new(u64::from(side) << 32 ^ lamp as u64 ^ 0x6c61_6d70);
    let mut sum = Lanes::default();
    for k in 0..count {
        let [a, b, u, v] = sequence.point(u64::from(k));
        let place = elements.place(&scene.geometry, side, [a, b]);
        sum += irradiance(scene, elements, pass, lamp, &place, [u, v]);
    }
    sum * (count as f32).recip()
}

/// The mean irradiance of every side straight from each column's lamps, in the samples of all passes.
pub(super) fn of_sides<const N: usize, M: IlluminationModel<N> + Prepare>(
    scene: &Scene,
    elements: &Elements,
    passes: &[Pass<N, M>],
    (column_of, columns): (&[usize], usize),
    samples: usize,
    count: u32,
    cancel: &Cancel,
) -> Result<Vec<f32>, Cancelled> {
    let width = columns * samples;
    let mut found = vec![0f32; elements.sides.len() * width];
    found.par_chunks_mut(width.max(1)).enumerate().try_for_each(|(side, row)| {
        cancel.check()?;
        for pass in passes {
            for (lamp, &column) in column_of.iter().enumerate() {
                let light = mean(scene, elements, pass, lamp, side as u32, count);
                let slots = &mut row[column * samples + pass.samples.start..];
                for (slot, v) in slots.iter_mut().zip(&light.0[..pass.samples.len()]) {
                    *slot += v;
                }
            }
        }
        Ok(())
    })?;
    Ok(found)
}
