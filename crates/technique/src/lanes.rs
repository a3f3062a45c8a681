//! A scene in the lanes of one pass.

use crate::participating::MediumLanes;
use crate::passes::Light;
use crate::radiosity::{Directional, Field};
use crate::sequence::Sequence;
use crate::skins::{Mixture, SkinLanes};
use crate::wavelength::Wavelength;
use glam::Vec3;
use illuminant_illumination::{Illumination, IlluminationModel, Index, Prepare, REPRESENTATIVE_NM, Surface};
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_scene::{LampForm, LampSample, Scene, TexturePoint};
use std::ops::Range;
use std::sync::Arc;

/// The index of refraction of a medium.
#[derive(Clone, Copy, Debug)]
struct IndexLanes<const N: usize> {
    mean: f32,
    least: f32,
    lanes: Lanes<N>,
}

/// The wavelength of its own that a path carries, where it is of this pass.
#[derive(Clone, Copy, Debug)]
pub struct Companion {
    /// Its lane.
    pub lane: usize,
    /// The sample of the basis that stands for its part of the spectrum.
    pub stand_in: usize,
    /// The width of the spectrum that the wavelength stands for, as a fraction of that for which the sample stands.
    pub share: f32,
}

/// All that depends on wavelength, for the samples of one pass: materials as the model `M` wants them, media, lamps.
#[derive(Debug)]
pub struct Pass<const N: usize, M> {
    /// Which samples of the basis the lanes are.
    pub samples: Range<usize>,
    /// How many samples a path carries in all.
    pub total: usize,
    /// The wavelength of its own that a path carries, if it is of this pass.
    pub companion: Option<Companion>,
    /// The sample that is that wavelength.
    pub carried: Option<usize>,
    /// The first bundle of light that has been dispersed; the bundles before it hold the light that has not.
    pub dispersed: Option<usize>,
    /// The materials.
    pub materials: Vec<M>,
    /// What images say of each material, if they do.
    pub(crate) skins: Vec<Option<SkinLanes<N, M>>>,
    /// The radiance that stands for all light that is not followed, of each group of lamps; empty where all is followed.
    pub ambient: Vec<Lanes<N>>,
    /// What patches send into all directions, if that has been solved for.
    pub(crate) directional: Option<Arc<Directional>>,
    /// The solution of radiosity, if there is one.
    pub(crate) field: Option<Field<N>>,
    /// What is in the air, if anything.
    pub(crate) medium: Option<MediumLanes<N>>,
    /// The spectra of the lamps.
    pub emission: Vec<Lanes<N>>,
    /// Where each lane lies in the spectral range, 0 to 1.
    position: Lanes<N>,
    vacuum: IndexLanes<N>,
    indices: Vec<IndexLanes<N>>,
    absorption: Vec<Option<Lanes<N>>>,
    /// The least absorption coefficient of each material over the range, 1/m.
    least_absorption: Vec<f32>,
    /// For each bundle the rows of the map to XYZ: one bundle a group of lamps, and as many more for dispersed light.
    pub to_xyz: Vec<[Lanes<N>; 3]>,
}

