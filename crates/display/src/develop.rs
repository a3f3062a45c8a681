//! From XYZ to the code values of a display, in the order of book figure 5.1 (right): exposure, colour correction, tone,
//! gamut, transfer; dither and quantisation follow.
//!
//! Work goes row by row in blocks of pixels that stay in the first cache: the matrix over all, the gamut's method over
//! those that lie outside, a table for the transfer function, and the thresholds of an ordered dither in the same pass.

use crate::dither::{self, Code, Dither, DitherError, quantise_into};
use crate::{Display, EncodingTable, Gamut, GamutMap, Tone};
use illuminant_color::Triple;
use rayon::prelude::*;

/// Code values of an image, in rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Up to eight bits a channel.
    Eight(Vec<u8>),
    /// Nine to sixteen bits a channel.
    Sixteen(Vec<u16>),
}

/// How an image is developed for a display.
#[derive(Clone, Debug)]
pub struct Development {
    display: Display,
    /// From the unit of the image to light, 1 for the display's white.
    scale: f64,
    /// What the display sends by itself, in the same light; it cannot be taken away.
    shift: f64,
    tone: Tone,
    gamut: GamutMap,
    tables: [EncodingTable; 3],
}

/// What was met on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Met {
    /// Pixels with a channel below 0: their chromaticity lies outside the gamut (book 5.1.3, first category).
    pub negative: usize,
    /// Pixels with a channel above 1 and none below 0: too bright (book 5.1.3, second category).
    pub above: usize,
    /// Pixels that are no numbers; they become black.
    pub not_finite: usize,
}

impl Met {
    fn with(self, other: Self) -> Self {
        Self {
            negative: self.negative + other.negative,
            above: self.above + other.above,
            not_finite: self.not_finite + other.not_finite,
        }
    }
}

/// A number of an image: f32 or f64.
pub trait Sample: Copy + Send + Sync {
    /// As a 32-bit float.
    fn single(self) -> f32;
    /// As a 64-bit float.
    fn double(self) -> f64;
}

impl Sample for f32 {
    #[inline(always)]
    fn single(self) -> f32 {
        self
    }
    #[inline(always)]
    fn double(self) -> f64 {
        f64::from(self)
    }
}

impl Sample for f64 {
    #[inline(always)]
    fn single(self) -> f32 {
        self as f32
    }
    #[inline(always)]
    fn double(self) -> f64 {
        self
    }
}

/// A hair of rounding is no colour outside the gamut: of the largest channel, and beyond white.
const SLACK: f32 = 1e-4;
const BLOCK: usize = 128;

type Block = [[f32; BLOCK]; 3];

impl Development {
    /// Development for a display.
    ///
    /// `exposure` takes the unit of the image to 1 for `reference`, the luminance on this display (cd/m²) of what the
    /// image's author calls white: the display's own white as a rule, 203 cd/m² on one of high dynamic range.
    #[must_use]
    pub fn new(display: Display, exposure: f64, reference: f64, tone: Tone, gamut: Gamut) -> Self {
        let range = display.peak() - display.black();
        let gamut = GamutMap::new(gamut, display.system());
        let tables = std::array::from_fn(|c| EncodingTable::new(&display.responses()[c]));
        Self {
            scale: exposure * reference / range,
            shift: -display.black() / range,
            tone,
            gamut,
            tables,
            display,
        }
    }

    /// The light of each channel that an XYZ asks for, before the gamut's method.
    #[must_use]
    pub fn light(&self, xyz: Triple) -> Triple {
        let rgb = self.display.system().from_xyz(xyz).map(|v| v * self.scale + self.shift);
        self.tone.apply(rgb, self.display.system().to_xyz_rows()[1])
    }

    /// Develops an image: XYZ in, three values a pixel, `width` pixels a row.
    ///
    /// `emit` takes the code values of a block, 0 to 1, channel by channel, with the row and the first column, and writes
    /// the block's part of the output.
    fn rows<T: Sample, C: Send>(
        &self,
        xyz: &[T],
        width: usize,
        output: &mut [C],
        emit: impl Fn(usize, usize, &Block, &mut [C]) + Sync,
    ) -> Met {
        let whole = self.whole_image(xyz);
        let row = 3 * width.max(1);
        output
            .par_chunks_mut(row)
            .zip(xyz.par_chunks(row))
            .enumerate()
            .map(|(y, (output, xyz))| {
                let mut met = Met::default();
                let mut block: Block = [[0.0; BLOCK]; 3];
                let blocks = output.chunks_mut(3 * BLOCK).zip(xyz.chunks(3 * BLOCK));
                for (number, (output, xyz)) in blocks.enumerate() {
                    met = met.with(self.block(xyz, whole, &mut block));
                    emit(y, number * BLOCK, &block, output);
                }
                met
            })
            .reduce(Met::default, Met::with)
    }

