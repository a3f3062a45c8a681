//! Tone operators: bringing a contrast that is too high into the range of a display, before the gamut is seen to.
//!
//! All work on linear RGB of the display after exposure, where 1 is its white. x is a channel or the luminance Y.
//!
//! | name | curve | works on | hue |
//! | --- | --- | --- | --- |
//! | `none` | x | – | stays |
//! | `reinhard` | x (1 + x / w²) / (1 + x), w = 4 the smallest luminance that becomes white | luminance | stays |
//! | `filmic` | h(2x) / h(11.2), h(x) = (x (0.15 x + 0.05) + 0.004) / (x (0.15 x + 0.5) + 0.06) − 1/15 | each channel | moves towards primaries' mixtures, as on film |
//! | `filmic-hue` | the same | luminance | stays |
//!
//! Where the luminance alone is changed, chromaticity stays and a channel may still be above 1: the gamut's method
//! decides then. Negative luminance is left as it is.
//!
//! References: E. Reinhard et al., "Photographic tone reproduction for digital images", SIGGRAPH 2002 (eq 4);
//! J. Hable, "Uncharted 2: HDR lighting", Game Developers Conference 2010.

use illuminant_color::Triple;

/// A tone operator.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Tone {
    /// The image as it is.
    #[default]
    None,
    /// Reinhard's global operator, on luminance.
    Reinhard,
    /// Hable's curve, on each channel.
    Filmic,
    /// Hable's curve, on luminance.
    FilmicHue,
}

const ALL: [(&str, Tone); 4] = [
    ("none", Tone::None),
    ("reinhard", Tone::Reinhard),
    ("filmic", Tone::Filmic),
    ("filmic-hue", Tone::FilmicHue),
];

const REINHARD_WHITE: f64 = 4.0;

/// The curve over x, which has a limit at 0.
fn reinhard(x: f64) -> f64 {
    (1.0 + x / (REINHARD_WHITE * REINHARD_WHITE)) / (1.0 + x)
}

/// The curve over x. The fraction −1/15 is brought under the bar, so that nothing cancels at 0.
fn filmic(x: f64) -> f64 {
    let over_x = |x: f64| (0.14 * x + 1.0 / 60.0) / (x * (0.15 * x + 0.5) + 0.06);
    2.0 * over_x(2.0 * x) / (11.2 * over_x(11.2))
}

impl Tone {
    /// The names of all operators.
    pub fn names() -> impl Iterator<Item = &'static str> {
        ALL.iter().map(|(name, _)| *name)
    }

    /// The operator of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        ALL.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, tone)| *tone)
    }

    /// The name of this operator.
    #[must_use]
    pub fn name(self) -> &'static str {
        ALL.iter().find(|(_, tone)| *tone == self).map_or("", |(name, _)| name)
    }

    /// The colour after the operator; `luminance` holds the luminance of each primary.
    ///
    /// ```
    /// use illuminant_display::Tone;
    /// let weights = [0.2126, 0.7152, 0.0722];
    /// let [r, g, b] = Tone::Reinhard.apply([4.0, 4.0, 4.0], weights);
    /// assert!((r - 1.0).abs() < 1e-12 && r == g && g == b);
    /// ```
    #[must_use]
    pub fn apply(self, rgb: Triple, luminance: Triple) -> Triple {
        let by_luminance = |curve: fn(f64) -> f64| {
            let y: f64 = luminance.iter().zip(rgb).map(|(weight, v)| weight * v).sum();
            if y > 0.0 { rgb.map(|v| v * curve(y)) } else { rgb }
        };
        match self {
            Self::None => rgb,
            Self::Reinhard => by_luminance(reinhard),
            Self::Filmic => rgb.map(|v| if v > 0.0 { v * filmic(v) } else { v }),
            Self::FilmicHue => by_luminance(filmic),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const Y: Triple = [0.2126, 0.7152, 0.0722];

    #[test]
    fn every_curve_rises_from_black() {
        for name in Tone::names() {
            let tone = Tone::named(name).unwrap();
            let mut before = tone.apply([0.0; 3], Y)[1];
            assert!(before.abs() < 1e-12);
            for i in 1..200 {
                let now = tone.apply([f64::from(i) / 20.0; 3], Y)[1];
                assert!(now > before, "{name} at {i}");
                before = now;
            }
        }
        assert!((5.6 * filmic(5.6) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn operators_on_luminance_keep_the_chromaticity() {
        for tone in [Tone::Reinhard, Tone::FilmicHue] {
            let [r, g, b] = tone.apply([3.0, 1.5, 0.3], Y);
            assert!((r / g - 2.0).abs() < 1e-12 && (g / b - 5.0).abs() < 1e-12);
        }
        let [r, g, _] = Tone::Filmic.apply([3.0, 1.5, 0.3], Y);
        assert!(r / g < 1.9);
    }
}