impl<const N: usize, M: Prepare> Pass<N, M> {
    /// Reduces a scene to the samples of a pass. `groups` gives one lamp for each group of lamps that share a map.
    pub(crate) fn new(
        scene: &Scene,
        illumination: Illumination,
        brightness: &[f32],
        basis: &dyn Basis,
        samples: Range<usize>,
        groups: &[usize],
        companion: Option<Wavelength>,
        light: Light<'_>,
    ) -> Self {
        let range = scene.range;
        let lanes = |values: &[f64]| Lanes::<N>::from_slice(&values[samples.clone()]);
        let vacuum = IndexLanes { mean: 1.0, least: 1.0, lanes: Lanes::splat(1.0) };
        let indices = scene.materials.iter().map(|material| match &material.surface {
            Surface::Dielectric { n, dispersion: true, .. } if basis.is_spectral() => IndexLanes {
                mean: n.at(REPRESENTATIVE_NM) as f32,
                least: n.extent(range).0 as f32,
                lanes: {
                    // A padded lane is never looked at, but must not divide by zero.
                    let mut all = lanes(&basis.reduce(n, Role::Constant));
                    let count = samples.len();
                    all.0[count..].fill(1.0);
                    all
                },
            },
            Surface::Dielectric { n, .. } => {
                let mean = n.at(REPRESENTATIVE_NM) as f32;
                IndexLanes { mean, least: mean, lanes: Lanes::splat(mean) }
            }
            _ => vacuum,
        });
        let absorption = scene.materials.iter().map(|material| match &material.surface {
            Surface::Dielectric { absorption: Some(a), .. } => Some(lanes(&basis.reduce(a, Role::Constant))),
            _ => None,
        });
        let least_absorption = scene.materials.iter().map(|material| match &material.surface {
            Surface::Dielectric { absorption: Some(a), .. } => a.extent(range).0.max(0.0) as f32,
            _ => 0.0,
        });
        let mut to_xyz: Vec<[Lanes<N>; 3]> =
            groups.iter().map(|&lamp| basis.to_xyz(lamp).each_ref().map(|row| lanes(row))).collect();
        // Under flat light paths end where they would be dispersed: no sample goes on.
        let carried = match light {
            Light::Lamps => companion.map(|_| basis.len() - 1),
            Light::Flat(_) => Some(usize::MAX),
        };
        if let (Some(wavelength), Some(own)) = (companion, carried) {
            let map = wavelength.to_xyz(own);
            to_xyz.extend(groups.iter().map(|_| map.each_ref().map(|row| lanes(row))));
        }
        let emission = scene.lamps.iter().enumerate().map(|(i, lamp)| match light {
            Light::Lamps => lanes(&basis.reduce(&lamp.spectrum, Role::Emission)),
            Light::Flat(values) => lanes(&vec![f64::from(values[i]); basis.len()]),
        });
        let span = range.width_nm() - 1.0;
        let position: Vec<f64> =
            (0..basis.len()).map(|i| (basis.wavelength_nm(i) - f64::from(range.min_nm)) / span).collect();
        Self {
            materials: scene
                .materials
                .iter()
                .zip(brightness)
                .map(|(material, &b)| M::prepare(material, illumination, b, basis, samples.clone(), range))
                .collect(),
            skins: scene
                .materials
                .iter()
                .zip(&scene.skins)
                .zip(brightness)
                .map(|((material, skin), &b)| {
                    SkinLanes::new(skin, material, illumination, b, basis, samples.clone(), range)
                })
                .collect(),
            ambient: Vec::new(),
            directional: None,
            field: None,
            medium: scene.medium.as_ref().map(|m| MediumLanes::new(m, basis, samples.clone(), range)),
            emission: emission.collect(),
            position: lanes(&position),
            vacuum,
            indices: indices.collect(),
            absorption: absorption.collect(),
            least_absorption: least_absorption.collect(),
            to_xyz,
            total: basis.len(),
            companion: companion.zip(carried).filter(|(_, own)| samples.contains(own)).map(|(w, own)| {
                let (stand_in, width_nm) = stand_in(basis, own, w.nm, scene);
                Companion { lane: own - samples.start, stand_in, share: (w.width_nm / width_nm) as f32 }
            }),
            carried,
            dispersed: companion.map(|_| groups.len()),
            samples,
        }
    }
}

impl<const N: usize, M: IlluminationModel<N> + Prepare> Pass<N, M> {
    /// The material at a point of which images say something. Between two rungs of roughness one is taken by chance.
    #[inline(never)]
    pub(crate) fn textured(
        &self,
        scene: &Scene,
        material: usize,
        point: &TexturePoint,
        sequence: &mut Sequence,
    ) -> Option<M> {
        let (lanes, skin) = (self.skins[material].as_ref()?, &scene.skins[material]);
        let rung = lanes.mixture(skin, point).map(|Mixture { lower, part }| {
            let next = part > 0.0 && sequence.next4()[0] < part;
            lower + usize::from(next)
        });
        let colour = lanes.colour(skin, point);
        Some(lanes.model(&self.materials[material], rung, colour.as_ref()))
    }
}

