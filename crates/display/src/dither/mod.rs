//! Dither: fewer codes than the eye can count, without steps (book 5.1.4, figure 5.12).
//!
//! A value v in [0, 1] is shown by one of 2ᵇ codes, b = 1 … 16. Rounding turns a slow gradation into steps, whose
//! edges the eye sharpens to Mach bands. A dither shows the codes on either side of v(2ᵇ − 1) in such a proportion
//! that their mean is right; the methods differ in where they put the error.
//!
//! - **Thresholds**: code = ⌊v(2ᵇ − 1) + t⌋ with 0 < t < 1 ([`Thresholds`]): `none` (t = ½, that is rounding),
//!   `random` (another t for every pixel and channel), `ordered-2` and `ordered-4` (the book's tiles: Limb 1969;
//!   Jarvis, Judice and Ninke 1976), `bayer-2` … `bayer-64` (Bayer 1973), `blue-noise` (void and cluster, Ulichney
//!   1993).
//! - **Error diffusion** ([`Weights`]): `floyd-steinberg` (1976: 7, 3, 5 and 1 sixteenths), `floyd-steinberg-book`
//!   (the three weights which the book prints, erratum 58), `floyd-steinberg-serpentine` (every other row runs
//!   backwards).
//! - **Dot diffusion** ([`ClassMatrix`], Knuth 1987): `dot-diffusion` and, with a cell of 4 × 4, `dot-diffusion-4`.
//!
//! Values are what the display's transfer function gives, because the dither must come last: after gamma and at the
//! depth of the display. A value below 0, or one that is no number, counts as 0; a value above 1 as 1. Under
//! thresholds and under error diffusion 0 is always code 0 and 1 always the highest code, whatever stands beside
//! it; under dot diffusion a field of 0 or 1 stays clean, but an error may spill over its edge. Channels are
//! dithered independently. The result depends neither on the number of threads nor on the machine.
//!
//! ```
//! use illuminant_display::{Dither, Pixels, quantise};
//! let field = vec![5.5 / 255.0; 64 * 64];
//! let dither = Dither::named("ordered-2").unwrap();
//! let Pixels::Eight(codes) = quantise(&field, 64, 1, 8, &dither).unwrap() else { unreachable!() };
//! assert_eq!(codes.iter().filter(|&&code| code == 6).count(), 64 * 64 / 2); // and the other half is 5
//! ```

mod blue_noise;
mod dot_diffusion;
mod error_diffusion;
mod patterning;
mod random;
pub(crate) mod thresholds;

pub use dot_diffusion::ClassMatrix;
pub use error_diffusion::Weights;
pub use patterning::Patterning;
pub use thresholds::Thresholds;

use crate::Pixels;
use std::borrow::Cow;

/// A way to choose codes.
#[derive(Clone, Debug, PartialEq)]
pub enum Dither {
    /// A threshold from a tile.
    Tile(Cow<'static, Thresholds>),
    /// A threshold of its own for every pixel and channel, uniform in (0, 1).
    Random {
        /// Another seed gives another pattern.
        seed: u64,
    },
    /// The error of a pixel goes to neighbours that come later, row by row.
    ErrorDiffusion {
        /// How much to which neighbour.
        weights: Weights,
        /// Every other row runs from right to left.
        serpentine: bool,
    },
    /// The error of a pixel goes to neighbours of a higher class.
    DotDiffusion(Cow<'static, ClassMatrix>),
}

/// Why an image cannot be dithered.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DitherError {
    /// No such dither.
    #[error("there is no dither {0:?}; there are {list}", list = Dither::names().join(", "))]
    Unknown(String),
    /// A depth that no display has.
    #[error("codes have 1 to {most} bits here, not {bits}")]
    Bits {
        /// What was asked for.
        bits: u32,
        /// What is possible.
        most: u32,
    },
    /// Values that make no rows.
    #[error("{values} values make no rows of {width} pixels with {channels} channels")]
    Shape {
        /// The number of values.
        values: usize,
        /// Pixels in a row.
        width: usize,
        /// Values in a pixel.
        channels: usize,
    },
    /// A buffer of another length.
    #[error("the buffer holds {found} codes, and {expected} are needed")]
    Buffer {
        /// Its length.
        found: usize,
        /// The length that is needed.
        expected: usize,
    },
    /// A tile, matrix or cell that is not what it should be.
    #[error("{0}")]
    Tile(String),
}

impl Dither {
    /// The names that [`Dither::named`] knows.
    #[must_use]
    pub fn names() -> &'static [&'static str] {
        &[
            "none",
            "random",
            "ordered-2",
            "ordered-4",
            "bayer-2",
            "bayer-4",
            "bayer-8",
            "bayer-16",
            "bayer-32",
            "bayer-64",
            "blue-noise",
            "floyd-steinberg",
            "floyd-steinberg-book",
            "floyd-steinberg-serpentine",
            "dot-diffusion",
            "dot-diffusion-4",
        ]
    }

