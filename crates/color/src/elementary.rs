//! Elementary functions that a compiler can run over many values at once, in f64 and f32.
//!
//! Cube root, power, and what they need, without branches and without tables, so that a loop over an array becomes
//! vector instructions. The formulas of this room are written once over [`Real`], for both widths.
//!
//! | function | method | largest relative error, f64 | f32 |
//! | --- | --- | --- | --- |
//! | [`Real::cbrt`] | x · (x^(−1/3))², by the series of (1 − h)^(−1/3), with a last step of Newton | 3 × 10⁻¹⁶ | 2 × 10⁻⁷ |
//! | [`Real::pow`] | 2^(p log₂ x), by the series of artanh and of exp, in f64 | 10⁻¹³ | 10⁻⁷ |
//!
//! The errors are those of normal numbers, for `pow` with results from 2⁻²⁰⁰ to 2²⁰⁰ (measured by the tests). Zero,
//! infinity and NaN are what they are in the standard library; a base of `pow` below the smallest normal number
//! counts as 0.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number of either width: f64, or f32.
pub trait Real:
    Copy
    + Send
    + Sync
    + PartialOrd
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// The number nearest to an f64.
    fn of(value: f64) -> Self;
    /// The same number as f64.
    fn f64(self) -> f64;
    /// The absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// This magnitude with the sign of another number.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// `self` × a + b, rounded once.
    #[must_use]
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// The cube root, odd: that of −x is minus that of x.
    #[must_use]
    fn cbrt(self) -> Self;
    /// This number, not negative, to a positive power.
    #[must_use]
    fn pow(self, exponent: f64) -> Self;
    /// The first number if the condition holds, else the second: by bits, so that no branch comes of it.
    #[must_use]
    fn select(condition: bool, yes: Self, no: Self) -> Self;
    /// The larger of two numbers; which one when one of them is NaN is not said.
    #[must_use]
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::select(self > other, self, other)
    }
    /// The smaller of two numbers; which one when one of them is NaN is not said.
    #[must_use]
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self::select(self < other, self, other)
    }
}

impl Real for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn f64(self) -> f64 {
        self
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f64::copysign(self, sign)
    }
    #[inline(always)]
    fn select(condition: bool, yes: Self, no: Self) -> Self {
        let mask = u64::from(condition).wrapping_neg();
        Self::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        f64::mul_add(self, a, b)
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        let x = f64::abs(self);
        // A third of the exponent by integers. Only the upper half is divided: by a product, for which there is a
        // vector instruction.
        let third = ((x.to_bits() >> 32) * 0xAAAA_AAAB) >> 33;
        let mut y = f64::from_bits(0x553e_f0ff_u64.wrapping_sub(third) << 32);
        let mut h = f64::mul_add(-(x * y), y * y, 1.0);
        y *= 1.0 + h * series(h);
        h = f64::mul_add(-(x * y), y * y, 1.0);
        y *= f64::mul_add(h, f64::mul_add(h, 2.0 / 9.0, 1.0 / 3.0), 1.0);
        let root = x * y * y;
        // Newton, with root² in two parts: the residual is a difference of numbers that almost agree.
        let square = root * root;
        let rest = f64::mul_add(root, root, -square);
        let residual = f64::mul_add(rest, root, f64::mul_add(square, root, -x));
        let root = f64::mul_add(-residual, y * y / 3.0, root);
        // Infinity and NaN are their own roots.
        Self::select(x <= Self::MAX, f64::copysign(root, self), self)
    }
    #[inline(always)]
    fn pow(self, exponent: f64) -> Self {
        power(self, exponent, log2_of_mantissa, exp_of_small)
    }
}

