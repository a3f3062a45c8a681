//! Conversions of whole arrays of three values, and chains of them in one pass over the memory.
//!
//! An array is taken in blocks that stay in the nearest cache; within a block each of the three values has a row of
//! its own, so that a formula runs over many pixels in vector instructions. A chain (XYZ to linear RGB to code values)
//! is done block by block, so it reads and writes the memory once. The formulas are those of the single colour, in
//! the files of their spaces.
//!
//! NaN goes through, nothing is clamped, and the result does not depend on the number of threads.

use crate::lab::{from_relative, to_relative};
use crate::transfer::{decode_rec709, decode_srgb, encode_rec709, encode_srgb, power};
use crate::{
    Difference, HslSolid, Lightness, LuvWhite, Matrix, Real, Transfer, Triple, chromaticity, hsv, threads,
};

/// A conversion of three values to three others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conversion {
    /// The product with a matrix.
    Matrix(Matrix),
    /// Linear values to code values.
    Encode(Transfer),
    /// Code values to linear values.
    Decode(Transfer),
    /// XYZ beside a white to L\*a\*b\*.
    XyzToLab(Triple, Lightness),
    /// L\*a\*b\* to XYZ beside a white.
    LabToXyz(Triple, Lightness),
    /// XYZ beside a white to L\*u\*v\*.
    XyzToLuv(LuvWhite, Lightness),
    /// L\*u\*v\* to XYZ beside a white.
    LuvToXyz(LuvWhite, Lightness),
    /// XYZ to x, y, Y.
    XyzToXyy,
    /// x, y, Y to XYZ.
    XyyToXyz,
    /// XYZ to u′, v′, Y.
    XyzToUvy,
    /// u′, v′, Y to XYZ.
    UvyToXyz,
    /// Three amounts divided by their sum.
    Project,
    /// RGB to HSV.
    RgbToHsv,
    /// HSV to RGB.
    HsvToRgb,
    /// RGB to HSL in one of its solids.
    RgbToHsl(HslSolid),
    /// HSL in one of its solids to RGB.
    HslToRgb(HslSolid),
}

/// Pixels in a block.
const BLOCK: usize = 128;
/// Blocks in a piece of work.
const PIECE: usize = 64;

type Block<T> = [[T; BLOCK]; 3];

impl Conversion {
    /// This conversion of one colour.
    ///
    /// ```
    /// use illuminant_color::Conversion;
    /// assert_eq!(Conversion::XyzToXyy.apply([0.5, 1.0, 0.5]), [0.25, 0.5, 1.0]);
    /// ```
    #[must_use]
    pub fn apply<T: Real>(&self, triple: [T; 3]) -> [T; 3] {
        let mut out = triple;
        convert_in_place(std::slice::from_ref(self), &mut out);
        out
    }

    fn run<T: Real>(&self, block: &mut Block<T>) {
        match *self {
            Self::Matrix(matrix) => each(block, |v| matrix.apply(v)),
            Self::Encode(Transfer::Srgb) => each_value(block, encode_srgb),
            Self::Decode(Transfer::Srgb) => each_value(block, decode_srgb),
            Self::Encode(Transfer::Rec709) => each_value(block, encode_rec709),
            Self::Decode(Transfer::Rec709) => each_value(block, decode_rec709),
            Self::Encode(Transfer::Gamma(gamma)) => each_value(block, |v| power(v, 1.0 / gamma)),
            Self::Decode(Transfer::Gamma(gamma)) => each_value(block, |v| power(v, gamma)),
            Self::Encode(Transfer::Linear) | Self::Decode(Transfer::Linear) => {}
            Self::XyzToLab(white, form) => {
                let [x, y, z] = white.map(|w| T::of(1.0 / w));
                match form {
                    Lightness::Cie => {
                        each(block, |v| from_relative([v[0] * x, v[1] * y, v[2] * z], Lightness::Cie))
                    }
                    Lightness::Book => {
                        each(block, |v| from_relative([v[0] * x, v[1] * y, v[2] * z], Lightness::Book))
                    }
                }
            }
            Self::LabToXyz(white, form) => {
                let [x, y, z] = white.map(T::of);
                each(block, |lab| {
                    let relative = to_relative(lab, form);
                    [relative[0] * x, relative[1] * y, relative[2] * z]
                });
            }
            Self::XyzToLuv(white, form) => each(block, |v| white.luv(v, form)),
            Self::LuvToXyz(white, form) => each(block, |v| white.xyz(v, form)),
            Self::XyzToXyy => each(block, chromaticity::xyz_to_xyy),
            Self::XyyToXyz => each(block, chromaticity::xyy_to_xyz),
            Self::XyzToUvy => each(block, chromaticity::xyz_to_uvy),
            Self::UvyToXyz => each(block, chromaticity::uvy_to_xyz),
            Self::Project => each(block, chromaticity::project),
            Self::RgbToHsv => each(block, hsv::rgb_to_hsv),
            Self::HsvToRgb => each(block, hsv::hsv_to_rgb),
            Self::RgbToHsl(solid) => each(block, |v| solid.from_rgb(v)),
            Self::HslToRgb(solid) => each(block, |v| solid.to_rgb(v)),
        }
    }
}

