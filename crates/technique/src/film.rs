//! The film: exact sums of samples, in named layers.
//!
//! Each value is added as a whole multiple of 2⁻⁴⁸ to a 128-bit integer. Integer sums do not depend on their order, so
//! any split of the work (threads, tiles, ranges of samples, machines, restarts) gives the same bits, and no block of
//! samples has to be kept together. Memory depends on pixels and channels, not on samples.

use crate::settings::{Layer, Settings};
use std::ops::Range;

/// The terms of an illumination model as layers.
pub(crate) const TERMS: [&str; 5] = ["ambient", "diffuse", "specular", "transmitted", "emitted"];

/// The smallest size that a film cannot hold, 2⁴⁷: a sample that reaches it is dropped. Below it 2³² samples can be
/// summed without overflow.
pub const TOO_LARGE: f32 = 140_737_488_355_328.0;

/// The number of fraction bits of a sum.
const FRACTION: i32 = 48;

/// Below this size a value's multiple of 2⁻⁴⁸ fits 64 bits.
const SMALL: f32 = 32_768.0;

/// A value of size below [`TOO_LARGE`] as a multiple of 2⁻⁴⁸, towards zero.
#[inline(always)]
#[must_use]
pub fn fixed(value: f32) -> i128 {
    debug_assert!(value.abs() < TOO_LARGE);
    // Nearly every value: its multiple fits 64 bits, and the product is exact.
    if value.abs() < SMALL {
        return i128::from((f64::from(value) * (1i64 << FRACTION) as f64) as i64);
    }
    let bits = value.to_bits();
    let exponent = (bits >> 23 & 0xff) as i32;
    let mantissa = i128::from(bits & 0x7f_ffff | if exponent > 0 { 0x80_0000 } else { 0 });
    let shift = exponent.max(1) - 150 + FRACTION;
    let magnitude = if shift >= 0 { mantissa << shift.min(100) } else { mantissa >> (-shift).min(127) };
    if value.is_sign_negative() { -magnitude } else { magnitude }
}

/// The number that a sum stands for.
#[must_use]
fn value(sum: i128) -> f64 {
    sum as f64 / (1i64 << FRACTION) as f64
}

/// Where the channels of a layer lie among those of a pixel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayerPlan {
    /// Which layer.
    pub layer: Layer,
    /// Its name in files: `xyz`, `lamp:NAME`, …
    pub name: String,
    /// Its channels.
    pub channels: Range<usize>,
}

/// The sums of one tile.
#[derive(Clone, Debug)]
pub struct TileFilm {
    /// x₀, y₀, x₁, y₁ in pixels of the whole image.
    pub area: [u32; 4],
    /// Samples that each pixel holds, dropped ones not counted.
    pub samples: Vec<u32>,
    /// The samples that the tile has seen, as disjoint ranges in order.
    pub(crate) seen: Vec<Range<u64>>,
    pub(crate) sums: Vec<i128>,
    channels: usize,
}

impl TileFilm {
    fn new(area: [u32; 4], channels: usize) -> Self {
        let [x0, y0, x1, y1] = area;
        let pixels = (x1 - x0) as usize * (y1 - y0) as usize;
        let (samples, sums) = (vec![0; pixels], vec![0; pixels * channels]);
        Self { area, samples, seen: Vec::new(), sums, channels }
    }

    /// Forgets all samples.
    fn clear(&mut self) {
        self.samples.fill(0);
        self.sums.fill(0);
        self.seen.clear();
    }

    /// Adds to the channels of a pixel (by its place in the whole image) without counting a sample.
    pub fn splat(&mut self, [x, y]: [u32; 2], values: &[f32]) {
        let pixel = (y - self.area[1]) as usize * self.width() as usize + (x - self.area[0]) as usize;
        let sums = &mut self.sums[pixel * self.channels..][..self.channels];
        sums.iter_mut().zip(values).for_each(|(sum, &v)| *sum += fixed(v));
    }

