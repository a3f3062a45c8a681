//! Tone curves: from code values to linear ones (ICC.1:2022, 10.6 and 10.18).

use crate::{IccError, Version, tags::fixed};

/// How many entries a curve has that is sampled because a version has no formula for it.
pub const SAMPLES: usize = 4096;

/// How far a table may fall from one entry to a later one and still be taken for noise of a measurement.
const NOISE: f64 = 0.01;

/// How many parameters each function type of `para` has.
const PARAMETERS: [usize; 5] = [1, 3, 4, 5, 7];

/// The curve of one channel, on [0, 1].
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// code^γ.
    Gamma(f64),
    /// g, a, b, c, d, e, f: (a code + b)^g + e from d on, and c code + f below.
    Parametric([f64; 7]),
    /// Values at codes that divide [0, 1] evenly, with straight lines between them.
    Table(Vec<f64>),
}

impl Curve {
    /// The curve of IEC 61966-2-1.
    #[must_use]
    pub fn srgb() -> Self {
        Self::Parametric([2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045, 0.0, 0.0])
    }

    /// The inverse of the camera curve of ITU-R BT.709 and BT.2020, at full precision.
    #[must_use]
    pub fn rec709() -> Self {
        const ALPHA: f64 = 1.099_296_826_809_44;
        const BETA: f64 = 0.018_053_968_510_807;
        let (a, b) = (1.0 / ALPHA, (ALPHA - 1.0) / ALPHA);
        Self::Parametric([1.0 / 0.45, a, b, 1.0 / 4.5, 4.5 * BETA, 0.0, 0.0])
    }

    /// The linear value of a code value; both are clipped to [0, 1], as the standard asks.
    ///
    /// ```
    /// use illuminant_icc::Curve;
    /// assert!((Curve::srgb().linear(0.5) - 0.214_041).abs() < 1e-6);
    /// assert_eq!(Curve::Table(vec![0.0, 0.1, 1.0]).linear(0.75), 0.55);
    /// ```
    #[must_use]
    pub fn linear(&self, code: f64) -> f64 {
        self.unclipped(code.clamp(0.0, 1.0)).clamp(0.0, 1.0)
    }

    /// Values at `number` codes that divide [0, 1] evenly.
    #[must_use]
    pub fn samples(&self, number: usize) -> Vec<f64> {
        let last = number.saturating_sub(1).max(1) as f64;
        (0..number).map(|i| self.linear(i as f64 / last)).collect()
    }

    fn unclipped(&self, code: f64) -> f64 {
        match self {
            Self::Gamma(gamma) => code.powf(*gamma),
            Self::Parametric([g, a, b, c, d, e, f]) => {
                if code >= *d {
                    (a * code + b).max(0.0).powf(*g) + e
                } else {
                    c * code + f
                }
            }
            Self::Table(values) => {
                let at = code * values.len().saturating_sub(1) as f64;
                let below = at.floor();
                let low = values.get(below as usize).copied().unwrap_or(0.0);
                let high = values.get(below as usize + 1).copied().unwrap_or(low);
                low + (high - low) * (at - below)
            }
        }
    }

    /// Refuses what no profile can hold.
    pub(crate) fn check(&self, channel: &str) -> Result<(), IccError> {
        let refuse = |why: String| Err(IccError::Description(format!("the curve of {channel} {why}")));
        match self {
            Self::Gamma(gamma) if !(*gamma > 0.0 && *gamma <= 100.0) => {
                return refuse(format!("has an exponent of {gamma}, and one up to 100 is possible"));
            }
            Self::Parametric(numbers) if !numbers.iter().all(|v| v.abs() < 32768.0) => {
                return refuse("has a parameter that is not between -32768 and 32768".into());
            }
            Self::Table(values) if !(2..=SAMPLES).contains(&values.len()) => {
                return refuse(format!("has {} values, and 2 to {SAMPLES} are possible", values.len()));
            }
            Self::Table(values) if !values.iter().all(|v| (0.0..=1.0).contains(v)) => {
                return refuse("has values that are not between 0 and 1".into());
            }
            Self::Table(values) if values.windows(2).any(|pair| pair[1] < pair[0]) => {
                return refuse("falls, and it should rise from black to white".into());
            }
            _ => {}
        }
        if !self.is_finite() || !rises(&self.samples(SAMPLES)) || !(self.linear(0.0) < self.linear(1.0)) {
            return refuse("does not rise from black to white".into());
        }
        let white = self.unclipped(1.0);
        if !((white - 1.0).abs() <= 1e-3) {
            return refuse(format!("makes {white} of the code 1, and it should make 1"));
        }
        Ok(())
    }

