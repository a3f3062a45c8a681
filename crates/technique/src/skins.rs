//! What images say of materials, in the lanes of a pass.
//!
//! A colour is a sum of three curves and is found in lanes by as many products. Roughness is different: a model has tables for each
//! slope. So a material is prepared at a ladder of slopes, and between two rungs it is a mixture of both, as a surface is of which
//! a part has one roughness and the rest the other: what holds for each rung, reciprocity and equilibrium, holds for the mixture.

use glam::Vec3;
use illuminant_illumination::{Finish, Illumination, IlluminationModel, Material, Prepare, Surface};
use illuminant_optics::fresnel::dielectric;
use illuminant_optics::saunderson::internal_reflectance;
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_scene::{ColourTexture, Scene, Skin, SlopeTexture, TexturePoint};
use illuminant_spectrum::SpectralRange;
use rayon::prelude::*;
use std::ops::Range;

/// The most rungs of a ladder of slopes; between two of nine a half-width differs by a few degrees at most.
const RUNGS: usize = 9;

/// A ladder of slopes.
#[derive(Clone, Debug)]
struct Ladder<M> {
    low: f64,
    step: f64,
    rungs: Vec<M>,
}

/// Where a mixture lies on a ladder: the lower rung, and the part of the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Mixture {
    pub lower: usize,
    pub part: f32,
}

/// A colour of three channels in lanes.
#[derive(Clone, Copy, Debug)]
struct ColourLanes<const N: usize> {
    /// One unit of each channel, in lanes and the largest over the range.
    basis: [Lanes<N>; 3],
    largest: [f32; 3],
    /// The largest of one unit of all channels together.
    together: f32,
    /// For finished paint: what the boundary reflects, and of diffuse light from inside.
    boundary: Option<[f32; 2]>,
}

impl<const N: usize> ColourLanes<N> {
    fn new(texture: &ColourTexture, basis: &dyn Basis, samples: Range<usize>, range: SpectralRange) -> Self {
        let lanes = |curve| Lanes::from_slice(&basis.reduce(curve, Role::Fraction)[samples.clone()]);
        Self {
            basis: texture.basis.each_ref().map(lanes),
            largest: texture.basis.each_ref().map(|curve| curve.extent(range).1 as f32),
            together: range
                .wavelengths()
                .map(|w| texture.basis.iter().map(|curve| curve.at(w)).sum::<f64>())
                .fold(0.0, f64::max) as f32,
            boundary: texture
                .finished
                .map(|n| [dielectric(1.0, n), internal_reflectance(n)].map(|v| v as f32)),
        }
    }

    /// The colour of a texel in lanes, and a bound of it as one number.
    fn of(&self, texel: [f32; 3]) -> (Lanes<N>, f32) {
        let [r, g, b] = texel.map(|v| v.max(0.0));
        let sum = (self.basis[0] * r + self.basis[1] * g + self.basis[2] * b).map(|v| v.min(1.0));
        let most = self.largest[0] * r + self.largest[1] * g + self.largest[2] * b;
        let most = most.min(self.together * r.max(g).max(b)).min(1.0);
        let Some([outer, inner]) = self.boundary else { return (sum, most) };
        // The inverse of Saunderson's formula.
        let pigment = |paint: f32| {
            let seen = (paint - outer).max(0.0);
            (seen / ((1.0 - outer) * (1.0 - inner) + inner * seen)).min(1.0)
        };
        (sum.map(pigment), pigment(most))
    }
}

/// What images say of one material.
#[derive(Clone, Debug)]
pub(crate) struct SkinLanes<const N: usize, M> {
    colour: Option<ColourLanes<N>>,
    ladder: Option<Ladder<M>>,
}

fn with_slope(material: &Material, slope: f64) -> Material {
    let mut found = material.clone();
    match &mut found.surface {
        Surface::Conductor { finish, .. }
        | Surface::Dielectric { finish, .. }
        | Surface::Coated { finish, .. } => {
            *finish = Finish { slope: [slope; 2], ..*finish };
        }
        Surface::Diffuse { .. } | Surface::Filter { .. } | Surface::Translucent { .. } => {}
    }
    found
}