    /// The dither of a name.
    ///
    /// # Errors
    /// There is no such name.
    pub fn named(name: &str) -> Result<Self, DitherError> {
        let diffusion = |weights, serpentine| Self::ErrorDiffusion { weights, serpentine };
        let tile = |tile: Thresholds| Self::Tile(Cow::Owned(tile));
        let lower = name.to_ascii_lowercase();
        Ok(match lower.as_str() {
            "none" => tile(Thresholds::rounding()),
            "random" => Self::Random { seed: 0 },
            "ordered-2" => tile(Thresholds::limb()),
            "ordered-4" => tile(Thresholds::jarvis()),
            "blue-noise" => Self::Tile(Cow::Borrowed(blue_noise::tile())),
            "floyd-steinberg" => diffusion(Weights::FloydSteinberg, false),
            "floyd-steinberg-book" => diffusion(Weights::Book, false),
            "floyd-steinberg-serpentine" => diffusion(Weights::FloydSteinberg, true),
            "dot-diffusion" => Self::DotDiffusion(Cow::Owned(ClassMatrix::knuth())),
            "dot-diffusion-4" => Self::DotDiffusion(Cow::Owned(ClassMatrix::four())),
            _ => {
                let size = lower.strip_prefix("bayer-").filter(|_| Self::names().contains(&lower.as_str()));
                match size.and_then(|size| size.parse().ok()) {
                    Some(size) => tile(Thresholds::bayer(size)?),
                    None => return Err(DitherError::Unknown(name.to_owned())),
                }
            }
        })
    }

    /// The same dither with another seed: only `random` has one.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        match self {
            Self::Random { .. } => Self::Random { seed },
            other => other,
        }
    }

    /// The same dither with one tile for all channels, unshifted: the book's way, and what keeps a grey picture
    /// grey. Only tiles can be shifted; other dithers stay as they are.
    #[must_use]
    pub fn with_channels_alike(self) -> Self {
        match self {
            Self::Tile(tile) => Self::Tile(Cow::Owned(tile.into_owned().with_shifts(&[(0, 0)]))),
            other => other,
        }
    }

    /// The tile, where the dither is one: a pipeline can add it while it converts.
    #[must_use]
    pub fn thresholds(&self) -> Option<&Thresholds> {
        match self {
            Self::Tile(tile) => Some(tile),
            _ => None,
        }
    }
}

/// A code as it lies in memory.
pub trait Code: sealed::Sealed + Copy + Default + Send + Sync + 'static {
    /// The most bits that it holds.
    const BITS: u32;
    /// Of a number that fits.
    fn of(number: u32) -> Self;
    /// Codes from words that hold them, lowest bits first.
    fn unpack(words: &[u32], codes: &mut [Self]);
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for u8 {}
    impl Sealed for u16 {}
}

impl Code for u8 {
    const BITS: u32 = 8;
    #[inline(always)]
    fn of(number: u32) -> Self {
        number as Self
    }
    #[inline(always)]
    fn unpack(words: &[u32], codes: &mut [Self]) {
        for (codes, word) in codes.chunks_exact_mut(4).zip(words) {
            codes.copy_from_slice(&word.to_le_bytes());
        }
    }
}

impl Code for u16 {
    const BITS: u32 = 16;
    #[inline(always)]
    fn of(number: u32) -> Self {
        number as Self
    }
    #[inline(always)]
    fn unpack(words: &[u32], codes: &mut [Self]) {
        for (codes, &word) in codes.chunks_exact_mut(2).zip(words) {
            codes[0] = word as Self;
            codes[1] = (word >> 16) as Self;
        }
    }
}