impl Real for f32 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value as f32
    }
    #[inline(always)]
    fn f64(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f32::abs(self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        f32::copysign(self, sign)
    }
    #[inline(always)]
    fn select(condition: bool, yes: Self, no: Self) -> Self {
        let mask = u32::from(condition).wrapping_neg();
        Self::from_bits((yes.to_bits() & mask) | (no.to_bits() & !mask))
    }
    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        f32::mul_add(self, a, b)
    }
    #[inline(always)]
    fn cbrt(self) -> Self {
        let x = f32::abs(self);
        let mut y = f32::from_bits(0x54a2_1d2a_u32.wrapping_sub(x.to_bits() / 3));
        let h = f32::mul_add(-(x * y), y * y, 1.0);
        y *= 1.0 + h * series(h);
        let root = x * y * y;
        let residual = f32::mul_add(root * root, root, -x);
        let root = f32::mul_add(-residual, y * y * (1.0 / 3.0), root);
        Self::select(x <= Self::MAX, f32::copysign(root, self), self)
    }
    #[inline(always)]
    fn pow(self, exponent: f64) -> Self {
        // A power of f32 is one of f64 with fewer terms: f32 has not the digits for the logarithm.
        power(f64::from(self), exponent, log2_of_mantissa_single, exp_of_small_single) as f32
    }
}

/// ((1 − h)^(−1/3) − 1) / h to the fifth order.
#[inline(always)]
fn series<T: Real>(h: T) -> T {
    let mut sum = T::of(91.0 / 729.0);
    for coefficient in [35.0 / 243.0, 14.0 / 81.0, 2.0 / 9.0, 1.0 / 3.0] {
        sum = sum.mul_add(h, T::of(coefficient));
    }
    sum
}

/// A polynomial, by Horner's rule, from its coefficients in rising order. Written out: a loop within the loop over an
/// array would keep it from becoming vector instructions.
macro_rules! polynomial {
    ($x:expr; $last:expr) => { $last };
    ($x:expr; $first:expr, $($rest:expr),+) => { f64::mul_add(polynomial!($x; $($rest),+), $x, $first) };
}

/// x^p for x ≥ 0, p > 0, from log₂ of a mantissa in [√½, √2) and exp of a number within ±ln 2 / 2.
#[inline(always)]
fn power(x: f64, exponent: f64, logarithm: impl Fn(f64) -> f64, exponential: impl Fn(f64) -> f64) -> f64 {
    const ROOT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
    const ONE: u64 = 1023 << 52;
    // The exponent stays biased by 1023, so that it is never negative: there is no vector shift with sign.
    let whole = x.to_bits().wrapping_add(ONE - ROOT_HALF) >> 52;
    let mantissa = f64::from_bits(x.to_bits().wrapping_sub(whole << 52).wrapping_add(ONE));
    // 2^52 + exponent, written down as bits, gives the exponent as a number.
    let whole = f64::from_bits(whole | 0x4330_0000_0000_0000) - (4_503_599_627_370_496.0 + 1023.0);
    let y = exponent * (whole + logarithm(mantissa));

    // 2^y: adding 1.5 × 2^52 rounds to the nearest whole number and leaves it in the lowest bits.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    let inside = f64::select(y < -1022.0, -1022.0, y);
    let inside = f64::select(inside > 1023.0, 1023.0, inside);
    let shifted = inside + SHIFT;
    let rest = exponential((inside - (shifted - SHIFT)) * std::f64::consts::LN_2);
    let found = rest * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);

    let found = f64::select(y > 1023.5, f64::INFINITY, found);
    let found = f64::select((y < -1022.5) | (x < f64::MIN_POSITIVE), 0.0, found);
    // Infinity and NaN are their own powers.
    f64::select(x <= f64::MAX, found, x)
}

/// log₂ m = 2 artanh(s) / ln 2, s = (m − 1)/(m + 1), |s| ≤ 0.172: the next term is below 2⁻⁵⁵ of the sum.
#[inline(always)]
fn log2_of_mantissa(mantissa: f64) -> f64 {
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    let sum = polynomial!(s * s; 1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 1.0 / 13.0,
        1.0 / 15.0, 1.0 / 17.0, 1.0 / 19.0);
    2.0 * std::f64::consts::LOG2_E * s * sum
}

/// [`log2_of_mantissa`] to the digits of f32.
#[inline(always)]
fn log2_of_mantissa_single(mantissa: f64) -> f64 {
    let s = (mantissa - 1.0) / (mantissa + 1.0);
    2.0 * std::f64::consts::LOG2_E * s * polynomial!(s * s; 1.0, 1.0 / 3.0, 1.0 / 5.0, 1.0 / 7.0, 1.0 / 9.0)
}

