//! Towards white: along a straight line in RGB to the neutral axis, until the colour is inside.

use illuminant_color::Triple;

/// The limits of book III.9, slightly inside of 0 and 1.
const MIN_CLIP: f64 = 0.0001;
const MAX_CLIP: f64 = 0.9999;

/// Towards the neutral axis at constant r + g + b (book III.9, `CLR_clip_rgb`).
///
/// A sum whose third is above 0.9999 is white, one below 0.0001 black. The limits of the cube are 0.0001 and 0.9999.
pub(super) fn constant_intensity(rgb: Triple) -> Triple {
    let axis = rgb.iter().sum::<f64>() / 3.0;
    towards(rgb, axis, MIN_CLIP, MAX_CLIP)
}

/// Towards the neutral axis at constant luminance; a luminance of 1 and more is white.
pub(super) fn constant_luminance(rgb: Triple, luminance: Triple) -> Triple {
    let axis = luminance.iter().zip(rgb).map(|(weight, v)| weight * v).sum();
    towards(rgb, axis, 0.0, 1.0)
}

/// From the colour along the line to the grey `axis`, until every channel is inside the limits.
fn towards(rgb: Triple, axis: f64, low: f64, high: f64) -> Triple {
    if axis <= low {
        return [0.0; 3];
    }
    if axis >= high {
        return [1.0; 3];
    }
    let mut part: f64 = 1.0;
    for v in rgb {
        if v > 1.0 {
            part = part.min((high - axis) / (v - axis));
        } else if v < 0.0 {
            part = part.min((low - axis) / (v - axis));
        }
    }
    rgb.map(|v| axis + (v - axis) * part)
}

/// White is added until no channel is negative, at constant luminance: the dominant wavelength stays (Cook 1981).
///
/// In terms of light: x, y move on the straight line to the white point. A colour of no luminance is black.
pub(super) fn add_white(rgb: Triple, luminance: Triple) -> Triple {
    let axis: f64 = luminance.iter().zip(rgb).map(|(weight, v)| weight * v).sum();
    if axis <= 0.0 {
        return [0.0; 3];
    }
    let lowest = rgb.into_iter().fold(0.0, f64::min);
    let part = axis / (axis - lowest);
    rgb.map(|v| axis + (v - axis) * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_plane_keeps_is_kept() {
        let luminance = [0.2126, 0.7152, 0.0722];
        let y = |rgb: Triple| -> f64 { luminance.iter().zip(rgb).map(|(w, v)| w * v).sum() };
        for rgb in [[1.5, 0.2, 0.1], [0.3, -0.05, 0.9], [1.2, 0.9, -0.3]] {
            let sum = |rgb: Triple| rgb.iter().sum::<f64>();
            assert!((sum(constant_intensity(rgb)) - sum(rgb)).abs() < 1e-12);
            assert!((y(constant_luminance(rgb, luminance)) - y(rgb)).abs() < 1e-12);
            assert!((y(add_white(rgb, luminance)) - y(rgb)).abs() < 1e-12);
        }
    }
}
