//! A participating medium in the lanes of a pass.
//!
//! Distances are drawn by one of a few representative extinctions, the same along a path; its weight is over the mean of the chances that
//! all of them would have given it (the balance heuristic; Wilkie et al. 2014), so it stays bounded where extinction has colour, and
//! distances never depend on the lanes. Where the density varies, what a ray passes of it takes the place of distance: exactly, cell by
//! cell. Where fewer tentative meetings than cells are to be expected, meetings are tried instead at the rate of the densest place, and
//! each is a real one or none (Woodcock 1965; in lanes: Kutz et al. 2017); shadows multiply what tentative ones leave (ratio tracking;
//! Novák et al. 2014).

use crate::sequence::Sequence;
use glam::Vec3;
use illuminant_sampling::{Basis, Lanes, Role};
use illuminant_scene::{Column, Medium, Phase};
use illuminant_spectrum::SpectralRange;
use std::ops::Range;

/// How many extinctions represent a spectrum.
const REPRESENTATIVE: usize = 5;

/// What a tentative meeting costs, in steps from cell to cell: it draws numbers, and in a shadow it makes noise.
const TENTATIVE: f32 = 2.0;

/// Nothing is left behind this optical depth: e to the minus this is 0 in single precision.
const OPAQUE: f32 = 105.0;

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
    /// Behind this amount of matter nothing is left in any lane that has an extinction.
    opaque: f32,
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
        let extinction = absorption + scattering;
        let least = extinction.0.iter().copied().filter(|s| *s > 0.0).fold(f32::INFINITY, f32::min);
        let opaque = OPAQUE / least;
        Self { extinction, scattering, sampled, majorant, opaque, medium: medium.clone() }
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
        let Some([near, far]) = self.within(origin, direction, length) else {
            return Lanes::splat(1.0);
        };
        if self.is_thin(direction, far - near) {
            let mut left = Lanes::splat(1.0);
            self.try_meetings(far - near, sequence, |passed, _| {
                let density = self.medium.density_at(origin + direction * (near + passed)) / self.majorant;
                left *= self.extinction.map(|s| (1.0 - s * density).max(0.0));
                false
            });
            return left;
        }
        let column = self.medium.column(origin, direction, [near, far], self.opaque).amount;
        self.extinction.map(|s| kept(s, column))
    }

    /// The distances between which a ray is in the medium, if that does anything to light.
    fn within(&self, origin: Vec3, direction: Vec3, length: f32) -> Option<[f32; 2]> {
        self.medium.within(origin, direction, length).filter(|_| self.majorant > 0.0)
    }

    /// Whether a ray would try fewer meetings than it passes cells, by what both cost.
    fn is_thin(&self, direction: Vec3, length: f32) -> bool {
        self.medium.density.is_some()
            && TENTATIVE * self.majorant * length < self.medium.steps(direction * length)
    }

    /// Tries meetings at the rate of the densest place, until one is `real` or the length is passed.
    fn try_meetings(&self, length: f32, sequence: &mut Sequence, mut real: impl FnMut(f32, f32) -> bool) {
        let mut passed = 0.0;
        loop {
            let [u_distance, u_kind, ..] = sequence.next4();
            passed -= (1.0 - u_distance).ln() / self.majorant;
            // What is no number ends it too.
            if !(passed < length) || real(passed, u_kind) {
                return;
            }
        }
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
        let Some([near, far]) = self.within(origin, direction, length) else { return through };
        if self.is_thin(direction, far - near) {
            return self.track(origin, direction, [near, far], draws, sequence);
        }
        let [chosen, _] = self.sampled[draws.chosen];
        let [u, ..] = sequence.next4();
        let depth = if chosen > 0.0 { -(1.0 - u).ln() / chosen } else { f32::INFINITY };
        let Column { amount, reached } = self.medium.column(origin, direction, [near, far], depth);
        if reached.is_some() {
            // The density at the place is in the chances and in the weight alike.
            let before = *draws;
            let mean = draws.times(|i| self.sampled[i][0] * kept(self.sampled[i][0], amount));
            let weight = self.extinction.zip(self.scattering, |s, scattering| scattering * kept(s, amount));
            let bright = before.scattered(|i| self.sampled[i][1] * kept(self.sampled[i][0], amount));
            return Found { weight: weight * mean.recip(), brightness: bright / mean, scattered: reached };
        }
        let mean = draws.times(|i| kept(self.sampled[i][0], amount));
        let weight = self.extinction.map(|s| kept(s, amount));
        Found { weight: weight * mean.recip(), ..through }
    }

    /// The same by tentative meetings: the extinction by which the path draws says which are real.
    fn track(
        &self,
        origin: Vec3,
        direction: Vec3,
        [near, far]: [f32; 2],
        draws: &mut Draws,
        sequence: &mut Sequence,
    ) -> Found<N> {
        let mut found = Found { weight: Lanes::splat(1.0), brightness: 1.0, scattered: None };
        self.try_meetings(far - near, sequence, |passed, u_kind| {
            let at = near + passed;
            let density = self.medium.density_at(origin + direction * at) / self.majorant;
            if u_kind < self.sampled[draws.chosen][0] * density {
                let bright = draws.scattered(|i| self.sampled[i][1] * density);
                let mean = draws.times(|i| self.sampled[i][0] * density);
                found.weight *= self.scattering * (density / mean);
                found.brightness = bright / mean;
                found.scattered = Some(at);
                return true;
            }
            let mean = draws.times(|i| 1.0 - self.sampled[i][0] * density);
            found.weight *= self.extinction.map(|s| (1.0 - s * density).max(0.0) / mean);
            false
        });
        found
    }
}

