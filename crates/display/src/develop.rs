//! Exposure, colour system, transfer, quantisation: the order of book figure 5.1.

use illuminant_color::RgbSystem;
use rayon::prelude::*;

/// Code values of an image, three to a pixel, in rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// Eight bits a channel.
    Eight(Vec<u8>),
    /// Sixteen bits a channel.
    Sixteen(Vec<u16>),
}

/// What [`develop`] makes.
#[derive(Clone, Debug)]
pub struct Developed {
    /// The code values.
    pub pixels: Pixels,
    /// The fraction of pixels that lay outside the display's gamut and were clamped, channel by channel.
    pub out_of_gamut: f64,
}

/// Develops an image of XYZ (three values a pixel) for a display.
///
/// Linear RGB is `exposure` × M⁻¹ XYZ; each channel is clamped to [0, 1] (book 5.1.3: the simplest of the gamut
/// methods), taken through the transfer function of `system` and rounded to the nearest of 2⁸ or 2¹⁶ codes. A value
/// that is not finite becomes 0. `exposure` maps the unit of the image to 1 for the display's white.
///
/// ```
/// use illuminant_color::RgbSystem;
/// use illuminant_display::{Pixels, develop};
/// let srgb = RgbSystem::named("sRGB").unwrap();
/// let white = srgb.to_xyz([1.0; 3]).map(|v| v * 100.0); // 100 cd/m²
/// assert_eq!(develop(&white, &srgb, 0.01, false).pixels, Pixels::Eight(vec![255; 3]));
/// ```
#[must_use]
pub fn develop(xyz: &[f64], system: &RgbSystem, exposure: f64, sixteen_bits: bool) -> Developed {
    // A hair of rounding is no colour outside the gamut.
    const SLACK: f64 = 1e-4;
    let linear = |pixel: &[f64]| {
        let xyz = [pixel[0], pixel[1], pixel[2]].map(|v| if v.is_finite() { v * exposure } else { 0.0 });
        system.from_xyz(xyz)
    };
    let code = |v: f64, top: f64| (system.transfer.encode(v.clamp(0.0, 1.0)).clamp(0.0, 1.0) * top).round();
    let outside: usize = xyz
        .par_chunks_exact(3)
        .filter(|pixel| linear(pixel).iter().any(|v| !(-SLACK..=1.0 + SLACK).contains(v)))
        .count();
    let pixels = if sixteen_bits {
        let codes = xyz.par_chunks_exact(3).flat_map_iter(|p| linear(p).map(|v| code(v, 65535.0) as u16));
        Pixels::Sixteen(codes.collect())
    } else {
        let codes = xyz.par_chunks_exact(3).flat_map_iter(|p| linear(p).map(|v| code(v, 255.0) as u8));
        Pixels::Eight(codes.collect())
    };
    Developed { pixels, out_of_gamut: outside as f64 / (xyz.len() / 3).max(1) as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_outside_is_clamped_and_counted() {
        let srgb = RgbSystem::named("sRGB").unwrap();
        let inside = srgb.to_xyz([0.2, 0.2, 0.2]);
        let outside = srgb.to_xyz([2.0, 0.5, -0.1]);
        let image: Vec<f64> = inside.into_iter().chain(outside).chain([f64::NAN; 3]).collect();
        let developed = develop(&image, &srgb, 1.0, false);
        assert!((developed.out_of_gamut - 1.0 / 3.0).abs() < 1e-12);
        let Pixels::Eight(codes) = developed.pixels else { panic!("eight bits were asked for") };
        assert_eq!(codes, [124, 124, 124, 255, 188, 0, 0, 0, 0]);
    }
}
