//! A scene in the lanes of one pass.

use glam::Vec3;
use illuminant_illumination::{Index, Prepare, REPRESENTATIVE_NM, Surface};
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_scene::{LampForm, Scene};
use std::ops::Range;

/// The index of refraction of a medium.
#[derive(Clone, Copy, Debug)]
struct IndexLanes<const N: usize> {
    mean: f32,
    least: f32,
    lanes: Lanes<N>,
}

/// All that depends on wavelength, for the samples of one pass: materials as the model `M` wants them, media, lamps.
#[derive(Debug)]
pub struct Pass<const N: usize, M> {
    /// Which samples of the basis the lanes are.
    pub samples: Range<usize>,
    /// How many samples the basis has in all.
    pub total: usize,
    /// The materials.
    pub materials: Vec<M>,
    /// The spectra of the lamps.
    pub emission: Vec<Lanes<N>>,
    /// Where each lane lies in the spectral range, 0 to 1.
    position: Lanes<N>,
    vacuum: IndexLanes<N>,
    indices: Vec<IndexLanes<N>>,
    absorption: Vec<Option<Lanes<N>>>,
    /// For each group of lamps, the rows of the map to XYZ.
    pub to_xyz: Vec<[Lanes<N>; 3]>,
}

impl<const N: usize, M: Prepare> Pass<N, M> {
    /// Reduces a scene to the samples of a pass. `groups` gives one lamp for each group of lamps that share a map.
    pub fn new(scene: &Scene, basis: &dyn Basis, samples: Range<usize>, groups: &[usize]) -> Self {
        let range = scene.range;
        let lanes = |values: &[f64]| Lanes::<N>::from_slice(&values[samples.clone()]);
        let vacuum = IndexLanes { mean: 1.0, least: 1.0, lanes: Lanes::splat(1.0) };
        let indices = scene.materials.iter().map(|material| match &material.surface {
            Surface::Dielectric { n, dispersion: true, .. } => IndexLanes {
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
        let span = range.width_nm() - 1.0;
        let position: Vec<f64> =
            (0..basis.len()).map(|i| (basis.wavelength_nm(i) - f64::from(range.min_nm)) / span).collect();
        Self {
            materials: scene.materials.iter().map(|m| M::prepare(m, basis, samples.clone(), range)).collect(),
            emission: scene.lamps.iter().map(|l| lanes(&basis.reduce(&l.spectrum, Role::Emission))).collect(),
            position: lanes(&position),
            vacuum,
            indices: indices.collect(),
            absorption: absorption.collect(),
            to_xyz: groups.iter().map(|&lamp| basis.to_xyz(lamp).each_ref().map(|row| lanes(row))).collect(),
            total: basis.len(),
            samples,
        }
    }

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

    /// The radiance of surroundings in a direction.
    #[inline]
    pub fn surroundings(&self, scene: &Scene, lamp: usize, direction: Vec3) -> Lanes<N> {
        match &scene.lamps[lamp].form {
            LampForm::Image(image) => {
                image.radiance(image.uv(direction), &self.position, &self.emission[lamp])
            }
            _ => self.emission[lamp],
        }
    }

    /// The lane of a sample, if it is of this pass.
    #[inline(always)]
    pub fn lane(&self, sample: usize) -> Option<usize> {
        self.samples.contains(&sample).then(|| sample - self.samples.start)
    }
}
