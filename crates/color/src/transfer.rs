//! Transfer functions: how linear values become code values, and back.
//!
//! | name | code of a linear value v | source |
//! | --- | --- | --- |
//! | `sRGB` | 12.92 v up to 0.0031308, then 1.055 v^(1/2.4) − 0.055 | IEC 61966-2-1 |
//! | `Rec.709` | 4.5 v below β, then α v^0.45 − (α − 1) | ITU-R BT.709 and BT.2020, α and β at full precision |
//! | `gamma γ` | v^(1/γ), and −\|v\|^(1/γ) below 0 | book eq 5.1 |
//! | `linear` | v | |
//!
//! Nothing is clamped: above 1 the curves go on, and below 0 the straight parts do.

use crate::Real;

/// How an RGB system turns linear values into code values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Transfer {
    /// The piecewise curve of IEC 61966-2-1.
    Srgb,
    /// The camera curve of ITU-R BT.709 and BT.2020.
    Rec709,
    /// A power law with this exponent: code = value^(1/γ).
    Gamma(f64),
    /// No curve at all.
    Linear,
}

const SRGB_LINEAR: f64 = 0.003_130_8;
const SRGB_CODE: f64 = 12.92 * SRGB_LINEAR;
const ALPHA: f64 = 1.099_296_826_809_44;
const BETA: f64 = 0.018_053_968_510_807;

impl Transfer {
    /// The transfer function of a name (`sRGB`, `Rec.709`, `gamma 2.2`, `linear`), whatever its case; a γ is positive.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let lower = name.to_ascii_lowercase();
        match lower.as_str() {
            "srgb" => Some(Self::Srgb),
            "rec.709" => Some(Self::Rec709),
            "linear" => Some(Self::Linear),
            other => {
                let gamma: f64 = other.strip_prefix("gamma ")?.trim().parse().ok()?;
                (gamma > 0.0 && gamma.is_finite()).then_some(Self::Gamma(gamma))
            }
        }
    }

    /// The code value of a linear value.
    ///
    /// ```
    /// use illuminant_color::Transfer;
    /// assert!((Transfer::Srgb.encode(0.18) - 0.461_356).abs() < 1e-6);
    /// assert_eq!(Transfer::Gamma(2.0).encode(-0.25), -0.5);
    /// ```
    #[must_use]
    pub fn encode(self, linear: f64) -> f64 {
        match self {
            Self::Srgb => encode_srgb(linear),
            Self::Rec709 => encode_rec709(linear),
            Self::Gamma(gamma) => power(linear, 1.0 / gamma),
            Self::Linear => linear,
        }
    }

    /// The linear value of a code value: the inverse of [`Self::encode`].
    #[must_use]
    pub fn decode(self, code: f64) -> f64 {
        match self {
            Self::Srgb => decode_srgb(code),
            Self::Rec709 => decode_rec709(code),
            Self::Gamma(gamma) => power(code, gamma),
            Self::Linear => code,
        }
    }

    /// The name by which files and messages call it.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Srgb => "sRGB".into(),
            Self::Rec709 => "Rec.709".into(),
            Self::Gamma(gamma) => format!("gamma {gamma}"),
            Self::Linear => "linear".into(),
        }
    }
}

#[inline(always)]
pub(crate) fn encode_srgb<T: Real>(linear: T) -> T {
    let curve = linear.abs().pow(1.0 / 2.4).mul_add(T::of(1.055), T::of(-0.055));
    T::select(linear <= T::of(SRGB_LINEAR), linear * T::of(12.92), curve)
}

#[inline(always)]
pub(crate) fn decode_srgb<T: Real>(code: T) -> T {
    let curve = ((code + T::of(0.055)) * T::of(1.0 / 1.055)).abs().pow(2.4);
    T::select(code <= T::of(SRGB_CODE), code * T::of(1.0 / 12.92), curve)
}

#[inline(always)]
pub(crate) fn encode_rec709<T: Real>(linear: T) -> T {
    let curve = linear.abs().pow(0.45).mul_add(T::of(ALPHA), T::of(1.0 - ALPHA));
    T::select(linear < T::of(BETA), linear * T::of(4.5), curve)
}

#[inline(always)]
pub(crate) fn decode_rec709<T: Real>(code: T) -> T {
    let curve = ((code + T::of(ALPHA - 1.0)) * T::of(1.0 / ALPHA)).abs().pow(1.0 / 0.45);
    T::select(code < T::of(4.5 * BETA), code * T::of(1.0 / 4.5), curve)
}

/// The power of the magnitude, with the sign of the value.
#[inline(always)]
pub(crate) fn power<T: Real>(value: T, exponent: f64) -> T {
    value.abs().pow(exponent).copysign(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transfers_invert() {
        for transfer in [Transfer::Srgb, Transfer::Rec709, Transfer::Gamma(2.2), Transfer::Linear] {
            for i in -20..=200 {
                let v = f64::from(i) / 100.0;
                assert!((transfer.decode(transfer.encode(v)) - v).abs() < 1e-9, "{transfer:?} {v}");
            }
            assert!((transfer.encode(1.0) - 1.0).abs() < 1e-12);
            assert_eq!(transfer.encode(0.0), 0.0);
            assert!(transfer.encode(f64::NAN).is_nan() && transfer.decode(f64::NAN).is_nan());
            assert_eq!(Transfer::named(&transfer.name()), Some(transfer));
        }
    }

    #[test]
    fn a_name_that_is_none_is_refused() {
        for name in ["", "gamma", "gamma -2", "gamma nan", "log"] {
            assert_eq!(Transfer::named(name), None, "{name}");
        }
    }
}
