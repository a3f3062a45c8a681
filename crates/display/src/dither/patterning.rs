//! Patterning: cells of pixels that show more levels than a pixel can (book 5.1.4, figure 5.11).
//!
//! A cell of n pixels with 2ᵇ codes each has L = n(2ᵇ − 1) + 1 sums, from all 0 to all at the highest code: 5 for 2
//! × 2 at one bit, 1021 at eight. The cell shows the level ⌊mv · L⌋ of the mean value mv, and the highest one for 1
//! (the book multiplies by a little less than L; for four pixels that is their sum times 5/4 less a little, where
//! the book prints 1.5: erratum 57). Level k puts ⌊k/n⌋ into every pixel and one more into the first k mod n pixels
//! of an order of growth; so a pixel that is on stays on at every higher level, and there are no false contours.
//!
//! The order starts at the middle of the cell and goes outwards; among pixels equally far out, it takes the one
//! farthest from the one before. For 3 × 3 it is the usual one (Foley and Van Dam 1984). In 2 × 3 and 3 × 2 the
//! middle would be a line, so they have an order of their own, in which no line is full before it must be. A
//! cell costs resolution: either every pixel becomes a cell ([`Patterning::enlarge`]), or a cell of the image
//! shows its mean ([`Patterning::replace`]).

use super::{Code, DitherError, check, unit};
use crate::Pixels;
use rayon::prelude::*;

/// A cell with its order of growth.
///
/// ```
/// use illuminant_display::{Patterning, Pixels};
/// let cell = Patterning::new(2, 2).unwrap();
/// assert_eq!((cell.levels(1), cell.levels(8)), (5, 1021));
/// // Half of full: two of four pixels are on, at opposite corners.
/// assert_eq!(cell.enlarge(&[0.5], 1, 1, 1).unwrap(), Pixels::Eight(vec![1, 0, 0, 1]));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Patterning {
    width: usize,
    height: usize,
    /// When each pixel of the cell is switched on.
    turns: Vec<usize>,
}

/// Codes of the largest image that is made.
const MOST_CODES: usize = 1 << 31;

impl Patterning {
    /// A cell of `width` × `height` pixels.
    ///
    /// # Errors
    /// A side is not in 1 … 64.
    pub fn new(width: usize, height: usize) -> Result<Self, DitherError> {
        if !(1..=64).contains(&width) || !(1..=64).contains(&height) {
            let message =
                format!("a cell of patterning has 1 to 64 pixels on a side, not {width} × {height}");
            return Err(DitherError::Tile(message));
        }
        let turns = match (width, height) {
            (2, 3) => vec![3, 2, 0, 4, 5, 1],
            (3, 2) => vec![3, 0, 5, 2, 4, 1],
            (3, 3) => vec![6, 8, 4, 1, 0, 3, 5, 2, 7],
            _ => growth(width, height),
        };
        Ok(Self { width, height, turns })
    }

    /// Pixels in a row of the cell.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows of the cell.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// When each pixel of the cell is switched on, in rows from the top: 0 comes first.
    #[must_use]
    pub fn turns(&self) -> &[usize] {
        &self.turns
    }

    /// The number of levels at so many bits a pixel.
    #[must_use]
    pub fn levels(&self, bits: u32) -> u64 {
        self.turns.len() as u64 * ((1u64 << bits.min(32)) - 1) + 1
    }

    /// An image in which each value has become a cell: `width` times as many pixels in a row, `height` times as
    /// many rows.
    ///
    /// # Errors
    /// The number of bits is not in 1 … 16, or the values make no whole rows, or the image would have more than 2³¹ codes.
    pub fn enlarge(
        &self,
        values: &[f32],
        width: usize,
        channels: usize,
        bits: u32,
    ) -> Result<Pixels, DitherError> {
        check(values.len(), width, channels, bits, 16)?;
        let shape = || DitherError::Shape { values: values.len(), width, channels };
        let count =
            values.len().checked_mul(self.turns.len()).filter(|&n| n <= MOST_CODES).ok_or_else(shape)?;
        Ok(if bits <= 8 {
            let mut codes = vec![0u8; count];
            self.enlarge_into(values, width * channels, channels, bits, &mut codes);
            Pixels::Eight(codes)
        } else {
            let mut codes = vec![0u16; count];
            self.enlarge_into(values, width * channels, channels, bits, &mut codes);
            Pixels::Sixteen(codes)
        })
    }