#[inline(always)]
fn each<T: Real>(block: &mut Block<T>, formula: impl Fn([T; 3]) -> [T; 3]) {
    let [x, y, z] = block;
    for i in 0..BLOCK {
        [x[i], y[i], z[i]] = formula([x[i], y[i], z[i]]);
    }
}

#[inline(always)]
fn each_value<T: Real>(block: &mut Block<T>, formula: impl Fn(T) -> T) {
    for value in block.as_flattened_mut() {
        *value = formula(*value);
    }
}

/// Converts an array of triples by a chain of conversions into another array, spread over threads.
///
/// ```
/// use illuminant_color::{Conversion, Transfer, convert};
/// let mut codes = [0.0; 6];
/// convert(&[Conversion::Encode(Transfer::Gamma(2.0))], &[0.25, 1.0, 0.0, 0.04, 4.0, -0.25], &mut codes);
/// assert!(codes.iter().zip([0.5, 1.0, 0.0, 0.2, 2.0, -0.5]).all(|(a, b): (&f64, f64)| (a - b).abs() < 1e-15));
/// ```
///
/// # Panics
/// When the lengths differ or are no multiple of three: a slip of the programmer, never of the data.
pub fn convert<T: Real>(chain: &[Conversion], input: &[T], output: &mut [T]) {
    assert!(input.len() == output.len() && input.len() % 3 == 0, "triples in, as many out");
    let piece = 3 * BLOCK * PIECE;
    threads::each_piece(input, output, piece, piece, |input, output| {
        let mut block = [[T::default(); BLOCK]; 3];
        for (from, to) in input.chunks(3 * BLOCK).zip(output.chunks_mut(3 * BLOCK)) {
            read(from, &mut block);
            for conversion in chain {
                conversion.run(&mut block);
            }
            write(&block, to);
        }
    });
}

/// [`convert`] within one array.
///
/// # Panics
/// When the length is no multiple of three: a slip of the programmer, never of the data.
pub fn convert_in_place<T: Real>(chain: &[Conversion], values: &mut [T]) {
    assert!(values.len() % 3 == 0, "triples");
    threads::each_piece_in_place(values, 3 * BLOCK * PIECE, |values| {
        let mut block = [[T::default(); BLOCK]; 3];
        for part in values.chunks_mut(3 * BLOCK) {
            read(part, &mut block);
            for conversion in chain {
                conversion.run(&mut block);
            }
            write(&block, part);
        }
    });
}

#[inline(always)]
fn read<T: Real>(from: &[T], block: &mut Block<T>) {
    let [x, y, z] = block;
    for (i, triple) in from.chunks_exact(3).enumerate().take(BLOCK) {
        (x[i], y[i], z[i]) = (triple[0], triple[1], triple[2]);
    }
}

#[inline(always)]
fn write<T: Real>(block: &Block<T>, to: &mut [T]) {
    let [x, y, z] = block;
    for (i, triple) in to.chunks_exact_mut(3).enumerate().take(BLOCK) {
        (triple[0], triple[1], triple[2]) = (x[i], y[i], z[i]);
    }
}

