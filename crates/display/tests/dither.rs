//! Dithers against plain references, closed forms and statistics.

use illuminant_display::{
    ClassMatrix, Dither, DitherError, Pixels, Thresholds, Weights, quantise, quantise_into,
};

/// A small generator of its own, so that no test depends on what it tests.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn unit(&mut self) -> f32 {
        (self.next() >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// Noise around a gradation, with values outside [0, 1], at its ends, and none.
fn picture(width: usize, height: usize, channels: usize, seed: u64) -> Vec<f32> {
    let mut numbers = Numbers(seed | 1);
    (0..width * height * channels)
        .map(|i| match numbers.next() >> 58 {
            0 => f32::NAN,
            1 => f32::INFINITY,
            2 => f32::NEG_INFINITY,
            3 => 0.0,
            4 => 1.0,
            5 => numbers.unit() * 6.0 - 3.0,
            _ => (i / channels % width) as f32 / width as f32 + 0.2 * (numbers.unit() - 0.5),
        })
        .collect()
}

fn numbers(pixels: &Pixels) -> Vec<u32> {
    match pixels {
        Pixels::Eight(codes) => codes.iter().map(|&c| u32::from(c)).collect(),
        Pixels::Sixteen(codes) => codes.iter().map(|&c| u32::from(c)).collect(),
    }
}

fn dithered(values: &[f32], width: usize, channels: usize, bits: u32, dither: &Dither) -> Vec<u32> {
    numbers(&quantise(values, width, channels, bits, dither).unwrap())
}

fn unit(v: f32) -> f32 {
    if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) }
}

/// Error diffusion as one writes it down: one channel, one pixel after the other, errors thrown forward.
fn plain_diffusion(
    values: &[f32],
    width: usize,
    channels: usize,
    bits: u32,
    weights: Weights,
    serpentine: bool,
) -> Vec<u32> {
    let height = values.len() / (width * channels);
    let places = 30 - bits.max(8);
    let scale = ((1u32 << bits) - 1) as f32 * (1u32 << places) as f32;
    let [right, below_left, below, below_right] = weights.sixteenths();
    let mut codes = vec![0; values.len()];
    for channel in 0..channels {
        let mut given = vec![0i64; width * height];
        for y in 0..height {
            let backwards = serpentine && y % 2 == 1;
            for step in 0..width {
                let x = if backwards { width - 1 - step } else { step };
                let i = (y * width + x) * channels + channel;
                let value = (unit(values[i]) * scale) as i64;
                let desired = value + ((given[y * width + x] + 8) >> 4);
                let code = (desired + (1 << (places - 1))) >> places;
                codes[i] = code as u32;
                let error = desired - (code << places);
                let forward = if backwards { -1 } else { 1 };
                for (dx, dy, weight) in
                    [(forward, 0, right), (-forward, 1, below_left), (0, 1, below), (forward, 1, below_right)]
                {
                    let (x, y) = (x as i64 + dx, y + dy);
                    if (0..width as i64).contains(&x) && y < height {
                        given[y * width + x as usize] += error * i64::from(weight);
                    }
                }
            }
        }
    }
    codes
}

/// Dot diffusion over the whole image, class by class.
fn plain_dots(values: &[f32], width: usize, channels: usize, bits: u32, matrix: &ClassMatrix) -> Vec<u32> {
    let height = values.len() / (width * channels);
    let top = ((1u32 << bits) - 1) as f32;
    let beside = [(0, -1), (-1, 0), (1, 0), (0, 1)];
    let corners = [(-1, -1), (1, -1), (-1, 1), (1, 1)];
    let size = matrix.size();
    let class = |x: isize, y: isize| {
        matrix.class(x.rem_euclid(size as isize) as usize, y.rem_euclid(size as isize) as usize)
    };
    let mut codes = vec![0; values.len()];
    for channel in 0..channels {
        let mut shares = vec![0.0f32; width * height];
        let mut pixels: Vec<(isize, isize)> =
            (0..width * height).map(|i| ((i % width) as isize, (i / width) as isize)).collect();
        pixels.sort_by_cached_key(|&(x, y)| class(x, y));
        for (x, y) in pixels {
            let own = class(x, y);
            let sum = |offsets: [(isize, isize); 4]| {
                let mut sum = 0.0f32;
                for (dx, dy) in offsets {
                    let (x, y) = (x + dx, y + dy);
                    let inside = x >= 0 && y >= 0 && x < width as isize && y < height as isize;
                    if inside && class(x, y) < own {
                        sum += shares[y as usize * width + x as usize];
                    }
                }
                sum
            };
            let at = y as usize * width + x as usize;
            let desired = unit(values[at * channels + channel]) * top + (2.0 * sum(beside) + sum(corners));
            let code = (desired + 0.5).floor().clamp(0.0, top);
            codes[at * channels + channel] = code as u32;
            let parts = |offsets: [(isize, isize); 4]| {
                offsets.into_iter().filter(|&(dx, dy)| class(x + dx, y + dy) > own).count()
            };
            let parts = 2 * parts(beside) + parts(corners);
            let share = if parts == 0 { 0.0 } else { 1.0 / parts as f32 };
            shares[at] = (desired - code) * share;
        }
    }
    codes
}

