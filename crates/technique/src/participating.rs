//! A participating medium in the lanes of a pass.
//!
//! Distances are drawn by one of a few representative extinctions, the same along a path; its weight is over the mean of the chances that
//! all of them would have given it (the balance heuristic; Wilkie et al. 2014), so it stays bounded where extinction has colour, and
//! distances never depend on the lanes. Where the density varies, meetings are tried at the rate of the densest place, and each is a real
//! one or none (Woodcock 1965; in lanes: Kutz et al. 2017); shadows multiply what tentative ones leave (ratio tracking; Novák et al. 2014).

use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_scene::{Medium, Phase};
use illuminant_spectrum::SpectralRange;
use std::ops::Range;

/// How many extinctions represent a spectrum.
const REPRESENTATIVE: usize = 5;

/// The most tentative meetings along one ray.
const MOST: usize = 100_000;

/// Which extinction a path draws by, and the chance that each would have given it, relative to their mean.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Draws {
    chosen: usize,
    chances: [f32; REPRESENTATIVE],
}

impl Draws {
    /// From a number in [0, 1).
    pub fn new(u: f32) -> Self {
        let chosen = ((u * REPRESENTATIVE as f32) as usize).min(REPRESENTATIVE - 1);
        Self { chosen, chances: [1.0; REPRESENTATIVE] }
    }

    /// The mean of what the extinctions let through and scatter, by the chances that they have.
    fn scattered(&self, part: impl Fn(usize) -> f32) -> f32 {
        self.chances.iter().enumerate().map(|(i, c)| c * part(i)).sum::<f32>() / REPRESENTATIVE as f32
    }

    /// Multiplies the chances, and returns their mean, by which they are then divided.
    fn times(&mut self, chance: impl Fn(usize) -> f32) -> f32 {
        self.chances.iter_mut().enumerate().for_each(|(i, c)| *c *= chance(i));
        let mean = (self.chances.iter().sum::<f32>() / REPRESENTATIVE as f32).max(f32::MIN_POSITIVE);
        self.chances.iter_mut().for_each(|c| *c /= mean);
        mean
    }
}

/// A medium in lanes.
#[derive(Clone, Debug)]
pub(crate) struct MediumLanes<const N: usize> {
    extinction: Lanes<N>,
    scattering: Lanes<N>,
    /// Extinction and scattering at wavelengths over the range.
    sampled: [[f32; 2]; REPRESENTATIVE],
    /// The largest extinction at the densest place.
    majorant: f32,
    medium: Medium,
}

/// What a ray finds in a medium.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<const N: usize> {
    /// What the throughput is multiplied by.
    pub weight: Lanes<N>,
    /// The same as one number.
    pub brightness: f32,
    /// The distance at which light is scattered; `None` where the ray gets through.
    pub scattered: Option<f32>,
}

impl<const N: usize> MediumLanes<N> {
    pub fn new(medium: &Medium, basis: &dyn Basis, samples: Range<usize>, range: SpectralRange) -> Self {
        let lanes = |curve| Lanes::from_slice(&basis.reduce(curve, Role::Constant)[samples.clone()]);
        let (absorption, scattering): (Lanes<N>, Lanes<N>) =
            (lanes(&medium.absorption), lanes(&medium.scattering));
        let sampled = std::array::from_fn(|i| {
            let nm = f64::from(range.min_nm)
                + (i as f64 + 0.5) / REPRESENTATIVE as f64 * f64::from(range.max_nm - range.min_nm);
            let [a, s] = [&medium.absorption, &medium.scattering].map(|curve| curve.at(nm) as f32);
            [a + s, s]
        });
        let most = range.wavelengths().map(|nm| medium.absorption.at(nm) + medium.scattering.at(nm));
        let majorant = most.fold(0.0, f64::max) as f32 * medium.densest();
        Self { extinction: absorption + scattering, scattering, sampled, majorant, medium: medium.clone() }
    }

    pub fn phase(&self) -> Phase {
        self.medium.phase
    }