/// The differences of two arrays of L\*a\*b\* (or L\*u\*v\*) colours, computed in f64, spread over threads; either array
/// may hold one colour for all of the other.
///
/// # Panics
/// When the lengths do not fit: a slip of the programmer, never of the data.
pub fn differences<T: Real>(formula: Difference, first: &[T], second: &[T], output: &mut [T]) {
    let fits = |colours: &[T]| colours.len() == 3 * output.len() || colours.len() == 3;
    assert!(fits(first) && fits(second), "triples in, one value for each out");
    const PIXELS: usize = 2048;
    let of = |v: &[T]| [v[0].f64(), v[1].f64(), v[2].f64()];
    let run = |first: &[T], second: &[T], output: &mut [T]| {
        let one =
            |colours: &[T], i: usize| if colours.len() == 3 { of(colours) } else { of(&colours[3 * i..]) };
        for (i, slot) in output.iter_mut().enumerate() {
            *slot = T::of(formula.between(one(first, i), one(second, i)));
        }
    };
    if second.len() == 3 {
        threads::each_piece(first, output, 3 * PIXELS, PIXELS, |first, out| run(first, second, out));
    } else if first.len() == 3 {
        threads::each_piece(second, output, 3 * PIXELS, PIXELS, |second, out| run(first, second, out));
    } else {
        let pairs: Vec<(&[T], &[T])> = first.chunks(3 * PIXELS).zip(second.chunks(3 * PIXELS)).collect();
        threads::each_piece(&pairs, output, 1, PIXELS, |pair, out| run(pair[0].0, pair[0].1, out));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Lab, RgbSystem};

    fn colours(count: usize) -> Vec<f64> {
        (0..3 * count).map(|i| (i * 7919 % 1009) as f64 / 1009.0).collect()
    }

    #[test]
    fn an_array_is_converted_like_each_colour_alone_whatever_its_length() {
        let white = [0.9505, 1.0, 1.089];
        for count in [0, 1, 127, 128, 129, 20_001] {
            let xyz = colours(count);
            let mut lab = vec![0.0; xyz.len()];
            convert(&[Conversion::XyzToLab(white, Lightness::Cie)], &xyz, &mut lab);
            for (from, to) in xyz.chunks_exact(3).zip(lab.chunks_exact(3)) {
                let Lab { l, a, b } = Lab::from_xyz([from[0], from[1], from[2]], white);
                for (x, y) in [l, a, b].into_iter().zip(to) {
                    assert!((x - y).abs() < 1e-12, "{from:?}");
                }
            }
            let mut in_place = xyz.clone();
            convert_in_place(&[Conversion::XyzToLab(white, Lightness::Cie)], &mut in_place);
            assert_eq!(in_place, lab);
        }
    }

    #[test]
    fn every_conversion_and_its_inverse_return_in_both_widths() {
        use Conversion as C;
        let srgb = RgbSystem::named("sRGB").unwrap();
        let (white, luv) = ([0.95, 1.0, 1.09], LuvWhite::new([0.95, 1.0, 1.09]));
        let mut pairs = vec![
            (C::Matrix(Matrix(srgb.to_xyz_rows())), C::Matrix(Matrix(srgb.from_xyz_rows()))),
            (C::XyzToXyy, C::XyyToXyz),
            (C::XyzToUvy, C::UvyToXyz),
            (C::RgbToHsv, C::HsvToRgb),
        ];
        for transfer in [Transfer::Srgb, Transfer::Rec709, Transfer::Gamma(2.2), Transfer::Linear] {
            pairs.push((C::Encode(transfer), C::Decode(transfer)));
        }
        for form in [Lightness::Cie, Lightness::Book] {
            pairs.push((C::XyzToLab(white, form), C::LabToXyz(white, form)));
            pairs.push((C::XyzToLuv(luv, form), C::LuvToXyz(luv, form)));
        }
        for solid in [HslSolid::DoubleHexcone, HslSolid::DoubleCone, HslSolid::Cylinder] {
            pairs.push((C::RgbToHsl(solid), C::HslToRgb(solid)));
        }
        let double: Vec<f64> = colours(2000).iter().map(|v| v + 1e-3).collect();
        let single: Vec<f32> = double.iter().map(|v| *v as f32).collect();
        for (there, back) in pairs {
            let mut found = vec![0.0; double.len()];
            convert(&[there, back], &double, &mut found);
            let mut found_single = vec![0.0; single.len()];
            convert(&[there, back], &single, &mut found_single);
            for i in 0..double.len() {
                assert!((found[i] - double[i]).abs() < 1e-11, "{there:?}: {} {}", found[i], double[i]);
                assert!(
                    (found_single[i] - single[i]).abs() < 2e-5,
                    "{there:?}: {} {}",
                    found_single[i],
                    single[i]
                );
            }
        }
    }

    #[test]
    fn one_colour_is_compared_with_all() {
        let all = colours(5000);
        let (mut left, mut right, mut both) = (vec![0.0; 5000], vec![0.0; 5000], vec![0.0; 5000]);
        differences(Difference::Cie2000, &all, &all[..3], &mut left);
        differences(Difference::Cie2000, &all[..3], &all, &mut right);
        let repeated: Vec<f64> = all[..3].iter().copied().cycle().take(all.len()).collect();
        differences(Difference::Cie2000, &all, &repeated, &mut both);
        assert_eq!(left, both);
        for (a, b) in left.iter().zip(right) {
            assert!((a - b).abs() < 1e-12);
        }
    }
}
