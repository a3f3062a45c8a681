//! Error diffusion: what a pixel is shown too dark, its neighbours are shown lighter (book 5.1.4; Floyd and
//! Steinberg 1976).
//!
//! Pixels are taken in rows from the top, left to right. With the errors e of neighbours that came before,
//!
//! d(x, y) = v(2ᵇ − 1) + Σ wᵢ eᵢ,  code = ⌊d + ½⌋,  e = d − code,
//!
//! where the weights of [`Weights`] sum to 1. An error that would leave the image is lost.
//!
//! Numbers are fixed point in i32 with F = 30 − max(b, 8) binary places; v(2ᵇ − 1)2ᶠ is one product in f32, cut to
//! a whole number, and the weighted sum is (Σ 16wᵢ eᵢ + 8) >> 4. So the result is the same bits in any order of
//! evaluation. And −½ ≤ e < ½ always: the sum of errors stays in that interval too, hence 0 gives code 0 and 1 the
//! highest code beside any neighbour, and no code needs to be clamped.
//!
//! Order of work: a pixel needs its left neighbour and three above it. Eight rows go through together, one in each
//! lane of a vector, each two pixels behind the row above, so that all that a pixel needs is in the vectors of one
//! to three steps before; the lowest row leaves its errors for the next band of eight. Threads take the bands in
//! turn and follow one another at a distance. (One row at a time, as the serpentine order needs it, runs at a third
//! of the speed.)

use super::{Code, one_by_one, unit};
use std::sync::atomic::{AtomicI32, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// How much of the error goes to which neighbour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weights {
    /// Floyd and Steinberg (1976): 7/16 right, 3/16 below left, 5/16 below, 1/16 below right.
    FloydSteinberg,
    /// As the book prints them (erratum 58): 3/8 right, 3/8 below, 1/4 below right.
    Book,
}

impl Weights {
    /// In sixteenths: right, below left, below, below right.
    #[must_use]
    pub fn sixteenths(self) -> [i32; 4] {
        match self {
            Self::FloydSteinberg => [7, 3, 5, 1],
            Self::Book => [6, 0, 6, 4],
        }
    }
}

/// Rows in a band, which are lanes of a vector.
const LANES: usize = 8;
/// A row is so many pixels behind the row above.
const LAG: usize = 2;
/// The last row of a band is so many pixels behind the first.
const SKEW: usize = LAG * (LANES - 1);
/// Pixels that a row advances at a time.
const BLOCK: usize = 8;
/// A thread tells how far it is after so many blocks, and one that must wait lets the other go ahead by as much:
/// each telling takes the line of memory from the other core.
const BLOCKS_BETWEEN: usize = 16;

/// So a band follows the one above at about this distance, in pixels.
const DISTANCE: usize = SKEW + 2 * BLOCKS_BETWEEN * BLOCK;

type Lanes = [i32; LANES];

/// Fixed point: the highest code and the number of binary places.
#[derive(Clone, Copy)]
struct Fixed {
    scale: f32,
    places: u32,
}

impl Fixed {
    fn new(bits: u32) -> Self {
        let places = 30 - bits.max(8);
        Self { scale: super::top(bits) * (1u32 << places) as f32, places }
    }

    #[inline(always)]
    fn of(self, value: f32) -> i32 {
        let scaled = unit(value) * self.scale;
        // SAFETY: `unit` is in [0, 1] and never NaN, and `scale` is below 2³⁰. (The checked conversion halves the
        // speed.)
        unsafe { scaled.to_int_unchecked() }
    }

    /// Code and error.
    #[inline(always)]
    fn split(self, desired: i32) -> (i32, i32) {
        let code = (desired + (1 << (self.places - 1))) >> self.places;
        (code, desired - (code << self.places))
    }
}

/// The errors of the last row of a band.
struct Seam {
    errors: Vec<AtomicI32>,
}

pub(super) fn quantise<T: Code>(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    weights: Weights,
    codes: &mut [T],
) {
    let fixed = Fixed::new(bits);
    match (weights, channels) {
        (Weights::FloydSteinberg, 1) => wavefront::<T, 1, 7, 3, 5, 1>(values, width, fixed, codes),
        (Weights::FloydSteinberg, 2) => wavefront::<T, 2, 7, 3, 5, 1>(values, width, fixed, codes),
        (Weights::FloydSteinberg, 3) => wavefront::<T, 3, 7, 3, 5, 1>(values, width, fixed, codes),
        (Weights::FloydSteinberg, 4) => wavefront::<T, 4, 7, 3, 5, 1>(values, width, fixed, codes),
        (Weights::Book, 1) => wavefront::<T, 1, 6, 0, 6, 4>(values, width, fixed, codes),
        (Weights::Book, 2) => wavefront::<T, 2, 6, 0, 6, 4>(values, width, fixed, codes),
        (Weights::Book, 3) => wavefront::<T, 3, 6, 0, 6, 4>(values, width, fixed, codes),
        (Weights::Book, 4) => wavefront::<T, 4, 6, 0, 6, 4>(values, width, fixed, codes),
        _ => one_by_one(values, channels, codes, |values, codes| {
            quantise(values, width, 1, bits, weights, codes);
        }),
    }
}

