//! Independent random numbers for tests: SplitMix64.
//!
//! The renderer draws from low-discrepancy sequences, whose points are not independent; the laws of chi-square
//! and of standard errors need points that are. Source: Steele, Lea and Flood, "Fast splittable pseudorandom
//! number generators", OOPSLA 2014 (period 2⁶⁴).

/// A stream of independent numbers, the same for the same seed on every machine.
///
/// ```
/// use illuminant_verify::random::Random;
/// let (mut a, mut b) = (Random::new(7), Random::new(7));
/// let u = a.unit();
/// assert!((0.0..1.0).contains(&u) && u == b.unit());
/// ```
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The stream with this seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [0, 1), a multiple of 2⁻⁵³.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (-53f64).exp2()
    }

    /// Several numbers in [0, 1).
    pub fn units<const D: usize>(&mut self) -> [f64; D] {
        std::array::from_fn(|_| self.unit())
    }

    /// Several numbers in [0, 1) as f32, multiples of 2⁻²⁴: none is rounded up to 1.
    pub fn singles<const D: usize>(&mut self) -> [f32; D] {
        std::array::from_fn(|_| (self.bits() >> 40) as f32 * (-24f32).exp2())
    }

    /// A direction, all of the sphere alike.
    pub fn direction(&mut self) -> [f64; 3] {
        illuminant_optics::hemisphere::sphere(self.units())
    }
}

/// Points that fill the unit cube of D dimensions evenly: for means, whose error then falls nearly as 1/N.
///
/// The additive recurrence u_k = frac(shift + k α) with α_j = φ^−(j+1), φ the positive root of x^(D+1) = x + 1
/// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"), shifted at random.
#[derive(Clone, Debug)]
pub struct EvenPoints<const D: usize> {
    point: [f64; D],
    step: [f64; D],
}

impl<const D: usize> EvenPoints<D> {
    /// The sequence with the shift of this seed.
    ///
    /// ```
    /// use illuminant_verify::random::EvenPoints;
    /// let mut points = EvenPoints::<2>::new(3);
    /// let mean = (0..1000).map(|_| { let [u, v] = points.next_point(); u * v }).sum::<f64>() / 1000.0;
    /// assert!((mean - 0.25).abs() < 2e-3);
    /// ```
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let mut root = 1.5f64;
        for _ in 0..64 {
            root = (1.0 + root).powf(1.0 / (D as f64 + 1.0));
        }
        let step = std::array::from_fn(|j| root.powi(-(j as i32 + 1)));
        Self { point: Random::new(seed).units(), step }
    }

    /// The next point, each coordinate in [0, 1).
    pub fn next_point(&mut self) -> [f64; D] {
        for (x, step) in self.point.iter_mut().zip(self.step) {
            *x = (*x + step).fract();
        }
        self.point
    }
}

/// A number of [0, 1) as f32, rounded down to a multiple of 2⁻²⁴: never 1.
#[must_use]
pub fn single(u: f64) -> f32 {
    ((u * 24f64.exp2()).floor() * (-24f64).exp2()) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_sequence() {
        // First outputs of the reference implementation (Vigna, splitmix64.c) for the seed 1234567.
        let mut random = Random::new(1_234_567);
        let drawn: [u64; 3] = std::array::from_fn(|_| random.bits());
        assert_eq!(drawn, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn the_largest_single_is_below_one() {
        assert!((u64::MAX >> 40) as f32 * (-24f32).exp2() < 1.0);
        assert!(single(1.0 - f64::EPSILON) < 1.0 && single(0.0) == 0.0);
    }
}
