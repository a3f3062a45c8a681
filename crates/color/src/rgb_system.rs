//! RGB systems: three primaries, a white, and the matrices to and from XYZ.

use crate::Triple;
use illuminant_spectrum::{Curve, daylight};
use nalgebra::{Matrix3, Vector3};

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

impl Transfer {
    /// The code value, in [0, 1], of a linear value; values outside [0, 1] are the caller's to handle.
    #[must_use]
    pub fn encode(self, linear: f64) -> f64 {
        match self {
            Self::Srgb if linear <= 0.003_130_8 => 12.92 * linear,
            Self::Srgb => 1.055 * linear.powf(1.0 / 2.4) - 0.055,
            Self::Rec709 if linear < 0.018_053_968_510_807 => 4.5 * linear,
            Self::Rec709 => 1.099_296_826_809_44 * linear.powf(0.45) - 0.099_296_826_809_44,
            Self::Gamma(gamma) => linear.max(0.0).powf(1.0 / gamma),
            Self::Linear => linear,
        }
    }

    /// The linear value of a code value: the inverse of [`Self::encode`].
    #[must_use]
    pub fn decode(self, code: f64) -> f64 {
        match self {
            Self::Srgb if code <= 0.040_449_936 => code / 12.92,
            Self::Srgb => ((code + 0.055) / 1.055).powf(2.4),
            Self::Rec709 if code < 4.5 * 0.018_053_968_510_807 => code / 4.5,
            Self::Rec709 => ((code + 0.099_296_826_809_44) / 1.099_296_826_809_44).powf(1.0 / 0.45),
            Self::Gamma(gamma) => code.max(0.0).powf(gamma),
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

/// An RGB system, stated by the chromaticities of its primaries and white (book eq 3.2).
///
/// ```
/// use illuminant_color::RgbSystem;
/// let srgb = RgbSystem::named("sRGB").unwrap();
/// let white = srgb.to_xyz([1.0, 1.0, 1.0]);
/// assert!((white[1] - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RgbSystem {
    /// The name, as users write it.
    pub name: String,
    /// x, y of the red, green and blue primaries.
    pub primaries: [[f64; 2]; 3],
    /// x, y of the white (1, 1, 1).
    pub white: [f64; 2],
    /// How linear values become code values.
    pub transfer: Transfer,
    to_xyz: Matrix3<f64>,
    from_xyz: Matrix3<f64>,
}

const D65: [f64; 2] = [0.3127, 0.3290];
const D60: [f64; 2] = [0.321_68, 0.337_67];
const REC709: [[f64; 2]; 3] = [[0.640, 0.330], [0.300, 0.600], [0.150, 0.060]];

/// Name, primaries, white and transfer.
type Known = (&'static str, [[f64; 2]; 3], [f64; 2], Transfer);

/// The systems that are known by name.
#[rustfmt::skip]
const SYSTEMS: &[Known] = &[
    ("sRGB", REC709, D65, Transfer::Srgb),
    ("Rec.709", REC709, D65, Transfer::Rec709),
    ("Rec.2020", [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046]], D65, Transfer::Rec709),
    ("Display P3", [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060]], D65, Transfer::Srgb),
    ("Adobe RGB", [[0.640, 0.330], [0.210, 0.710], [0.150, 0.060]], D65, Transfer::Gamma(563.0 / 256.0)),
    ("ACES AP0", [[0.7347, 0.2653], [0.0, 1.0], [0.0001, -0.077]], D60, Transfer::Linear),
    ("ACES AP1", [[0.713, 0.293], [0.165, 0.830], [0.128, 0.044]], D60, Transfer::Linear),
    ("XYZ", [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], [1.0 / 3.0, 1.0 / 3.0], Transfer::Linear),
];

/// The names of the systems that are known by name.
pub fn rgb_system_names() -> impl Iterator<Item = &'static str> {
    SYSTEMS.iter().map(|system| system.0)
}