impl<const N: usize, M: Prepare> SkinLanes<N, M> {
    /// What images say, prepared for a pass; `None` where they say nothing of colour and slope.
    pub fn new(
        skin: &Skin,
        material: &Material,
        illumination: Illumination,
        brightness: f32,
        basis: &dyn Basis,
        samples: Range<usize>,
        range: SpectralRange,
    ) -> Option<Self> {
        if skin.colour.is_none() && skin.slope.is_none() {
            return None;
        }
        let ladder = |texture: &SlopeTexture| {
            let [low, high] = texture.extent();
            let count = if high - low < 1e-3 { 1 } else { RUNGS };
            let step = (high - low) / (count.max(2) - 1) as f64;
            let rung = |i: usize| {
                let material = with_slope(material, low + step * i as f64);
                M::prepare(&material, illumination, brightness, basis, samples.clone(), range)
            };
            Ladder { low, step, rungs: (0..count).into_par_iter().map(rung).collect() }
        };
        Some(Self {
            colour: skin
                .colour
                .as_ref()
                .map(|texture| ColourLanes::new(texture, basis, samples.clone(), range)),
            ladder: skin.slope.as_ref().map(ladder),
        })
    }
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> SkinLanes<N, M> {
    /// Where the roughness at a point lies on the ladder; `None` where it is the same everywhere.
    pub fn mixture(&self, skin: &Skin, point: &TexturePoint) -> Option<Mixture> {
        let (ladder, texture) = self.ladder.as_ref().zip(skin.slope.as_ref())?;
        if ladder.rungs.len() == 1 {
            return Some(Mixture { lower: 0, part: 0.0 });
        }
        let place =
            ((texture.at(point) - ladder.low) / ladder.step).clamp(0.0, (ladder.rungs.len() - 1) as f64);
        let lower = (place as usize).min(ladder.rungs.len() - 2);
        Some(Mixture { lower, part: (place - lower as f64) as f32 })
    }

    /// The colour at a point, in lanes and as one number.
    pub fn colour(&self, skin: &Skin, point: &TexturePoint) -> Option<(Lanes<N>, f32)> {
        let (lanes, colour) = self.colour.as_ref().zip(skin.colour.as_ref())?;
        Some(lanes.of(colour.texture.at(point)))
    }

    /// The material with a rung of the ladder, or `base` where there is none, and a colour.
    pub fn model(&self, base: &M, rung: Option<usize>, colour: Option<&(Lanes<N>, f32)>) -> M {
        let model = self.ladder.as_ref().zip(rung).map_or(base, |(ladder, rung)| &ladder.rungs[rung]);
        match colour {
            Some((lanes, brightness)) => model.coloured(lanes, *brightness),
            None => model.clone(),
        }
    }
}

/// The normal that images make of a shading normal, as long as the viewer, if there is one, sees its front.
pub(crate) fn perturbed(
    scene: &Scene,
    material: usize,
    point: &TexturePoint,
    normal: Vec3,
    to_viewer: Vec3,
) -> Vec3 {
    let Some(relief) = &scene.skins[material].relief else { return normal };
    let moved = relief.perturbed(point, normal);
    if moved.dot(to_viewer) * normal.dot(to_viewer) > 0.0 { moved } else { normal }
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_optics::saunderson::{paint, pigment};

    #[test]
    fn finished_paint_is_seen_through_its_boundary() {
        let boundary = [dielectric(1.0, 1.5), internal_reflectance(1.5)].map(|v| v as f32);
        let lanes = ColourLanes::<4> {
            basis: [Lanes::splat(1.0); 3],
            largest: [1.0; 3],
            together: 3.0,
            boundary: Some(boundary),
        };
        for p in [0.0f64, 0.2, 0.7, 1.0] {
            let shown = paint(p, 1.5);
            let (found, most) = lanes.of([shown as f32, 0.0, 0.0]);
            assert!((f64::from(found.0[0]) - p).abs() < 1e-5 && (f64::from(most) - p).abs() < 1e-5);
            assert!((pigment(shown, 1.5) - p).abs() < 1e-9);
        }
    }
}
