//! The solution in the lanes of a pass: irradiance anywhere on a surface.

use super::reflectance::{Counted, of_materials};
use super::settings::Gather;
use super::solution::RadiositySolution;
use crate::lanes::Pass;
use crate::settings::Settings;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_radiosity::{Elements, Points};
use illuminant_sampling::Lanes;
use illuminant_scene::{Hit, Scene, SurfacePoint};
use std::f32::consts::FRAC_1_PI;
use std::sync::Arc;

/// Irradiance at the corners of elements, for each group of lamps.
#[derive(Clone, Debug)]
pub(crate) struct Field<const N: usize> {
    elements: Arc<Elements>,
    points: Arc<Points>,
    groups: usize,
    /// Of each side of surfaces the values at points: a bundle for each group.
    values: [Vec<Lanes<N>>; 2],
    /// Of each material what it returns of even light, and lets through.
    pub reflectance: Vec<[Lanes<N>; 2]>,
    /// Whether what surfaces themselves reflect counts as diffuse.
    pub counted: Counted,
}

impl<const N: usize> Field<N> {
    /// The irradiance of all points under the lamps of a scene; of light from other surfaces alone where lamps are asked at every pixel.
    pub fn new<M: IlluminationModel<N> + Prepare>(
        solution: &RadiositySolution,
        scene: &Scene,
        pass: &Pass<N, M>,
        group_of: &[usize],
        settings: &Settings,
    ) -> Self {
        let groups = group_of.iter().max().map_or(1, |last| last + 1);
        let (samples, width) = (solution.samples, solution.samples * solution.columns);
        let light = solution.light(scene);
        let mut group = vec![0; solution.columns];
        for (lamp, &column) in solution.column_of.iter().enumerate() {
            group[column] = group_of[lamp];
        }
        let own = pass.own_samples();
        let without_lamps = settings.radiosity.gather == Gather::Direct;
        let values = [false, true].map(|back| {
            // Of each side the light of all columns in the lanes of this pass, group by group.
            let sums: Vec<f32> = (0..solution.elements.sides.len())
                .flat_map(|side| {
                    let all = &solution.irradiance[side * width..][..width];
                    let direct = &solution.direct[side * width..][..width];
                    let mut sums = vec![0f32; groups * N];
                    for column in 0..solution.columns {
                        for (lane, sample) in own.clone().enumerate() {
                            let at = column * samples + sample;
                            let less = if without_lamps { direct[at] } else { 0.0 };
                            sums[group[column] * N + lane] += (all[at] - less) * light[column][sample];
                        }
                    }
                    sums
                })
                .collect();
            let of = |element| {
                let side = solution.elements.side(element, back)?;
                Some(&sums[side as usize * groups * N..][..groups * N])
            };
            let flat = solution.points.values(groups * N, &of);
            flat.chunks(N).map(|v| Lanes::from_fn(|i| v[i])).collect()
        });
        Self {
            elements: Arc::clone(&solution.elements),
            points: Arc::clone(&solution.points),
            groups,
            values,
            reflectance: of_materials(scene, pass, solution.counted),
            counted: solution.counted,
        }
    }

    /// The elements.
    pub fn elements(&self) -> &Elements {
        &self.elements
    }

    /// The radiance that a surface sends back along a ray that has met it, handed to `each` for each group, of its reflectance and
    /// transmittance; false where there is no solution.
    #[inline]
    pub fn radiance(
        &self,
        [reflectance, transmittance]: [Lanes<N>; 2],
        hit: &Hit,
        point: &SurfacePoint,
        direction: Vec3,
        mut each: impl FnMut(usize, Lanes<N>),
    ) -> bool {
        let Some((element, weights)) = self.elements.locate(hit, point.position) else { return false };
        let back = point.geometric_normal.dot(direction) > 0.0;
        if self.elements.side(element, back).is_none() {
            return false;
        }
        let points = self.points.of_element[element as usize];
        let through = !transmittance.is_zero();
        let at = |back: bool, group: usize| {
            let mut sum = Lanes::default();
            for (point, weight) in points.into_iter().zip(weights) {
                sum += self.values[usize::from(back)][point as usize * self.groups + group] * weight;
            }
            sum
        };
        for group in 0..self.groups {
            let mut sent = reflectance * at(back, group);
            if through {
                sent += transmittance * at(!back, group);
            }
            each(group, sent * FRAC_1_PI);
        }
        true
    }

    /// About how far from a hit the solution's own detail reaches: an edge of the element there.
    #[inline]
    pub fn detail(&self, hit: &Hit, position: Vec3) -> f32 {
        self.elements
            .locate(hit, position)
            .map_or(0.0, |(element, _)| (2.0 * self.elements.all[element as usize].area).sqrt() as f32)
    }
}
