//! Random dither (book 5.1.4): a threshold of its own for every pixel and channel.
//!
//! The threshold is a hash of seed, row, column and channel, not the next number of a stream; so a pixel has the
//! same one whatever was computed before it, on any number of threads, in a crop that keeps its corner, and with
//! other channels beside it. The hash is two rounds of multiplication and shift (constants: C. Wellons' search for
//! low bias, 2018) with a key of the row before each; its upper 23 bits give t = (n + ½)/2²³.

use super::thresholds::{rows_of_task, step};
use super::{Code, top};
use rayon::prelude::*;

/// What sets channels apart: an odd number, far from the distance of any two columns.
const CHANNEL: u32 = 0x9e37_79b9;
/// Thresholds are made for so many values at a time.
const RUN: usize = 256;

/// The hash of SplitMix64, for keys of rows (Steele, Lea and Flood 2014).
fn mix(mut z: u64) -> u64 {
    z = z.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// 1 − t, uniform in (0, 1).
#[inline(always)]
fn complement(place: u32, keys: [u32; 2]) -> f32 {
    let mut h = place ^ keys[0];
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d) ^ keys[1];
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    uniform(h ^ (h >> 16))
}

/// The upper 23 bits as the mantissa of a number in [1, 2), less almost 1.
#[inline(always)]
fn uniform(h: u32) -> f32 {
    f32::from_bits(0x3f80_0000 | (h >> 9)) - (1.0 - 0.5 / 8_388_608.0)
}

pub(super) fn quantise<T: Code>(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    seed: u64,
    codes: &mut [T],
) {
    let row = width * channels;
    let top = top(bits);
    let run = RUN.div_ceil(channels) * channels;
    let places: Vec<u32> = (0..run)
        .map(|i| ((i / channels) as u32).wrapping_add(((i % channels) as u32).wrapping_mul(CHANNEL)))
        .collect();
    let rows = rows_of_task(row);
    codes.par_chunks_mut(row * rows).zip(values.par_chunks(row * rows)).enumerate().for_each(
        |(task, (codes, values))| {
            for (y, (codes, values)) in codes.chunks_mut(row).zip(values.chunks(row)).enumerate() {
                let key = mix(mix(seed) ^ (task * rows + y) as u64);
                let keys = [key as u32, (key >> 32) as u32];
                for (i, (codes, values)) in codes.chunks_mut(run).zip(values.chunks(run)).enumerate() {
                    let x = (i * (run / channels)) as u32;
                    for ((code, &value), &place) in codes.iter_mut().zip(values).zip(&places) {
                        *code = step(value, top, complement(place.wrapping_add(x), keys));
                    }
                }
            }
        },
    );
}

#[cfg(test)]
mod tests {
    #[test]
    fn thresholds_stay_within_the_open_interval() {
        assert!(super::uniform(0) > 0.0 && super::uniform(u32::MAX) < 1.0);
    }
}