/// What an extinction leaves of light behind an amount of matter, which may be infinite.
fn kept(extinction: f32, amount: f32) -> f32 {
    if extinction > 0.0 { (-extinction * amount).exp() } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_sampling::OneNanometre;
    use illuminant_scene::Density;
    use illuminant_spectrum::Curve;

    const RANGE: SpectralRange = SpectralRange { min_nm: 400, max_nm: 403 };
    /// 4,096 cells with a density between 0 and 1.
    const SIZE: [usize; 3] = [16; 3];

    /// A medium in the unit cube, its lanes, and two that are over.
    fn lanes(absorption: f64, scattering: f64) -> (Medium, MediumLanes<6>) {
        let values = (0..4096u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 8) as f32 / 16_777_216.0);
        let medium = Medium {
            absorption: Curve::constant(absorption),
            scattering: Curve::constant(scattering),
            phase: Phase::Rayleigh,
            bounds: Some([Vec3::ZERO, Vec3::ONE]),
            density: Density::new(SIZE, values.collect()),
        };
        let lanes = MediumLanes::new(&medium, &OneNanometre::new(RANGE), 0..4, RANGE);
        (medium, lanes)
    }

    /// A ray right through the cube.
    fn ray() -> (Vec3, Vec3, f32) {
        let (from, to) = (Vec3::new(0.1, 0.2, 0.0), Vec3::new(0.7, 0.9, 1.0));
        (from, (to - from).normalize(), from.distance(to))
    }

    #[test]
    fn a_shadow_is_beers_law_of_the_column_whichever_way_it_is_found() {
        let (origin, direction, length) = ray();
        for extinction in [0.7, 3.0, 40.0] {
            let (medium, lanes) = lanes(extinction, 0.0);
            let column = medium.column(origin, direction, [0.0, length], f32::INFINITY).amount;
            let exact = f64::from((-extinction as f32 * column).exp());
            let thin = lanes.is_thin(direction, length);
            assert_eq!(thin, extinction < 10.0);
            let count = if thin { 20_000 } else { 1 };
            let mut mean = 0.0;
            for i in 0..count {
                let mut sequence = Sequence::new(5, 0, i, 0);
                let left = lanes.transmittance(origin, direction, length, &mut sequence);
                assert_eq!(left.0[4..], [1.0; 2]);
                mean += f64::from(left.0[0]) / count as f64;
            }
            assert!((mean / exact - 1.0).abs() < if thin { 5e-3 } else { 1e-5 }, "{mean} for {exact}");
        }
    }

    #[test]
    fn a_path_gets_through_or_is_scattered_as_often_as_the_column_says() {
        let (origin, direction, length) = ray();
        for (absorption, scattering) in [(0.2, 0.4), (10.0, 20.0), (0.0, 40.0)] {
            let (medium, lanes) = lanes(absorption, scattering);
            let extinction = (absorption + scattering) as f32;
            let whole = medium.column(origin, direction, [0.0, length], f32::INFINITY).amount;
            let half = medium.column(origin, direction, [0.0, 0.5 * length], f32::INFINITY).amount;
            let count = 40_000;
            let [mut through, mut near, mut far] = [0.0f64; 3];
            for i in 0..count {
                let mut sequence = Sequence::new(7, 0, i, 0);
                let found = lanes.travel(origin, direction, length, &mut Draws::new(0.5), &mut sequence);
                let weight = f64::from(found.weight.0[0]) / count as f64;
                match found.scattered {
                    None => through += weight,
                    Some(at) if at < 0.5 * length => near += weight,
                    Some(_) => far += weight,
                }
            }
            let albedo = scattering / (absorption + scattering);
            let kept = |amount: f32| f64::from((-extinction * amount).exp());
            let expected = [kept(whole), albedo * (1.0 - kept(half)), albedo * (kept(half) - kept(whole))];
            for (found, expected) in [through, near, far].into_iter().zip(expected) {
                assert!((found - expected).abs() < 4e-3, "{found} for {expected}");
            }
        }
    }

    #[test]
    fn a_medium_that_does_nothing_lets_all_light_through() {
        let (origin, direction, length) = ray();
        // The product of the coefficient and the densest place is 0 in single precision.
        for extinction in [0.0, 1e-46] {
            let (_, lanes) = lanes(extinction, 0.0);
            let mut sequence = Sequence::new(1, 0, 0, 0);
            assert_eq!(lanes.transmittance(origin, direction, length, &mut sequence).0, [1.0; 6]);
            let found = lanes.travel(origin, direction, length, &mut Draws::new(0.5), &mut sequence);
            assert!(found.scattered.is_none() && found.weight.0 == [1.0; 6]);
        }
        // A step of 0 / 0 ends the way.
        let (_, mut lanes) = lanes(1.0, 0.0);
        lanes.majorant = f32::NAN;
        let mut tries = 0;
        lanes.try_meetings(length, &mut Sequence::new(1, 0, 0, 0), |_, _| {
            tries += 1;
            false
        });
        assert_eq!(tries, 0);
    }

    #[test]
    fn a_ray_of_millions_of_mean_free_paths_ends_at_once() {
        let (origin, direction, length) = ray();
        let (_, lanes) = lanes(0.0, 1e6);
        let mut sequence = Sequence::new(1, 0, 0, 0);
        let left = lanes.transmittance(origin, direction, length, &mut sequence);
        assert_eq!(left.0[..4], [0.0; 4]);
        let found = lanes.travel(origin, direction, length, &mut Draws::new(0.5), &mut sequence);
        assert!(found.scattered.unwrap() < 1e-4 && (found.weight.0[0] - 1.0).abs() < 1e-6);
    }
}
