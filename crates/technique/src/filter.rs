//! The reconstruction filter, sampled by importance: a sample belongs to one pixel and counts once.

use serde::{Deserialize, Serialize};

/// A filter around the centre of a pixel, the product of one function of x and the same of y.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Filter {
    /// Constant within `radius` pixels.
    Box {
        /// Half-width, pixels.
        #[serde(default = "half")]
        radius: f32,
    },
    /// Falling linearly to zero at `radius`.
    Tent {
        /// Half-width, pixels.
        #[serde(default = "one")]
        radius: f32,
    },
    /// A Gaussian of standard deviation `radius` / 3, cut off at `radius`.
    Gaussian {
        /// Half-width, pixels.
        #[serde(default = "one_and_a_half")]
        radius: f32,
    },
    /// The cubic of Mitchell and Netravali (1988) with B = C = ⅓, over `radius` = 2 pixels if it is theirs. It is negative in places.
    Mitchell {
        /// Half-width, pixels.
        #[serde(default = "two")]
        radius: f32,
    },
    /// The window of four cosines of Blackman and Harris (1978).
    BlackmanHarris {
        /// Half-width, pixels.
        #[serde(default = "one_and_a_half")]
        radius: f32,
    },
}

fn half() -> f32 {
    0.5
}

fn one() -> f32 {
    1.0
}

fn two() -> f32 {
    2.0
}

fn one_and_a_half() -> f32 {
    1.5
}

impl Default for Filter {
    fn default() -> Self {
        Self::Gaussian { radius: one_and_a_half() }
    }
}

impl Filter {
    /// The half-width, pixels.
    #[must_use]
    pub fn radius(&self) -> f32 {
        match self {
            Self::Box { radius }
            | Self::Tent { radius }
            | Self::Gaussian { radius }
            | Self::Mitchell { radius }
            | Self::BlackmanHarris { radius } => *radius,
        }
    }

    fn value(&self, x: f64) -> f64 {
        let r = f64::from(self.radius());
        match self {
            Self::Box { .. } => 1.0,
            Self::Tent { .. } => (1.0 - x.abs() / r).max(0.0),
            Self::Gaussian { .. } => {
                let sigma = r / 3.0;
                (-0.5 * (x / sigma).powi(2)).exp()
            }
            Self::Mitchell { .. } => {
                let x = (2.0 * x / r).abs();
                if x < 1.0 {
                    (7.0 * x.powi(3) - 12.0 * x.powi(2) + 16.0 / 3.0) / 6.0
                } else {
                    (-7.0 / 3.0 * x.powi(3) + 12.0 * x.powi(2) - 20.0 * x + 32.0 / 3.0) / 6.0
                }
            }
            Self::BlackmanHarris { .. } => {
                let t = std::f64::consts::PI * (x / r + 1.0);
                0.35875 - 0.48829 * t.cos() + 0.14128 * (2.0 * t).cos() - 0.01168 * (3.0 * t).cos()
            }
        }
    }
}

/// A filter's inverse distribution, tabulated.
///
/// Offsets are drawn by |f|. Where f is negative a sample counts −1, and all are scaled so that the mean weight is 1.
#[derive(Clone, Debug)]
pub struct FilterSampler {
    filter: Filter,
    /// ∫f.
    integral: f64,
    offsets: Vec<f32>,
    /// Where f changes its sign: it is negative beyond.
    sign_change: f32,
    /// ∫|f| over ∫f.
    scale: f32,
}

impl FilterSampler {
    const CELLS: usize = 1024;

    /// Tabulates a filter.
    #[must_use]
    pub fn new(filter: &Filter) -> Self {
        let fine = 64 * Self::CELLS;
        let radius = f64::from(filter.radius());
        let x = |i: usize| radius * (2.0 * (i as f64) / fine as f64 - 1.0);
        let mut sums = vec![0.0; fine + 1];
        let mut signed = 0.0;
        for i in 0..fine {
            let value = filter.value((x(i) + x(i + 1)) / 2.0);
            sums[i + 1] = sums[i] + value.abs();
            signed += value;
        }
        let total = sums[fine];
        let offsets = (0..=Self::CELLS).map(|k| {
            let wanted = total * k as f64 / Self::CELLS as f64;
            let i = sums.partition_point(|&s| s < wanted).clamp(1, fine);
            let width = sums[i] - sums[i - 1];
            let t = if width > 0.0 { (wanted - sums[i - 1]) / width } else { 0.0 };
            (x(i - 1) + t.clamp(0.0, 1.0) * (x(i) - x(i - 1))) as f32
        });
        // The outer cubic is (x − 2)² (8 − 7 x)/18 at a radius of 2.
        let sign_change = match filter {
            Filter::Mitchell { radius } => radius * (4.0 / 7.0),
            _ => f32::MAX,
        };
        let (offsets, scale) = (offsets.collect(), (total / signed) as f32);
        let integral = signed * (x(1) - x(0));
        Self { filter: *filter, integral, offsets, sign_change, scale }
    }

