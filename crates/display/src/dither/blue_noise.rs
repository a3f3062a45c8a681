//! Void and cluster (Ulichney 1993): a tile of thresholds without low frequencies.
//!
//! Each pixel of a 64 × 64 torus gets a rank. Pixels that are on spread a Gaussian (σ = 1.5 pixels) around them;
//! the pixel that is on where the sum is largest is the tightest cluster, the one that is off where it is smallest
//! the largest void. A tenth of the pixels is switched on at random, and the tightest cluster moved into the
//! largest void until it would move back. From there ranks go down by taking clusters away, and up by filling
//! voids. (Past half, Ulichney looks for clusters of pixels that are off. On a torus the two sums add to a
//! constant, so these are the voids.)
//!
//! Sums are whole numbers, so that what is added can be taken away again exactly and every machine finds the same
//! tile. Blue noise carries no structure at any scale; so channels are shifted far, by the R₂ sequence (Roberts
//! 2018).

use super::Thresholds;
use std::sync::OnceLock;

const SIZE: usize = 64;
const PIXELS: usize = SIZE * SIZE;
const SIGMA: f64 = 1.5;
/// Beyond, the Gaussian rounds to 0.
const REACH: usize = 8;

struct Field {
    on: Vec<bool>,
    sum: Vec<i64>,
    gaussian: [[i64; 2 * REACH + 1]; 2 * REACH + 1],
}

impl Field {
    fn new() -> Self {
        let square = |i: usize| (i as f64 - REACH as f64).powi(2);
        let gaussian = std::array::from_fn(|y| {
            std::array::from_fn(|x| {
                ((-(square(x) + square(y)) / (2.0 * SIGMA * SIGMA)).exp() * f64::from(1 << 20)).round() as i64
            })
        });
        Self { on: vec![false; PIXELS], sum: vec![0; PIXELS], gaussian }
    }

    fn switch(&mut self, pixel: usize) {
        let sign = if self.on[pixel] { -1 } else { 1 };
        self.on[pixel] = !self.on[pixel];
        for (dy, row) in self.gaussian.iter().enumerate() {
            let y = (pixel / SIZE + SIZE + dy - REACH) % SIZE;
            for (dx, g) in row.iter().enumerate() {
                self.sum[y * SIZE + (pixel % SIZE + SIZE + dx - REACH) % SIZE] += sign * g;
            }
        }
    }

    fn tightest_cluster(&self) -> usize {
        // `min_by_key` takes the first of equals, and so do both searches.
        (0..PIXELS).filter(|&i| self.on[i]).min_by_key(|&i| -self.sum[i]).unwrap_or(0)
    }

    fn largest_void(&self) -> usize {
        (0..PIXELS).filter(|&i| !self.on[i]).min_by_key(|&i| self.sum[i]).unwrap_or(0)
    }
}

fn ranks() -> Vec<usize> {
    let mut field = Field::new();
    let mut state = 1u32;
    let mut count = 0;
    while count < PIXELS / 10 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let pixel = (state >> 20) as usize % PIXELS;
        if !field.on[pixel] {
            field.switch(pixel);
            count += 1;
        }
    }
    loop {
        let cluster = field.tightest_cluster();
        field.switch(cluster);
        let void = field.largest_void();
        field.switch(void);
        if void == cluster {
            break;
        }
    }
    let mut ranks = vec![0; PIXELS];
    let start = field.on.clone();
    for rank in (0..count).rev() {
        let cluster = field.tightest_cluster();
        field.switch(cluster);
        ranks[cluster] = rank;
    }
    for (pixel, _) in start.iter().enumerate().filter(|(_, on)| **on) {
        field.switch(pixel);
    }
    for rank in count..PIXELS {
        let void = field.largest_void();
        field.switch(void);
        ranks[void] = rank;
    }
    ranks
}

/// The tile, made at first use.
pub(super) fn tile() -> &'static Thresholds {
    static TILE: OnceLock<Thresholds> = OnceLock::new();
    TILE.get_or_init(|| {
        // What comes first is switched on first, by the highest threshold.
        let odd: Vec<usize> = ranks().iter().map(|rank| 2 * (PIXELS - 1 - rank) + 1).collect();
        let shift = |n: usize| (n * 48 % SIZE, n * 36 % SIZE);
        Thresholds::odd(SIZE, &odd).with_shifts(&[shift(0), shift(1), shift(2), shift(3)])
    })
}
