//! The random numbers of a path: Owen-scrambled Sobol (Burley 2020), keyed by seed, pixel, sample and dimension.

/// Samples that one scramble of the sequence holds; beyond them another seed is taken.
const SAMPLES: u64 = 1 << 16;
/// Sets of four dimensions that one scramble holds.
const SETS: u32 = 64;

/// A good hash of two words (the finaliser of splitmix64).
#[must_use]
pub(crate) fn mix(a: u64, b: u64) -> u64 {
    let mut z = a.wrapping_add(b.wrapping_mul(0x9E37_79B9_7F4A_7C15)).wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The numbers of one sample of one pixel, four at a time. The same (seed, stream, sample) gives the same numbers
/// whatever was drawn before.
#[derive(Clone, Copy, Debug)]
pub struct Sequence {
    index: u32,
    seed: u64,
    set: u32,
}

impl Sequence {
    /// The numbers of a sample. `stream` names the pixel; `replicate` picks one of several independent scrambles.
    #[inline(always)]
    #[must_use]
    pub fn new(seed: u64, stream: u64, sample: u64, replicate: u64) -> Self {
        let block = sample / SAMPLES;
        let seed = mix(mix(seed, stream), block << 8 | replicate);
        Self { index: (sample % SAMPLES) as u32, seed, set: 0 }
    }

    /// The next four numbers in [0, 1), well spread together over the samples of a pixel.
    #[inline(always)]
    pub fn next4(&mut self) -> [f32; 4] {
        let set = self.set;
        self.set += 1;
        let seed = if set < SETS { self.seed } else { mix(self.seed, u64::from(set / SETS)) };
        sobol_burley::sample_4d(self.index, set % SETS, (seed >> 32) as u32 ^ seed as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_stratified_and_keyed() {
        let n = 256u64;
        let mut cells = vec![0u32; n as usize];
        for i in 0..n {
            let u = Sequence::new(7, 3, i, 0).next4();
            assert!(u.iter().all(|v| (0.0..1.0).contains(v)));
            cells[(u[0] * 16.0) as usize * 16 + (u[1] * 16.0) as usize] += 1;
        }
        assert!(cells.iter().all(|&c| c == 1), "256 points fill 16 × 16 cells, one each");
        assert_ne!(Sequence::new(7, 3, 0, 0).next4(), Sequence::new(7, 4, 0, 0).next4());
        assert_ne!(Sequence::new(7, 3, 0, 0).next4(), Sequence::new(7, 3, 65_536, 0).next4());
        assert_ne!(Sequence::new(7, 3, 0, 0).next4(), Sequence::new(7, 3, 0, 1).next4());
        let mut long = Sequence::new(7, 3, 5, 0);
        let first = long.next4();
        for _ in 0..200 {
            assert!(long.next4().iter().all(|v| (0.0..1.0).contains(v)));
        }
        assert_ne!(first, long.next4());
    }
}
