//! Bringing a colour that a display cannot show into its gamut (book 5.1.3 and III.9).
//!
//! All work on linear RGB of the display, whose gamut is the cube from 0 to 1. A colour inside is left as it is, bit
//! for bit, by all but `soft`.
//!
//! | name | what it keeps | source |
//! | --- | --- | --- |
//! | `clamp` | each channel that is inside | book III.9, `CLR_clamp_rgb` |
//! | `scale` | chromaticity, if no channel is negative | book III.9, `CLR_scale_rgb` |
//! | `constant-intensity` | r + g + b, and the direction from the neutral axis | book III.9, `CLR_clip_rgb` |
//! | `constant-luminance` | Y, and dominant wavelength | book 5.1.3 |
//! | `cook` | dominant wavelength, by adding white; then chromaticity | Cook 1981, book 5.1.3 |
//! | `oklab` | lightness and hue in Oklab; chroma is reduced | Ottosson 2020 |
//! | `oklab-adaptive` | hue in Oklab; lightness gives way the more, the more chroma is lost | Ottosson 2021 |
//! | `cam16` | lightness and hue in CAM16-UCS; chroma is reduced | Li et al. 2017 |
//! | `soft` | smoothness: what is inside gives way too, so that no gradient has a kink | after ACES 1.3 |
//! | `scale-image` | chromaticity and contrast of the whole image, which is darkened | book 5.1.3 |
//!
//! NaN becomes 0 in all of them.

mod desaturation;
mod soft;
mod uniform;

use illuminant_color::{RgbSystem, Triple};

/// A method that brings colours into a gamut.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Gamut {
    /// Each channel by itself.
    Clamp,
    /// Negative channels to 0, then all divided by the largest.
    Scale,
    /// Towards the neutral axis in a plane perpendicular to it.
    ConstantIntensity,
    /// Towards the neutral axis at constant luminance.
    ConstantLuminance,
    /// White is added until no channel is negative, at constant luminance; then as `Scale`.
    Cook,
    /// Chroma is reduced in Oklab at constant lightness and hue.
    Oklab,
    /// Chroma is reduced in Oklab at constant hue towards a grey between the colour's and the middle.
    OklabAdaptive,
    /// Chroma is reduced in CAM16-UCS at constant lightness and hue.
    Cam16,
    /// Compression without a kink.
    Soft,
    /// The whole image is divided by its largest channel; negative channels go to 0.
    ScaleImage,
}

const ALL: [(&str, Gamut); 10] = [
    ("clamp", Gamut::Clamp),
    ("scale", Gamut::Scale),
    ("constant-intensity", Gamut::ConstantIntensity),
    ("constant-luminance", Gamut::ConstantLuminance),
    ("cook", Gamut::Cook),
    ("oklab", Gamut::Oklab),
    ("oklab-adaptive", Gamut::OklabAdaptive),
    ("cam16", Gamut::Cam16),
    ("soft", Gamut::Soft),
    ("scale-image", Gamut::ScaleImage),
];

impl Gamut {
    /// The names of all methods.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ALL.iter().map(|(name, _)| *name)
    }

    /// The method of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        ALL.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, gamut)| *gamut)
    }

    /// The name of this method.
    #[must_use]
    pub fn name(self) -> &'static str {
        ALL.iter().find(|(_, gamut)| *gamut == self).map_or("", |(name, _)| name)
    }
}

/// A method made ready for one RGB system.
///
/// ```
/// use illuminant_color::RgbSystem;
/// use illuminant_display::{Gamut, GamutMap};
/// let srgb = RgbSystem::named("sRGB").unwrap();
/// let scale = GamutMap::new(Gamut::Scale, &srgb);
/// assert_eq!(scale.map([2.0, 1.0, 0.0]), [1.0, 0.5, 0.0]);
/// let clamp = GamutMap::new(Gamut::Clamp, &srgb);
/// assert_eq!(clamp.map([2.0, 1.0, 0.0]), [1.0, 1.0, 0.0]);
/// ```
#[derive(Clone, Debug)]
pub struct GamutMap {
    gamut: Gamut,
    luminance: Triple,
    uniform: Option<uniform::Uniform>,
}