    /// Counts samples of every pixel.
    pub fn count(&mut self, samples: u32) {
        self.samples.iter_mut().for_each(|n| *n += samples);
    }

    /// Adds the channels of one sample of a pixel (by its number within the tile).
    #[inline(always)]
    pub fn add(&mut self, pixel: usize, values: &[f32]) {
        self.samples[pixel] += 1;
        let sums = &mut self.sums[pixel * self.channels..][..self.channels];
        for (sum, &v) in sums.iter_mut().zip(values) {
            if v != 0.0 {
                *sum += fixed(v);
            }
        }
    }

    /// The parts of a range of samples that the tile has not seen, which it then counts as seen: so that a range which
    /// was cancelled half-way, or overlaps another, is taken up where it is missing.
    pub fn claim(&mut self, wanted: Range<u64>) -> Vec<Range<u64>> {
        let mut missing = Vec::new();
        let mut from = wanted.start;
        for seen in &self.seen {
            if seen.start > from && from < wanted.end {
                missing.push(from..seen.start.min(wanted.end));
            }
            from = from.max(seen.end);
        }
        if from < wanted.end {
            missing.push(from..wanted.end);
        }
        self.seen.extend(missing.iter().cloned());
        self.seen.sort_by_key(|range| range.start);
        let mut joined: Vec<Range<u64>> = Vec::with_capacity(self.seen.len());
        for range in self.seen.drain(..) {
            match joined.last_mut().filter(|last| last.end == range.start) {
                Some(last) => last.end = range.end,
                None => joined.push(range),
            }
        }
        self.seen = joined;
        missing
    }

    /// Columns of the tile.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.area[2] - self.area[0]
    }
}

/// All tiles of a cropped image.
#[derive(Clone, Debug)]
pub struct Film {
    /// x₀, y₀, x₁, y₁ in pixels of the whole image.
    pub crop: [u32; 4],
    /// The layers.
    pub plan: Vec<LayerPlan>,
    /// The tiles, row by row.
    pub tiles: Vec<TileFilm>,
    /// What paths from lamps bring, over the whole crop, if there are such paths.
    pub from_lamps: Option<TileFilm>,
    channels: usize,
}

impl Film {
    /// An empty film for a crop, with the layers that `settings` ask for; `lamps` are their names and `spectral` the
    /// number of spectral samples.
    #[must_use]
    pub fn new(crop: [u32; 4], settings: &Settings, lamps: &[String], spectral: usize) -> Self {
        Self::with_tiles(crop, [settings.tile; 2], settings, lamps, spectral)
    }

    /// The layers that settings ask for, and how many channels they have in all.
    pub(crate) fn plan(settings: &Settings, lamps: &[String], spectral: usize) -> (Vec<LayerPlan>, usize) {
        let mut plan = Vec::new();
        let mut channels = 0;
        let mut push = |layer: Layer, name: String, count: usize| {
            plan.push(LayerPlan { layer, name, channels: channels..channels + count });
            channels += count;
        };
        push(Layer::Xyz, "xyz".into(), 3);
        if settings.replicates > 1 {
            push(Layer::Halves, "halves".into(), 2);
        }
        for layer in &settings.layers {
            match layer {
                Layer::Xyz | Layer::Halves | Layer::LampSpectra => {}
                Layer::Lamps => lamps.iter().for_each(|name| push(Layer::Lamps, format!("lamp:{name}"), 3)),
                Layer::Spectra => push(Layer::Spectra, "spectra".into(), spectral),
                Layer::Depth => push(Layer::Depth, "depth".into(), 2),
                Layer::Normal => push(Layer::Normal, "normal".into(), 3),
                Layer::Albedo => push(Layer::Albedo, "albedo".into(), 3),
                Layer::Emission => push(Layer::Emission, "emission".into(), 1),
                Layer::Terms => TERMS.iter().for_each(|name| push(Layer::Terms, (*name).into(), 3)),
            }
        }
        if [Layer::Lamps, Layer::Spectra].iter().all(|layer| settings.layers.contains(layer)) {
            lamps.iter().for_each(|name| push(Layer::LampSpectra, format!("spectra:{name}"), spectral));
        }
        (plan, channels)
    }