const SIZES: [(usize, usize); 18] = [
    (1, 1),
    (1, 7),
    (1, 64),
    (7, 1),
    (300, 1),
    (2, 2),
    (3, 9),
    (8, 8),
    (13, 16),
    (15, 17),
    (16, 8),
    (21, 23),
    (22, 24),
    (23, 40),
    (64, 15),
    (257, 33),
    (1001, 10),
    (1024, 20),
];

#[test]
fn error_diffusion_is_the_plain_algorithm_bit_for_bit() {
    for (i, (width, height)) in SIZES.into_iter().enumerate() {
        for channels in 1..=5 {
            for bits in [1, 2, 7, 8, 9, 16] {
                let values =
                    picture(width, height, channels, (i * 100 + channels * 20) as u64 + u64::from(bits));
                for weights in [Weights::FloydSteinberg, Weights::Book] {
                    for serpentine in [false, true] {
                        let dither = Dither::ErrorDiffusion { weights, serpentine };
                        let codes = dithered(&values, width, channels, bits, &dither);
                        let plain = plain_diffusion(&values, width, channels, bits, weights, serpentine);
                        assert!(codes == plain, "{width}x{height}x{channels}, {bits} bits, {dither:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn dot_diffusion_is_the_plain_algorithm_bit_for_bit() {
    let spiral = ClassMatrix::new(3, vec![0, 1, 2, 7, 8, 3, 6, 5, 4]).unwrap();
    let one = ClassMatrix::new(1, vec![0]).unwrap();
    let sizes = SIZES.into_iter().chain([(500, 140), (239, 65), (240, 64), (241, 63), (256, 72)]);
    for (i, (width, height)) in sizes.enumerate() {
        for channels in [1, 3, 5] {
            for bits in [1, 16] {
                let values = picture(width, height, channels, (i * 10 + channels) as u64);
                for matrix in [&ClassMatrix::knuth(), &ClassMatrix::four(), &spiral, &one] {
                    let dither = Dither::DotDiffusion(std::borrow::Cow::Owned(matrix.clone()));
                    let codes = dithered(&values, width, channels, bits, &dither);
                    let plain = plain_dots(&values, width, channels, bits, matrix);
                    assert!(
                        codes == plain,
                        "{width}x{height}x{channels}, {bits} bits, size {}",
                        matrix.size()
                    );
                }
            }
        }
    }
}

#[test]
fn a_tile_adds_its_threshold_and_rounds_down() {
    for (width, height) in SIZES {
        for name in ["none", "ordered-2", "ordered-4", "bayer-8", "bayer-64", "blue-noise"] {
            let dither = Dither::named(name).unwrap();
            let tile = dither.thresholds().unwrap();
            for (channels, bits) in [(1, 1), (3, 8), (2, 12), (4, 16), (70, 3)] {
                let values = picture(width, height, channels, 77);
                let codes = dithered(&values, width, channels, bits, &dither);
                for (i, (&value, &code)) in values.iter().zip(&codes).enumerate() {
                    let scaled = unit(value) * ((1u32 << bits) - 1) as f32;
                    let threshold = tile.at(i / channels % width, i / channels / width, i % channels);
                    let expected = (f64::from(scaled) + f64::from(threshold)).floor();
                    assert_eq!(f64::from(code), expected, "{name} at {i}, {value}");
                }
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let (width, height) = (301, 167);
    let values = picture(width, height, 3, 5);
    for name in Dither::names() {
        let dither = Dither::named(name).unwrap();
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| quantise(&values, width, 3, 8, &dither).unwrap())
        };
        let one = run(1);
        for threads in [2, 7] {
            for _ in 0..5 {
                assert!(run(threads) == one, "{name} with {threads} threads");
            }
        }
    }
}

#[test]
fn black_and_white_stay_clean() {
    // Under thresholds and error diffusion even beside other values; under dot diffusion as fields.
    let (width, height) = (200, 100);
    for name in Dither::names() {
        let dither = Dither::named(name).unwrap();
        for bits in 1..=16 {
            let most = (1u32 << bits) - 1;
            for (value, code) in [(0.0, 0), (1.0, most), (f32::NAN, 0), (f32::INFINITY, most), (-1.0, 0)] {
                let codes = dithered(&vec![value; width * height], width, 1, bits, &dither);
                assert!(codes.iter().all(|&c| c == code), "{name}, {bits} bits, {value}");
            }
            if !name.starts_with("dot") {
                let values = picture(width, height, 1, 3);
                let codes = dithered(&values, width, 1, bits, &dither);
                for (value, code) in values.into_iter().zip(codes) {
                    assert!(unit(value) > 0.0 || code == 0, "{name}, {bits} bits");
                    assert!(unit(value) < 1.0 || code == most, "{name}, {bits} bits");
                    assert!(code <= most);
                }
            }
        }
    }
}

/// A ramp of a megapixel along the rows, from `from` to `to`.
fn ramp(from: f64, to: f64, down: bool) -> Vec<f32> {
    let side = 1024;
    (0..side * side)
        .map(|i| {
            let step = if down { i / side } else { i % side };
            (from + (to - from) * (step as f64 + 0.5) / side as f64) as f32
        })
        .collect()
}

fn mean_error(values: &[f32], bits: u32, dither: &Dither) -> f64 {
    let codes = dithered(values, 1024, 1, bits, dither);
    let top = f64::from((1u32 << bits) - 1);
    let shown: f64 = codes.iter().map(|&c| f64::from(c)).sum::<f64>() / top;
    let wanted: f64 = values.iter().map(|&v| f64::from(v)).sum();
    (shown - wanted) / values.len() as f64
}

const RAMPS: [(f64, f64); 5] = [(0.0, 1.0), (1.0, 0.0), (0.02, 0.05), (0.3, 0.71), (0.499, 0.503)];

#[test]
fn ramps_keep_their_mean_at_eight_bits() {
    for name in Dither::names() {
        let dither = Dither::named(name).unwrap();
        for (from, to) in RAMPS {
            for down in [false, true] {
                let error = mean_error(&ramp(from, to, down), 8, &dither);
                // Rounding is no dither: a short ramp between two codes goes wherever it is nearer.
                let limit = if *name == "none" { 0.5 / 255.0 } else { 1e-4 };
                assert!(error.abs() <= limit, "{name}, {from} to {to}: {error}");
            }
        }
    }
}

#[test]
fn ramps_keep_their_mean_at_one_bit() {
    for name in Dither::names() {
        let dither = Dither::named(name).unwrap();
        for (from, to) in RAMPS {
            for down in [false, true] {
                let values = ramp(from, to, down);
                let error = mean_error(&values, 1, &dither);
                let limit = match &dither {
                    // Two barons in sixteen pixels may lose half a code each, and in the dark they always lose it.
                    Dither::DotDiffusion(matrix) if matrix.size() == 4 && (from - to).abs() < 1.0 => {
                        1.0 / 16.0
                    }
                    Dither::ErrorDiffusion { .. } | Dither::DotDiffusion(_) => 1e-3,
                    Dither::Random { .. } => {
                        let variance: f64 = values.iter().map(|&v| f64::from(v) * (1.0 - f64::from(v))).sum();
                        4.0 * variance.sqrt() / values.len() as f64
                    }
                    // The closed form, to the last pixel.
                    Dither::Tile(tile) => {
                        let shown = values.iter().enumerate().filter(|(i, v)| {
                            f64::from(**v) + f64::from(tile.at(i % 1024, i / 1024, 0)) >= 1.0
                        });
                        let wanted: f64 = values.iter().map(|&v| f64::from(v)).sum();
                        let expected = (shown.count() as f64 - wanted) / values.len() as f64;
                        assert_eq!(error, expected, "{name}");
                        continue;
                    }
                };
                assert!(error.abs() <= limit, "{name}, {from} to {to}: {error}, limit {limit}");
            }
        }
    }
}

#[test]
fn an_ordered_field_has_the_mean_of_the_nearest_step() {
    for (name, steps) in [("ordered-2", 4), ("ordered-4", 16), ("bayer-8", 64), ("blue-noise", 4096)] {
        let dither = Dither::named(name).unwrap();
        for value in [0.1f32, 0.25, 0.3333, 0.5, 0.77, 0.999] {
            let codes = dithered(&vec![value; 128 * 128], 128, 1, 1, &dither);
            let shown = codes.iter().sum::<u32>() as f64 / (128.0 * 128.0);
            let expected = (f64::from(value) * f64::from(steps) + 0.5).floor() / f64::from(steps);
            assert_eq!(shown, expected, "{name} at {value}");
        }
    }
}

#[test]
fn tiles_hold_each_odd_number_once() {
    for name in Dither::names() {
        let dither = Dither::named(name).unwrap();
        let Some(tile) = dither.thresholds() else { continue };
        let count = tile.width() * tile.height();
        let mut odd: Vec<f32> = tile.values().iter().map(|t| t * 2.0 * count as f32).collect();
        odd.sort_by(f32::total_cmp);
        assert!(odd.into_iter().eq((0..count).map(|i| (2 * i + 1) as f32)), "{name}");
    }
    let numerators = |name: &str, scale: f32| -> Vec<f32> {
        let dither = Dither::named(name).unwrap();
        dither.thresholds().unwrap().values().iter().map(|t| t * scale).collect()
    };
    assert_eq!(numerators("ordered-2", 8.0), [1., 5., 7., 3.]);
    let four = [1., 17., 5., 21., 25., 9., 29., 13., 7., 23., 3., 19., 31., 15., 27., 11.];
    assert_eq!(numerators("ordered-4", 32.0), four);
}

#[test]
fn half_a_code_is_shown_by_equal_numbers_of_both_under_random_dither() {
    // The book's example: 5.5 is shown as 5 and 6.
    let codes = dithered(&vec![5.5 / 255.0; 1 << 20], 1024, 1, 8, &Dither::Random { seed: 9 });
    let six = codes.iter().filter(|&&c| c == 6).count();
    assert!(codes.iter().all(|&c| c == 5 || c == 6));
    assert!((six as f64 - 524_288.0).abs() < 4.0 * 512.0, "{six}");
}

#[test]
fn random_thresholds_are_those_of_the_pixel() {
    // A crop that keeps its corner, and another number of channels, leave a pixel its threshold; another seed does
    // not.
    let value = 0.37f32;
    let of = |width: usize, channels, seed| {
        dithered(&vec![value; width * 64 * channels], width, channels, 1, &Dither::Random { seed })
    };
    let wide = of(640, 1, 0);
    let narrow = of(333, 1, 0);
    let colour = of(333, 3, 0);
    for y in 0..64 {
        for x in 0..333 {
            assert_eq!(wide[y * 640 + x], narrow[y * 333 + x]);
            assert_eq!(colour[(y * 333 + x) * 3], narrow[y * 333 + x]);
        }
    }
    assert_ne!(narrow, of(333, 1, 1));
    // Channels, rows and seeds are independent: the products of deviations average to nothing.
    let deviation = |codes: &[u32], i: usize| f64::from(codes[i]) - f64::from(value);
    let other = of(333, 1, 1);
    let count = 333 * 63;
    let correlation = |pair: &dyn Fn(usize) -> (f64, f64)| {
        let sum: f64 = (0..count).map(|i| pair(i).0 * pair(i).1).sum();
        sum / (count as f64).sqrt() / (0.37 * 0.63)
    };
    for z in [
        correlation(&|i| (deviation(&colour, 3 * i), deviation(&colour, 3 * i + 1))),
        correlation(&|i| (deviation(&colour, 3 * i + 1), deviation(&colour, 3 * i + 2))),
        correlation(&|i| (deviation(&narrow, i), deviation(&narrow, i + 333))),
        correlation(&|i| (deviation(&narrow, i), deviation(&narrow, i + 1))),
        correlation(&|i| (deviation(&narrow, i), deviation(&other, i))),
    ] {
        assert!(z.abs() < 4.0, "{z}");
    }
}

/// Power of a 64 × 64 pattern of 0 and 1, averaged over rings of one cycle a tile; white noise has `mean(1 − mean)`
/// everywhere.
fn rings(pattern: &[u32]) -> Vec<f64> {
    let n = 64;
    let mean = pattern.iter().sum::<u32>() as f64 / pattern.len() as f64;
    let wave: Vec<(f64, f64)> =
        (0..n).map(|k| (std::f64::consts::TAU * k as f64 / n as f64).sin_cos()).collect();
    // Rows, then columns.
    let transform = |input: &[(f64, f64)]| -> Vec<(f64, f64)> {
        let mut out = vec![(0.0, 0.0); n * n];
        for y in 0..n {
            for f in 0..n {
                let mut sum = (0.0, 0.0);
                for x in 0..n {
                    let ((re, im), (sin, cos)) = (input[y * n + x], wave[f * x % n]);
                    sum = (sum.0 + re * cos + im * sin, sum.1 + im * cos - re * sin);
                }
                out[f * n + y] = sum;
            }
        }
        out
    };
    let start: Vec<(f64, f64)> = pattern.iter().map(|&p| (f64::from(p) - mean, 0.0)).collect();
    let spectrum = transform(&transform(&start));
    let mut power = vec![(0.0, 0usize); n];
    for (i, (re, im)) in spectrum.into_iter().enumerate() {
        let signed = |f: usize| if f > n / 2 { f as f64 - n as f64 } else { f as f64 };
        let ring = signed(i % n).hypot(signed(i / n)).round() as usize;
        power[ring].0 += (re * re + im * im) / (n * n) as f64;
        power[ring].1 += 1;
    }
    power.into_iter().filter(|p| p.1 > 0).map(|(sum, count)| sum / count as f64).collect()
}

#[test]
fn blue_noise_has_no_low_frequencies() {
    let blue = Dither::named("blue-noise").unwrap();
    for value in [0.1f32, 0.25, 0.5, 0.75, 0.9] {
        let white = f64::from(value) * (1.0 - f64::from(value));
        let pattern = |dither: &Dither| dithered(&vec![value; 64 * 64], 64, 1, 1, dither);
        let power = rings(&pattern(&blue));
        // The principal frequency of a pattern of minority pixels is the root of their density, in cycles a pixel.
        let principal = 64.0 * f64::from(value.min(1.0 - value)).sqrt().min(0.707);
        let low = (principal / 3.0) as usize;
        let mean = power[1..low].iter().sum::<f64>() / (low - 1) as f64;
        assert!(mean < 0.08 * white, "{value}: {mean} of {white}");
        let highest = power.iter().copied().fold(0.0, f64::max);
        assert!(highest > 1.5 * white);
        // The same measure sees white noise as white.
        let power = rings(&pattern(&Dither::Random { seed: 4 }));
        let mean = power[1..32].iter().sum::<f64>() / 31.0;
        assert!((mean / white - 1.0).abs() < 0.25, "{value}: {mean} of {white}");
    }
}

#[test]
fn error_diffusion_is_blue_too() {
    for name in ["floyd-steinberg", "floyd-steinberg-serpentine"] {
        let dither = Dither::named(name).unwrap();
        let codes = dithered(&vec![0.3; 256 * 256], 256, 1, 1, &dither);
        // A part that is far from the edge, where the pattern has settled.
        let part: Vec<u32> = (0..64).flat_map(|y| codes[(y + 120) * 256 + 100..][..64].to_vec()).collect();
        let power = rings(&part);
        assert!(power[2..12].iter().sum::<f64>() / 10.0 < 0.1 * 0.3 * 0.7, "{name}");
    }
}

#[test]
fn shifted_channels_leave_less_noise_in_luminance() {
    // Grey fields between codes; the weights are those of Rec. 709.
    let luminance_variance = |dither: &Dither| {
        let mut sum = 0.0;
        for step in 0..16 {
            let value = (100.0 + (f64::from(step) + 0.5) / 16.0) / 255.0;
            let codes = dithered(&vec![value as f32; 64 * 64 * 3], 64, 3, 8, dither);
            for pixel in codes.chunks(3) {
                let [r, g, b] = [0, 1, 2].map(|c| f64::from(pixel[c]) - value * 255.0);
                sum += (0.2126 * r + 0.7152 * g + 0.0722 * b).powi(2);
            }
        }
        sum / (16.0 * 4096.0)
    };
    for (name, ratio) in [("bayer-2", 0.5), ("bayer-8", 0.5), ("blue-noise", 0.65)] {
        let shifted = Dither::named(name).unwrap();
        let alike = shifted.clone().with_channels_alike();
        let found = luminance_variance(&shifted) / luminance_variance(&alike);
        assert!(found < ratio, "{name}: {found}");
        // And alike means that grey stays grey.
        let codes = dithered(&vec![0.42; 64 * 64 * 3], 64, 3, 8, &alike);
        assert!(codes.chunks(3).all(|p| p[0] == p[1] && p[1] == p[2]));
    }
}

#[test]
fn channels_do_not_mix() {
    let (width, height) = (90, 37);
    let values = picture(width, height, 3, 21);
    for name in Dither::names() {
        let dither = Dither::named(name).unwrap().with_channels_alike();
        let together = dithered(&values, width, 3, 4, &dither);
        let first: Vec<f32> = values.iter().step_by(3).copied().collect();
        let alone = dithered(&first, width, 1, 4, &dither);
        assert!(together.iter().step_by(3).eq(&alone), "{name}");
    }
}

#[test]
fn an_exact_code_stays_what_it_is() {
    // All of 8 bits, through every dither that has no error to diffuse.
    let values: Vec<f32> = (0..=255u8).map(|code| f32::from(code) / 255.0).collect();
    for name in Dither::names() {
        let codes = dithered(&values, 16, 1, 8, &Dither::named(name).unwrap());
        let wrong = codes.iter().zip(0..).filter(|(code, i)| **code != *i).count();
        // The product v · 255 may lie a rounding below the code, and a random threshold as near to 0.
        assert!(wrong == 0, "{name}: {wrong}");
    }
}

#[test]
fn wrong_arguments_are_errors() {
    let dither = Dither::named("none").unwrap();
    let bits = |bits| quantise(&[0.0; 4], 2, 2, bits, &dither);
    assert_eq!(bits(0), Err(DitherError::Bits { bits: 0, most: 16 }));
    assert_eq!(bits(17), Err(DitherError::Bits { bits: 17, most: 16 }));
    for (values, width, channels) in [(5, 2, 2), (4, 0, 2), (4, 2, 0), (4, usize::MAX, 2), (0, 2, 0)] {
        let found = quantise(&vec![0.0; values], width, channels, 8, &dither);
        assert_eq!(found, Err(DitherError::Shape { values, width, channels }));
    }
    assert_eq!(quantise(&[], 0, 3, 8, &dither), Ok(Pixels::Eight(vec![])));
    let mut codes = [0u8; 3];
    let found = quantise_into(&[0.0; 4], 2, 2, 8, &dither, &mut codes);
    assert_eq!(found, Err(DitherError::Buffer { found: 3, expected: 4 }));
    let found = quantise_into(&[0.0; 3], 1, 1, 9, &dither, &mut codes);
    assert_eq!(found, Err(DitherError::Bits { bits: 9, most: 8 }));
    for name in ["", "bayer-3", "bayer-128", "bayer-08", "Floyd!"] {
        let error = Dither::named(name).unwrap_err();
        assert_eq!(error, DitherError::Unknown(name.to_owned()));
        assert!(error.to_string().contains("blue-noise"));
    }
}

#[test]
fn a_tile_of_ones_own_can_be_used() {
    let tile = Thresholds::new(3, 1, vec![0.25, 0.5, 0.75]).unwrap().with_shifts(&[(0, 0), (1, 0)]);
    let dither = Dither::Tile(std::borrow::Cow::Owned(tile));
    let codes = dithered(&[0.4; 8], 4, 2, 1, &dither);
    // Thresholds 0.25, 0.5, 0.75, 0.25 in the first channel, 0.5, 0.75, 0.25, 0.5 in the second.
    assert_eq!(codes, [0, 0, 0, 1, 1, 0, 0, 0]);
}