    /// One of the pixels along an axis that see a place, drawn by what it counts for them from a number in [0, 1): the number of the pixel,
    /// and what the place counts for it then. On average each pixel receives what [`Self::offset`] would find.
    #[must_use]
    pub fn pixel(&self, place: f32, u: f32) -> [f32; 2] {
        let (place, radius) = (f64::from(place), f64::from(self.filter.radius()));
        let first = (place - radius - 0.5).ceil();
        let value = |i: f64| {
            let x = place - (first + i) - 0.5;
            if x.abs() < radius { self.filter.value(x) } else { 0.0 }
        };
        let count = (2.0 * radius).ceil() as u32 + 1;
        let sum: f64 = (0..count).map(|i| value(f64::from(i)).abs()).sum();
        let mut left = f64::from(u) * sum;
        let chosen = (0..count).map(f64::from).find(|&i| {
            left -= value(i).abs();
            left < 0.0
        });
        let Some(chosen) = chosen else { return [first as f32, 0.0] };
        [(first + chosen) as f32, (value(chosen).signum() * sum / self.integral) as f32]
    }

    /// An offset from the centre of the pixel, drawn by the filter, from a number in [0, 1).
    #[inline(always)]
    #[must_use]
    pub fn offset(&self, u: f32) -> f32 {
        let position = u * Self::CELLS as f32;
        let i = (position as usize).min(Self::CELLS - 1);
        let t = position - i as f32;
        self.offsets[i] + t * (self.offsets[i + 1] - self.offsets[i])
    }

    /// Whether all samples count the same.
    #[inline(always)]
    #[must_use]
    pub fn is_positive(&self) -> bool {
        self.sign_change == f32::MAX
    }

    /// What a sample at these offsets counts; 1 for filters that are nowhere negative.
    #[inline(always)]
    #[must_use]
    pub fn weight(&self, offsets: [f32; 2]) -> f32 {
        if self.is_positive() {
            return 1.0;
        }
        offsets.iter().fold(1.0, |w, x| w * self.scale * (self.sign_change - x.abs()).signum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_shared_out_among_pixels_as_pixels_draw_them() {
        for filter in [
            Filter::Box { radius: 0.5 },
            Filter::Box { radius: 0.8 },
            Filter::Tent { radius: 1.0 },
            Filter::Gaussian { radius: 1.5 },
            Filter::Mitchell { radius: 2.0 },
        ] {
            let sampler = FilterSampler::new(&filter);
            // Places all over a line: every pixel receives 1, and from places at their mean distance.
            let (n, mut sum, mut squares) = (200_000u32, 0.0f64, 0.0f64);
            for i in 0..n {
                let place = 20.0 * (i as f32 + 0.5) / n as f32;
                let u = (f64::from(i) * 0.618_033_988_749_895).fract();
                let [pixel, weight] = sampler.pixel(place, u as f32);
                if pixel == 10.0 {
                    sum += f64::from(weight);
                    squares += f64::from(weight * (place - 10.5) * (place - 10.5));
                }
            }
            let per_unit = f64::from(n) / 20.0;
            assert!((sum / per_unit - 1.0).abs() < 2e-2, "{filter:?} {}", sum / per_unit);
            let expected: f64 = (0..n)
                .map(|i| {
                    let x = sampler.offset((i as f32 + 0.5) / n as f32);
                    let weight = sampler.weight([x, 0.0]) / sampler.weight([0.0, 0.0]).sqrt();
                    f64::from(weight * x * x)
                })
                .sum::<f64>()
                / f64::from(n);
            assert!((squares / per_unit / expected - 1.0).abs() < 4e-2, "{filter:?} {squares} {expected}");
        }
    }

    #[test]
    fn variances_are_those_of_the_filters() {
        let gaussian = {
            // A normal distribution cut off at three standard deviations.
            let sigma: f64 = 0.5;
            sigma * sigma * 0.9733
        };
        for (filter, variance) in [
            (Filter::Box { radius: 0.5 }, 1.0 / 12.0),
            (Filter::Tent { radius: 1.0 }, 1.0 / 6.0),
            (Filter::Gaussian { radius: 1.5 }, gaussian),
            (Filter::Mitchell { radius: 2.0 }, 1.0 / 9.0),
            // By numerical integration.
            (Filter::BlackmanHarris { radius: 1.5 }, 0.172_658_5),
        ] {
            let sampler = FilterSampler::new(&filter);
            let n = 100_000;
            let (mut sum, mut squares, mut weights) = (0.0f64, 0.0f64, 0.0f64);
            for i in 0..n {
                let x = sampler.offset((i as f32 + 0.5) / n as f32);
                // Along one axis.
                let weight = f64::from(sampler.weight([x, 0.0]) / sampler.weight([0.0, 0.0]).sqrt());
                let x = f64::from(x);
                weights += weight;
                sum += weight * x;
                squares += weight * x * x;
            }
            assert!((weights / f64::from(n) - 1.0).abs() < 2e-3, "{filter:?} {weights}");
            let found = squares / f64::from(n);
            assert!((sum / f64::from(n)).abs() < 1e-4);
            // The table is coarse in the long tails of the window of cosines.
            let most = if matches!(filter, Filter::BlackmanHarris { .. }) { 4e-3 } else { 2e-3 };
            assert!((found / variance - 1.0).abs() < most, "{filter:?} {found} {variance}");
        }
    }
}