impl RgbSystem {
    /// A system from its primaries and white (book eq 3.2): the columns of the matrix to XYZ are the primaries'
    /// chromaticities, scaled so that (1, 1, 1) is the white with Y = 1.
    ///
    /// `None` when the primaries lie on one line, or the white has y = 0.
    #[must_use]
    pub fn new(name: &str, primaries: [[f64; 2]; 3], white: [f64; 2], transfer: Transfer) -> Option<Self> {
        let columns = primaries.map(|[x, y]| Vector3::new(x, y, 1.0 - x - y));
        let chromaticities = Matrix3::from_columns(&columns);
        let white_xyz = Vector3::new(white[0] / white[1], 1.0, (1.0 - white[0] - white[1]) / white[1]);
        let scale = chromaticities.try_inverse()? * white_xyz;
        let to_xyz = chromaticities * Matrix3::from_diagonal(&scale);
        let from_xyz = to_xyz.try_inverse()?;
        let finite = to_xyz.iter().chain(from_xyz.iter()).all(|v| v.is_finite());
        finite.then(|| Self { name: name.into(), primaries, white, transfer, to_xyz, from_xyz })
    }

    /// A system by its name, whatever its case.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let found = SYSTEMS.iter().find(|system| system.0.eq_ignore_ascii_case(name))?;
        Self::new(found.0, found.1, found.2, found.3)
    }

    /// XYZ of linear RGB.
    #[must_use]
    pub fn to_xyz(&self, rgb: Triple) -> Triple {
        (self.to_xyz * Vector3::from(rgb)).into()
    }

    /// Linear RGB of XYZ; values outside [0, 1] say that the colour lies outside the system.
    #[must_use]
    pub fn from_xyz(&self, xyz: Triple) -> Triple {
        (self.from_xyz * Vector3::from(xyz)).into()
    }

    /// The matrix to XYZ, as rows.
    #[must_use]
    pub fn to_xyz_rows(&self) -> [Triple; 3] {
        rows(&self.to_xyz)
    }

    /// The matrix from XYZ, as rows.
    #[must_use]
    pub fn from_xyz_rows(&self) -> [Triple; 3] {
        rows(&self.from_xyz)
    }

    /// The spectrum that stands for the system's white: daylight of that white, or equal energy.
    ///
    /// D65 and D60 are phases of daylight; any other white is taken as equal energy, and says so by its chromaticity.
    #[must_use]
    pub fn white_curve(&self) -> Curve {
        let temperature =
            if self.white == D65 { Some(6504.0) } else { (self.white == D60).then_some(6000.0) };
        temperature.and_then(daylight).unwrap_or_else(|| Curve::constant(1.0))
    }
}

fn rows(m: &Matrix3<f64>) -> [Triple; 3] {
    [0, 1, 2].map(|i| [m[(i, 0)], m[(i, 1)], m[(i, 2)]])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ntsc_with_d6500_has_the_first_row_of_the_book() {
        let ntsc = RgbSystem::new(
            "NTSC",
            [[0.67, 0.33], [0.21, 0.71], [0.14, 0.08]],
            [0.313, 0.329],
            Transfer::Gamma(2.2),
        )
        .unwrap();
        for (value, expected) in ntsc.to_xyz_rows()[0].iter().zip([0.5893, 0.1790, 0.1831]) {
            assert!((value - expected).abs() < 1e-4, "{value} against {expected}");
        }
    }

    #[test]
    fn white_is_white_and_the_inverse_inverts() {
        for name in rgb_system_names() {
            let system = RgbSystem::named(name).unwrap();
            let rgb = [0.2, 0.7, 0.4];
            let back = system.from_xyz(system.to_xyz(rgb));
            for (a, b) in rgb.iter().zip(back) {
                assert!((a - b).abs() < 1e-12);
            }
            let [x, y, z] = system.to_xyz([1.0; 3]);
            assert!((x / (x + y + z) - system.white[0]).abs() < 1e-12);
        }
    }

    #[test]
    fn collinear_primaries_are_refused() {
        assert!(
            RgbSystem::new("line", [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]], D65, Transfer::Linear).is_none()
        );
    }

    #[test]
    fn transfers_invert() {
        for transfer in [Transfer::Srgb, Transfer::Rec709, Transfer::Gamma(2.2), Transfer::Linear] {
            for i in 0..=100 {
                let v = f64::from(i) / 100.0;
                assert!((transfer.decode(transfer.encode(v)) - v).abs() < 1e-7, "{transfer:?} {v}");
            }
            assert!((transfer.encode(1.0) - 1.0).abs() < 1e-12);
        }
    }
}
