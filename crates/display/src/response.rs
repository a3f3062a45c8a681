//! How a channel of a display answers a code value: from code to light, and back.
//!
//! Light is a fraction of the channel's range, from 0 at black to 1 at the display's white; code values run from 0 to 1.
//!
//! | name | light of a code value v | source |
//! | --- | --- | --- |
//! | `sRGB`, `Rec.709`, `gamma γ`, `linear` | the inverse of that transfer function | `illuminant_color::Transfer` |
//! | `BT.1886` | a (max(v + b, 0))^2.4, with a and b from the luminances of white and black | ITU-R BT.1886 |
//! | `PQ` | EOTF(v) × 10,000 / peak, above 1 for codes that the display cannot show | SMPTE ST 2084, ITU-R BT.2100 |
//! | `HLG` | the scene's light E(v); the display's OOTF follows (see [`crate::Display`]) | ITU-R BT.2100 |
//! | gain, offset and γ | (max(g v + o, 0)^γ − max(o, 0)^γ) / (max(g + o, 0)^γ − max(o, 0)^γ) | Berns 1996 |
//! | table | linear between measured values | |
//!
//! References: ITU-R BT.1886-0 (2011); BT.2100-3 (2025); R. S. Berns, "Methods for characterizing CRT displays",
//! Displays 16(4), 1996.

use illuminant_color::Transfer;

/// How a channel of a display answers a code value.
#[derive(Clone, Debug, PartialEq)]
pub enum Response {
    /// The inverse of a transfer function.
    Transfer(Transfer),
    /// The reference display of studios: a power of 2.4 that is lifted to the black of the display.
    Bt1886 {
        /// Luminance of black over luminance of white.
        black: f64,
    },
    /// The perceptual quantiser: code values are absolute luminances up to 10,000 cd/m².
    Pq {
        /// Luminance of the display's white, cd/m².
        peak: f64,
    },
    /// Hybrid log-gamma: the light of the scene, before the display's own OOTF.
    Hlg,
    /// Gain, offset and gamma of a gun (Berns 1996).
    GainOffsetGamma {
        /// Factor on the code value.
        gain: f64,
        /// What is added to it.
        offset: f64,
        /// The exponent.
        gamma: f64,
    },
    /// Light at equally spaced code values from 0 to 1, rising from 0 to 1.
    Table(Vec<f64>),
}

/// The nearest number from 0 to `top`; NaN becomes 0.
pub(crate) fn between(v: f64, top: f64) -> f64 {
    if v > 0.0 { v.min(top) } else { 0.0 }
}

const M1: f64 = 2610.0 / 16384.0;
const M2: f64 = 2523.0 / 4096.0 * 128.0;
const C1: f64 = 3424.0 / 4096.0;
const C2: f64 = 2413.0 / 4096.0 * 32.0;
const C3: f64 = 2392.0 / 4096.0 * 32.0;
const PQ_PEAK: f64 = 10_000.0;

/// More light than any display has, so that no curve meets infinity.
pub(crate) const LARGEST: f64 = 1e12;

const HLG_A: f64 = 0.178_832_77;
const HLG_B: f64 = 1.0 - 4.0 * HLG_A;

fn hlg_c() -> f64 {
    0.5 - HLG_A * (4.0 * HLG_A).ln()
}

impl Response {
    /// The response of a name, for a display whose white and black have these luminances (cd/m²).
    ///
    /// Names: `BT.1886`, `PQ`, `HLG`, `gain-offset-gamma G O γ`, and those of `Transfer`; upper and lower case are one.
    #[must_use]
    pub fn named(name: &str, peak: f64, black: f64) -> Option<Self> {
        let lower = name.to_ascii_lowercase();
        match lower.as_str() {
            "bt.1886" => return Some(Self::Bt1886 { black: black / peak }),
            "pq" => return Some(Self::Pq { peak }),
            "hlg" => return Some(Self::Hlg),
            _ => {}
        }
        if let Some(numbers) = lower.strip_prefix("gain-offset-gamma ") {
            let numbers: Vec<f64> =
                numbers.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
            let [gain, offset, gamma] = numbers[..] else { return None };
            return Some(Self::GainOffsetGamma { gain, offset, gamma });
        }
        Transfer::named(name).map(Self::Transfer)
    }

    /// The light of a code value; what lies outside 0 to 1 is taken to the nearer end, NaN to 0.
    ///
    /// ```
    /// use illuminant_color::Transfer;
    /// use illuminant_display::Response;
    /// assert_eq!(Response::Transfer(Transfer::Gamma(2.0)).decode(0.5), 0.25);
    /// assert!((Response::Pq { peak: 1000.0 }.decode(0.751_827) - 1.0).abs() < 1e-5);
    /// ```
    #[must_use]
    pub fn decode(&self, code: f64) -> f64 {
        let code = between(code, 1.0);
        match self {
            Self::Transfer(transfer) => transfer.decode(code),
            Self::Bt1886 { black } => {
                let root = black.powf(1.0 / 2.4);
                let light = (code * (1.0 - root) + root).max(0.0).powf(2.4);
                (light - black) / (1.0 - black)
            }
            Self::Pq { peak } => {
                let v = code.powf(1.0 / M2);
                ((v - C1).max(0.0) / (C2 - C3 * v)).powf(1.0 / M1) * PQ_PEAK / peak
            }
            Self::Hlg if code <= 0.5 => code * code / 3.0,
            Self::Hlg => (((code - hlg_c()) / HLG_A).exp() + HLG_B) / 12.0,
            Self::GainOffsetGamma { gain, offset, gamma } => {
                let light = |code: f64| (gain * code + offset).max(0.0).powf(*gamma);
                (light(code) - light(0.0)) / (light(1.0) - light(0.0))
            }
            Self::Table(values) => {
                let at = code * (values.len() - 1) as f64;
                let low = (at as usize).min(values.len() - 2);
                values[low] + (at - low as f64) * (values[low + 1] - values[low])
            }
        }
    }