fn wavefront<T: Code, const C: usize, const R: i32, const BL: i32, const B: i32, const BR: i32>(
    values: &[f32],
    width: usize,
    fixed: Fixed,
    codes: &mut [T],
) {
    let row = width * C;
    let bands = values.len().div_ceil(row * LANES);
    // Threads beyond those that fit into a row, one behind the other, would only wait.
    let workers = rayon::current_num_threads().min(bands).min(1 + width / DISTANCE);
    // Bands end in order, so with one seam more than workers the one that a band overwrites has been read to its
    // end. A seam holds a pixel to the left of the image and some to the right; their errors stay 0.
    let length = (1 + width + BLOCK + SKEW + LAG) * C;
    let seams: Vec<Seam> =
        (0..=workers).map(|_| Seam { errors: (0..length).map(|_| AtomicI32::new(0)).collect() }).collect();
    let nothing = Seam { errors: (0..length).map(|_| AtomicI32::new(0)).collect() };
    // Pixels of the last row that are done; the first is that of a band above the image.
    let done: Vec<AtomicUsize> =
        (0..=bands).map(|i| AtomicUsize::new(if i == 0 { width } else { 0 })).collect();
    let next = Mutex::new(values.chunks(row * LANES).zip(codes.chunks_mut(row * LANES)).enumerate());
    // A worker takes the next band and waits only for the one before, which a worker has taken that runs already:
    // so even one worker comes to the end.
    let work = || {
        loop {
            let taken = next.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((band, (values, codes))) = taken else { break };
            let above = if band == 0 { &nothing } else { &seams[(band - 1) % seams.len()] };
            let below = &seams[band % seams.len()];
            let before = Progress { done: &done[band], known: 0, width };
            band_of_rows::<T, C, R, BL, B, BR>(
                values,
                codes,
                width,
                fixed,
                above,
                before,
                below,
                &done[band + 1],
            );
        }
    };
    rayon::scope(|scope| {
        for _ in 1..workers {
            scope.spawn(|_| work());
        }
        work();
    });
}

/// How far the band above is.
struct Progress<'a> {
    done: &'a AtomicUsize,
    known: usize,
    width: usize,
}

impl Progress<'_> {
    /// Waits until `pixels` of the row are there.
    #[inline(always)]
    fn wait(&mut self, pixels: usize) {
        let pixels = pixels.min(self.width);
        if self.known < pixels {
            self.wait_until((pixels + BLOCKS_BETWEEN * BLOCK).min(self.width));
        }
    }

    #[cold]
    fn wait_until(&mut self, pixels: usize) {
        let mut turns = 0u32;
        loop {
            self.known = self.done.load(Ordering::Acquire);
            if self.known >= pixels {
                return;
            }
            turns += 1;
            if turns < 256 { std::hint::spin_loop() } else { std::thread::yield_now() }
        }
    }
}

/// The 8 × 8 transposed, in steps of pairs, quarters and halves of a vector.
#[inline(always)]
fn transpose(m: [Lanes; 8]) -> [Lanes; 8] {
    let low = |a: Lanes, b: Lanes| [a[0], b[0], a[1], b[1], a[4], b[4], a[5], b[5]];
    let high = |a: Lanes, b: Lanes| [a[2], b[2], a[3], b[3], a[6], b[6], a[7], b[7]];
    let low2 = |a: Lanes, b: Lanes| [a[0], a[1], b[0], b[1], a[4], a[5], b[4], b[5]];
    let high2 = |a: Lanes, b: Lanes| [a[2], a[3], b[2], b[3], a[6], a[7], b[6], b[7]];
    let low4 = |a: Lanes, b: Lanes| [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]];
    let high4 = |a: Lanes, b: Lanes| [a[4], a[5], a[6], a[7], b[4], b[5], b[6], b[7]];
    let (a0, a1, a2, a3) = (low(m[0], m[1]), high(m[0], m[1]), low(m[2], m[3]), high(m[2], m[3]));
    let (a4, a5, a6, a7) = (low(m[4], m[5]), high(m[4], m[5]), low(m[6], m[7]), high(m[6], m[7]));
    let (b0, b1, b2, b3) = (low2(a0, a2), high2(a0, a2), low2(a1, a3), high2(a1, a3));
    let (b4, b5, b6, b7) = (low2(a4, a6), high2(a4, a6), low2(a5, a7), high2(a5, a7));
    [
        low4(b0, b4),
        low4(b1, b5),
        low4(b2, b6),
        low4(b3, b7),
        high4(b0, b4),
        high4(b1, b5),
        high4(b2, b6),
        high4(b3, b7),
    ]
}

