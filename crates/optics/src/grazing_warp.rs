//! Steps over the cosine to the normal, even in angle near the normal and finer near grazing.

use crate::Real;

/// w of a cosine z in [0, 1]: with t = 1 − √(1 − z), which is even in angle near the normal, w = t (1 + κ)/(t + κ), whose
/// steps below κ are finer. What facets of slope m hide lies at cosines of the order of m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GrazingWarp<R> {
    pub(crate) kappa: R,
}

impl<R: Real> GrazingWarp<R> {
    /// Where a cosine lies, 0 to 1.
    #[inline(always)]
    pub(crate) fn of(self, cos: R) -> R {
        let t = R::one() - (R::one() - cos).max(R::zero()).sqrt();
        t * (R::one() + self.kappa) / (t + self.kappa)
    }

    /// How fast the cosine grows with w.
    #[inline(always)]
    pub(crate) fn slope(self, cos: R) -> R {
        let rest = (R::one() - cos).max(R::zero()).sqrt();
        let t = R::one() - rest + self.kappa;
        R::of(2.0) * rest * t * t / (self.kappa * (R::one() + self.kappa))
    }

    /// The cosine that lies at w.
    pub(crate) fn cosine(self, w: R) -> R {
        let t = self.kappa * w / (R::one() + self.kappa - w);
        let rest = R::one() - t;
        R::one() - rest * rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_agree() {
        let warp = GrazingWarp { kappa: 0.07f64 };
        for i in 0..=100 {
            let w = f64::from(i) / 100.0;
            assert!((warp.of(warp.cosine(w)) - w).abs() < 1e-9);
        }
        assert_eq!((warp.cosine(0.0), warp.cosine(1.0)), (0.0, 1.0));
    }
}
