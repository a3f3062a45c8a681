//! Colour differences ΔE between L\*a\*b\* colours, for lightness, chroma and hue seen under reference conditions
//! (all k = 1).
//!
//! - 1976: the distance √(ΔL² + Δa² + Δb²); in L\*u\*v\* it is the same sum of squares.
//! - 1994 (CIE 116-1995): ΔL/k_L, ΔC/(1 + K₁C₁), ΔH/(1 + K₂C₁), where C₁ is the chroma of the first colour, the
//!   standard; so it is not symmetric.
//! - 2000: [`delta_e_2000`].

use crate::{Lab, Triple};

/// A formula of colour difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// CIE 1976, the distance in L\*a\*b\* or in L\*u\*v\*.
    Cie1976,
    /// CIE 1994 with the constants of graphic arts: k_L = 1, K₁ = 0.045, K₂ = 0.015.
    Cie1994GraphicArts,
    /// CIE 1994 with the constants of textiles: k_L = 2, K₁ = 0.048, K₂ = 0.014.
    Cie1994Textiles,
    /// CIEDE2000.
    Cie2000,
}

impl Difference {
    /// The formula of a name: `1976`, `1994 graphic arts`, `1994 textiles` or `2000`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "1976" => Some(Self::Cie1976),
            "1994 graphic arts" => Some(Self::Cie1994GraphicArts),
            "1994 textiles" => Some(Self::Cie1994Textiles),
            "2000" => Some(Self::Cie2000),
            _ => None,
        }
    }

    /// The difference of two colours; the first is the standard.
    ///
    /// ```
    /// use illuminant_color::Difference;
    /// assert_eq!(Difference::Cie1976.between([50.0, 3.0, 0.0], [50.0, 0.0, 4.0]), 5.0);
    /// ```
    #[must_use]
    pub fn between(self, first: Triple, second: Triple) -> f64 {
        match self {
            Self::Cie1976 => distance([0, 1, 2].map(|i| second[i] - first[i])),
            Self::Cie1994GraphicArts => delta_e_1994(first, second, 1.0, [0.045, 0.015]),
            Self::Cie1994Textiles => delta_e_1994(first, second, 2.0, [0.048, 0.014]),
            Self::Cie2000 => {
                let lab = |[l, a, b]: Triple| Lab { l, a, b };
                delta_e_2000(lab(first), lab(second))
            }
        }
    }
}

fn distance([x, y, z]: Triple) -> f64 {
    z.mul_add(z, y.mul_add(y, x * x)).sqrt()
}

fn delta_e_1994(first: Triple, second: Triple, k_l: f64, [k1, k2]: [f64; 2]) -> f64 {
    let chroma = |[_, a, b]: Triple| a.hypot(b);
    let (c1, c2) = (chroma(first), chroma(second));
    let d_c = c1 - c2;
    let (d_a, d_b) = (first[1] - second[1], first[2] - second[2]);
    // ΔH² = Δa² + Δb² − ΔC² is never negative but for rounding. `max` would turn NaN into 0.
    let d_h2 = d_a * d_a + d_b * d_b - d_c * d_c;
    let d_h = if d_h2 < 0.0 { 0.0 } else { d_h2.sqrt() };
    distance([(first[0] - second[0]) / k_l, d_c / (1.0 + k1 * c1), d_h / (1.0 + k2 * c1)])
}