    /// The same with tiles of a width and a height.
    #[must_use]
    pub fn with_tiles(
        crop: [u32; 4],
        tile: [u32; 2],
        settings: &Settings,
        lamps: &[String],
        spectral: usize,
    ) -> Self {
        let (plan, channels) = Self::plan(settings, lamps, spectral);
        let [width, height] = tile.map(|size| size.max(1));
        let [x0, y0, x1, y1] = crop;
        let mut tiles = Vec::new();
        for y in (y0..y1).step_by(height as usize) {
            for x in (x0..x1).step_by(width as usize) {
                let area = [x, y, x.saturating_add(width).min(x1), y.saturating_add(height).min(y1)];
                tiles.push(TileFilm::new(area, channels));
            }
        }
        let from_lamps = settings.caustics.then(|| TileFilm::new(crop, channels));
        Self { crop, plan, tiles, from_lamps, channels }
    }

    /// Forgets all samples.
    pub fn clear(&mut self) {
        self.tiles
            .iter_mut()
            .chain(&mut self.from_lamps)
            .filter(|tile| !tile.seen.is_empty())
            .for_each(TileFilm::clear);
    }

    /// Channels of a pixel, over all layers.
    #[must_use]
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// Width and height of the crop.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        let [x0, y0, x1, y1] = self.crop;
        [(x1 - x0) as usize, (y1 - y0) as usize]
    }

    /// The number that the channel of a pixel holds over its samples: what its own samples brought, and the paths from lamps.
    fn mean(&self, pixel: usize, channel: usize, samples: f64, sum: i128) -> f64 {
        let own = if samples > 0.0 { value(sum) / samples } else { 0.0 };
        let Some(film) = self.from_lamps.as_ref().filter(|film| film.samples[pixel] > 0) else { return own };
        own + value(film.sums[pixel * self.channels + channel]) / f64::from(film.samples[pixel])
    }

    /// Calls `f` with the place of each pixel in the crop (row-major), its samples and its sums.
    fn for_each(&self, mut f: impl FnMut(usize, u32, &[i128])) {
        let [width, _] = self.size();
        for tile in &self.tiles {
            for (i, &samples) in tile.samples.iter().enumerate() {
                let (dx, dy) = (i as u32 % tile.width(), i as u32 / tile.width());
                let (x, y) = (tile.area[0] + dx - self.crop[0], tile.area[1] + dy - self.crop[1]);
                f(y as usize * width + x as usize, samples, &tile.sums[i * self.channels..][..self.channels]);
            }
        }
    }

    /// Samples of each pixel of the crop, row-major.
    #[must_use]
    pub fn samples(&self) -> Vec<u32> {
        let [w, h] = self.size();
        let mut counts = vec![0; w * h];
        self.for_each(|pixel, samples, _| counts[pixel] = samples);
        counts
    }

    /// The mean of a layer, by name, row-major with its channels together, and how many they are; a pixel without
    /// samples is 0. Depth is the mean over the samples that met something, infinity where none did.
    #[must_use]
    pub fn layer(&self, name: &str) -> Option<(Vec<f64>, usize)> {
        let plan = self.plan.iter().find(|plan| plan.name == name)?;
        let [w, h] = self.size();
        let depth = plan.layer == Layer::Depth;
        let count = if depth { 1 } else { plan.channels.len() };
        let mut image = vec![0.0; w * h * count];
        self.for_each(|pixel, samples, all| {
            let sums = &all[plan.channels.clone()];
            if depth {
                image[pixel] = if sums[1] == 0 { f64::INFINITY } else { value(sums[0]) / value(sums[1]) };
            } else {
                for (slot, channel) in image[pixel * count..].iter_mut().zip(plan.channels.clone()) {
                    *slot = self.mean(pixel, channel, f64::from(samples), all[channel]);
                }
            }
        });
        Some((image, count))
    }

    /// The standard error of Y in each pixel, row-major, from two independently scrambled halves of its samples:
    /// |A − B|/2 for their means A and B. `None` when the film was not told to keep halves; infinity where one is empty.
    #[must_use]
    pub fn standard_error(&self) -> Option<Vec<f64>> {
        let halves = self.plan.iter().find(|plan| plan.layer == Layer::Halves)?;
        let [w, h] = self.size();
        let mut error = vec![f64::INFINITY; w * h];
        // How far the halves of the light from lamps lie apart: odd samples are one of them.
        let from_lamps = self.from_lamps.as_ref().map(|film| {
            move |pixel: usize| {
                let sums = &film.sums[pixel * self.channels..][..self.channels];
                let (y, half) = (value(sums[1]), value(sums[halves.channels.start]));
                let odd = f64::from(film.samples[pixel] / 2);
                let even = f64::from(film.samples[pixel]) - odd;
                half / odd.max(1.0) - (y - half) / even.max(1.0)
            }
        });
        self.for_each(|pixel, samples, sums| {
            let y = value(sums[1]);
            let (half_y, half_n) =
                (value(sums[halves.channels.start]), value(sums[halves.channels.start + 1]));
            let other = f64::from(samples) - half_n;
            if half_n > 0.0 && other > 0.0 {
                let apart = half_y / half_n - (y - half_y) / other;
                let more = from_lamps.as_ref().map_or(0.0, |of| of(pixel));
                error[pixel] = (apart + more).abs() / 2.0;
            }
        });
        Some(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn fixed_point_is_the_value(v in -1e12f32..1e12) {
            let back = value(fixed(v));
            prop_assert!((back - f64::from(v)).abs() <= 4e-15 + 1e-15 * f64::from(v).abs());
        }

        #[test]
        fn small_values_are_cut_off_as_large_ones_are(v in -65536f32..65536.0) {
            // Exactly, whichever way it was found: what is lost lies below the last bit, towards zero.
            let exact = f64::from(v) * (1u64 << FRACTION) as f64;
            prop_assert_eq!(fixed(v), exact as i128);
            let tiny = v * 2f32.powi(-40);
            prop_assert_eq!(fixed(tiny), (f64::from(tiny) * (1u64 << FRACTION) as f64) as i128);
        }

        #[test]
        fn sums_do_not_depend_on_order(mut values in prop::collection::vec(0.0f32..1e9, 1..50)) {
            let sum = |v: &[f32]| v.iter().map(|&x| fixed(x)).sum::<i128>();
            let forward = sum(&values);
            values.reverse();
            prop_assert_eq!(forward, sum(&values));
        }
    }

    #[test]
    fn no_sample_is_claimed_twice() {
        let film = Film::new([0, 0, 4, 4], &Settings::default(), &[], 8);
        let mut tile = film.tiles[0].clone();
        let one = |range: Range<u64>| vec![range];
        assert_eq!(tile.claim(4..8), one(4..8));
        assert_eq!(tile.claim(4..8), Vec::new());
        assert_eq!(tile.claim(0..16), [0..4, 8..16]);
        assert_eq!(tile.claim(20..24), one(20..24));
        assert_eq!(tile.claim(10..22), one(16..20));
        assert_eq!(tile.seen, one(0..24));
    }

    #[test]
    fn the_largest_value_fits_four_thousand_million_times() {
        let largest = f32::from_bits(TOO_LARGE.to_bits() - 1);
        assert_eq!(value(fixed(largest)), f64::from(largest));
        assert!(fixed(largest).checked_mul(1 << 32).is_some());
        assert_eq!(fixed(f32::MIN_POSITIVE), 0);
        assert_eq!((value(fixed(1.0)), value(fixed(-0.75))), (1.0, -0.75));
    }
}
