//! Thresholds in a tile: ordered dither (book 5.1.4).
//!
//! code = ⌊v(2ᵇ − 1) + t(x, y)⌋ with t from a tile that is laid over the image again and again. A tile of n numbers
//! which holds each of 1/2n, 3/2n … (2n − 1)/2n once is uniform: over a flat field, the mean of the codes is v(2ᵇ −
//! 1) rounded to the nearest n-th (half a step up), so that its error is at most 1/2n.
//!
//! The sum is not formed: in f32 it would lose the threshold at 16 bits. With v(2ᵇ − 1) = w + f, w whole, the code
//! is w + 1 where f ≥ 1 − t, and f and 1 − t are exact.
//!
//! Channels: the book adds the same tile to all. All channels then step at the same pixels, and the eye, which sees
//! lightness in finer detail than colour, gets the sum of their errors. With the tile shifted for each channel the
//! errors of the channels largely cancel in lightness and remain as a fine speckle of colour of one code: on a grey
//! gradation at 8 bits, a Bayer tile leaves less than half of the variance of luminance. Hence the tiles of Bayer
//! and the blue noise are shifted, and the two tiles of the book, which are the smaller ones of Bayer, are not. On
//! a display of few codes, where colours of neighbouring codes differ much, or where grey must stay grey, take
//! [`with_channels_alike`](crate::Dither::with_channels_alike).

use super::{Code, DitherError, to_code, top, unit};
use rayon::prelude::*;

/// Thresholds that are laid over an image again and again.
#[derive(Clone, Debug, PartialEq)]
pub struct Thresholds {
    width: usize,
    height: usize,
    values: Vec<f32>,
    shifts: Vec<(usize, usize)>,
}

/// With these, the first four channels of a pixel get four neighbours of the tile: in Bayer's, one from each
/// quarter of (0, 1).
const NEIGHBOURS: [(usize, usize); 4] = [(0, 0), (1, 0), (0, 1), (1, 1)];

impl Thresholds {
    /// A tile of one's own, in rows from the top, for all channels.
    ///
    /// # Errors
    /// The tile has no pixels or not `width` × `height`, or a threshold is not between 0 and 1.
    pub fn new(width: usize, height: usize, values: Vec<f32>) -> Result<Self, DitherError> {
        if values.is_empty() || width.checked_mul(height) != Some(values.len()) {
            let message = format!("{} thresholds make no tile of {width} × {height}", values.len());
            return Err(DitherError::Tile(message));
        }
        if let Some(bad) = values.iter().find(|t| !(**t > 0.0 && **t < 1.0)) {
            return Err(DitherError::Tile(format!("a threshold lies between 0 and 1, and {bad} does not")));
        }
        Ok(Self { width, height, values, shifts: vec![(0, 0)] })
    }

    /// One threshold of ½: rounding.
    #[must_use]
    pub fn rounding() -> Self {
        Self::square(1, vec![0.5])
    }

    /// The book's 2 × 2 (Limb 1969).
    #[must_use]
    pub fn limb() -> Self {
        Self::odd(2, &[1, 5, 7, 3])
    }

    /// The book's 4 × 4 (Jarvis, Judice and Ninke 1976).
    #[must_use]
    pub fn jarvis() -> Self {
        Self::odd(4, &[1, 17, 5, 21, 25, 9, 29, 13, 7, 23, 3, 19, 31, 15, 27, 11])
    }

    /// Bayer's tile of `size` × `size` (1973): each step doubles the tile, D₂ₙ = [4Dₙ, 4Dₙ + 2; 4Dₙ + 3, 4Dₙ + 1].
    /// Channels are shifted by a pixel to the right, down, and both.
    ///
    /// # Errors
    /// The size is not 2, 4, 8, 16, 32 or 64.
    pub fn bayer(size: usize) -> Result<Self, DitherError> {
        if !(size.is_power_of_two() && (2..=64).contains(&size)) {
            return Err(DitherError::Tile(format!(
                "a tile of Bayer's has a size of 2, 4, 8, 16, 32 or 64, not {size}"
            )));
        }
        let rank = |x: usize, y: usize| {
            // From the finest bit of the coordinates, which counts most, to the coarsest.
            let mut rank = 0;
            for bit in 0..size.trailing_zeros() {
                let (x, y) = (x >> bit & 1, y >> bit & 1);
                rank = 4 * rank + (2 * (x ^ y) + y);
            }
            rank
        };
        let odd: Vec<usize> = (0..size * size).map(|i| 2 * rank(i % size, i / size) + 1).collect();
        Ok(Self::odd(size, &odd).with_shifts(&NEIGHBOURS))
    }

    /// Of a square of odd numbers over twice their count.
    pub(crate) fn odd(size: usize, odd: &[usize]) -> Self {
        Self::square(size, odd.iter().map(|&n| n as f32 / (2 * odd.len()) as f32).collect())
    }

    fn square(size: usize, values: Vec<f32>) -> Self {
        Self { width: size, height: size, values, shifts: vec![(0, 0)] }
    }

