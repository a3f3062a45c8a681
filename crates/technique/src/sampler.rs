//! Which random numbers a technique draws.
//!
//! All but Sobol's are here for comparison: what they differ in is how evenly the samples of a pixel lie (Cook 1986; Mitchell 1991).

use crate::sequence::{Sequence, mix};
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// How the numbers of the samples of a pixel lie. Pairs of numbers lie as described; different pairs are shuffled against each other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sampler {
    /// Owen-scrambled Sobol: even at every number of samples.
    #[default]
    SobolOwen,
    /// Each without regard to the others.
    Random,
    /// In the middles of as many equal cells as a pixel has samples: even, but regular.
    Stratified,
    /// Anywhere in those cells (Cook, Porter and Carpenter 1984).
    Jittered,
    /// At least so far from each other (Cook 1986): a set by Mitchell's best candidates (1991), moved at random around the torus.
    PoissonDisk,
}

/// What every sequence of a render needs to know.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers {
    sampler: Sampler,
    /// The samples of a pixel, among which strata are shared out.
    count: u32,
}

impl Numbers {
    pub fn new(sampler: Sampler, count: u32) -> Self {
        Self { sampler, count: count.clamp(1, MOST) }
    }

    /// The numbers of a sample ([`Sequence::new`]).
    #[inline(always)]
    pub fn sequence(&self, seed: u64, stream: u64, sample: u64, replicate: u64) -> Sequence {
        match self.sampler {
            Sampler::SobolOwen => Sequence::new(seed, stream, sample, replicate),
            sampler => Sequence::of(sampler, self.count, seed, stream, sample, replicate),
        }
    }
}

/// The most strata.
const MOST: u32 = 1 << 16;

/// The points of a Poisson disk set; with more samples another set of them is taken.
const DISK: usize = 1024;

/// A number in [0, 1) from bits.
#[inline(always)]
pub(crate) fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// Four independent numbers.
#[inline(always)]
pub(crate) fn independent(hash: u64) -> [f32; 4] {
    let (a, b) = (mix(hash, 1), mix(hash, 2));
    [a as u32, (a >> 32) as u32, b as u32, (b >> 32) as u32].map(unit)
}

/// The place of `i` in a permutation of `0..count` (Kensler 2013: a hash of as many bits, until it falls into the range).
fn permuted(i: u32, count: u32, key: u32) -> u32 {
    let mask = count.next_power_of_two() - 1;
    let mut i = i % count;
    loop {
        i ^= key;
        i = i.wrapping_mul(0xe170_893d);
        i ^= key >> 16;
        i ^= (i & mask) >> 4;
        i ^= key >> 8;
        i = i.wrapping_mul(0x0929_eb3f);
        i ^= key >> 23;
        i ^= (i & mask) >> 1;
        i = i.wrapping_mul(1 | key >> 27);
        i = i.wrapping_mul(0x6935_fa69);
        i ^= (i & mask) >> 11;
        i = i.wrapping_mul(0x74dc_b303);
        i ^= (i & mask) >> 2;
        i = i.wrapping_mul(0x9e50_1cc3);
        i ^= (i & mask) >> 2;
        i = i.wrapping_mul(0xc860_a3df);
        i &= mask;
        i ^= i >> 5;
        if i < count {
            return (i + key % count) % count;
        }
    }
}

/// Columns and rows of the cells of so many samples, no fewer than they are.
fn cells(count: u32) -> [u32; 2] {
    let columns = (f64::from(count).sqrt().round() as u32).max(1);
    [columns, count.div_ceil(columns)]
}

/// A pair of numbers of sample `index` of `count`; `hash` is that of the pair, the same for all samples.
fn pair(sampler: Sampler, index: u32, count: u32, hash: u64, own: [f32; 2]) -> [f32; 2] {
    let key = (hash >> 32) as u32;
    match sampler {
        Sampler::Stratified | Sampler::Jittered => {
            let [columns, rows] = cells(count);
            let cell = permuted(index, columns * rows, key);
            let within = if sampler == Sampler::Jittered { own } else { [0.5; 2] };
            let place = |at: u32, within: f32, count: u32| {
                ((at as f32 + within) / count as f32).min(1.0 - f32::EPSILON / 2.0)
            };
            [place(cell % columns, within[0], columns), place(cell / columns, within[1], rows)]
        }
        Sampler::PoissonDisk => {
            let count = count.min(DISK as u32);
            let point = disk()[permuted(index, count, key) as usize];
            let shift = [unit(hash as u32), unit(mix(hash, 3) as u32)];
            std::array::from_fn(|i| (point[i] + shift[i]).fract())
        }
        Sampler::SobolOwen | Sampler::Random => own,
    }
}

/// How many samples of a sampler belong together, for so many in a pixel.
pub(crate) fn period(sampler: Sampler, count: u32) -> u32 {
    match sampler {
        Sampler::Stratified | Sampler::Jittered => {
            let [columns, rows] = cells(count);
            columns * rows
        }
        Sampler::PoissonDisk => count.min(DISK as u32),
        Sampler::SobolOwen | Sampler::Random => 1,
    }
}

/// The next four numbers: two pairs. `hash` is that of the four, `own` that of the sample.
pub(crate) fn four(sampler: Sampler, index: u32, count: u32, hash: u64, own: u64) -> [f32; 4] {
    let [a, b, c, d] = independent(own);
    if sampler == Sampler::Random {
        return [a, b, c, d];
    }
    let [x, y] = pair(sampler, index, count, mix(hash, 5), [a, b]);
    let [z, w] = pair(sampler, index, count, mix(hash, 6), [c, d]);
    [x, y, z, w]
}

