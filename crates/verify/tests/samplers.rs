//! Chi-square of the samplers of `illuminant-optics`, in f64 and f32: directions over the hemisphere and the
//! sphere, over rectangles and triangles seen from a point, and facet normals visible from a direction.

use illuminant_optics::facets::{Facets, Shape};
use illuminant_optics::hemisphere::{cosine, sphere};
use illuminant_optics::spherical_rectangle::SphericalRectangle;
use illuminant_optics::spherical_triangle::SphericalTriangle;
use illuminant_optics::vectors::{dot, normalize};
use illuminant_optics::{Real, Vector};
use illuminant_verify::chi_square::{ChiSquare, sidak};
use illuminant_verify::integrate::{Cell, Quadrature};
use std::f64::consts::{FRAC_1_PI, TAU};

/// All tests of this file together: [`hemispheres`] 4, [`rectangles`] 5, [`triangles`] 4, [`facets`] 36.
const TESTS: usize = 4 + 5 + 4 + 36;

fn check(
    name: &str,
    seed: u64,
    sample: impl FnMut([f64; 2]) -> Option<Vector<f64>>,
    pdf: impl Fn(Vector<f64>) -> f64,
) {
    // Sharp rims want small cells.
    let quadrature = Quadrature { rows: 64, columns: 64, ..Quadrature::default() };
    let test = ChiSquare { samples: 50_000, seed, quadrature, ..ChiSquare::default() };
    let outcome = test.run(sample, pdf);
    assert!(outcome.passes(sidak(0.01, TESTS)), "{name}: {outcome:?}");
    assert!((outcome.probability - 1.0).abs() < 1e-3, "{name}: {outcome:?}");
    assert_eq!(outcome.directions, test.samples, "{name}");
}

/// The numbers as f32, below 1.
fn singles(u: [f64; 2]) -> [f32; 2] {
    u.map(|u| (u as f32).min(1.0 - f32::EPSILON))
}

fn doubles(d: Vector<f32>) -> Option<Vector<f64>> {
    Some(d.map(f64::from))
}

#[test]
fn hemispheres() {
    let lambert = |d: Vector<f64>| d[2].max(0.0) * FRAC_1_PI;
    check("cosine", 1, |u| Some(cosine(u)), lambert);
    check("cosine f32", 2, |u| doubles(cosine(singles(u))), lambert);
    check("sphere", 3, |u| Some(sphere(u)), |_| 0.5 / TAU);
    check("sphere f32", 4, |u| doubles(sphere(singles(u))), |_| 0.5 / TAU);
}

#[test]
fn rectangles() {
    // (corner, size): near, tilted away to one side, far, long and thin, and one that is nearly half of what
    // one sees.
    let views = [
        ([0.2, -0.4, 1.0], [1.5, 0.8]),
        ([-2.0, 1.0, 0.5], [1.0, 2.0]),
        ([-0.3, 0.5, 5.0], [1.0, 1.0]),
        ([-4.0, 0.1, 1.0], [8.0, 0.2]),
        ([-20.0, -20.0, 1.0], [40.0, 40.0]),
    ];
    for (i, (corner, size)) in views.into_iter().enumerate() {
        // In a frame that is aligned with nothing.
        let x = normalize([0.6, 0.64, 0.48]);
        let y = normalize([-0.8, 0.48, 0.36]);
        let z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
        let point = [0.1, -0.7, 0.3];
        let place =
            |c: Vector<f64>| std::array::from_fn(|k| point[k] + c[0] * x[k] + c[1] * y[k] + c[2] * z[k]);
        let seen = SphericalRectangle::new(place(corner), x, y, size, point).unwrap();
        let pdf = |d: Vector<f64>| {
            let depth = dot(d, z);
            let at = [dot(d, x) / depth * corner[2] - corner[0], dot(d, y) / depth * corner[2] - corner[1]];
            let inside = depth > 0.0 && at.iter().zip(size).all(|(at, size)| (0.0..=size).contains(at));
            if inside { seen.solid_angle().recip() } else { 0.0 }
        };
        let direction = |u| Some(normalize(std::array::from_fn(|k| seen.sample(u)[k] - point[k])));
        check(&format!("rectangle {i}"), 10 + i as u64, direction, pdf);
    }
}

#[test]
fn triangles() {
    let views = [
        [[0.3, -0.2, 1.0], [1.2, 0.1, 0.8], [0.4, 0.9, 1.3]],
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[5.0, 5.0, -3.0], [5.3, 5.0, -3.0], [5.0, 5.4, -3.1]],
        [[-10.0, -10.0, 0.4], [10.0, -10.0, 0.5], [0.0, 12.0, 0.6]],
    ];
    for (i, corners) in views.into_iter().enumerate() {
        let seen = SphericalTriangle::new(corners, [0.0; 3]).unwrap();
        let cross = |a: Vector<f64>, b: Vector<f64>| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let [a, b, c] = corners;
        let volume = dot(cross(a, b), c);
        let pdf = |d| {
            let inside = [(a, b), (b, c), (c, a)].iter().all(|(p, q)| dot(cross(*p, *q), d) * volume > 0.0);
            if inside { seen.solid_angle().recip() } else { 0.0 }
        };
        check(&format!("triangle {i}"), 20 + i as u64, |u| Some(seen.sample(u)), pdf);
    }
}

fn facets_of<R: Real>(
    shape: Shape,
    slope: [f64; 2],
    theta_deg: f64,
    seed: u64,
    to_real: impl Fn([f64; 2]) -> [R; 2],
) {
    let v = Cell::direction([theta_deg.to_radians(), 0.7]);
    let facets = Facets { shape, slope: slope.map(R::of) };
    let seen = v.map(R::of);
    let double = |h: Vector<R>| h.map(|x| x.to_f64().unwrap());
    // The density in f64 for either: it is the law, not its rounding.
    let exact = Facets { shape, slope };
    let name =
        format!("{shape:?} facets {slope:?}, view {theta_deg} degrees, {}", std::any::type_name::<R>());
    check(
        &name,
        seed,
        |u| Some(double(facets.sample_visible(seen, to_real(u)))),
        |h| exact.pdf_visible(v, h),
    );
}

#[test]
fn facets() {
    let mut seed = 100;
    for shape in [Shape::Beckmann, Shape::Ggx] {
        for slope in [[0.05, 0.05], [0.2, 0.2], [1.0, 1.0], [3.0, 3.0], [0.1, 0.4], [0.8, 0.3]] {
            for theta in [0.0, 50.0, 85.0] {
                facets_of::<f64>(shape, slope, theta, seed, |u| u);
                facets_of::<f32>(shape, slope, theta, seed + 1, singles);
                seed += 2;
            }
        }
    }
}