    /// What is left of light over a part of a span, or to infinity along it.
    pub fn left_of(&self, origin: Vec3, span: Vec3, part: f32, sequence: &mut Sequence) -> Lanes<N> {
        let length = span.length();
        self.transmittance(origin, span / length, length * part, sequence)
    }

    /// What is left of light over a distance.
    fn transmittance(&self, origin: Vec3, direction: Vec3, length: f32, sequence: &mut Sequence) -> Lanes<N> {
        let Some([near, far]) = self.medium.within(origin, direction, length) else {
            return Lanes::splat(1.0);
        };
        if self.medium.density.is_none() {
            return self.extinction.map(|s| if s > 0.0 { (-s * (far - near)).exp() } else { 1.0 });
        }
        let mut left = Lanes::splat(1.0);
        let mut at = near;
        for _ in 0..MOST {
            at -= (1.0 - sequence.next4()[0]).ln() / self.majorant;
            if at >= far || left.is_zero() {
                break;
            }
            let density = self.medium.density_at(origin + direction * at);
            left *= self.extinction.map(|s| 1.0 - s * density / self.majorant);
        }
        left
    }

    /// What a ray finds over a distance, which may be infinite.
    pub fn travel(
        &self,
        origin: Vec3,
        direction: Vec3,
        length: f32,
        draws: &mut Draws,
        sequence: &mut Sequence,
    ) -> Found<N> {
        let through = Found { weight: Lanes::splat(1.0), brightness: 1.0, scattered: None };
        let Some([near, far]) = self.medium.within(origin, direction, length) else { return through };
        if !(self.majorant > 0.0) {
            return through;
        }
        if self.medium.density.is_some() {
            return self.track(origin, direction, [near, far], draws, sequence);
        }
        let length = far - near;
        let [chosen, _] = self.sampled[draws.chosen];
        let [u, ..] = sequence.next4();
        let distance = if chosen > 0.0 { -(1.0 - u).ln() / chosen } else { f32::INFINITY };
        let kept = |s: f32, t: f32| if s > 0.0 { (-s * t).exp() } else { 1.0 };
        if distance < length {
            let before = *draws;
            let mean = draws.times(|i| self.sampled[i][0] * kept(self.sampled[i][0], distance));
            let weight = self.extinction.zip(self.scattering, |s, scattering| scattering * kept(s, distance));
            let bright = before.scattered(|i| self.sampled[i][1] * kept(self.sampled[i][0], distance));
            return Found {
                weight: weight * mean.recip(),
                brightness: bright / mean,
                scattered: Some(near + distance),
            };
        }
        let mean = draws.times(|i| kept(self.sampled[i][0], length));
        let weight = self.extinction.map(|s| kept(s, length));
        Found { weight: weight * mean.recip(), ..through }
    }

    /// The same where the density varies: the extinction by which the path draws says which tentative meetings are real.
    fn track(
        &self,
        origin: Vec3,
        direction: Vec3,
        [near, far]: [f32; 2],
        draws: &mut Draws,
        sequence: &mut Sequence,
    ) -> Found<N> {
        let mut weight = Lanes::splat(1.0);
        let mut at = near;
        for _ in 0..MOST {
            let [u_distance, u_kind, ..] = sequence.next4();
            at -= (1.0 - u_distance).ln() / self.majorant;
            if at >= far {
                break;
            }
            let density = self.medium.density_at(origin + direction * at) / self.majorant;
            if u_kind < self.sampled[draws.chosen][0] * density {
                let bright = draws.scattered(|i| self.sampled[i][1] * density);
                let mean = draws.times(|i| self.sampled[i][0] * density);
                weight *= self.scattering * (density / mean);
                return Found { weight, brightness: bright / mean, scattered: Some(at) };
            }
            let mean = draws.times(|i| 1.0 - self.sampled[i][0] * density);
            weight *= self.extinction.map(|s| (1.0 - s * density) / mean);
        }
        Found { weight, brightness: 1.0, scattered: None }
    }
}
