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
use illuminant_scene::{Hit, LampForm, Scene, SurfacePoint};
use rayon::prelude::*;
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
    /// The same of light of lamps that came by way of mirrors and glass, where paths leave that out.
    caustics: Option<[Vec<Lanes<N>>; 2]>,
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
        // Of each side the light of all columns in the lanes of this pass, group by group, and from that of points, on either side.
        let at_points = |of: &(dyn Fn(usize) -> f32 + Sync)| -> [Vec<Lanes<N>>; 2] {
            let mut sums = vec![0f32; solution.elements.sides.len() * groups * N];
            sums.par_chunks_mut(groups * N).enumerate().for_each(|(side, sums)| {
                for column in 0..solution.columns {
                    for (lane, sample) in own.clone().enumerate() {
                        let at = side * width + column * samples + sample;
                        sums[group[column] * N + lane] += of(at) * light[column][sample];
                    }
                }
            });
            [false, true].map(|back| {
                let of = |element| {
                    let side = solution.elements.side(element, back)?;
                    Some(&sums[side as usize * groups * N..][..groups * N])
                };
                let flat = solution.points.values(groups * N, &of);
                flat.chunks(N).map(|v| Lanes::from_fn(|i| v[i])).collect()
            })
        };
        let less = |at: usize| match settings.radiosity.gather {
            // Lamps are asked again.
            Gather::Direct => solution.direct[at] - solution.caustics.get(at).copied().unwrap_or(0.0),
            _ => 0.0,
        };
        let values = at_points(&|at| solution.irradiance[at] - less(at));
        // What is all around can only be met by chance, so that a path cannot leave it out by halves.
        let known = settings.radiosity.gather == Gather::Full
            && !solution.caustics.is_empty()
            && !scene.lamps.iter().any(|lamp| matches!(lamp.form, LampForm::Uniform));
        let caustics = known.then(|| at_points(&|at| solution.caustics[at]));
        Self {
            elements: Arc::clone(&solution.elements),
            points: Arc::clone(&solution.points),
            groups,
            values,
            caustics,
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
        each: impl FnMut(usize, Lanes<N>),
    ) -> bool {
        self.sent(&self.values, [reflectance, transmittance], hit, point, direction, each)
    }

    /// Whether paths leave out light of lamps that comes to diffuse surfaces by way of mirrors and glass.
    pub fn has_caustics(&self) -> bool {
        self.caustics.is_some()
    }

    /// The part of that radiance which lamps make by way of mirrors and glass.
    pub fn caustic(
        &self,
        returned: [Lanes<N>; 2],
        hit: &Hit,
        point: &SurfacePoint,
        direction: Vec3,
        each: impl FnMut(usize, Lanes<N>),
    ) {
        if let Some(values) = &self.caustics {
            self.sent(values, returned, hit, point, direction, each);
        }
    }

    #[inline]
    fn sent(
        &self,
        values: &[Vec<Lanes<N>>; 2],
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
                sum += values[usize::from(back)][point as usize * self.groups + group] * weight;
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