    fn enlarge_into<T: Code>(&self, values: &[f32], row: usize, channels: usize, bits: u32, codes: &mut [T]) {
        if values.is_empty() {
            return;
        }
        let enlarged = row * self.width;
        codes.par_chunks_mut(enlarged * self.height).zip(values.par_chunks(row)).for_each(
            |(codes, values)| {
                let levels: Vec<u64> =
                    values.iter().map(|&value| self.level(f64::from(unit(value)), bits)).collect();
                for (codes, turns) in codes.chunks_mut(enlarged).zip(self.turns.chunks(self.width)) {
                    for (codes, levels) in
                        codes.chunks_mut(self.width * channels).zip(levels.chunks(channels))
                    {
                        for (codes, &turn) in codes.chunks_mut(channels).zip(turns) {
                            for (code, &level) in codes.iter_mut().zip(levels) {
                                *code = self.code(level, turn);
                            }
                        }
                    }
                }
            },
        );
    }

    /// An image of the same size, in which each cell shows the mean of its values. A cell that is cut by the right
    /// or lower edge shows the mean of what is there with the part of the pattern that is there.
    ///
    /// # Errors
    /// The number of bits is not in 1 … 16, or the values make no whole rows.
    pub fn replace(
        &self,
        values: &[f32],
        width: usize,
        channels: usize,
        bits: u32,
    ) -> Result<Pixels, DitherError> {
        check(values.len(), width, channels, bits, 16)?;
        Ok(if bits <= 8 {
            let mut codes = vec![0u8; values.len()];
            self.replace_into(values, width * channels, channels, bits, &mut codes);
            Pixels::Eight(codes)
        } else {
            let mut codes = vec![0u16; values.len()];
            self.replace_into(values, width * channels, channels, bits, &mut codes);
            Pixels::Sixteen(codes)
        })
    }

    fn replace_into<T: Code>(&self, values: &[f32], row: usize, channels: usize, bits: u32, codes: &mut [T]) {
        if values.is_empty() {
            return;
        }
        let cells = (row / channels).div_ceil(self.width);
        let band = row * self.height;
        codes.par_chunks_mut(band).zip(values.par_chunks(band)).for_each(|(codes, values)| {
            let mut sums = vec![0.0f64; cells * channels];
            let place = |i: usize| i / channels / self.width * channels + i % channels;
            for values in values.chunks(row) {
                for (i, &value) in values.iter().enumerate() {
                    sums[place(i)] += f64::from(unit(value));
                }
            }
            let height = values.len() / row;
            let levels: Vec<u64> = sums
                .iter()
                .enumerate()
                .map(|(i, sum)| {
                    let width = (row / channels - i / channels * self.width).min(self.width);
                    self.level(sum / (width * height) as f64, bits)
                })
                .collect();
            for (codes, turns) in codes.chunks_mut(row).zip(self.turns.chunks(self.width)) {
                for (i, code) in codes.iter_mut().enumerate() {
                    *code = self.code(levels[place(i)], turns[i / channels % self.width]);
                }
            }
        });
    }

    fn level(&self, mean: f64, bits: u32) -> u64 {
        let levels = self.levels(bits);
        ((mean * levels as f64) as u64).min(levels - 1)
    }

    fn code<T: Code>(&self, level: u64, turn: usize) -> T {
        let pixels = self.turns.len() as u64;
        T::of((level / pixels) as u32 + u32::from((turn as u64) < level % pixels))
    }
}

/// From the middle outwards; among equals, the one farthest from the one before, and then the first in reading
/// order.
fn growth(width: usize, height: usize) -> Vec<usize> {
    // Twice the coordinates, from the middle, are whole numbers.
    let from_middle = |i: usize| {
        ((2 * (i % width)) as i64 - (width as i64 - 1), (2 * (i / width)) as i64 - (height as i64 - 1))
    };
    let mut left: Vec<usize> = (0..width * height).collect();
    let mut turns = vec![0; width * height];
    let mut last: Option<usize> = None;
    for turn in 0..width * height {
        let key = |&i: &usize| {
            let (x, y) = from_middle(i);
            let step = last.map_or(0, |last| {
                let (lx, ly) = from_middle(last);
                (x - lx).pow(2) + (y - ly).pow(2)
            });
            (x * x + y * y, -step)
        };
        let Some(at) = left.iter().enumerate().min_by_key(|(_, i)| key(i)).map(|(at, _)| at) else { break };
        let pixel = left.remove(at);
        turns[pixel] = turn;
        last = Some(pixel);
    }
    turns
}

#[cfg(test)]
mod tests {
    use super::*;