    /// The code values of up to [`BLOCK`] pixels.
    fn block<T: Sample>(&self, xyz: &[T], whole: f64, block: &mut Block) -> Met {
        let count = xyz.len() / 3;
        self.correct(xyz, whole, block);
        let every = self.tone != Tone::None || self.gamut.moves_all();
        let ootf = self.display.ootf_gamma().is_some();
        let method = self.gamut.gamut();
        let met = if every
            || ootf
            || !matches!(method, Gamut::Clamp | Gamut::Scale | Gamut::ScaleImage | Gamut::Cook)
        {
            self.one_by_one(xyz, whole, block)
        } else {
            let met = self.classified(block, count);
            if met != Met::default() {
                self.together(block);
            }
            met
        };
        for (channel, table) in block.iter_mut().zip(&self.tables) {
            for value in &mut channel[..count] {
                *value = table.encode(*value);
            }
        }
        met
    }

    /// Exposure and colour correction: the light of each channel, as far as the display could send any.
    #[inline(always)]
    fn correct<T: Sample>(&self, xyz: &[T], whole: f64, [red, green, blue]: &mut Block) {
        let rows = self.display.system().from_xyz_rows();
        let [r, g, b] = rows.map(|row| row.map(|v| (v * self.scale * whole) as f32));
        let shift = (self.shift * whole) as f32;
        let channel = |row: [f32; 3], x: f32, y: f32, z: f32| {
            row[0].mul_add(x, row[1].mul_add(y, row[2].mul_add(z, shift)))
        };
        let channels = red.iter_mut().zip(green).zip(blue);
        for (pixel, ((red, green), blue)) in xyz.chunks_exact(3).zip(channels) {
            let [x, y, z] = [pixel[0].single(), pixel[1].single(), pixel[2].single()];
            *red = channel(r, x, y, z);
            *green = channel(g, x, y, z);
            *blue = channel(b, x, y, z);
        }
    }

    /// The methods of which no choice depends on the pixel, over a whole block at once and in f32; see [`GamutMap`].
    fn together(&self, [red, green, blue]: &mut Block) {
        let add_white = self.gamut.gamut() == Gamut::Cook;
        let divide = add_white || self.gamut.gamut() == Gamut::Scale;
        let [wr, wg, wb] = self.display.system().to_xyz_rows()[1].map(|v| v as f32);
        let floor = self.floor();
        for ((red, green), blue) in red.iter_mut().zip(green).zip(blue) {
            // A pixel is moved for its own sake, never for a neighbour's.
            let moved = kind([*red, *green, *blue], floor) != Met::default();
            let before = [*red, *green, *blue];
            // What is no number is black.
            let finite = (*red + *green + *blue).abs() < f32::INFINITY;
            let mut rgb = [*red, *green, *blue].map(|v| if finite { v } else { 0.0 });
            if add_white {
                let axis = wr * rgb[0] + wg * rgb[1] + wb * rgb[2];
                let low = rgb[0].min(rgb[1]).min(rgb[2]).min(0.0);
                let part = if low < 0.0 { axis / (axis - low) } else { 1.0 };
                let part = if axis > 0.0 { part } else { 0.0 };
                let axis = axis.max(0.0);
                let whiter = rgb.map(|v| (v - axis).mul_add(part, axis));
                rgb = if low < 0.0 { whiter } else { rgb };
            }
            if divide {
                let high = rgb[0].max(rgb[1]).max(rgb[2]).max(1.0);
                rgb = rgb.map(|v| v / high);
            }
            [*red, *green, *blue] = std::array::from_fn(|c| if moved { rgb[c] } else { before[c] });
        }
    }

