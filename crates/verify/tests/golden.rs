//! The numeric cases of the book's hemispherical integrator (tests/golden/integration.json).

use illuminant_optics::distribution::Distribution;
use illuminant_optics::masking::{sancer, torrance_sparrow};
use illuminant_optics::vectors::{dot, half, reflect};
use illuminant_verify::integrate::book_hemisphere;
use serde_json::Value;

#[test]
fn the_hemisphere_of_the_book() {
    let path = format!("{}/../../tests/golden/integration.json", env!("CARGO_MANIFEST_DIR"));
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for case in data["sets"][0]["cases"].as_array().unwrap() {
        let given = &case["in"];
        let p = given["parameter"].as_f64().unwrap_or(0.0);
        let theta = given["theta_i"].as_f64().unwrap();
        let (n, l) = ([0.0, 0.0, 1.0], [0.0, theta.sin(), theta.cos()]);
        let cook = |v: [f64; 3], g: f64| {
            // Book eq 4.23 with F = 1.
            Distribution::Cook.value(n, l, v, p) * g / (v[2] * l[2])
        };
        let f = |v: [f64; 3]| match given["function"].as_str().unwrap() {
            "identity" => 1.0,
            "cosine" => v[2],
            "phong_lobe" => dot(reflect(v, n), l).max(0.0).powf(p),
            "blinn_lobe" => half(l, v).map_or(0.0, |h| h[2].powf(p)),
            "cook_brdf" => cook(v, 1.0),
            "cook_brdf_torrance" => cook(v, torrance_sparrow(n, l, v)),
            "cook_brdf_sancer" => cook(v, sancer(n, l, v, p)),
            other => panic!("{other}"),
        };
        let mut sum = 0.0;
        book_hemisphere(given["incs"].as_u64().unwrap() as usize, |v, omega| sum += f(v) * v[2] * omega);
        let wanted = case["out"]["integral"].as_f64().unwrap();
        assert!((sum - wanted).abs() <= 1e-10 + 1e-9 * wanted, "{}: {sum}, expected {wanted}", case["id"]);
    }
}
