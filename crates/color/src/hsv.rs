//! HSV, the hexcone of Smith (1978), and the hue of the sextants that HSL shares.
//!
//! V = max(R, G, B), S = (max − min)/max, and the hue runs linearly within each sextant of the hexagon: 0° red, 60°
//! yellow, 120° green, 180° cyan, 240° blue, 300° magenta. For RGB in [0, 1], whose role (linear or encoded) is the
//! caller's; V above 1 is kept. Grey has hue 0, black saturation 0.

use crate::Real;

/// Hue in degrees [0, 360), saturation and value of RGB.
///
/// ```
/// let hsv = illuminant_color::rgb_to_hsv([0.0, 0.5, 0.25]);
/// assert_eq!(hsv, [150.0, 1.0, 0.5]);
/// ```
#[must_use]
#[inline(always)]
pub fn rgb_to_hsv<T: Real>(rgb: [T; 3]) -> [T; 3] {
    let (largest, chroma) = extent(rgb);
    let saturation = if largest == T::of(0.0) { T::of(0.0) } else { chroma / largest };
    carry_nan(rgb, [sextant(rgb) * T::of(60.0), saturation, largest])
}

/// RGB of a hue in degrees (of any size), saturation and value.
#[must_use]
#[inline(always)]
pub fn hsv_to_rgb<T: Real>([hue, saturation, value]: [T; 3]) -> [T; 3] {
    let chroma = value * saturation;
    from_sextant(hue * T::of(1.0 / 60.0), chroma, value - chroma)
}

/// The largest of three values, and how far the smallest lies below it.
#[inline(always)]
pub(crate) fn extent<T: Real>([r, g, b]: [T; 3]) -> (T, T) {
    let largest = r.larger(g).larger(b);
    (largest, largest - r.smaller(g).smaller(b))
}

/// NaN in all three places when there is one among the values: a comparison would lose it.
#[inline(always)]
pub(crate) fn carry_nan<T: Real>([r, g, b]: [T; 3], found: [T; 3]) -> [T; 3] {
    let sum = r + g + b;
    #[allow(clippy::eq_op)] // only NaN differs from itself
    let broken = sum != sum;
    found.map(|v| if broken { sum } else { v })
}

/// Hue in sixths of a turn, in [0, 6); 0 for grey.
#[inline(always)]
pub(crate) fn sextant<T: Real>(rgb: [T; 3]) -> T {
    let [r, g, b] = rgb;
    let (largest, chroma) = extent(rgb);
    let scale = T::of(1.0) / chroma;
    let red = (g - b) * scale;
    let red = if red < T::of(0.0) { red + T::of(6.0) } else { red };
    let green = (b - r).mul_add(scale, T::of(2.0));
    let blue = (r - g).mul_add(scale, T::of(4.0));
    let hue = if largest == r {
        red
    } else if largest == g {
        green
    } else {
        blue
    };
    // A hair below red rounds to a whole turn.
    let hue = if hue >= T::of(6.0) { T::of(0.0) } else { hue };
    if chroma == T::of(0.0) { T::of(0.0) } else { hue }
}

/// RGB with this hue (in sixths of a turn, of any size), this largest minus smallest, and this smallest.
#[inline(always)]
pub(crate) fn from_sextant<T: Real>(hue: T, chroma: T, smallest: T) -> [T; 3] {
    // Red is full within a sixth of 0, falls over the next sixth and is absent beyond; green and blue lie 2 and 4
    // sixths further on.
    let turns = T::of((hue.f64() / 6.0).floor());
    let hue = turns.mul_add(T::of(-6.0), hue);
    let channel = |offset: f64| {
        let from = (hue - T::of(offset)).abs();
        let distance = from.smaller(T::of(6.0) - from);
        let share = (T::of(2.0) - distance).smaller(T::of(1.0)).larger(T::of(0.0));
        share.mul_add(chroma, smallest)
    };
    carry_nan([hue, chroma, smallest], [channel(0.0), channel(2.0), channel(4.0)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn full_colours_have_value_one_and_whole_hues() {
        for (i, rgb) in
            [[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]].into_iter().enumerate()
        {
            let rgb = rgb.map(f64::from);
            assert_eq!(rgb_to_hsv(rgb), [60.0 * i as f64, 1.0, 1.0]);
            assert_eq!(hsv_to_rgb(rgb_to_hsv(rgb)), rgb);
            assert_eq!(hsv_to_rgb([60.0 * i as f64 - 720.0, 1.0, 1.0]), rgb, "two turns back");
        }
        assert_eq!(rgb_to_hsv([0.0f64; 3]), [0.0; 3]);
        assert_eq!(rgb_to_hsv([0.25f64; 3]), [0.0, 0.0, 0.25]);
        assert!(rgb_to_hsv([0.1, f64::NAN, 0.2]).iter().all(|v| v.is_nan()));
        assert!(hsv_to_rgb([f64::NAN, 0.5, 0.2]).iter().all(|v| v.is_nan()));
    }
}
