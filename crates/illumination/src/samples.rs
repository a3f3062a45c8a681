//! The spectral values that the historical models compute with.

use illuminant_sampling::Lanes;
use std::ops::{Add, AddAssign, Mul};

/// One value or many: an f64 for analysis, the lanes of a path, or lanes with one number that stands for all of them.
///
/// The geometry of a model is computed once, in f64; what depends on wavelength, by this trait.
pub trait Samples:
    Copy + std::fmt::Debug + Default + Add<Output = Self> + AddAssign + Mul<Output = Self> + Send + Sync
{
    /// The same value everywhere.
    fn splat(value: f64) -> Self;

    /// All values times a factor.
    #[must_use]
    fn times(self, factor: f64) -> Self;

    /// Negative values as 0.
    #[must_use]
    fn positive(self) -> Self;

    /// 1 minus all values.
    #[must_use]
    fn complement(self) -> Self {
        Self::splat(1.0) + self.times(-1.0)
    }
}

impl Samples for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn positive(self) -> Self {
        self.max(0.0)
    }
}

impl<const N: usize> Samples for Lanes<N> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self::splat(value as f32)
    }

    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self * factor as f32
    }

    #[inline(always)]
    fn positive(self) -> Self {
        self.map(|v| v.max(0.0))
    }
}

/// Lanes, and the brightness by which paths decide.
#[derive(Clone, Copy, Debug, Default)]
pub struct Weighed<const N: usize> {
    /// The value in every lane.
    pub lanes: Lanes<N>,
    /// The same for the whole spectrum as one number.
    pub brightness: f64,
}

impl<const N: usize> Add for Weighed<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { lanes: self.lanes + other.lanes, brightness: self.brightness + other.brightness }
    }
}

impl<const N: usize> AddAssign for Weighed<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const N: usize> Mul for Weighed<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { lanes: self.lanes * other.lanes, brightness: self.brightness * other.brightness }
    }
}

impl<const N: usize> Samples for Weighed<N> {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self { lanes: Samples::splat(value), brightness: value }
    }

    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        Self { lanes: Samples::times(self.lanes, factor), brightness: self.brightness * factor }
    }

    #[inline(always)]
    fn positive(self) -> Self {
        Self { lanes: Samples::positive(self.lanes), brightness: self.brightness.max(0.0) }
    }
}