    fn eight(pixels: Pixels) -> Vec<u8> {
        let Pixels::Eight(codes) = pixels else { panic!("eight bits were asked for") };
        codes
    }

    #[test]
    fn a_cell_of_four_shows_five_levels() {
        let cell = Patterning::new(2, 2).unwrap();
        let values = [0.0, 0.19, 0.21, 0.41, 0.61, 0.81, 1.0, f32::NAN];
        let codes = eight(cell.enlarge(&values, 8, 1, 1).unwrap());
        let on: Vec<u8> = (0..8)
            .map(|i| codes[2 * i] + codes[2 * i + 1] + codes[16 + 2 * i] + codes[16 + 2 * i + 1])
            .collect();
        assert_eq!(on, [0, 0, 1, 2, 3, 4, 4, 0]);
    }

    #[test]
    fn patterns_grow() {
        for (width, height) in [(1, 1), (2, 2), (2, 3), (3, 2), (3, 3), (4, 4), (5, 3), (64, 1)] {
            let cell = Patterning::new(width, height).unwrap();
            let mut turns = cell.turns().to_vec();
            turns.sort_unstable();
            assert!(turns.into_iter().eq(0..width * height));
        }
        assert_eq!(Patterning::new(2, 2).unwrap().turns(), [0, 2, 3, 1]);
        // Up to three pixels of six are in three different rows, or columns.
        let first = |width, height| {
            let turns = Patterning::new(width, height).unwrap().turns().to_vec();
            (0..6).filter(move |&i| turns[i] < 3)
        };
        assert!(first(2, 3).map(|i| i / 2).eq(0..3));
        let mut columns: Vec<usize> = first(3, 2).map(|i| i % 3).collect();
        columns.sort_unstable();
        assert_eq!(columns, [0, 1, 2]);
    }

    #[test]
    fn every_sum_of_codes_can_be_shown() {
        let cell = Patterning::new(2, 2).unwrap();
        assert_eq!(cell.levels(8), 1021);
        let values: Vec<f32> = (0..1021).map(|k| (k as f32 + 0.5) / 1021.0).collect();
        let codes = eight(cell.enlarge(&values, 1021, 1, 8).unwrap());
        for k in 0..1021 {
            let sum: usize = [0, 1, 2042, 2043].iter().map(|o| usize::from(codes[2 * k + o])).sum();
            assert_eq!(sum, k);
        }
    }

    #[test]
    fn a_level_that_can_be_shown_is_shown_exactly() {
        for (width, height, bits) in [(2, 2, 8), (3, 3, 8), (2, 3, 1), (2, 2, 3)] {
            let cell = Patterning::new(width, height).unwrap();
            let levels = cell.levels(bits);
            for level in 0..levels {
                assert_eq!(cell.level(level as f64 / (levels - 1) as f64, bits), level);
            }
        }
    }

    #[test]
    fn an_image_of_the_same_size_shows_the_means_of_its_cells() {
        // Five by three pixels in cells of 2 × 2: the last column and the last row are cut.
        let cell = Patterning::new(2, 2).unwrap();
        #[rustfmt::skip]
        let values = [
            1.0, 0.0, 0.3, 0.3, 0.9,
            0.0, 1.0, 0.3, 0.3, 0.9,
            0.0, 0.0, 1.0, 1.0, 0.5,
        ];
        #[rustfmt::skip]
        let expected = [
            1, 0, 1, 0, 1,
            0, 1, 0, 0, 1,
            0, 0, 1, 1, 1,
        ];
        assert_eq!(eight(cell.replace(&values, 5, 1, 1).unwrap()), expected);
        // Two channels side by side are two images.
        let two: Vec<f32> = values.iter().flat_map(|&v| [v, 1.0 - v]).collect();
        let codes = eight(cell.replace(&two, 5, 2, 1).unwrap());
        assert!(codes.iter().step_by(2).eq(&expected));
    }

    #[test]
    fn a_cell_without_pixels_or_beyond_bounds_is_refused() {
        for (width, height) in [(0, 2), (2, 0), (65, 1), (usize::MAX, usize::MAX)] {
            assert!(Patterning::new(width, height).is_err());
        }
        let cell = Patterning::new(2, 2).unwrap();
        assert!(cell.enlarge(&[0.0; 3], 2, 1, 1).is_err());
        assert!(cell.replace(&[0.0; 4], 2, 1, 17).is_err());
        assert_eq!(cell.replace(&[], 0, 1, 1).unwrap(), Pixels::Eight(vec![]));
    }
}
