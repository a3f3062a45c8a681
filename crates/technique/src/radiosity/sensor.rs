//! Irradiance where no surface need be: on grids of sensors and on working planes.

use super::direct;
use super::reflectance::Counted;
use super::solution::RadiositySolution;
use super::specular::{Followed, Scratch};
use crate::passes::{Light, passes_of};
use glam::Vec3;
use illuminant_illumination::{General, Illumination};
use illuminant_optics::frame::Frame;
use illuminant_optics::hemisphere;
use illuminant_radiosity::{Direction, Kronecker, Place};
use illuminant_sampling::xyz_by;
use illuminant_scene::{Scene, SurfacePoint};
use rayon::prelude::*;

impl RadiositySolution {
    /// XYZ of the irradiance at places, each with the unit normal that it faces; Y is illuminance, lx. Each lamp is asked at `samples`
    /// places, and as many rays look around for the light that surfaces send.
    #[must_use]
    pub fn illuminance(
        &self,
        scene: &Scene,
        places: &[[Vec3; 2]],
        (samples, threshold): (u32, f32),
    ) -> Vec<[f64; 3]> {
        let geometry = &*scene.geometry;
        let (low, high) = geometry.bounds();
        let error = 1e-6 * (high - low).max_element().max(low.abs().max(high.abs()).max_element());
        let lamps = scene.lamps.len();
        // Lamps give the same under every model.
        let passes =
            passes_of::<8, General<8>>(scene, Illumination::General, &*self.basis, None, &[0], Light::Lamps);
        let light = self.light(scene);
        let maps: Vec<_> = (0..lamps).map(|lamp| self.basis.to_xyz(lamp)).collect();
        let width = self.columns * self.samples;
        let lamp_of = self.lamps_of_columns();
        let radiosity = self.radiosity();
        let followed = (self.counted == Counted::Diffuse).then(|| Followed {
            scene,
            elements: &self.elements,
            passes: &passes,
            looking: None,
            threshold,
            column_of: &self.column_of,
            columns: self.columns,
            samples: self.samples,
            straight: true,
            specular: true,
        });
        let at = |(number, &[position, normal]): (usize, &[Vec3; 2])| {
            let point =
                SurfacePoint { position, error, geometric_normal: normal, normal, uv: glam::Vec2::ZERO };
            let place = Place { point, normal };
            let sequence = Kronecker::<4>::new(number as u64 ^ 0x7365_6e73);
            let mut xyz = [0.0; 3];
            let mut add = |lamp: usize, samples: &[f64]| {
                xyz.iter_mut().zip(xyz_by(&maps[lamp], samples)).for_each(|(sum, v)| *sum += v);
            };
            for (lamp, _) in maps.iter().enumerate() {
                let mut sum = vec![0f64; self.samples];
                for k in 0..samples {
                    let [u, v, ..] = sequence.point(u64::from(k));
                    for pass in &passes {
                        let found = direct::irradiance(scene, &self.elements, pass, lamp, &place, [u, v]);
                        for (sum, v) in sum[pass.samples.clone()].iter_mut().zip(&found.0) {
                            *sum += f64::from(*v) / f64::from(samples);
                        }
                    }
                }
                add(lamp, &sum);
            }
            let frame = Frame::from_normal(normal);
            let rays: Vec<Direction> = (0..samples)
                .map(|k| {
                    let [.., u, v] = sequence.point(u64::from(k));
                    let ray = place.ray(frame.to_world(Vec3::from(hemisphere::cosine([u, v]))));
                    Direction { ray, part: (samples as f32).recip() }
                })
                .collect();
            let mut sums = vec![0f64; width];
            let receive = |sums: &mut [f64], patch: u32, weight: &dyn Fn(usize) -> f32| {
                let sent = &radiosity[patch as usize * width..][..width];
                for (i, (sum, sent)) in sums.iter_mut().zip(sent).enumerate() {
                    *sum += f64::from(sent * weight(i % self.samples));
                }
            };
            match &followed {
                Some(followed) => {
                    let mut scratch = Scratch::new(self.elements.patches.len());
                    let seen = followed.look_along(&rays, number as u64, &mut scratch);
                    seen.straight.iter().for_each(|&(patch, part)| receive(&mut sums, patch, &|_| part));
                    for (&patch, values) in seen.columns.iter().zip(seen.values.chunks(self.samples)) {
                        receive(&mut sums, patch, &|sample| values[sample]);
                    }
                    for (column, light) in seen.lamps.chunks(self.samples).enumerate() {
                        let light: Vec<f64> = light.iter().map(|v| f64::from(*v)).collect();
                        add(lamp_of[column], &light);
                    }
                }
                None => {
                    for Direction { ray, part } in rays {
                        let met = self.elements.meet(geometry, ray);
                        if let Some(side) = met.and_then(|(ray, hit)| self.elements.side_at(&ray, &hit)) {
                            let sent = self.radiosity_of(side);
                            sums.iter_mut().zip(sent).for_each(|(sum, b)| *sum += f64::from(b * part));
                        }
                    }
                }
            }
            for column in 0..self.columns {
                let own = sums[column * self.samples..][..self.samples].iter().zip(&light[column]);
                add(lamp_of[column], &own.map(|(sum, light)| sum * f64::from(*light)).collect::<Vec<_>>());
            }
            xyz
        };
        places.par_iter().enumerate().map(at).collect()
    }