/// CIEDE2000 (ISO/CIE 11664-6) with k_L = k_C = k_H = 1, in the form of Sharma, Wu and Dalal (2005).
///
/// ```
/// use illuminant_color::{Lab, delta_e_2000};
/// // The first pair of Sharma's table.
/// let a = Lab { l: 50.0, a: 2.6772, b: -79.7751 };
/// let b = Lab { l: 50.0, a: 0.0, b: -82.7485 };
/// assert!((delta_e_2000(a, b) - 2.0425).abs() < 5e-5);
/// ```
#[must_use]
pub fn delta_e_2000(first: Lab, second: Lab) -> f64 {
    use std::f64::consts::{PI, TAU};
    const POW_25_7: f64 = 6_103_515_625.0;
    let mean_chroma = f64::midpoint(first.a.hypot(first.b), second.a.hypot(second.b));
    let c7 = mean_chroma.powi(7);
    let g = 0.5 * (1.0 - (c7 / (c7 + POW_25_7)).sqrt());
    let polar = |lab: Lab| {
        let a = (1.0 + g) * lab.a;
        let hue = if a == 0.0 && lab.b == 0.0 { 0.0 } else { lab.b.atan2(a).rem_euclid(TAU) };
        (a.hypot(lab.b), hue)
    };
    let ((c1, h1), (c2, h2)) = (polar(first), polar(second));
    let d_l = second.l - first.l;
    let d_c = c2 - c1;
    let grey = c1 * c2 == 0.0;
    let turn = h2 - h1;
    let d_hue = if grey {
        0.0
    } else if turn > PI {
        turn - TAU
    } else if turn < -PI {
        turn + TAU
    } else {
        turn
    };
    let d_h = 2.0 * (c1 * c2).sqrt() * (0.5 * d_hue).sin();
    let mean_hue = if grey {
        h1 + h2
    } else if turn.abs() <= PI {
        f64::midpoint(h1, h2)
    } else if h1 + h2 < TAU {
        f64::midpoint(h1, h2) + PI
    } else {
        f64::midpoint(h1, h2) - PI
    };
    let mean_l = f64::midpoint(first.l, second.l);
    let mean_c = f64::midpoint(c1, c2);
    let deg = f64::to_radians;
    let t = 1.0 - 0.17 * (mean_hue - deg(30.0)).cos()
        + 0.24 * (2.0 * mean_hue).cos()
        + 0.32 * (3.0 * mean_hue + deg(6.0)).cos()
        - 0.20 * (4.0 * mean_hue - deg(63.0)).cos();
    let rotation = deg(30.0) * (-((mean_hue - deg(275.0)) / deg(25.0)).powi(2)).exp();
    let mean_c7 = mean_c.powi(7);
    let r_c = 2.0 * (mean_c7 / (mean_c7 + POW_25_7)).sqrt();
    let l50 = (mean_l - 50.0).powi(2);
    let s_l = 1.0 + 0.015 * l50 / (20.0 + l50).sqrt();
    let s_c = 1.0 + 0.045 * mean_c;
    let s_h = 1.0 + 0.015 * mean_c * t;
    let r_t = -(2.0 * rotation).sin() * r_c;
    let (x, y, z) = (d_l / s_l, d_c / s_c, d_h / s_h);
    // The form is positive definite but for rounding. `max` would turn NaN into 0.
    let sum = x * x + y * y + z * z + r_t * y * z;
    if sum < 0.0 { 0.0 } else { sum.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_formulas_of_1994_agree_by_hand() {
        // ΔL = 10, C₁ = 5, C₂ = 13, Δa = −2 and Δb = −8: ΔH² = 68 − 64 = 4.
        let (a, b) = ([60.0, 3.0, 4.0], [50.0, 5.0, 12.0]);
        let graphic: f64 = 100.0 + (8.0f64 / 1.225).powi(2) + (2.0f64 / 1.075).powi(2);
        let textiles: f64 = 25.0 + (8.0f64 / 1.24).powi(2) + (2.0f64 / 1.07).powi(2);
        assert!((Difference::Cie1994GraphicArts.between(a, b) - graphic.sqrt()).abs() < 1e-12);
        assert!((Difference::Cie1994Textiles.between(a, b) - textiles.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn every_formula_is_zero_for_one_colour_and_carries_nan() {
        let colour = [40.0, -20.0, 7.0];
        for name in ["1976", "1994 graphic arts", "1994 textiles", "2000"] {
            let formula = Difference::named(name).unwrap();
            assert_eq!(formula.between(colour, colour), 0.0, "{name}");
            for place in 0..3 {
                let mut broken = colour;
                broken[place] = f64::NAN;
                assert!(formula.between(colour, broken).is_nan(), "{name} {place}");
            }
        }
    }

    /// Pairs of the test data of Sharma, Wu and Dalal (2005), table 1.
    #[test]
    fn agrees_with_the_published_pairs() {
        let pairs = [
            ([50.0, 2.5, 0.0], [50.0, 0.0, -2.5], 4.3065),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, -1.0, 2.0], [50.0, 0.0, 0.0], 2.3669),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0011], 7.2195),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([22.7233, 20.0904, -46.6940], [23.0331, 14.9730, -42.5619], 2.0373),
            ([90.9257, -0.5406, -0.9208], [88.6381, -0.8985, -0.7239], 1.5381),
            ([2.0776, 0.0795, -1.1350], [0.9033, -0.0636, -0.5514], 0.9082),
        ];
        for (a, b, expected) in pairs {
            let [a, b] = [a, b].map(|[l, a, b]| Lab { l, a, b });
            assert!((delta_e_2000(a, b) - expected).abs() < 5e-5, "{a:?} {b:?}: {}", delta_e_2000(a, b));
            assert!((delta_e_2000(a, b) - delta_e_2000(b, a)).abs() < 1e-12);
        }
    }
}