impl<const N: usize, M> Pass<N, M> {
    /// The index of a medium; `None` is the open.
    #[inline(always)]
    pub fn index(&self, medium: Option<usize>) -> Index<'_, N> {
        let found = medium.map_or(&self.vacuum, |m| &self.indices[m]);
        Index { mean: found.mean, least: found.least, lanes: &found.lanes }
    }

    /// What is left of light after a distance in a medium; `None` where nothing is lost.
    #[inline(always)]
    pub fn transmittance(&self, medium: Option<usize>, distance: f32) -> Option<Lanes<N>> {
        let absorption = self.absorption[medium?]?;
        Some(absorption.map(|a| (-a * distance).exp()))
    }

    /// What a distance in a medium leaves of the brightness of a path: as much as of its brightest wavelength.
    #[inline(always)]
    pub fn brightness_after(&self, medium: Option<usize>, distance: f32) -> f32 {
        medium.map_or(1.0, |m| (-self.least_absorption[m] * distance).exp())
    }

    /// The radiance of surroundings in a direction.
    #[inline]
    pub fn surroundings(&self, scene: &Scene, lamp: usize, direction: Vec3) -> Lanes<N> {
        match &scene.lamps[lamp].form {
            LampForm::Image(image) => {
                image.radiance(image.uv(direction), &self.position, &self.emission[lamp])
            }
            LampForm::Sky(sky) => sky.radiance(direction, &self.position, &self.emission[lamp]),
            LampForm::Sun(sun) => sun.radiance(direction, &self.position, &self.emission[lamp]),
            _ => self.emission[lamp],
        }
    }

    /// The light that a lamp gives in the direction in which it was asked.
    #[inline(always)]
    pub fn emission_to(&self, scene: &Scene, lamp: usize, light: &LampSample) -> Lanes<N> {
        if light.varies { self.surroundings(scene, lamp, light.direction) } else { self.emission[lamp] }
    }

    /// The mean radiance of surroundings in a cone about a direction, `radius` its half-angle in radians.
    pub fn surroundings_in_cone(&self, scene: &Scene, lamp: usize, direction: Vec3, radius: f32) -> Lanes<N> {
        match &scene.lamps[lamp].form {
            LampForm::Image(image) => {
                let uv = image.uv(direction);
                image.radiance_of_cone(uv, radius, &self.position, &self.emission[lamp])
            }
            // The sky hardly varies over a highlight.
            _ => self.surroundings(scene, lamp, direction),
        }
    }

    /// The lane of a sample, if it is of this pass.
    #[inline(always)]
    pub fn lane(&self, sample: usize) -> Option<usize> {
        self.samples.contains(&sample).then(|| sample - self.samples.start)
    }

    /// The samples of the basis that are of this pass: without the wavelength of a path's own.
    #[inline(always)]
    pub fn own_samples(&self) -> Range<usize> {
        let end = self.carried.map_or(self.samples.end, |own| self.samples.end.min(own));
        self.samples.start..end
    }
}

/// Of the first `own` samples the one nearest to a wavelength, and the width of the spectrum, nm, that is nearest to it.
fn stand_in(basis: &dyn Basis, own: usize, nm: f64, scene: &Scene) -> (usize, f64) {
    let mut order: Vec<usize> = (0..own).collect();
    order.sort_by(|&a, &b| basis.wavelength_nm(a).total_cmp(&basis.wavelength_nm(b)));
    let at = |i: usize| basis.wavelength_nm(order[i]);
    let place = (1..own).find(|&i| f64::midpoint(at(i - 1), at(i)) > nm).unwrap_or(own) - 1;
    let low = if place == 0 {
        f64::from(scene.range.min_nm) - 0.5
    } else {
        f64::midpoint(at(place - 1), at(place))
    };
    let high = if place + 1 == own {
        f64::from(scene.range.max_nm) + 0.5
    } else {
        f64::midpoint(at(place), at(place + 1))
    };
    (order[place], (high - low).max(1e-3))
}
