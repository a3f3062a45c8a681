//! RGB systems: three primaries, a white, and the matrices to and from XYZ.

use crate::{Matrix, Transfer, Triple};
use illuminant_spectrum::{Curve, Outside, daylight};

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
    to_xyz: Matrix,
    from_xyz: Matrix,
}

const D65: [f64; 2] = [0.3127, 0.3290];
const D60: [f64; 2] = [0.321_68, 0.337_67];
/// What the book calls D6500.
const D6500: [f64; 2] = [0.313, 0.329];
const C: [f64; 2] = [0.310_06, 0.316_16];
/// The NTSC of 1953 (FCC; ITU-R BT.470 M).
const NTSC: [[f64; 2]; 3] = [[0.67, 0.33], [0.21, 0.71], [0.14, 0.08]];
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
    ("NTSC 1953", NTSC, C, Transfer::Gamma(2.2)),
    ("NTSC 1953 D65", NTSC, D65, Transfer::Gamma(2.2)),
    ("book NTSC", NTSC, D6500, Transfer::Gamma(2.2)),
    ("SMPTE-C", [[0.630, 0.340], [0.310, 0.595], [0.155, 0.070]], D65, Transfer::Rec709),
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
        let columns = primaries.map(|[x, y]| [x, y, 1.0 - x - y]);
        let chromaticities = Matrix::from_columns(columns);
        let white_xyz = [white[0] / white[1], 1.0, (1.0 - white[0] - white[1]) / white[1]];
        let scale = chromaticities.inverse().ok()?.apply(white_xyz);
        let to_xyz = chromaticities.after(&Matrix::diagonal(scale));
        let from_xyz = to_xyz.inverse().ok()?;
        Some(Self { name: name.into(), primaries, white, transfer, to_xyz, from_xyz })
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
        self.to_xyz.apply(rgb)
    }

    /// Linear RGB of XYZ; values outside [0, 1] say that the colour lies outside the system.
    #[must_use]
    pub fn from_xyz(&self, xyz: Triple) -> Triple {
        self.from_xyz.apply(xyz)
    }

    /// The matrix to XYZ, as rows.
    #[must_use]
    pub fn to_xyz_rows(&self) -> [Triple; 3] {
        self.to_xyz.0
    }

    /// The matrix from XYZ, as rows.
    #[must_use]
    pub fn from_xyz_rows(&self) -> [Triple; 3] {
        self.from_xyz.0
    }

    /// The matrix from this system's linear RGB to that of another (book eq 3.3). The colour stays what it is: no
    /// white is adapted to the other.
    ///
    /// ```
    /// use illuminant_color::{Matrix, RgbSystem};
    /// let [ntsc, srgb] = ["book NTSC", "sRGB"].map(|name| RgbSystem::named(name).unwrap());
    /// let there_and_back = srgb.to(&ntsc).after(&ntsc.to(&srgb));
    /// assert!((there_and_back.0[0][0] - 1.0).abs() < 1e-14);
    /// ```
    #[must_use]
    pub fn to(&self, other: &Self) -> Matrix {
        other.from_xyz.after(&self.to_xyz)
    }

    /// The spectrum that stands for the system's white: daylight of that white, illuminant C, or equal energy.
    ///
    /// D65, the book's D6500 and D60 are phases of daylight, and C has a table; any other white is taken as equal
    /// energy, and says so by its chromaticity.
    #[must_use]
    pub fn white_curve(&self) -> Curve {
        let found = match self.white {
            D65 | D6500 => daylight(6504.0),
            D60 => daylight(6000.0),
            C => illuminant_c(),
            _ => None,
        };
        found.unwrap_or_else(|| Curve::constant(1.0))
    }
}

/// Illuminant C (CIE 15:2004), whose table is compiled in: a failure here is a broken build, not broken input.
fn illuminant_c() -> Option<Curve> {
    let table = include_str!("../../../python/illuminant/data/illuminants/c.csv");
    let lines = table.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let points = lines.map(|line| {
        let (wavelength, value) = line.split_once(',')?;
        Some((wavelength.trim().parse::<f64>().ok()?, value.trim().parse::<f64>().ok()?))
    });
    let (wavelengths, values) = points.collect::<Option<Vec<_>>>()?.into_iter().unzip();
    Curve::new(wavelengths, values, Outside::Zero).ok()
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
    fn the_white_curve_has_the_colour_of_the_white() {
        let observer = illuminant_spectrum::Observer::cie_1931_2deg();
        for name in rgb_system_names() {
            let system = RgbSystem::named(name).unwrap();
            let [x, y, z] =
                observer.xyz(&system.white_curve(), illuminant_spectrum::SpectralRange::default());
            let sum = x + y + z;
            for (found, wanted) in [x / sum, y / sum].into_iter().zip(system.white) {
                assert!((found - wanted).abs() < 8e-4, "{name}: {found} against {wanted}");
            }
        }
    }
}
