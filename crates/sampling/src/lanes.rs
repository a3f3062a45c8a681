//! The values carried along a path.

use std::ops::{Add, AddAssign, Div, Index, IndexMut, Mul, MulAssign, Sub};

/// The sizes of bundle that the core is compiled for.
pub const LANE_COUNTS: [usize; 4] = [4, 8, 16, 32];

/// The smallest compiled size that holds `samples` values; the rest of the bundle is padding. `None` above 32.
#[must_use]
pub fn lanes_for(samples: usize) -> Option<usize> {
    LANE_COUNTS.into_iter().find(|&n| n >= samples)
}

/// N spectral values that travel together, one to a SIMD lane.
///
/// ```
/// use illuminant_sampling::Lanes;
/// let grey = Lanes::<4>::splat(0.5);
/// assert_eq!((grey * grey)[2], 0.25);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Lanes<const N: usize>(pub [f32; N]);

impl<const N: usize> Default for Lanes<N> {
    fn default() -> Self {
        Self::splat(0.0)
    }
}

impl<const N: usize> Lanes<N> {
    /// The same value in every lane.
    #[inline(always)]
    #[must_use]
    pub const fn splat(value: f32) -> Self {
        Self([value; N])
    }

    /// Values from a slice; lanes beyond its end are zero.
    #[must_use]
    pub fn from_slice(values: &[f64]) -> Self {
        let mut lanes = Self::default();
        for (lane, value) in lanes.0.iter_mut().zip(values) {
            *lane = *value as f32;
        }
        lanes
    }

    /// Each lane by its number.
    #[inline(always)]
    #[must_use]
    pub fn from_fn(f: impl Fn(usize) -> f32) -> Self {
        // A plain loop: `array::from_fn` leaves a call a lane where `f` is long.
        let mut all = [0.0; N];
        for (i, v) in all.iter_mut().enumerate() {
            *v = f(i);
        }
        Self(all)
    }

    /// A function of each lane.
    #[inline(always)]
    #[must_use]
    pub fn map(mut self, f: impl Fn(f32) -> f32) -> Self {
        for v in &mut self.0 {
            *v = f(*v);
        }
        self
    }

    /// A function of each pair of lanes.
    #[inline(always)]
    #[must_use]
    pub fn zip(mut self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        for (v, w) in self.0.iter_mut().zip(&other.0) {
            *v = f(*v, *w);
        }
        self
    }

    /// self · a + b, lane by lane, rounded once.
    #[inline(always)]
    #[must_use]
    pub fn mul_add(self, a: Self, b: Self) -> Self {
        Self::from_fn(|i| self.0[i].mul_add(a.0[i], b.0[i]))
    }

    /// The sum of products with another bundle: one row of a map to XYZ. The order of the sum is fixed.
    #[inline(always)]
    #[must_use]
    pub fn dot(self, other: &Self) -> f32 {
        let mut partial = [0.0f32; 4];
        for i in 0..N {
            partial[i % 4] = self.0[i].mul_add(other.0[i], partial[i % 4]);
        }
        (partial[0] + partial[1]) + (partial[2] + partial[3])
    }

    /// Whether every lane is finite and not negative: what a radiance must be.
    #[inline(always)]
    #[must_use]
    pub fn is_radiance(&self) -> bool {
        self.0.iter().fold(true, |ok, v| ok & (*v >= 0.0) & (*v < f32::INFINITY))
    }

    /// Whether every lane is zero.
    #[inline(always)]
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.iter().fold(true, |zero, v| zero & (*v == 0.0))
    }

    /// The bundle in which only one lane is kept, times a factor.
    #[inline(always)]
    #[must_use]
    pub fn only(self, lane: usize, factor: f32) -> Self {
        let mut kept = Self::default();
        kept.0[lane] = self.0[lane] * factor;
        kept
    }
}

impl<const N: usize> Index<usize> for Lanes<N> {
    type Output = f32;
    fn index(&self, lane: usize) -> &f32 {
        &self.0[lane]
    }
}

impl<const N: usize> IndexMut<usize> for Lanes<N> {
    fn index_mut(&mut self, lane: usize) -> &mut f32 {
        &mut self.0[lane]
    }
}

macro_rules! lane_by_lane {
    ($($op:ident $method:ident $symbol:tt),*) => {$(
        impl<const N: usize> $op for Lanes<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, |a, b| a $symbol b)
            }
        }
    )*};
}
lane_by_lane!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<const N: usize> Mul<f32> for Lanes<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f32) -> Self {
        self.map(|a| a * factor)
    }
}

impl<const N: usize> AddAssign for Lanes<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> MulAssign for Lanes<N> {
    #[inline(always)]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const N: usize> MulAssign<f32> for Lanes<N> {
    #[inline(always)]
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn padding_is_zero_and_takes_no_part() {
        let lanes = Lanes::<8>::from_slice(&[1.0, 2.0, 3.0]);
        assert_eq!(lanes.dot(&Lanes::splat(1.0)), 6.0);
        assert_eq!(lanes_for(3), Some(4));
        assert_eq!(lanes_for(17), Some(32));
        assert_eq!(lanes_for(33), None);
    }

    #[test]
    fn a_radiance_is_finite_and_not_negative() {
        assert!(Lanes::<4>::splat(0.0).is_radiance());
        for bad in [f32::NAN, f32::INFINITY, -1.0] {
            let mut lanes = Lanes::<4>::splat(1.0);
            lanes[3] = bad;
            assert!(!lanes.is_radiance());
        }
    }
}