    /// Tone, gamut and OOTF of the pixels that need any, one by one and in f64.
    fn one_by_one<T: Sample>(&self, xyz: &[T], whole: f64, block: &mut Block) -> Met {
        let every = self.tone != Tone::None || self.gamut.moves_all();
        let ootf = self.display.ootf_gamma().is_some();
        let floor = self.floor();
        let mut met = Met::default();
        for (i, pixel) in xyz.chunks_exact(3).enumerate() {
            if !every && !ootf && kind([block[0][i], block[1][i], block[2][i]], floor) == Met::default() {
                continue;
            }
            let asked = self.light([pixel[0], pixel[1], pixel[2]].map(Sample::double)).map(|v| v * whole);
            let found = kind(asked.map(|v| v as f32), floor);
            met = met.with(found);
            let mut rgb = if found.not_finite > 0 {
                [0.0; 3]
            } else if every || found != Met::default() {
                self.gamut.map(asked)
            } else {
                asked
            };
            if ootf {
                // The display is bounded by its own white, the signal by the light of the scene: what asks for more of that
                // is too bright, and is scaled at its chromaticity.
                let scene = self.display.before_ootf(rgb.map(|v| v.clamp(0.0, 1.0)));
                let high = scene.into_iter().fold(1.0, f64::max);
                met.above += usize::from(high > 1.0 + f64::from(SLACK) && found == Met::default());
                rgb = scene.map(|v| v / high);
            }
            for (channel, v) in block.iter_mut().zip(rgb) {
                channel[i] = v as f32;
            }
        }
        met
    }

    /// What no light at all becomes: a colour darker than the display's black is not outside for its chromaticity.
    fn floor(&self) -> f32 {
        self.shift as f32
    }

    fn classified(&self, block: &Block, count: usize) -> Met {
        let floor = self.floor();
        let [mut negative, mut above, mut not_finite] = [0u32; 3];
        for ((&red, &green), &blue) in
            block[0][..count].iter().zip(&block[1][..count]).zip(&block[2][..count])
        {
            let met = kind([red, green, blue], floor);
            negative += met.negative as u32;
            above += met.above as u32;
            not_finite += met.not_finite as u32;
        }
        Met { negative: negative as usize, above: above as usize, not_finite: not_finite as usize }
    }

    /// What the whole image is multiplied by: less than 1 only for [`Gamut::ScaleImage`].
    fn whole_image<T: Sample>(&self, xyz: &[T]) -> f64 {
        if self.gamut.gamut() != Gamut::ScaleImage {
            return 1.0;
        }
        let largest = |pixel: &[T]| {
            let rgb = self.light([pixel[0], pixel[1], pixel[2]].map(Sample::double));
            rgb.into_iter().filter(|v| v.is_finite()).fold(1.0, f64::max)
        };
        1.0 / xyz.par_chunks_exact(3).map(largest).reduce(|| 1.0, f64::max)
    }
}

/// Where a colour lies: outside by a negative channel, too bright, or no number. `floor` is what remains of no light
/// at all when the black of the display is taken away.
#[inline(always)]
fn kind(rgb: [f32; 3], floor: f32) -> Met {
    let finite = (rgb[0] + rgb[1] + rgb[2]).abs() < f32::INFINITY;
    let high = rgb[0].max(rgb[1]).max(rgb[2]);
    let low = rgb[0].min(rgb[1]).min(rgb[2]);
    let negative = finite && low < floor - SLACK * high.max(0.0) - 1e-7;
    let above = finite && !negative && high > 1.0 + SLACK;
    Met { negative: negative.into(), above: above.into(), not_finite: (!finite).into() }
}

/// Develops an image of XYZ into code values from 0 to 1, three a pixel.
///
/// A pixel that is no number is black. See [`Development`] for what is done, and [`Met`] for what is reported.
///
/// ```
/// use illuminant_color::{RgbSystem, Transfer};
/// use illuminant_display::{Development, Display, Gamut, Response, Tone, develop};
/// let response = || Response::Transfer(Transfer::Srgb);
/// let system = RgbSystem::named("sRGB").unwrap();
/// let display = Display::new(system, [response(), response(), response()], 100.0, 0.0)?;
/// let white = display.to_xyz([1.0; 3]);
/// let development = Development::new(display, 0.01, 100.0, Tone::None, Gamut::Clamp);
/// let mut codes = [0.0; 3];
/// develop(&white, 1, &development, &mut codes);
/// assert!(codes.iter().all(|code| (code - 1.0).abs() < 1e-6));
/// # Ok::<(), illuminant_display::DisplayError>(())
/// ```
pub fn develop<T: Sample>(xyz: &[T], width: usize, development: &Development, codes: &mut [f32]) -> Met {
    development.rows(xyz, width, codes, |_, _, block, output| {
        for (i, pixel) in output.chunks_exact_mut(3).enumerate() {
            pixel.copy_from_slice(&[block[0][i], block[1][i], block[2][i]]);
        }
    })
}

