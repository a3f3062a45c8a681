//! Colour differences.

use crate::Lab;

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
    (x * x + y * y + z * z + r_t * y * z).max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

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