impl GamutMap {
    /// Makes a method ready for the gamut of a system.
    #[must_use]
    pub fn new(gamut: Gamut, system: &RgbSystem) -> Self {
        let uniform = match gamut {
            Gamut::Oklab => uniform::Uniform::oklab(system, None),
            Gamut::OklabAdaptive => uniform::Uniform::oklab(system, Some(uniform::ADAPTIVE)),
            Gamut::Cam16 => uniform::Uniform::cam16(system),
            _ => None,
        };
        Self { gamut, luminance: system.to_xyz_rows()[1], uniform }
    }

    /// Which method this is.
    #[must_use]
    pub fn gamut(&self) -> Gamut {
        self.gamut
    }

    /// Whether colours inside the gamut are moved too.
    #[must_use]
    pub fn moves_all(&self) -> bool {
        self.gamut == Gamut::Soft
    }

    /// The colour that stands for this one in the gamut; every channel is from 0 to 1.
    #[must_use]
    pub fn map(&self, rgb: Triple) -> Triple {
        let rgb = rgb.map(|v| if v.is_nan() { 0.0 } else { v.clamp(-1e9, 1e9) });
        if !self.moves_all() && rgb.iter().all(|v| (0.0..=1.0).contains(v)) {
            return rgb;
        }
        let mapped = match self.gamut {
            Gamut::Clamp | Gamut::ScaleImage => rgb,
            Gamut::Scale => scale(rgb),
            Gamut::ConstantIntensity => desaturation::constant_intensity(rgb),
            Gamut::ConstantLuminance => desaturation::constant_luminance(rgb, self.luminance),
            Gamut::Cook => scale(desaturation::add_white(rgb, self.luminance)),
            Gamut::Soft => soft::compress(rgb),
            Gamut::Oklab | Gamut::OklabAdaptive | Gamut::Cam16 => {
                self.uniform.as_ref().map_or(rgb, |uniform| uniform.reduce_chroma(rgb))
            }
        };
        mapped.map(|v| v.clamp(0.0, 1.0))
    }
}

/// Negative channels become 0; if a channel is above 1, all are divided by the largest (book III.9, `CLR_scale_rgb`).
fn scale(rgb: Triple) -> Triple {
    let rgb = rgb.map(|v| v.max(0.0));
    let largest = rgb.into_iter().fold(1.0, f64::max);
    rgb.map(|v| v / largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn maps() -> Vec<GamutMap> {
        let system = RgbSystem::named("sRGB").unwrap();
        Gamut::names().map(|name| GamutMap::new(Gamut::named(name).unwrap(), &system)).collect()
    }

    #[test]
    fn everything_comes_inside_and_what_is_inside_stays() {
        for map in maps() {
            for i in 0..2000u32 {
                // Numbers from −1 to 3 of a multiplicative sequence.
                let rgb = [7u32, 13, 29].map(|k| {
                    f64::from(i.wrapping_mul(2_654_435_761).wrapping_mul(k) >> 8) / 4_194_304.0 - 1.0
                });
                let found = map.map(rgb);
                assert!(found.iter().all(|v| (0.0..=1.0).contains(v)), "{map:?}: {rgb:?} becomes {found:?}");
                if !map.moves_all() {
                    assert_eq!(map.map(found), found, "{map:?} moves what it has made");
                }
            }
            for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
                assert!(map.map([odd, 0.5, 0.2]).iter().all(|v| (0.0..=1.0).contains(v)), "{map:?}");
            }
        }
    }

    #[test]
    fn no_method_of_constant_lightness_makes_a_light_colour_black() {
        for map in maps() {
            if matches!(map.gamut(), Gamut::Oklab | Gamut::Cam16) {
                for blue in 0..30 {
                    let found = map.map([0.5, 0.5, -0.1 * f64::from(blue)]);
                    assert!(
                        found[0] > 0.1 && found[1] > 0.1,
                        "{map:?}: blue of −{blue}/10 becomes {found:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn neutral_colours_stay_neutral() {
        for map in maps() {
            for level in [-0.5, 0.0, 0.3, 1.0, 2.0] {
                let [r, g, b] = map.map([level; 3]);
                assert!(
                    (r - g).abs() < 1e-9 && (g - b).abs() < 1e-9,
                    "{map:?}: {level} becomes {:?}",
                    [r, g, b]
                );
            }
        }
    }
}