    /// The curve as the content of a tag.
    pub(crate) fn tag(&self, version: Version) -> Vec<u8> {
        match (self, version) {
            (Self::Gamma(gamma), Version::Two) if gamma_of_256ths(*gamma) => power_tag(*gamma),
            (Self::Gamma(gamma), Version::Four) => parametric_tag(0, &[*gamma]),
            (Self::Parametric(all), Version::Four) => match all {
                [g, a, b, c, d, 0.0, 0.0] => parametric_tag(3, &[*g, *a, *b, *c, *d]),
                _ => parametric_tag(4, all),
            },
            (Self::Table(values), _) => table_tag(values),
            (_, Version::Two) => table_tag(&self.samples(SAMPLES)),
        }
    }

    /// The curve of a tag, whose linear value at 1 is 1, and that linear value as it was.
    pub(crate) fn of_tag(tag: &[u8], name: &str) -> Result<(Self, f64), IccError> {
        let damaged = |why: &str| IccError::Damaged(format!("the curve {name} {why}"));
        let curve = match tag.get(..4) {
            Some(b"curv") => of_curv(tag).ok_or_else(|| damaged("ends too soon"))?,
            Some(b"para") => of_para(tag).ok_or_else(|| damaged("ends too soon or is of an unknown type"))?,
            _ => return Err(damaged("is neither of the type curv nor of the type para")),
        };
        let white = curve.linear(1.0);
        if !(white > 0.0) || !curve.is_finite() {
            return Err(damaged("makes no light of the highest code, or is not finite"));
        }
        // A formula whose numbers were rounded to 16 bits stays a formula.
        if let (Self::Gamma(_) | Self::Parametric(_), true) = (&curve, (white - 1.0).abs() < 2e-4) {
            return if rises(&curve.samples(SAMPLES)) { Ok((curve, 1.0)) } else { Err(damaged("falls")) };
        }
        let values = match &curve {
            Self::Table(values) => values.clone(),
            other => other.samples(SAMPLES),
        };
        if !rises(&values) {
            return Err(damaged("falls, and it should rise from black to white"));
        }
        let mut highest: f64 = 0.0;
        let risen = values.iter().map(|v| {
            highest = highest.max(*v);
            (highest / white).min(1.0)
        });
        Ok((Self::Table(risen.collect()), white))
    }

    fn is_finite(&self) -> bool {
        match self {
            Self::Gamma(gamma) => *gamma > 0.0,
            Self::Parametric([g, ..]) if !(*g > 0.0) => false,
            other => (0..=256).all(|i| other.unclipped(f64::from(i) / 256.0).is_finite()),
        }
    }
}

/// Whether values rise, but for noise.
fn rises(values: &[f64]) -> bool {
    let mut highest: f64 = 0.0;
    values.iter().all(|v| {
        highest = highest.max(*v);
        *v >= highest - NOISE
    })
}

fn gamma_of_256ths(gamma: f64) -> bool {
    let scaled = gamma * 256.0;
    scaled == scaled.round() && (1.0..65536.0).contains(&scaled)
}

fn header(kind: &[u8; 4]) -> Vec<u8> {
    let mut tag = kind.to_vec();
    tag.extend([0; 4]);
    tag
}

fn power_tag(gamma: f64) -> Vec<u8> {
    let mut tag = header(b"curv");
    if gamma == 1.0 {
        tag.extend(0_u32.to_be_bytes());
    } else {
        tag.extend(1_u32.to_be_bytes());
        tag.extend(((gamma * 256.0) as u16).to_be_bytes());
    }
    tag
}

fn table_tag(values: &[f64]) -> Vec<u8> {
    let mut tag = header(b"curv");
    tag.extend((values.len() as u32).to_be_bytes());
    for value in values {
        tag.extend(((value * 65535.0).round() as u16).to_be_bytes());
    }
    tag
}

fn parametric_tag(function: u16, numbers: &[f64]) -> Vec<u8> {
    let mut tag = header(b"para");
    tag.extend(function.to_be_bytes());
    tag.extend([0; 2]);
    for number in numbers {
        tag.extend(fixed::of(*number).to_be_bytes());
    }
    tag
}

fn of_curv(tag: &[u8]) -> Option<Curve> {
    let count = u32::from_be_bytes(*tag.get(8..)?.first_chunk()?) as usize;
    let words = tag.get(12..12_usize.checked_add(count.checked_mul(2)?)?)?;
    let mut words = words.chunks_exact(2).map(|word| f64::from(u16::from_be_bytes([word[0], word[1]])));
    match count {
        0 => Some(Curve::Gamma(1.0)),
        1 => words.next().map(|word| Curve::Gamma(word / 256.0)),
        _ => Some(Curve::Table(words.map(|word| word / 65535.0).collect())),
    }
}