/// eᶻ for |z| ≤ ln 2 / 2: the next term is below 2⁻⁵⁵.
#[inline(always)]
fn exp_of_small(z: f64) -> f64 {
    polynomial!(z; 1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0,
        1.0 / 40_320.0, 1.0 / 362_880.0, 1.0 / 3_628_800.0, 1.0 / 39_916_800.0, 1.0 / 479_001_600.0,
        1.0 / 6_227_020_800.0)
}

/// [`exp_of_small`] to the digits of f32.
#[inline(always)]
fn exp_of_small_single(z: f64) -> f64 {
    polynomial!(z; 1.0, 1.0, 1.0 / 2.0, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5040.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bases spread evenly over their exponents, from 2^first to 2^last.
    fn bases(first: f64, last: f64) -> impl Iterator<Item = f64> {
        const COUNT: usize = 200_000;
        (0..=COUNT).map(move |i| (first + (last - first) * i as f64 / COUNT as f64).exp2() * 1.000_123)
    }

    #[test]
    fn cube_roots_keep_their_stated_error() {
        let (mut double, mut single) = (0.0f64, 0.0f64);
        for x in bases(-1020.0, 1020.0) {
            double = double.max((Real::cbrt(x) / x.cbrt() - 1.0).abs());
        }
        for x in bases(-125.0, 126.0) {
            let x = x as f32;
            single = single.max((f64::from(Real::cbrt(x)) / f64::from(x).cbrt() - 1.0).abs());
        }
        assert!(double <= 3e-16 && single <= 2e-7, "{double:e} {single:e}");
        assert!(double > 0.0 && single > 1e-8, "measured nothing");
    }

    #[test]
    fn powers_keep_their_stated_error() {
        for exponent in [1.0f64 / 2.4, 2.4, 0.45, 1.0 / 0.45, 1.0 / 2.2, 2.2, 3.0] {
            let (mut double, mut single) = (0.0f64, 0.0f64);
            for x in bases(-200.0 / exponent.max(1.0), 200.0 / exponent.max(1.0)) {
                double = double.max((Real::pow(x, exponent) / x.powf(exponent) - 1.0).abs());
            }
            for x in bases(-30.0, 30.0) {
                let x = x as f32;
                let exact = f64::from(x).powf(exponent);
                single = single.max((f64::from(Real::pow(x, exponent)) / exact - 1.0).abs());
            }
            assert!(double <= 1e-13 && single <= 1e-7, "{exponent}: {double:e} {single:e}");
        }
    }

    #[test]
    fn powers_of_the_display_are_good_to_the_last_digits() {
        let mut worst = 0.0f64;
        for x in bases(-14.0, 3.0) {
            worst = worst.max((Real::pow(x, 1.0 / 2.4) / x.powf(1.0 / 2.4) - 1.0).abs());
        }
        assert!(worst <= 2e-15, "{worst:e}");
    }

    #[test]
    fn the_edges_are_those_of_the_standard_library() {
        for x in [0.0f64, -0.0, 1.0, -1.0, 8.0, -27.0, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Real::cbrt(x).to_bits(), x.cbrt().to_bits(), "{x}");
            let single = x as f32;
            assert_eq!(Real::cbrt(single).to_bits(), single.cbrt().to_bits(), "{x} as f32");
        }
        for x in [0.0f64, 1.0, f64::INFINITY] {
            assert_eq!(Real::pow(x, 2.4), x.powf(2.4), "{x}");
            assert_eq!(Real::pow(x as f32, 2.4), (x as f32).powf(2.4), "{x} as f32");
        }
        assert!(Real::cbrt(f64::NAN).is_nan() && Real::pow(f64::NAN, 0.5).is_nan());
        assert!(Real::cbrt(f32::NAN).is_nan() && Real::pow(f32::NAN, 0.5).is_nan());
        assert_eq!(Real::pow(1e300, 2.0), f64::INFINITY);
        assert_eq!(Real::pow(1e-300, 2.0), 0.0);
        // 10^(−310) is not normal: no digits, but no nonsense either.
        assert!(Real::cbrt(1e-310) >= 0.0 && Real::cbrt(1e-310) < 1e-100);
    }
}
