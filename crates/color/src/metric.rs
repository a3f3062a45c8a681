//! CIEDE2000 for small steps: its metric tensor.

use crate::{Lab, Triple};

/// The matrix G of CIEDE2000 at a colour: a small step δ in XYZ is a difference ΔE00 = √(δᵀ G δ).
///
/// G = Fᵀ Q F: F turns a step in XYZ into ΔL'/S_L, ΔC'/S_C and ΔH'/S_H (the derivative of CIE L\*a\*b\*, then polar
/// coordinates), and Q holds the rotation term R_T (Luo, Cui and Rigg 2001; ISO/CIE 11664-6). To first order G is exact;
/// it serves to minimise differences by linear algebra, and [`crate::delta_e_2000`] to report them.
///
/// `xyz` and `white` are in one unit, and G is in its inverse square.
///
/// ```
/// use illuminant_color::{Lab, delta_e_2000, delta_e_2000_metric};
/// let white = [0.95, 1.0, 1.09];
/// let (colour, step) = ([0.30, 0.20, 0.10], [1e-5, -2e-5, 3e-5]);
/// let g = delta_e_2000_metric(colour, white);
/// let square: f64 = (0..9).map(|i| step[i / 3] * g[i / 3][i % 3] * step[i % 3]).sum();
/// let moved = [0, 1, 2].map(|i| colour[i] + step[i]);
/// let exact = delta_e_2000(Lab::from_xyz(colour, white), Lab::from_xyz(moved, white));
/// assert!((square.sqrt() / exact - 1.0).abs() < 1e-3);
/// ```
#[must_use]
pub fn delta_e_2000_metric(xyz: Triple, white: Triple) -> [Triple; 3] {
    const DELTA: f64 = 6.0 / 29.0;
    const POW_25_7: f64 = 6_103_515_625.0;
    // f'(X/X₀)/X₀ and its likes for Y and Z.
    let slope: Triple = std::array::from_fn(|i| {
        let t = xyz[i] / white[i];
        let f = if t > DELTA.powi(3) { t.cbrt().powi(-2) / 3.0 } else { 1.0 / (3.0 * DELTA * DELTA) };
        f / white[i]
    });
    let Lab { l, a, b } = Lab::from_xyz(xyz, white);
    let c7 = a.hypot(b).powi(7);
    let stretch = 1.5 - 0.5 * (c7 / (c7 + POW_25_7)).sqrt();
    let a = stretch * a;
    let (chroma, hue) = (a.hypot(b), b.atan2(a));
    let (sin, cos) = hue.sin_cos();
    let deg = f64::to_radians;
    let t =
        1.0 - 0.17 * (hue - deg(30.0)).cos() + 0.24 * (2.0 * hue).cos() + 0.32 * (3.0 * hue + deg(6.0)).cos()
            - 0.20 * (4.0 * hue - deg(63.0)).cos();
    let turn = (hue.to_degrees().rem_euclid(360.0) - 275.0) / 25.0;
    let rotation = deg(30.0) * (-turn * turn).exp();
    let chroma7 = chroma.powi(7);
    let r_t = -(2.0 * rotation).sin() * 2.0 * (chroma7 / (chroma7 + POW_25_7)).sqrt();
    let l50 = (l - 50.0).powi(2);
    let s_l = 1.0 + 0.015 * l50 / (20.0 + l50).sqrt();
    let s_c = 1.0 + 0.045 * chroma;
    let s_h = 1.0 + 0.015 * chroma * t;
    let [x, y, z] = slope;
    // Steps of L*, of the stretched a*, and of b*, for unit steps in X, Y and Z.
    let (d_l, d_a) = ([0.0, 116.0 * y, 0.0], [500.0 * stretch * x, -500.0 * stretch * y, 0.0]);
    let d_b = [0.0, 200.0 * y, -200.0 * z];
    let f: [Triple; 3] = [
        d_l.map(|v| v / s_l),
        std::array::from_fn(|i| (cos * d_a[i] + sin * d_b[i]) / s_c),
        std::array::from_fn(|i| (cos * d_b[i] - sin * d_a[i]) / s_h),
    ];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            f[0][i] * f[0][j]
                + f[1][i] * f[1][j]
                + f[2][i] * f[2][j]
                + 0.5 * r_t * (f[1][i] * f[2][j] + f[2][i] * f[1][j])
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::delta_e_2000;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn small_steps_are_as_large_as_ciede2000_says(
            colour in prop::array::uniform3(0.002..0.95f64),
            step in prop::array::uniform3(-1.0..1.0f64),
        ) {
            let white = [0.96, 1.0, 0.82];
            let step = step.map(|v| 1e-6 * v);
            prop_assume!(step.iter().any(|v| v.abs() > 1e-7));
            let g = delta_e_2000_metric(colour, white);
            let square: f64 = (0..9).map(|i| step[i / 3] * g[i / 3][i % 3] * step[i % 3]).sum();
            let moved = std::array::from_fn(|i| colour[i] + step[i]);
            let exact = delta_e_2000(Lab::from_xyz(colour, white), Lab::from_xyz(moved, white));
            prop_assert!((square.sqrt() - exact).abs() < 0.01 * exact + 1e-9, "{} {}", square.sqrt(), exact);
        }
    }

    #[test]
    fn black_and_white_have_finite_metrics() {
        let white = [0.95, 1.0, 1.09];
        for colour in [[0.0; 3], white] {
            assert!(delta_e_2000_metric(colour, white).iter().flatten().all(|v| v.is_finite()));
        }
    }
}