/// Develops an image of XYZ into codes of `bits` bits, three a pixel: [`develop`] and [`crate::quantise`] in one.
///
/// A dither of thresholds is added in the same pass; for the others the code values of the whole image are kept.
///
/// # Errors
/// [`DitherError`]: the number of bits, the shape of the image or the length of the buffer is not possible.
pub fn develop_codes<T: Sample, C: Code>(
    xyz: &[T],
    width: usize,
    development: &Development,
    bits: u32,
    dither: &Dither,
    codes: &mut [C],
) -> Result<Met, DitherError> {
    dither::check(xyz.len(), width, 3, bits, C::BITS)?;
    if codes.len() != xyz.len() {
        return Err(DitherError::Buffer { found: codes.len(), expected: xyz.len() });
    }
    let Some(tile) = dither.thresholds() else {
        let mut values = vec![0.0; xyz.len()];
        let met = develop(xyz, width, development, &mut values);
        quantise_into(&values, width, 3, bits, dither, codes)?;
        return Ok(met);
    };
    // A row of complements is long enough for a block to begin anywhere in the tile.
    let rows: Vec<Vec<f32>> = (0..tile.height())
        .map(|y| {
            let period = tile.row(y, 3);
            period.iter().map(|t| 1.0 - t).cycle().take(3 * BLOCK + period.len()).collect()
        })
        .collect();
    Ok(development.rows(xyz, width, codes, |y, x, block, output| {
        let complements = &rows[y % rows.len()][3 * (x % tile.width())..];
        let mut values = [0.0; 3 * BLOCK];
        for (i, pixel) in values.chunks_exact_mut(3).enumerate() {
            pixel.copy_from_slice(&[block[0][i], block[1][i], block[2][i]]);
        }
        dither::thresholds::step_all(&values[..output.len()], bits, complements, output);
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Response;
    use illuminant_color::{RgbSystem, Transfer};

    fn development(gamut: Gamut, tone: Tone) -> Development {
        let response = Response::Transfer(Transfer::Srgb);
        let system = RgbSystem::named("sRGB").unwrap();
        let display =
            Display::new(system, [response.clone(), response.clone(), response], 100.0, 0.0).unwrap();
        Development::new(display, 1.0, 100.0, tone, gamut)
    }

    #[test]
    fn what_lies_outside_is_counted_by_its_kind() {
        let srgb = RgbSystem::named("sRGB").unwrap();
        let pixels = [[0.2; 3], [2.0, 0.5, -0.1], [1.5, 0.2, 0.0]].map(|rgb| srgb.to_xyz(rgb));
        let image: Vec<f64> = pixels.into_iter().flatten().chain([f64::NAN; 3]).collect();
        let mut codes = [0.0; 12];
        let met = develop(&image, 2, &development(Gamut::Clamp, Tone::None), &mut codes);
        assert_eq!(met, Met { negative: 1, above: 1, not_finite: 1 });
        let eight = codes.map(|code| (code * 255.0).round() as u8);
        assert_eq!(eight, [124, 124, 124, 255, 188, 0, 255, 124, 0, 0, 0, 0]);
    }

    #[test]
    fn both_widths_agree_and_blocks_leave_no_seam() {
        let image: Vec<f64> = (0..3 * 301 * 2).map(|i| f64::from(i * 37 % 1000) / 900.0).collect();
        let single: Vec<f32> = image.iter().map(|&v| v as f32).collect();
        for gamut in [Gamut::Clamp, Gamut::Oklab, Gamut::Soft] {
            let development = development(gamut, Tone::FilmicHue);
            let (mut a, mut b) = (vec![0.0; image.len()], vec![0.0; image.len()]);
            develop(&image, 301, &development, &mut a);
            develop(&single, 301, &development, &mut b);
            for (i, (a, b)) in a.iter().zip(&b).enumerate() {
                assert!((a - b).abs() < 2e-4, "{gamut:?}: {i}: {a} and {b}");
            }
        }
    }

    #[test]
    fn a_block_at_once_is_what_its_pixels_are_one_by_one() {
        // Among them colours that lie outside by less than rounding, beside some that lie far outside.
        let image: Vec<f64> = (0..3 * 500)
            .map(|i| f64::from(i * 61 % 997) / if i / 3 % 5 == 0 { 6e6 } else { 600.0 })
            .collect();
        for gamut in [Gamut::Clamp, Gamut::Scale, Gamut::Cook] {
            let development = development(gamut, Tone::None);
            let mut codes = vec![0.0; image.len()];
            develop(&image, 250, &development, &mut codes);
            for (pixel, codes) in image.chunks_exact(3).zip(codes.chunks_exact(3)) {
                let light = development.light([pixel[0], pixel[1], pixel[2]]);
                let outside = kind(light.map(|v| v as f32), 0.0) != Met::default();
                let wanted = if outside { development.gamut.map(light) } else { light };
                let wanted = development.display.encode(wanted);
                for (a, b) in codes.iter().zip(wanted) {
                    assert!(
                        (f64::from(*a) - b).abs() < 2e-5,
                        "{gamut:?}: {light:?}: {codes:?} and {wanted:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn black_is_no_colour_outside_the_gamut() {
        let response = Response::Transfer(Transfer::Srgb);
        let system = RgbSystem::named("sRGB").unwrap();
        let display =
            Display::new(system, [response.clone(), response.clone(), response], 118.0, 0.21).unwrap();
        let dim = display.system().to_xyz([0.001, 0.0, 0.0005]);
        let development = Development::new(display, 1.0, 118.0, Tone::None, Gamut::Cook);
        let image: Vec<f64> = [0.0; 3].into_iter().chain(dim).collect();
        let mut codes = [1.0; 6];
        assert_eq!(develop(&image, 2, &development, &mut codes), Met::default());
        assert_eq!(codes, [0.0; 6]);
    }

    #[test]
    fn hybrid_log_gamma_keeps_the_chromaticity_of_what_its_signal_cannot_hold() {
        let hlg = || Response::Hlg;
        let system = RgbSystem::named("Rec.2020").unwrap();
        let display = Display::new(system, [hlg(), hlg(), hlg()], 1000.0, 0.0).unwrap();
        let asked = [[0.0, 0.0, 1.0], [1.0, 0.5, 0.0], [0.4, 0.4, 0.4]];
        let image: Vec<f64> = asked.iter().flat_map(|&rgb| display.system().to_xyz(rgb)).collect();
        let development = Development::new(display.clone(), 1.0, 1000.0, Tone::None, Gamut::Cook);
        let mut codes = [0.0; 9];
        let met = develop(&image, 3, &development, &mut codes);
        assert_eq!(met, Met { above: 2, ..Met::default() });
        for (asked, codes) in asked.iter().zip(codes.chunks_exact(3)) {
            let shown = display.decode([0, 1, 2].map(|c| f64::from(codes[c])));
            let part = shown.into_iter().fold(0.0, f64::max) / asked.iter().copied().fold(0.0, f64::max);
            assert!(part < 1.0 + 1e-4 && part > 0.5);
            for (shown, asked) in shown.iter().zip(asked) {
                assert!((shown - part * asked).abs() < 2e-4, "{asked} is shown as {shown}");
            }
        }
    }

    #[test]
    fn infinity_is_black_by_every_method() {
        let image = [1.0, 1.0, f64::INFINITY, f64::NEG_INFINITY, 1.0, 1.0];
        for name in Gamut::names() {
            let mut codes = [1.0; 6];
            let met = develop(&image, 2, &development(Gamut::named(name).unwrap(), Tone::None), &mut codes);
            assert_eq!((met.not_finite, codes), (2, [0.0; 6]), "{name}");
        }
    }

    #[test]
    fn dither_in_the_same_pass_is_dither_after_it() {
        let image: Vec<f32> = (0..3 * 300 * 7).map(|i| (i * 61 % 997) as f32 / 700.0).collect();
        let development = development(Gamut::Cook, Tone::None);
        let mut values = vec![0.0; image.len()];
        let met = develop(&image, 300, &development, &mut values);
        for name in Dither::names() {
            let dither = Dither::named(name).unwrap();
            for bits in [1, 5, 8] {
                let (mut one, mut two) = (vec![0u8; image.len()], vec![0u8; image.len()]);
                assert_eq!(develop_codes(&image, 300, &development, bits, &dither, &mut one), Ok(met));
                quantise_into(&values, 300, 3, bits, &dither, &mut two).unwrap();
                assert!(one == two, "{name} at {bits} bits");
            }
        }
    }

    #[test]
    fn the_whole_image_is_darkened_until_nothing_is_too_bright() {
        let srgb = RgbSystem::named("sRGB").unwrap();
        let image: Vec<f64> =
            [[4.0, 1.0, 1.0], [0.4, 0.4, 0.4]].iter().flat_map(|&rgb| srgb.to_xyz(rgb)).collect();
        let mut codes = [0.0; 6];
        develop(&image, 2, &development(Gamut::ScaleImage, Tone::None), &mut codes);
        let linear = codes.map(|code| Transfer::Srgb.decode(f64::from(code)));
        for (a, b) in linear.into_iter().zip([1.0, 0.25, 0.25, 0.1, 0.1, 0.1]) {
            assert!((a - b).abs() < 1e-5, "{linear:?}");
        }
    }
}
