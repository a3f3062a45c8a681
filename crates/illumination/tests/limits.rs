//! Each generalised model is its author's own where the generalisation is left out.

use illuminant_illumination::{Coefficients, Highlight, Illumination, Masking, Side};
use illuminant_optics::distribution::Distribution;
use proptest::prelude::*;

const AIR: Side = Side { outside: 1.0, inside: 1.5, outside_is_air: true };

/// Identity material: K_s = 1 without colour, as Phong and Whitted had it.
fn identity(distribution: Distribution, coefficient: f64) -> Coefficients<f64> {
    Coefficients {
        ambient: 0.1,
        diffuse: 0.6,
        specular: 1.0,
        specular_scale: 0.3,
        transmitted: 0.0,
        highlight: Highlight { distribution, coefficient, masking: Masking::None },
        mean_reflectance: 0.04,
        conductor: None,
        transparent: false,
        terminator: 1.0,
    }
}

fn direction(theta: f64, phi: f64) -> [f64; 3] {
    [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
}

proptest! {
    /// Eye and light at infinity: with the normal tilted by an angle, R_v = (2N_kN_i, 2N_kN_j, 2N_k² − 1) (book eq 4.12).
    #[test]
    fn phong_is_the_closed_form_of_an_infinite_eye(
        tilt in 0.0..1.2f64, turn in 0.0..6.2f64, theta in 0.0..1.3f64, phi in 0.0..6.2f64, n in 1.0..200.0f64,
    ) {
        // In the frame of the eye, V = (0, 0, 1).
        let normal = direction(tilt, turn);
        let light = direction(theta, phi);
        let n_l = normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2];
        prop_assume!(n_l > 0.0 && normal[2] > 0.0);
        let r = [2.0 * normal[2] * normal[0], 2.0 * normal[2] * normal[1], 2.0 * normal[2] * normal[2] - 1.0];
        let r_l = (r[0] * light[0] + r[1] * light[1] + r[2] * light[2]).max(0.0);
        let expected = 0.6 * n_l + 0.3 * r_l.powf(n);
        // The same in the frame of the surface: only the three cosines matter.
        let v = [(1.0 - normal[2] * normal[2]).max(0.0).sqrt(), 0.0, normal[2]];
        let sin_l = (1.0 - n_l * n_l).max(0.0).sqrt();
        let cos = if v[0] * sin_l > 1e-9 { (light[2] - v[2] * n_l) / (v[0] * sin_l) } else { 1.0 };
        let cos = cos.clamp(-1.0, 1.0);
        let l = [sin_l * cos, sin_l * (1.0 - cos * cos).sqrt(), n_l];
        let found = Illumination::Phong.terms(&identity(Distribution::Phong, n), &AIR, v, l).sum();
        prop_assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }

    /// Blinn's form of Phong's highlight has H halfway between light and eye (book eq 4.13).
    #[test]
    fn blinns_highlight_is_the_power_of_n_dot_h(
        theta in 0.0..1.4f64, phi in 0.0..6.2f64, eye in 0.0..1.4f64, n in 1.0..200.0f64,
    ) {
        let (l, v) = (direction(theta, phi), direction(eye, 0.3));
        let sum: [f64; 3] = std::array::from_fn(|i| l[i] + v[i]);
        let n_h = sum[2] / sum.iter().map(|c| c * c).sum::<f64>().sqrt();
        let expected = 0.6 * l[2] + 0.3 * n_h.powf(n);
        for model in [Illumination::Phong, Illumination::Whitted] {
            let found = model.terms(&identity(Distribution::Blinn, n), &AIR, v, l).sum();
            prop_assert!((found - expected).abs() < 1e-9, "{model}: {found} {expected}");
        }
    }

    /// Where Fresnel's reflectance is 1 throughout, Hall's highlight is Whitted's, and what it asks of the mirror direction too.
    #[test]
    fn hall_is_whitted_where_reflectance_is_constant(theta in 0.0..1.4f64, phi in 0.0..6.2f64, eye in 0.0..1.4f64) {
        let (l, v) = (direction(theta, phi), direction(eye, 0.3));
        let surface = Coefficients { conductor: Some([1.0, 1e9]), ..identity(Distribution::Blinn, 30.0) };
        let [hall, whitted] = [Illumination::Hall, Illumination::Whitted].map(|m| m.terms(&surface, &AIR, v, l).sum());
        prop_assert!((hall - whitted).abs() < 1e-6);
        let [hall, whitted] = [Illumination::Hall, Illumination::Whitted].map(|m| m.asked(&surface, &AIR, v)[0].unwrap().weight);
        prop_assert!((hall - whitted).abs() < 1e-6);
    }

    /// Cook and Torrance's function of two directions does not change when they change places; Blinn's does.
    #[test]
    fn cook_torrance_is_reciprocal(theta in 0.1..1.4f64, phi in 0.0..6.2f64, eye in 0.1..1.4f64) {
        let (l, v) = (direction(theta, phi), direction(eye, 0.3));
        let mut surface = identity(Distribution::Cook, 0.09);
        surface.highlight.masking = Masking::TorranceSparrow;
        let f = |v: [f64; 3], l: [f64; 3]| Illumination::CookTorrance.terms(&surface, &AIR, v, l).sum() / l[2];
        prop_assert!((f(v, l) - f(l, v)).abs() <= 1e-9 * f(v, l).max(1.0));
    }
}

#[test]
fn an_exponent_smooths_the_terminator() {
    // Book figure 4.7: the slope of (N·L)^p where light begins is 1 for p = 1, and 0 for more.
    let slope = |p: f64| {
        let surface = Coefficients { terminator: p, ..identity(Distribution::Blinn, 10.0) };
        let lit = |angle: f64| {
            Illumination::Bouknight.terms(&surface, &AIR, [0.0, 0.0, 1.0], direction(angle, 0.0)).sum()
        };
        let end = std::f64::consts::FRAC_PI_2;
        (lit(end - 1e-6) - lit(end)) / 1e-6 / 0.6
    };
    assert!((slope(1.0) - 1.0).abs() < 1e-3 && slope(1.5) < 1e-2);
}