/// The codes of an image: `values` hold `channels` values for a pixel and `width` pixels for a row, and the codes
/// come in the same order, as bytes up to 8 bits and as 16-bit words above.
///
/// # Errors
/// The number of bits is not in 1 … 16, or the values make no whole rows.
pub fn quantise(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    dither: &Dither,
) -> Result<Pixels, DitherError> {
    check(values.len(), width, channels, bits, 16)?;
    if bits <= 8 {
        let mut codes = vec![0; values.len()];
        quantise_into::<u8>(values, width, channels, bits, dither, &mut codes)?;
        Ok(Pixels::Eight(codes))
    } else {
        let mut codes = vec![0; values.len()];
        quantise_into::<u16>(values, width, channels, bits, dither, &mut codes)?;
        Ok(Pixels::Sixteen(codes))
    }
}

/// [`quantise`] into a buffer of the caller's, of bytes (up to 8 bits) or 16-bit words.
///
/// # Errors
/// The number of bits is 0 or more than a code holds, the values make no whole rows, or the buffer is of another
/// length.
pub fn quantise_into<T: Code>(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    dither: &Dither,
    codes: &mut [T],
) -> Result<(), DitherError> {
    check(values.len(), width, channels, bits, T::BITS)?;
    if codes.len() != values.len() {
        return Err(DitherError::Buffer { found: codes.len(), expected: values.len() });
    }
    if values.is_empty() {
        return Ok(());
    }
    match dither {
        Dither::Tile(tile) => thresholds::quantise(values, width, channels, bits, tile, codes),
        Dither::Random { seed } => random::quantise(values, width, channels, bits, *seed, codes),
        Dither::ErrorDiffusion { weights, serpentine: false } => {
            error_diffusion::quantise(values, width, channels, bits, *weights, codes);
        }
        Dither::ErrorDiffusion { weights, serpentine: true } => {
            error_diffusion::quantise_serpentine(values, width, channels, bits, *weights, codes);
        }
        Dither::DotDiffusion(classes) => {
            dot_diffusion::quantise(values, width, channels, bits, classes, codes)
        }
    }
    Ok(())
}

pub(crate) fn check(
    values: usize,
    width: usize,
    channels: usize,
    bits: u32,
    most: u32,
) -> Result<(), DitherError> {
    if !(1..=most).contains(&bits) {
        return Err(DitherError::Bits { bits, most });
    }
    let whole = width.checked_mul(channels).is_some_and(|row| row > 0 && values % row == 0);
    if !(whole || (values == 0 && channels > 0)) {
        return Err(DitherError::Shape { values, width, channels });
    }
    Ok(())
}

/// Channels know nothing of each other, so each may be an image of its own: for numbers of channels that no loop
/// was made for.
fn one_by_one<T: Code>(
    values: &[f32],
    channels: usize,
    codes: &mut [T],
    quantise: impl Fn(&[f32], &mut [T]),
) {
    for channel in 0..channels {
        let plane: Vec<f32> = values.iter().skip(channel).step_by(channels).copied().collect();
        let mut of_plane = vec![T::default(); plane.len()];
        quantise(&plane, &mut of_plane);
        for (code, of_plane) in codes.iter_mut().skip(channel).step_by(channels).zip(of_plane) {
            *code = of_plane;
        }
    }
}

/// A value in [0, 1]: what is no number counts as 0.
#[inline(always)]
pub(crate) fn unit(v: f32) -> f32 {
    // As comparisons, these are one instruction each, and the first one takes NaN to 0.
    let v = if v > 0.0 { v } else { 0.0 };
    if v < 1.0 { v } else { 1.0 }
}

/// The highest code.
#[inline(always)]
pub(crate) fn top(bits: u32) -> f32 {
    ((1u32 << bits) - 1) as f32
}

/// A whole number of at most 2²² as bits: adding 2²³ leaves it in the low bits of the mantissa, and takes one
/// instruction where a checked conversion takes six.
#[inline(always)]
pub(crate) fn to_code<T: Code>(whole: f32) -> T {
    T::of((whole + 8_388_608.0).to_bits())
}