/// Errors of the steps before, for each channel: of the pixel to the left, and of those above, one to three steps
/// ago.
#[derive(Clone, Copy)]
struct History<const C: usize> {
    left: [Lanes; C],
    above: [[Lanes; C]; 3],
}

fn band_of_rows<T: Code, const C: usize, const R: i32, const BL: i32, const B: i32, const BR: i32>(
    values: &[f32],
    codes: &mut [T],
    width: usize,
    fixed: Fixed,
    above: &Seam,
    mut before: Progress,
    below: &Seam,
    done: &AtomicUsize,
) {
    let row = width * C;
    let rows = values.len() / row;
    before.wait(LAG);
    let mut history = History { left: [[0; LANES]; C], above: [[[0; LANES]; C]; 3] };
    // The pixels above the first, right of it, straight above and left of it, are what lane 0 has seen one to three
    // steps ago.
    for (steps, lanes) in history.above.iter_mut().enumerate() {
        for (channel, lanes) in lanes.iter_mut().enumerate() {
            lanes[0] = above.errors[(LAG - steps) * C + channel].load(Ordering::Relaxed);
        }
    }
    // By channel and pixel of a block; C × BLOCK of them are used as one run.
    let mut fixed_values = [[[0; LANES]; BLOCK]; C];
    let mut block_codes = [[[0; LANES]; BLOCK]; C];
    for (block, start) in (0..width + SKEW).step_by(BLOCK).enumerate() {
        before.wait(start + BLOCK + LAG);
        let seam = &above.errors[(1 + start + LAG) * C..][..BLOCK * C];
        let inside = start >= SKEW && start + BLOCK <= width && rows == LANES;
        if inside {
            for (k, run) in fixed_values.iter_mut().enumerate() {
                let mut lines = [[0; BLOCK]; LANES];
                for (lane, line) in lines.iter_mut().enumerate() {
                    let at = lane * row + (start - LAG * lane) * C + k * BLOCK;
                    let values = &values[at..at + BLOCK];
                    for (fixed_value, &value) in line.iter_mut().zip(values) {
                        *fixed_value = fixed.of(value);
                    }
                }
                *run = transpose(lines);
            }
            let out = &below.errors[(1 + start - SKEW) * C..][..BLOCK * C];
            steps::<C, R, BL, B, BR, false>(
                &fixed_values,
                &mut block_codes,
                &mut history,
                fixed,
                seam,
                out,
                &[],
            );
            let mut words = [[0u32; LANES]; 16];
            let per_word = 32 / T::BITS as usize;
            let count = C * BLOCK / per_word;
            for (word, packed) in words[..count].iter_mut().enumerate() {
                for part in 0..per_word {
                    let flat = word * per_word + part;
                    let lanes = &block_codes[flat / BLOCK][flat % BLOCK];
                    for (packed, &code) in packed.iter_mut().zip(lanes) {
                        *packed |= (code as u32) << (part as u32 * T::BITS);
                    }
                }
            }
            for lane in 0..LANES {
                let mut line = [0u32; 16];
                for (to, from) in line[..count].iter_mut().zip(&words) {
                    *to = from[lane];
                }
                let at = lane * row + (start - LAG * lane) * C;
                T::unpack(&line[..count], &mut codes[at..at + C * BLOCK]);
            }
        } else {
            // Where some of the rows have not begun, or have ended, or do not exist.
            let mut masks = [[0; LANES]; BLOCK];
            for (pixel, mask) in masks.iter_mut().enumerate() {
                for (lane, mask) in mask.iter_mut().enumerate() {
                    let x = (start + pixel).wrapping_sub(LAG * lane);
                    *mask = if x < width && lane < rows { -1 } else { 0 };
                    for channel in 0..C {
                        let flat = pixel * C + channel;
                        fixed_values[flat / BLOCK][flat % BLOCK][lane] =
                            if *mask == 0 { 0 } else { fixed.of(values[lane * row + x * C + channel]) };
                    }
                }
            }
            let scratch: [AtomicI32; 32] = std::array::from_fn(|_| AtomicI32::new(0));
            steps::<C, R, BL, B, BR, true>(
                &fixed_values,
                &mut block_codes,
                &mut history,
                fixed,
                seam,
                &scratch[..BLOCK * C],
                &masks,
            );
            for (pixel, mask) in masks.iter().enumerate() {
                for (lane, _) in mask.iter().enumerate().filter(|(_, mask)| **mask != 0) {
                    let x = start + pixel - LAG * lane;
                    for channel in 0..C {
                        let flat = pixel * C + channel;
                        codes[lane * row + x * C + channel] =
                            T::of(block_codes[flat / BLOCK][flat % BLOCK][lane] as u32);
                        if lane == LANES - 1 {
                            let error = scratch[flat].load(Ordering::Relaxed);
                            below.errors[(1 + x) * C + channel].store(error, Ordering::Relaxed);
                        }
                    }
                }
            }
        }
        if block % BLOCKS_BETWEEN == BLOCKS_BETWEEN - 1 {
            done.store((start + BLOCK).saturating_sub(SKEW).min(width), Ordering::Release);
        }
    }
    done.store(width, Ordering::Release);
}

