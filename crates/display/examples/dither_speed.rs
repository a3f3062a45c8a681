//! Speed of the dithers on a picture of 3840 × 2160:
//! `cargo run --release -p illuminant-display --example dither_speed [WxH] [NAME …]`.
//!
//! Megapixels (of three channels) a second, f32 to 8 bits into a buffer that exists: the best of several runs.
#![allow(clippy::print_stdout)]

use illuminant_display::{Dither, quantise_into};
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut asked: Vec<String> = std::env::args().skip(1).collect();
    let size = asked.first().and_then(|size| size.split_once('x'));
    let size = size.and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height): (usize, usize) = size.unwrap_or((3840, 2160));
    if size.is_some() {
        asked.remove(0);
    }
    let values: Vec<f32> = (0..width * height * 3)
        .map(|i| {
            let (x, y) = (i / 3 % width, i / 3 / width);
            (x as f32 / width as f32 + (y as f32 * 0.01).sin() * 0.2 + (i % 3) as f32 * 0.1).clamp(0.0, 1.0)
        })
        .collect();
    let mut codes = vec![0u8; values.len()];
    println!("{:28}{:>10}{:>10}", "", "1 thread", "2 threads");
    for name in Dither::names().iter().filter(|name| asked.is_empty() || asked.iter().any(|a| a == *name)) {
        let dither = Dither::named(name)?;
        let mut speeds = Vec::new();
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            let mut best = f64::INFINITY;
            for _ in 0..12 + 10_000_000 / (width * height) {
                let start = Instant::now();
                pool.install(|| quantise_into(&values, width, 3, 8, &dither, &mut codes))?;
                best = best.min(start.elapsed().as_secs_f64());
            }
            speeds.push((width * height) as f64 / 1e6 / best);
        }
        println!("{name:28}{:10.0}{:10.0}", speeds[0], speeds[1]);
    }
    Ok(())
}