    /// A lamp of each column: those of one column share a map to XYZ.
    fn lamps_of_columns(&self) -> Vec<usize> {
        (0..self.columns).map(|c| self.column_of.iter().position(|&of| of == c).unwrap_or(0)).collect()
    }

    /// The radiosity of a side for each column of lamps in every sample.
    fn radiosity_of(&self, side: u32) -> Vec<f32> {
        let width = self.columns * self.samples;
        let sent = |side: u32, of: &[f32]| -> Vec<f32> {
            let of = &of[side as usize * self.samples..][..self.samples];
            let irradiance = &self.irradiance[side as usize * width..][..width];
            irradiance.iter().enumerate().map(|(i, e)| of[i % self.samples] * e).collect()
        };
        let mut sum = sent(side, &self.reflectance);
        if let Some(behind) = self.elements.opposite(side).filter(|_| !self.transmittance.is_empty()) {
            // A sheet lets through from both sides alike.
            sum.iter_mut().zip(sent(behind, &self.transmittance)).for_each(|(sum, v)| *sum += v);
        }
        sum
    }

    /// XYZ of the radiance that sides send, emission along the normal included: a row for each side.
    #[must_use]
    pub fn radiance_of_sides(&self, scene: &Scene) -> Vec<[f64; 3]> {
        let light = self.light(scene);
        let maps: Vec<_> = (0..scene.lamps.len()).map(|lamp| self.basis.to_xyz(lamp)).collect();
        let lamp_of = self.lamps_of_columns();
        (0..self.elements.sides.len())
            .into_par_iter()
            .map(|side| {
                let mut xyz = [0.0; 3];
                let mut add = |lamp: usize, samples: &[f64]| {
                    xyz.iter_mut().zip(xyz_by(&maps[lamp], samples)).for_each(|(sum, v)| *sum += v);
                };
                let sent = self.radiosity_of(side as u32);
                for (column, sent) in sent.chunks(self.samples).enumerate() {
                    let sent = sent.iter().zip(&light[column]);
                    let sent: Vec<f64> = sent.map(|(b, l)| f64::from(b * l) / std::f64::consts::PI).collect();
                    add(lamp_of[column], &sent);
                }
                let element = self.elements.element_of(side as u32);
                let normal = if self.elements.sides[side].back { -element.normal } else { element.normal };
                if let Some(lamp) = scene.objects[element.object as usize].lamp {
                    if scene.lamps[lamp].emits(element.normal, -normal) {
                        let spectrum = &scene.lamps[lamp].spectrum;
                        add(lamp, &self.basis.reduce(spectrum, illuminant_sampling::Role::Emission));
                    }
                }
                xyz
            })
            .collect()
    }
}