    /// The same tile with a shift for each channel, to the right and down; channels beyond the last begin again. No
    /// shifts at all count as none for any channel.
    #[must_use]
    pub fn with_shifts(mut self, shifts: &[(usize, usize)]) -> Self {
        self.shifts = shifts.iter().map(|&(x, y)| (x % self.width, y % self.height)).collect();
        if self.shifts.is_empty() {
            self.shifts.push((0, 0));
        }
        self
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    #[must_use]
    pub fn height(&self) -> usize {
        self.height
    }

    /// The thresholds of the first channel, in rows from the top.
    #[must_use]
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The threshold at a pixel of an image.
    #[must_use]
    pub fn at(&self, x: usize, y: usize, channel: usize) -> f32 {
        let (right, down) = self.shifts[channel % self.shifts.len()];
        self.values[(y + down) % self.height * self.width + (x + right) % self.width]
    }

    /// The thresholds of a row of the image over one period, as the values lie: `width` × `channels` of them.
    #[must_use]
    pub fn row(&self, y: usize, channels: usize) -> Vec<f32> {
        (0..self.width * channels).map(|i| self.at(i / channels, y, i % channels)).collect()
    }
}

/// Values of a run of a row, each with its complement.
#[inline(always)]
pub(crate) fn step_all<T: Code>(values: &[f32], bits: u32, complements: &[f32], codes: &mut [T]) {
    let top = top(bits);
    for ((code, &value), &complement) in codes.iter_mut().zip(values).zip(complements) {
        *code = step(value, top, complement);
    }
}

/// One value: `complement` is 1 − t.
#[inline(always)]
pub(super) fn step<T: Code>(value: f32, top: f32, complement: f32) -> T {
    let scaled = unit(value) * top;
    let whole = scaled.floor();
    to_code(whole + if scaled - whole >= complement { 1.0 } else { 0.0 })
}

/// Rows that are worth a task of their own.
pub(super) fn rows_of_task(row: usize) -> usize {
    (1 << 16) / row.max(1) + 1
}

pub(super) fn quantise<T: Code>(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    tile: &Thresholds,
    codes: &mut [T],
) {
    let row = width * channels;
    let top = top(bits);
    // A period is repeated until it is long enough for the loop over it to be worth starting, and no longer than
    // the row.
    let complements: Vec<Vec<f32>> = (0..tile.height.min(values.len() / row))
        .map(|y| {
            let period: Vec<f32> = tile.row(y, channels).iter().map(|t| 1.0 - t).collect();
            let mut run = period.repeat((1024 / period.len()).clamp(1, row.div_ceil(period.len())));
            run.truncate(row);
            run
        })
        .collect();
    let rows = rows_of_task(row);
    codes.par_chunks_mut(row * rows).zip(values.par_chunks(row * rows)).enumerate().for_each(
        |(task, (codes, values))| {
            for (y, (codes, values)) in codes.chunks_mut(row).zip(values.chunks(row)).enumerate() {
                let complements = &complements[(task * rows + y) % tile.height];
                for (codes, values) in
                    codes.chunks_mut(complements.len()).zip(values.chunks(complements.len()))
                {
                    for ((code, &value), &complement) in codes.iter_mut().zip(values).zip(complements) {
                        *code = step(value, top, complement);
                    }
                }
            }
        },
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_books_tiles_are_bayers() {
        assert_eq!(Thresholds::limb().values, Thresholds::bayer(2).unwrap().values);
        assert_eq!(Thresholds::jarvis().values, Thresholds::bayer(4).unwrap().values);
    }

    #[test]
    fn a_tile_that_is_none_is_refused() {
        for (width, height, values) in [
            (2, 2, vec![0.5; 3]),
            (0, 0, vec![]),
            (1, 1, vec![1.0]),
            (1, 1, vec![f32::NAN]),
            (usize::MAX, 2, vec![0.5]),
        ] {
            assert!(matches!(Thresholds::new(width, height, values), Err(DitherError::Tile(_))));
        }
        assert!(
            Thresholds::bayer(3).is_err() && Thresholds::bayer(128).is_err() && Thresholds::bayer(0).is_err()
        );
    }

    #[test]
    fn the_channels_of_a_pixel_have_one_threshold_in_each_quarter() {
        let tile = Thresholds::bayer(8).unwrap();
        for i in 0..64 {
            let mut quarters = [0, 1, 2, 3].map(|channel| (tile.at(i % 8, i / 8, channel) * 4.0) as u32);
            quarters.sort_unstable();
            assert_eq!(quarters, [0, 1, 2, 3]);
        }
    }

    #[test]
    fn a_row_is_what_its_pixels_are() {
        let tile = Thresholds::bayer(4).unwrap();
        let row = tile.row(7, 3);
        assert_eq!(row.len(), 12);
        assert_eq!(row[3 * 2 + 1], tile.at(2, 7, 1));
        assert_eq!(row[3 * 2 + 1], tile.at(2 + 4, 3, 1));
    }
}
