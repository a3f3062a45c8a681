//! HSL, in three solids: the double hexcone of Rogers (1985), the double cone and the cylinder of Joblove and
//! Greenberg (1978).
//!
//! In all of them L = (max + min)/2, so that full colours have L = ½, and C = max − min. They differ in the section
//! across the neutral axis, and in what saturation is measured by:
//!
//! | solid | section | hue | saturation |
//! | --- | --- | --- | --- |
//! | double hexcone | hexagon | linear within each sextant, as in HSV | C / (1 − \|2L − 1\|), at most 1 at every L |
//! | double cone | circle | angle in the plane across the neutral axis | C, at most 1 − \|2L − 1\| |
//! | cylinder | circle | that angle | C / (1 − \|2L − 1\|): black and white spread into discs |
//!
//! The circle is the hexagon with each ray from its centre stretched to the length of the corners. The angle of a
//! colour is then atan2(√3 (G − B), 2R − G − B); within a sextant it is atan2(√3 t, 2 − t) of the linear hue t in
//! [0, 1], and t = sin h / sin(h + 60°) leads back. Both hues agree at the corners. For RGB in [0, 1].

use crate::Real;
use crate::hsv::{carry_nan, extent, from_sextant, sextant};

/// The solid in which hue, saturation and lightness are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HslSolid {
    /// Rogers' double hexcone.
    DoubleHexcone,
    /// Joblove and Greenberg's double cone.
    DoubleCone,
    /// Joblove and Greenberg's cylinder.
    Cylinder,
}

impl HslSolid {
    /// The solid of a name: `double hexcone`, `double cone` or `cylinder`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "double hexcone" => Some(Self::DoubleHexcone),
            "double cone" => Some(Self::DoubleCone),
            "cylinder" => Some(Self::Cylinder),
            _ => None,
        }
    }

    /// Hue in degrees [0, 360), saturation and lightness of RGB.
    ///
    /// ```
    /// use illuminant_color::HslSolid;
    /// assert_eq!(HslSolid::DoubleHexcone.from_rgb([0.0, 0.5, 0.0]), [120.0, 1.0, 0.25]);
    /// assert_eq!(HslSolid::DoubleCone.from_rgb([0.0, 0.5, 0.0])[1], 0.5);
    /// ```
    #[must_use]
    #[inline(always)]
    #[allow(clippy::wrong_self_convention)] // the solid is what is asked, not what is made
    pub fn from_rgb<T: Real>(self, rgb: [T; 3]) -> [T; 3] {
        let (largest, chroma) = extent(rgb);
        let sum = largest + largest - chroma;
        let lightness = sum * T::of(0.5);
        let room = T::of(1.0) - (sum - T::of(1.0)).abs();
        let relative = if chroma == T::of(0.0) { chroma } else { chroma / room };
        let hue = match self {
            Self::DoubleHexcone => sextant(rgb) * T::of(60.0),
            Self::DoubleCone | Self::Cylinder => T::of(angle_of_sextant(sextant(rgb).f64())),
        };
        let saturation = match self {
            Self::DoubleHexcone | Self::Cylinder => relative,
            Self::DoubleCone => chroma,
        };
        carry_nan(rgb, [hue, saturation, lightness])
    }

    /// RGB of a hue in degrees (of any size), saturation and lightness.
    #[must_use]
    #[inline(always)]
    pub fn to_rgb<T: Real>(self, [hue, saturation, lightness]: [T; 3]) -> [T; 3] {
        let room = T::of(1.0) - (lightness + lightness - T::of(1.0)).abs();
        let chroma = match self {
            Self::DoubleHexcone | Self::Cylinder => saturation * room,
            Self::DoubleCone => saturation,
        };
        let sixths = match self {
            Self::DoubleHexcone => hue * T::of(1.0 / 60.0),
            Self::DoubleCone | Self::Cylinder => T::of(sextant_of_angle(hue.f64())),
        };
        from_sextant(sixths, chroma, chroma.mul_add(T::of(-0.5), lightness))
    }
}

/// The angle in degrees, on the circle, of a linear hue in sixths of a turn.
fn angle_of_sextant(sixths: f64) -> f64 {
    // Even sextants lead away from a primary, odd ones are their mirror image.
    let (pair, within) = ((sixths / 2.0).floor(), sixths.rem_euclid(2.0));
    let t = if within > 1.0 { 2.0 - within } else { within };
    let angle = (3f64.sqrt() * t).atan2(2.0 - t).to_degrees();
    120.0 * pair + if within > 1.0 { 120.0 - angle } else { angle }
}

/// The linear hue in sixths of a turn of an angle in degrees on the circle.
fn sextant_of_angle(degrees: f64) -> f64 {
    let (pair, within) = ((degrees / 120.0).floor(), degrees.rem_euclid(120.0));
    let angle = if within > 60.0 { 120.0 - within } else { within }.to_radians();
    let t = angle.sin() / (angle + std::f64::consts::FRAC_PI_3).sin();
    2.0 * pair + if within > 60.0 { 2.0 - t } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOLIDS: [HslSolid; 3] = [HslSolid::DoubleHexcone, HslSolid::DoubleCone, HslSolid::Cylinder];

    #[test]
    fn full_colours_have_half_the_lightness_and_saturation_one() {
        for solid in SOLIDS {
            for (i, rgb) in
                [[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]].into_iter().enumerate()
            {
                let [h, s, l] = solid.from_rgb(rgb.map(f64::from));
                assert!((h - 60.0 * i as f64).abs() < 1e-12 && s == 1.0 && l == 0.5, "{solid:?} {h} {s} {l}");
            }
            for v in [0.0, 0.25, 1.0] {
                assert_eq!(solid.from_rgb([v; 3]), [0.0, 0.0, v]);
                assert_eq!(solid.to_rgb([0.0, 0.0, v]), [v; 3]);
            }
        }
    }

    #[test]
    fn the_angle_is_the_one_across_the_neutral_axis() {
        for rgb in [[0.9, 0.3, 0.1], [0.2, 0.8, 0.5], [0.1, 0.2, 0.7], [0.6, 0.1, 0.4]] {
            let [r, g, b] = rgb;
            let wanted = (3f64.sqrt() * (g - b)).atan2(2.0 * r - g - b).to_degrees().rem_euclid(360.0);
            assert!((HslSolid::Cylinder.from_rgb(rgb)[0] - wanted).abs() < 1e-12, "{rgb:?}");
        }
    }

    #[test]
    fn the_cylinder_is_full_at_every_lightness_and_the_cone_is_not() {
        for l in [0.1, 0.5, 0.8] {
            let rgb = HslSolid::Cylinder.to_rgb([200.0, 1.0, l]);
            assert!(rgb.iter().all(|v| (-1e-12..=1.0 + 1e-12).contains(v)));
            let [_, s, _] = HslSolid::DoubleCone.from_rgb(rgb);
            assert!((s - (1.0 - (2.0 * l - 1.0f64).abs())).abs() < 1e-12);
        }
    }
}
