//! Points spread evenly over a unit cube of up to four dimensions.

/// An additive sequence: point k is k·α modulo 1 with the powers of the generalised golden ratio (Roberts 2018), shifted by a hash, so
/// that each element has points of its own (Cranley and Patterson 1976).
#[derive(Clone, Copy, Debug)]
pub struct Kronecker<const D: usize> {
    shift: [u64; D],
    step: [u64; D],
}

/// The finaliser of splitmix64.
fn mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

impl<const D: usize> Kronecker<D> {
    /// The sequence of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        // The root above 1 of x^(D+1) = x + 1.
        let mut root = 2f64;
        for _ in 0..60 {
            let power = root.powi(D as i32);
            root -= (power * root - root - 1.0) / ((D as f64 + 1.0) * power - 1.0);
        }
        let step = std::array::from_fn(|i| (root.powi(-(i as i32 + 1)) * 2f64.powi(64)) as u64);
        Self { shift: std::array::from_fn(|i| mix(seed ^ mix(i as u64))), step }
    }

    /// Point k.
    #[inline]
    #[must_use]
    pub fn point(&self, k: u64) -> [f32; D] {
        std::array::from_fn(|i| {
            let bits = self.shift[i].wrapping_add(k.wrapping_mul(self.step[i]));
            // 24 bits, so that the number stays below 1.
            (bits >> 40) as f32 * (1.0 / 16_777_216.0)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_spread_more_evenly_than_chance_would() {
        let sequence = Kronecker::<4>::new(7);
        let count = 4096;
        for i in 0..4 {
            for j in 0..i {
                // The mean of u_i u_j over a square is 1/4; chance would miss it by 0.22/√4096 = 0.0034.
                let sum: f64 =
                    (0..count).map(|k| sequence.point(k)).map(|p| f64::from(p[i]) * f64::from(p[j])).sum();
                let off = (sum / f64::from(count as u32) - 0.25).abs();
                assert!(off < 0.0017, "{i} {j}: {off}");
            }
        }
    }
}
