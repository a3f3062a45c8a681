//! Compression without a kink: distances from grey, then intensities, are bent towards the gamut's edge.
//!
//! Grey is the largest channel; the distance of another from it is d = (max − c) / max, above 1 outside the gamut.
//! Both d and max are taken through
//!
//! ```text
//! f(x) = x up to t, then t + (1 − t) u / (1 + u) with u = (x − t) / (1 − t),
//! ```
//!
//! which leaves t with a slope of 1 and nears 1 for every x, however large. The distances follow the reference gamut
//! compression of ACES 1.3 in form, with limits at infinity, so that nothing remains outside.

use illuminant_color::Triple;

/// Where the bend begins: for distances from grey, and for intensities.
const DISTANCE: f64 = 0.85;
const INTENSITY: f64 = 0.8;

fn bend(x: f64, threshold: f64) -> f64 {
    if x <= threshold {
        return x;
    }
    let u = (x - threshold) / (1.0 - threshold);
    threshold + (1.0 - threshold) * (1.0 - 1.0 / (1.0 + u))
}

/// The colour, compressed; one whose largest channel is not above 0 is black.
pub(super) fn compress(rgb: Triple) -> Triple {
    let largest = rgb.into_iter().fold(0.0, f64::max);
    if largest <= 0.0 {
        return [0.0; 3];
    }
    let peak = bend(largest, INTENSITY);
    rgb.map(|v| peak * (1.0 - bend((largest - v) / largest, DISTANCE)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bend_has_no_kink_and_keeps_order() {
        let slope = |x: f64| (bend(x + 1e-6, 0.8) - bend(x - 1e-6, 0.8)) / 2e-6;
        assert!((slope(0.8 - 1e-5) - slope(0.8 + 1e-5)).abs() < 2e-4);
        for i in 0..300 {
            let x = f64::from(i) / 100.0;
            assert!(bend(x + 0.01, 0.8) > bend(x, 0.8) && bend(x, 0.8) < 1.0);
        }
    }

    #[test]
    fn moderate_colours_stay() {
        for rgb in [[0.5, 0.4, 0.3], [0.8, 0.2, 0.3]] {
            for (a, b) in compress(rgb).into_iter().zip(rgb) {
                assert!((a - b).abs() < 1e-15);
            }
        }
    }
}