/// A block of pixels in every row of a band: codes of values; the last row's errors go to `out`. With `MASKED`,
/// lanes whose mask is 0 have no pixel, so no error.
#[inline(always)]
#[expect(clippy::needless_range_loop)] // indices run over several arrays
fn steps<const C: usize, const R: i32, const BL: i32, const B: i32, const BR: i32, const MASKED: bool>(
    values: &[[Lanes; BLOCK]; C],
    codes: &mut [[Lanes; BLOCK]; C],
    history: &mut History<C>,
    fixed: Fixed,
    seam: &[AtomicI32],
    out: &[AtomicI32],
    masks: &[Lanes],
) {
    let History { mut left, above: [mut above1, mut above2, mut above3] } = *history;
    for pixel in 0..BLOCK {
        for channel in 0..C {
            let flat = pixel * C + channel;
            let value = values[flat / BLOCK][flat % BLOCK];
            let mut error = [0; LANES];
            let code = &mut codes[flat / BLOCK][flat % BLOCK];
            for lane in 0..LANES {
                let sum = R * left[channel][lane]
                    + (BL * above1[channel][lane] + B * above2[channel][lane] + BR * above3[channel][lane]);
                (code[lane], error[lane]) = fixed.split(value[lane] + ((sum + 8) >> 4));
            }
            if MASKED {
                for (error, mask) in error.iter_mut().zip(&masks[pixel]) {
                    *error &= mask;
                }
            }
            out[flat].store(error[LANES - 1], Ordering::Relaxed);
            left[channel] = error;
            above3[channel] = above2[channel];
            above2[channel] = above1[channel];
            // Each row sees the errors of the row above; the first one those of the band above.
            let first = seam[flat].load(Ordering::Relaxed);
            above1[channel] = [first, error[0], error[1], error[2], error[3], error[4], error[5], error[6]];
        }
    }
    *history = History { left, above: [above1, above2, above3] };
}

/// Every other row backwards, which breaks the worms of the plain order. A row needs all of the row above, so
/// channels are all that can be done side by side.
pub(super) fn quantise_serpentine<T: Code>(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    weights: Weights,
    codes: &mut [T],
) {
    let fixed = Fixed::new(bits);
    let weights = weights.sixteenths();
    match channels {
        1 => serpentine::<T, 1>(values, width, fixed, weights, codes),
        3 => serpentine::<T, 3>(values, width, fixed, weights, codes),
        4 => serpentine::<T, 4>(values, width, fixed, weights, codes),
        _ => one_by_one(values, channels, codes, |values, codes| {
            serpentine::<T, 1>(values, width, fixed, weights, codes);
        }),
    }
}

fn serpentine<T: Code, const C: usize>(
    values: &[f32],
    width: usize,
    fixed: Fixed,
    [right, below_left, below, below_right]: [i32; 4],
    codes: &mut [T],
) {
    // Weighted sums for the row in hand and the next, with a pixel to either side of the image.
    let mut here = vec![[0; C]; width + 2];
    let mut next = vec![[0; C]; width + 2];
    for (y, (values, codes)) in values.chunks(width * C).zip(codes.chunks_mut(width * C)).enumerate() {
        let mut left = [0; C];
        let backwards = y % 2 == 1;
        for step in 0..width {
            let x = if backwards { width - 1 - step } else { step };
            let (behind, ahead) = if backwards { (x + 2, x) } else { (x, x + 2) };
            for channel in 0..C {
                let sum = right * left[channel] + here[x + 1][channel];
                let desired = fixed.of(values[x * C + channel]) + ((sum + 8) >> 4);
                let (code, error) = fixed.split(desired);
                codes[x * C + channel] = T::of(code as u32);
                left[channel] = error;
                next[behind][channel] += below_left * error;
                next[x + 1][channel] += below * error;
                next[ahead][channel] += below_right * error;
            }
        }
        std::mem::swap(&mut here, &mut next);
        next.fill([0; C]);
    }
}