fn of_para(tag: &[u8]) -> Option<Curve> {
    let function = usize::from(u16::from_be_bytes(*tag.get(8..)?.first_chunk()?));
    let bytes = tag.get(12..12 + 4 * *PARAMETERS.get(function)?)?;
    let numbers: Vec<f64> =
        bytes.chunks_exact(4).map(|n| fixed::value(i32::from_be_bytes([n[0], n[1], n[2], n[3]]))).collect();
    Some(match *numbers.as_slice() {
        [g] => Curve::Gamma(g),
        // Types 1 and 2 begin to rise at -b/a, and are constant below.
        [g, a, b] if a > 0.0 => Curve::Parametric([g, a, b, 0.0, -b / a, 0.0, 0.0]),
        [g, a, b, c] if a > 0.0 => Curve::Parametric([g, a, b, 0.0, -b / a, c, c]),
        [g, a, b, c, d] => Curve::Parametric([g, a, b, c, d, 0.0, 0.0]),
        [g, a, b, c, d, e, f] => Curve::Parametric([g, a, b, c, d, e, f]),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use illuminant_color::Transfer;

    #[test]
    fn formulas_are_those_of_the_transfer_functions() {
        let pairs = [
            (Curve::srgb(), Transfer::Srgb),
            (Curve::rec709(), Transfer::Rec709),
            (Curve::Gamma(2.2), Transfer::Gamma(2.2)),
        ];
        for (curve, transfer) in pairs {
            for i in 0..=1000 {
                let code = f64::from(i) / 1000.0;
                assert!((curve.linear(code) - transfer.decode(code)).abs() < 2e-8, "{curve:?} at {code}");
            }
        }
    }

    #[test]
    fn every_tag_comes_back_as_the_same_curve() {
        let toe = Curve::Parametric([2.0, 0.9, 0.0, 0.0, 0.0, 0.19, 0.19]);
        let table = Curve::Table((0..1024).map(|i| (f64::from(i) / 1023.0).powi(3)).collect());
        for curve in [Curve::Gamma(1.0), Curve::Gamma(2.4), Curve::srgb(), Curve::rec709(), toe, table] {
            curve.check("red").unwrap();
            for version in [Version::Two, Version::Four] {
                let (back, white) = Curve::of_tag(&curve.tag(version), "rTRC").unwrap();
                assert!((white - 1.0).abs() < 1e-12);
                for i in 0..=500 {
                    let code = f64::from(i) / 500.0;
                    assert!((back.linear(code) - curve.linear(code)).abs() < 1e-4, "{curve:?} at {code}");
                }
            }
        }
        assert_eq!(Curve::Gamma(2.0).tag(Version::Two).len(), 14);
        assert_eq!(Curve::of_tag(&Curve::Gamma(2.0).tag(Version::Two), "").unwrap().0, Curve::Gamma(2.0));
    }

    #[test]
    fn the_five_functions_of_the_standard_are_read() {
        let read = |function, numbers: &[f64]| Curve::of_tag(&parametric_tag(function, numbers), "gTRC");
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-4, "{a} {b}");
        near(read(0, &[2.0]).unwrap().0.linear(0.5), 0.25);
        let one = read(1, &[2.0, 1.25, -0.25]).unwrap().0;
        near(one.linear(0.2), 0.0);
        near(one.linear(0.6), 0.25);
        let two = read(2, &[2.0, 1.0, 0.0, -0.25]).unwrap();
        near(two.1, 0.75);
        near(two.0.linear(1.0), 1.0);
        near(two.0.linear(0.4), 0.0);
        near(read(3, &[2.0, 1.0, 0.0, 0.1, 0.1]).unwrap().0.linear(0.05), 0.005);
        near(read(4, &[2.0, 0.9, 0.0, 0.1, 0.1, 0.19, 0.0]).unwrap().0.linear(0.5), 0.3925);
        assert!(read(5, &[1.0]).is_err());
        assert!(read(1, &[2.0, 0.0, 1.0]).is_err());
    }

    #[test]
    fn a_table_that_ends_below_white_is_stretched_and_noise_is_levelled() {
        let (curve, white) = Curve::of_tag(&table_tag(&[0.0, 0.3, 0.295, 0.8]), "bTRC").unwrap();
        assert!((white - 0.8).abs() < 1e-4);
        let Curve::Table(values) = curve else { panic!("a table") };
        assert!((values[3] - 1.0).abs() < 1e-12 && values[2] == values[1]);
        assert!(Curve::of_tag(&table_tag(&[0.0, 0.6, 0.3, 1.0]), "bTRC").is_err());
        assert!(Curve::of_tag(&table_tag(&[0.0, 0.0]), "bTRC").is_err());
    }

    #[test]
    fn a_curve_that_is_none_is_refused() {
        for curve in [
            Curve::Gamma(f64::NAN),
            Curve::Gamma(0.0),
            Curve::Table(vec![1.0]),
            Curve::Table(vec![0.0, f64::NAN]),
            Curve::Table(vec![0.0, 0.5]),
            Curve::Table(vec![0.5, 0.0, 1.0]),
            Curve::Parametric([2.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0]),
            Curve::Parametric([f64::NAN; 7]),
        ] {
            assert!(curve.check("red").unwrap_err().to_string().contains("the curve of red"), "{curve:?}");
        }
    }
}
