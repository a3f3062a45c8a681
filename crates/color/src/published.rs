//! Matrices as their standards print them, rounded.
//!
//! [`crate::RgbSystem`] derives its matrices from primaries and white, to all digits. Files and programs that follow a
//! standard to the letter use these; the two differ in the last printed digits. (IEC 61966-2-1 prints the inverse of its
//! rounded matrix, so that "XYZ to sRGB" is off by up to 4 × 10⁻⁴.)

use crate::Matrix;

type Printed = (&'static str, Matrix);

/// Name and matrix.
#[rustfmt::skip]
const PRINTED: &[Printed] = &[
    // IEC 61966-2-1:1999
    ("sRGB to XYZ", Matrix([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])),
    ("XYZ to sRGB", Matrix([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])),
    // Adobe RGB (1998), version 2005-05
    ("Adobe RGB to XYZ",
        Matrix([[0.57667, 0.18556, 0.18823], [0.29734, 0.62736, 0.07529], [0.02703, 0.07069, 0.99134]])),
    ("XYZ to Adobe RGB",
        Matrix([[2.04159, -0.56501, -0.34473], [-0.96924, 1.87597, 0.04156], [0.01344, -0.11836, 1.01517]])),
    // SMPTE ST 2065-1:2012
    ("ACES AP0 to XYZ", Matrix([
        [0.952_552_395_9, 0.0, 0.000_093_678_6],
        [0.343_966_449_8, 0.728_166_096_6, -0.072_132_546_4],
        [0.0, 0.0, 1.008_825_184_4],
    ])),
    ("XYZ to ACES AP0", Matrix([
        [1.049_811_017_5, 0.0, -0.000_097_484_5],
        [-0.495_903_023_1, 1.373_313_045_8, 0.098_240_036_1],
        [0.0, 0.0, 0.991_252_018_2],
    ])),
    // Academy S-2014-004, ACEScg
    ("ACES AP1 to XYZ", Matrix([
        [0.662_454_181_1, 0.134_004_206_5, 0.156_187_687_0],
        [0.272_228_716_8, 0.674_081_765_8, 0.053_689_517_4],
        [-0.005_574_649_5, 0.004_060_733_5, 1.010_339_100_3],
    ])),
    ("XYZ to ACES AP1", Matrix([
        [1.641_023_379_7, -0.324_803_294_2, -0.236_424_695_2],
        [-0.663_662_858_7, 1.615_331_591_7, 0.016_756_347_7],
        [0.011_721_894_3, -0.008_284_442_0, 0.988_394_858_5],
    ])),
];

/// The weights of linear R, G and B in luminance, as ITU-R BT.709 prints them.
pub const REC709_LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];

/// The names of the printed matrices.
pub fn published_names() -> impl Iterator<Item = &'static str> {
    PRINTED.iter().map(|printed| printed.0)
}

/// A printed matrix by its name, whatever its case.
#[must_use]
pub fn published(name: &str) -> Option<Matrix> {
    PRINTED.iter().find_map(|(known, matrix)| known.eq_ignore_ascii_case(name).then_some(*matrix))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RgbSystem;

    #[test]
    fn what_is_printed_is_what_primaries_and_white_give_to_the_printed_digits() {
        for name in published_names() {
            let (from, to) = name.split_once(" to ").unwrap();
            let (system, forward) = if to == "XYZ" { (from, true) } else { (to, false) };
            let system = RgbSystem::named(system).unwrap();
            let derived = if forward { system.to_xyz_rows() } else { system.from_xyz_rows() };
            let printed = published(name).unwrap().0;
            let tolerance = if system.name.starts_with("ACES") { 2e-9 } else { 4e-4 };
            for (a, b) in printed.iter().flatten().zip(derived.iter().flatten()) {
                assert!((a - b).abs() < tolerance, "{name}: {a} against {b}");
            }
        }
    }
}