/// A set of points of which every first ones are as far from each other as candidates allow, on a torus.
fn disk() -> &'static [[f32; 2]] {
    static POINTS: OnceLock<Vec<[f32; 2]>> = OnceLock::new();
    POINTS.get_or_init(|| {
        const CANDIDATES: u64 = 48;
        let mut points: Vec<[f32; 2]> = Vec::with_capacity(DISK);
        let apart = |a: &[f32; 2], b: &[f32; 2]| {
            let d: [f32; 2] = std::array::from_fn(|i| {
                let d = (a[i] - b[i]).abs();
                d.min(1.0 - d)
            });
            d[0] * d[0] + d[1] * d[1]
        };
        for i in 0..DISK as u64 {
            let candidates = (0..CANDIDATES).map(|k| {
                let [x, y, ..] = independent(mix(i, k));
                [x, y]
            });
            let nearest = |p: &[f32; 2]| points.iter().map(|q| apart(p, q)).fold(2.0f32, f32::min);
            let best = candidates.map(|p| (nearest(&p), p)).max_by(|a, b| a.0.total_cmp(&b.0));
            points.extend(best.map(|(_, p)| p));
        }
        points
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const OTHERS: [Sampler; 4] =
        [Sampler::Random, Sampler::Stratified, Sampler::Jittered, Sampler::PoissonDisk];

    /// The first pairs of the samples of a pixel.
    fn points(sampler: Sampler, count: u32, stream: u64) -> Vec<[f32; 2]> {
        let numbers = Numbers::new(sampler, count);
        let first = |i: u32| {
            let [x, y, ..] = numbers.sequence(7, stream, u64::from(i), 0).next4();
            [x, y]
        };
        (0..count).map(first).collect()
    }

    #[test]
    fn permutations_are_permutations() {
        for count in [1, 2, 3, 16, 17, 100, 1000] {
            for key in [0, 1, 0xdead_beef, u32::MAX] {
                let mut seen = vec![false; count as usize];
                for i in 0..count {
                    let at = permuted(i, count, key) as usize;
                    assert!(!std::mem::replace(&mut seen[at], true), "{count} {key} {i}");
                }
            }
        }
    }

    #[test]
    fn every_cell_holds_one_sample() {
        for sampler in [Sampler::Stratified, Sampler::Jittered] {
            for stream in 0..20 {
                let mut cells = [0; 64];
                for [x, y] in points(sampler, 64, stream) {
                    cells[(y * 8.0) as usize * 8 + (x * 8.0) as usize] += 1;
                }
                assert_eq!(cells, [1; 64], "{sampler:?}");
            }
        }
    }

    #[test]
    fn disks_keep_their_distance() {
        let nearest = |points: &[[f32; 2]]| {
            let mut least = 2.0f32;
            for (i, a) in points.iter().enumerate() {
                for b in &points[..i] {
                    let d: [f32; 2] = std::array::from_fn(|k| {
                        let d = (a[k] - b[k]).abs();
                        d.min(1.0 - d)
                    });
                    least = least.min((d[0] * d[0] + d[1] * d[1]).sqrt());
                }
            }
            least
        };
        for count in [16u32, 64, 256] {
            let apart = |sampler| (0..20).map(|s| nearest(&points(sampler, count, s))).sum::<f32>() / 20.0;
            // The densest packing of n disks in a unit square has centres 1.07/√n apart.
            let scale = (count as f32).sqrt().recip();
            assert!(
                apart(Sampler::PoissonDisk) > 0.5 * scale,
                "{count}: {}",
                apart(Sampler::PoissonDisk) / scale
            );
            assert!(apart(Sampler::Random) < 0.2 * scale);
        }
    }

    #[test]
    fn numbers_are_uniform_and_keyed() {
        for sampler in OTHERS {
            let (mut sums, mut squares) = ([0.0f64; 4], [0.0f64; 4]);
            let (pixels, count) = (500u64, 16u32);
            let numbers = Numbers::new(sampler, count);
            for stream in 0..pixels {
                for i in 0..u64::from(count) {
                    let mut sequence = numbers.sequence(3, stream, i, 0);
                    sequence.next4();
                    for (k, u) in sequence.next4().into_iter().enumerate() {
                        assert!((0.0..1.0).contains(&u));
                        sums[k] += f64::from(u);
                        squares[k] += f64::from(u) * f64::from(u);
                    }
                }
            }
            let n = (pixels * u64::from(count)) as f64;
            for k in 0..4 {
                assert!((sums[k] / n - 0.5).abs() < 0.015, "{sampler:?} {k}: {}", sums[k] / n);
                assert!((squares[k] / n - 1.0 / 3.0).abs() < 0.015, "{sampler:?} {k}");
            }
            let at =
                |seed, stream, sample, replicate| numbers.sequence(seed, stream, sample, replicate).next4();
            let base = at(7, 3, 0, 0);
            if sampler != Sampler::Stratified {
                for other in
                    [at(8, 3, 0, 0), at(7, 4, 0, 0), at(7, 3, 1, 0), at(7, 3, 4096, 0), at(7, 3, 0, 1)]
                {
                    assert_ne!(base, other, "{sampler:?}");
                }
            }
            assert_eq!(base, at(7, 3, 0, 0));
        }
    }
}