    /// The code value of a light: the inverse of [`Self::decode`], the smallest code where several give the same light.
    ///
    /// Light below 0, and NaN, is taken as 0; light above what a code value of 1 gives has the code 1.
    #[must_use]
    pub fn encode(&self, light: f64) -> f64 {
        let light = between(light, LARGEST);
        let code = match self {
            Self::Transfer(transfer) => transfer.encode(light),
            Self::Bt1886 { black } => {
                let root = black.powf(1.0 / 2.4);
                ((light * (1.0 - black) + black).powf(1.0 / 2.4) - root) / (1.0 - root)
            }
            Self::Pq { peak } => {
                let y = (light * peak / PQ_PEAK).powf(M1);
                ((C1 + C2 * y) / (1.0 + C3 * y)).powf(M2)
            }
            Self::Hlg if light <= 1.0 / 12.0 => (3.0 * light).sqrt(),
            Self::Hlg => HLG_A * (12.0 * light - HLG_B).ln() + hlg_c(),
            Self::GainOffsetGamma { .. } if light == 0.0 => 0.0,
            Self::GainOffsetGamma { gain, offset, gamma } => {
                let power = |code: f64| (gain * code + offset).max(0.0).powf(*gamma);
                let wanted = light * (power(1.0) - power(0.0)) + power(0.0);
                (wanted.powf(1.0 / gamma) - offset) / gain
            }
            Self::Table(values) => {
                let above = values.partition_point(|&value| value < light).clamp(1, values.len() - 1);
                let (a, b) = (values[above - 1], values[above]);
                let part = if b > a { ((light - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
                (above as f64 - 1.0 + part) / (values.len() - 1) as f64
            }
        };
        code.clamp(0.0, 1.0)
    }

    /// Whether the numbers make a response: white above black, a rising table, exponents that are positive.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        match self {
            Self::Transfer(Transfer::Gamma(gamma)) => *gamma > 0.0 && gamma.is_finite(),
            Self::Transfer(_) | Self::Hlg => true,
            Self::Bt1886 { black } => (0.0..1.0).contains(black),
            Self::Pq { peak } => *peak > 0.0 && *peak <= PQ_PEAK,
            Self::GainOffsetGamma { gain, offset, gamma } => {
                let finite = [gain, offset, gamma].iter().all(|v| v.is_finite());
                let light = |code: f64| (gain * code + offset).max(0.0).powf(*gamma);
                let rises = light(1.0) > light(0.0) && light(1.0).is_finite();
                finite && *gain > 0.0 && *gamma > 0.0 && rises
            }
            Self::Table(values) => {
                values.len() >= 2
                    && values.first() == Some(&0.0)
                    && values.last() == Some(&1.0)
                    && values.windows(2).all(|pair| pair[0] <= pair[1])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_response_inverts() {
        let table = (0..=64).map(|i| (f64::from(i) / 64.0).powi(3)).collect();
        let all = [
            Response::Transfer(Transfer::Srgb),
            Response::Transfer(Transfer::Gamma(2.2)),
            Response::Bt1886 { black: 0.0 },
            Response::Bt1886 { black: 0.001 },
            Response::Pq { peak: 10_000.0 },
            Response::Hlg,
            Response::GainOffsetGamma { gain: 0.95, offset: 0.03, gamma: 2.4 },
            Response::GainOffsetGamma { gain: 1.1, offset: -0.1, gamma: 2.2 },
            Response::Table(table),
        ];
        for response in all {
            assert!(response.is_sound());
            for i in 0..=100 {
                let code = f64::from(i) / 100.0;
                // Below its offset a gun sends nothing, for which the smallest code stands.
                let light = response.decode(code);
                let code = if light == 0.0 { 0.0 } else { code };
                let back = response.encode(light);
                // A PQ code of 0 stands for codes up to 7 × 10⁻⁷.
                assert!((back - code).abs() < 1e-6, "{response:?}: {code} becomes {back}");
            }
        }
    }

    #[test]
    fn published_values_of_hdr_come_out() {
        // BT.2100: PQ codes of 100 and 1,000 cd/m²; HLG's 1/12 is at code 0.5.
        let pq = Response::Pq { peak: 10_000.0 };
        assert!((pq.encode(0.01) - 0.508_078).abs() < 1e-6);
        assert!((pq.encode(0.1) - 0.751_827).abs() < 1e-6);
        assert!((Response::Hlg.decode(0.5) - 1.0 / 12.0).abs() < 1e-15);
        assert!((Response::Hlg.decode(1.0) - 1.0).abs() < 1e-7);
    }

    #[test]
    fn black_lifts_a_studio_display() {
        let [lifted, pure] = [0.001, 0.0].map(|black| Response::Bt1886 { black });
        assert!((pure.decode(0.5) - 0.5f64.powf(2.4)).abs() < 1e-15);
        assert!(lifted.decode(0.1) > pure.decode(0.1));
    }
}
