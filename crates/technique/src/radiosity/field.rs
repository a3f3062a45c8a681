//! The solution in the lanes of a pass: irradiance anywhere on a surface.

use super::reflectance::of_materials;
use super::settings::Gather;
use super::solution::RadiositySolution;
use crate::lanes::Pass;
use crate::settings::Settings;
use glam::Vec3;
use illuminant_illumination::{IlluminationModel, Prepare};
use illuminant_radiosity::{Elements, Points};
use illuminant_sampling::Lanes;
use illuminant_scene::{Hit, Scene};
use std::sync::Arc;

/// Irradiance at the corners of elements, for each group of lamps.
#[derive(Clone, Debug)]
pub(crate) struct Field<const N: usize> {
    elements: Arc<Elements>,
    points: Arc<Points>,
    groups: usize,
    /// Of each side of surfaces the values at points: a bundle for each group.
    values: [Vec<Lanes<N>>; 2],
    /// Of each material what it returns of even light.
    pub reflectance: Vec<Lanes<N>>,
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
            reflectance: of_materials(scene, pass),
        }
    }

    /// The elements.
    pub fn elements(&self) -> &Elements {
        &self.elements
    }

    /// The irradiance at a hit of a ray along `direction`, handed to `each` for each group; false where there is no solution.
    #[inline]
    pub fn irradiance(
        &self,
        hit: &Hit,
        position: Vec3,
        (normal, direction): (Vec3, Vec3),
        mut each: impl FnMut(usize, Lanes<N>),
    ) -> bool {
        let Some((element, weights)) = self.elements.locate(hit, position) else { return false };
        let back = normal.dot(direction) > 0.0;
        if self.elements.side(element, back).is_none() {
            return false;
        }
        let points = self.points.of_element[element as usize];
        let values = &self.values[usize::from(back)];
        for group in 0..self.groups {
            let mut sum = Lanes::default();
            for (point, weight) in points.into_iter().zip(weights) {
                sum += values[point as usize * self.groups + group] * weight;
            }
            each(group, sum);
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
