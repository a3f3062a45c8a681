//! The standard library's functions are those of this crate, and correctly rounded.

extern crate illuminant_elementary as _;

use std::hint::black_box;

/// Numbers all over a span, by the golden ratio.
fn numbers(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..200_000).map(move |i| from + (to - from) * (f64::from(i) * 0.618_033_988_749_895).fract())
}

#[test]
fn functions_of_the_standard_library_are_these() {
    let same = |name: &str, from, to, std: fn(f64) -> f64, own: fn(f64) -> f64| {
        let apart = numbers(from, to).find(|&x| std(black_box(x)).to_bits() != own(x).to_bits());
        assert_eq!(apart, None, "{name}");
    };
    same("sin", -30.0, 30.0, f64::sin, pxfm::f_sin);
    same("cos", -30.0, 30.0, f64::cos, pxfm::f_cos);
    same("tan", -3.0, 3.0, f64::tan, pxfm::f_tan);
    same("asin", -1.0, 1.0, f64::asin, pxfm::f_asin);
    same("acos", -1.0, 1.0, f64::acos, pxfm::f_acos);
    same("atan", -9.0, 9.0, f64::atan, pxfm::f_atan);
    same("exp", -50.0, 50.0, f64::exp, pxfm::f_exp);
    same("exp2", -50.0, 50.0, f64::exp2, pxfm::f_exp2);
    same("exp_m1", -1.0, 1.0, f64::exp_m1, pxfm::f_expm1);
    same("ln", 1e-9, 50.0, f64::ln, pxfm::f_log);
    same("log2", 1e-9, 50.0, f64::log2, pxfm::f_log2);
    same("log10", 1e-9, 50.0, f64::log10, pxfm::f_log10);
    same("ln_1p", -0.9, 1.0, f64::ln_1p, pxfm::f_log1p);
    same("cbrt", -8.0, 8.0, f64::cbrt, pxfm::f_cbrt);
    for x in numbers(1e-3, 20.0) {
        let y = black_box(2.0 - 0.3 * x);
        assert_eq!(x.powf(y).to_bits(), pxfm::f_pow(x, y).to_bits(), "{x}^{y}");
        assert_eq!(y.atan2(x).to_bits(), pxfm::f_atan2(y, x).to_bits());
        assert_eq!(y.hypot(x).to_bits(), pxfm::f_hypot(y, x).to_bits());
        let (sine, cosine) = x.sin_cos();
        assert_eq!((sine.to_bits(), cosine.to_bits()), (pxfm::f_sin(x).to_bits(), pxfm::f_cos(x).to_bits()));
    }
}

/// Whether a number in f32 is the one nearest to an exact value, which f64 knows to a billionth of an ulp of f32.
fn is_nearest(found: f32, exact: f64) -> bool {
    let next = |step: u32| f64::from(f32::from_bits(found.to_bits().wrapping_add(step)));
    let (below, above) = if found == 0.0 {
        (-f64::from(f32::from_bits(1)), f64::from(f32::from_bits(1)))
    } else {
        (next(u32::MAX), next(1))
    };
    let apart = (f64::from(found) - exact).abs();
    let slack = 1e-14 * exact.abs();
    apart <= (above - exact).abs() + slack && apart <= (below - exact).abs() + slack
}

#[test]
fn functions_of_f32_are_correctly_rounded() {
    let check = |name: &str, from, to, of: fn(f32) -> f32, exact: fn(f64) -> f64| {
        for x in numbers(from, to) {
            let x = black_box(x as f32);
            let found = of(x);
            assert!(is_nearest(found, exact(f64::from(x))), "{name}({x}) = {found}");
        }
    };
    check("sin", -30.0, 30.0, f32::sin, libm::sin);
    check("cos", -30.0, 30.0, f32::cos, libm::cos);
    check("tan", -1.5, 1.5, f32::tan, libm::tan);
    check("asin", -1.0, 1.0, f32::asin, libm::asin);
    check("acos", -1.0, 1.0, f32::acos, libm::acos);
    check("atan", -9.0, 9.0, f32::atan, libm::atan);
    check("exp", -50.0, 50.0, f32::exp, libm::exp);
    check("exp2", -50.0, 50.0, f32::exp2, libm::exp2);
    check("exp_m1", -1.0, 1.0, f32::exp_m1, libm::expm1);
    check("ln", 1e-9, 50.0, f32::ln, libm::log);
    check("log2", 1e-9, 50.0, f32::log2, libm::log2);
    check("log10", 1e-9, 50.0, f32::log10, libm::log10);
    check("ln_1p", -0.9, 1.0, f32::ln_1p, libm::log1p);
    check("cbrt", -8.0, 8.0, f32::cbrt, libm::cbrt);
    for x in numbers(1e-3, 20.0) {
        let (x, y) = (x as f32, black_box(2.0 - 0.3 * x as f32));
        let (wide_x, wide_y) = (f64::from(x), f64::from(y));
        assert!(is_nearest(x.powf(y), libm::pow(wide_x, wide_y)), "{x}^{y}");
        assert!(is_nearest(y.atan2(x), libm::atan2(wide_y, wide_x)), "{y}, {x}");
        assert!(is_nearest(y.hypot(x), libm::hypot(wide_y, wide_x)), "{y}, {x}");
        let (sine, cosine) = x.sin_cos();
        assert!(is_nearest(sine, libm::sin(wide_x)) && is_nearest(cosine, libm::cos(wide_x)), "{x}");
    }
}

/// Numbers whose functions are known to all places: multiples of the last place on either side would be wrong.
#[test]
fn functions_of_f64_are_correctly_rounded() {
    // By `mpmath` with 60 digits.
    let exact: [(f64, f64); 10] = [
        (black_box(1.0f64).exp(), std::f64::consts::E),
        (black_box(10.0f64).exp(), 22_026.465_794_806_718),
        (black_box(-0.5f64).exp_m1(), -0.393_469_340_287_366_6),
        (black_box(2.0f64).ln(), std::f64::consts::LN_2),
        (black_box(10.0f64).ln(), std::f64::consts::LN_10),
        (black_box(1e22f64).sin(), -0.852_200_849_767_188_8),
        (black_box(1.0f64).atan(), std::f64::consts::FRAC_PI_4),
        (black_box(0.2f64).powf(2.4), 0.021_012_222_435_230_144),
        (black_box(2.0f64).cbrt(), 1.259_921_049_894_873_2),
        (black_box(1.0f64).tan(), 1.557_407_724_654_902_2),
    ];
    for (i, (found, wanted)) in exact.iter().enumerate() {
        assert_eq!(found.to_bits(), wanted.to_bits(), "{i}: {found} is not {wanted}");
    }
}
