//! The numeric cases of the book's geometry, attenuation, distribution and Fresnel functions (tests/golden).

use illuminant_optics::distribution::Distribution;
use illuminant_optics::fresnel::{
    conductor_approximated, dielectric_polarised, extinction_of_reflectance, index_of_reflectance,
    interpolated,
};
use illuminant_optics::masking::{sancer, torrance_sparrow};
use illuminant_optics::roughness::{
    apparent_roughness, coherent, correlation_distance, height, slope, tangential_scattering,
};
use illuminant_optics::vectors::{dot, half, half_refracted, reflect, refract_either};
use illuminant_optics::wave_optics::{blended, series};
use serde_json::Value;

/// What a case gives by name.
struct Case<'a>(&'a Value);

impl Case<'_> {
    fn number(&self, key: &str) -> f64 {
        self.0["in"][key].as_f64().unwrap_or_else(|| panic!("{key} of {}", self.0))
    }

    fn list(&self, key: &str) -> Vec<f64> {
        self.0["in"][key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    }

    fn vector(&self, key: &str) -> [f64; 3] {
        self.list(key).try_into().unwrap()
    }

    fn has(&self, key: &str) -> bool {
        !self.0["in"][key].is_null()
    }
}

/// Runs every set of a file for which `answer` gives the outputs by name.
fn check(file: &str, answer: impl Fn(&str, &Case<'_>) -> Vec<(&'static str, Option<Vec<f64>>)>) {
    let path = format!("{}/../../tests/golden/{file}.json", env!("CARGO_MANIFEST_DIR"));
    let data: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for set in data["sets"].as_array().unwrap() {
        let name = set["function"].as_str().unwrap();
        let [abs, rel] = ["abs", "rel"].map(|key| set["tolerance"][key].as_f64().unwrap());
        for case in set["cases"].as_array().unwrap() {
            for (key, found) in answer(name, &Case(case)) {
                let wanted = match &case["out"][key] {
                    Value::Null => None,
                    Value::Array(list) => Some(list.iter().map(|v| v.as_f64().unwrap()).collect()),
                    Value::String(_) => Some(vec![f64::INFINITY]),
                    number => Some(vec![number.as_f64().unwrap()]),
                };
                let told = format!("{name} {}: {found:?}, expected {wanted:?}", case["id"]);
                match (found, wanted) {
                    (None, None) => {}
                    (Some(found), Some(wanted)) => {
                        assert_eq!(found.len(), wanted.len(), "{told}");
                        for (x, y) in found.into_iter().zip(wanted) {
                            assert!(x == y || (x - y).abs() <= abs + rel * y.abs(), "{told}");
                        }
                    }
                    _ => panic!("{told}"),
                }
            }
        }
    }
}

fn one(key: &'static str, value: f64) -> Vec<(&'static str, Option<Vec<f64>>)> {
    vec![(key, Some(vec![value]))]
}

#[test]
fn geometry() {
    check("geometry", |name, case| match name {
        "geo_rfl" => vec![("R", Some(reflect(case.vector("V"), case.vector("N")).to_vec()))],
        "geo_rfr" => {
            let t = refract_either(case.vector("V"), case.vector("N"), case.number("ni"), case.number("nt"));
            vec![("T", t.map(|t| t.to_vec()))]
        }
        "geo_H" => vec![("H", half(case.vector("L"), case.vector("V")).map(|h| h.to_vec()))],
        "geo_Ht" => {
            let h = half_refracted(case.vector("L"), case.vector("T"), case.number("ni"), case.number("nt"));
            vec![("Ht", h.map(|h| h.to_vec()))]
        }
        other => panic!("{other}"),
    });
}

#[test]
fn attenuation() {
    check("attenuation", |name, case| {
        let [n, l, v] = ["N", "L", "V"].map(|key| case.vector(key));
        match name {
            "G_torrance" => one("G", torrance_sparrow(n, l, v)),
            "G_sancer" => one("G", sancer(n, l, v, case.number("m_squared"))),
            other => panic!("{other}"),
        }
    });
}

#[test]
fn distributions() {
    let named = |name: &str| match name.trim_start_matches("D_").trim_end_matches("_init") {
        "phong" => Some(Distribution::Phong),
        "blinn" => Some(Distribution::Blinn),
        "gaussian" => Some(Distribution::Gaussian),
        "reitz" => Some(Distribution::TrowbridgeReitz),
        "cook" => Some(Distribution::Cook),
        _ => None,
    };
    check("distributions", |name, case| {
        let vectors = || ["N", "L", "V"].map(|key| case.vector(key));
        if let Some(distribution) = named(name) {
            if name.ends_with("_init") {
                return one("coefficient", distribution.coefficient(case.number("beta")));
            }
            let [n, l, v] = vectors();
            return one("D", distribution.value(n, l, v, case.number("coefficient")));
        }
        match name {
            "D_g" => {
                let [n, l, v] = vectors();
                let g = apparent_roughness(case.number("sigma"), case.number("lambda"), dot(n, l), dot(n, v));
                one("g", g)
            }
            "D_tau" => one("value", correlation_distance(case.number("sigma"), case.number("m"))),
            "D_sigma" => one("value", height(case.number("m"), case.number("tau"))),
            "D_m" => one("value", slope(case.number("sigma"), case.number("tau"))),
            "D_coherent" => one("r_sigma", coherent(case.number("g"))),
            "D_Vxz" => {
                let [n, l, v] = vectors();
                one("Vxz_squared", tangential_scattering(n, l, v, case.number("lambda")))
            }
            "D_incoherent" => {
                let [n, l, v] = vectors();
                let (m, g, tau) = (case.number("m"), case.number("g"), case.number("tau"));
                let phase = tangential_scattering(n, l, v, case.number("lambda")) * tau * tau / 4.0;
                let Some(h) = half(l, v) else { return one("D", 0.0) };
                let cos = dot(n, h);
                let mut found = one("D", blended(cos, m, g, phase));
                // The exact series has g and τ of one surface; the cases choose τ freely.
                let consistent = g * (1.0 - cos * cos) / (cos * cos * m * m);
                if (phase - consistent).abs() < 1e-9 * phase && g < 5.0 {
                    found.push(("D_all_terms", Some(vec![series(cos, m, g)])));
                }
                found
            }
            other => panic!("{other}"),
        }
    });
}

#[test]
fn fresnel() {
    check("fresnel", |name, case| {
        let cos = |case: &Case<'_>| dot(case.vector("N"), case.vector("L")).clamp(0.0, 1.0);
        let polarised = || dielectric_polarised(cos(case), case.number("nt") / case.number("ni"));
        let metal = || conductor_approximated(cos(case), case.number("n"), case.number("k"));
        let mean = |[a, b]: [f64; 2]| 0.5 * (a + b);
        let average = || {
            let samples = case.list("samples");
            samples.iter().sum::<f64>() / samples.len() as f64
        };
        match name {
            "F_d_pl" => one("R", polarised()[0]),
            "F_d_pp" => one("R", polarised()[1]),
            "F_d_R" => one("R", mean(polarised())),
            "F_c_pl" => one("R", metal()[0]),
            "F_c_pp" => one("R", metal()[1]),
            "F_c_R" => one("R", mean(metal())),
            "F_approx_n" => {
                vec![("n", Some(vec![index_of_reflectance(average())])), ("Ro", Some(vec![average()]))]
            }
            "F_approx_k" => {
                vec![("k", Some(vec![extinction_of_reflectance(average())])), ("Ro", Some(vec![average()]))]
            }
            "F_approx_Fr" => {
                let at = mean(metal());
                let f = case.list("samples").into_iter().map(|s| interpolated(s, at, case.number("Ro")));
                vec![("Fr", Some(f.collect()))]
            }
            "F_approx_Fr_Ft" => {
                let samples = case.list("samples");
                let f: Vec<f64> = if case.has("T") {
                    let at = mean(polarised());
                    samples.into_iter().map(|s| interpolated(s, at, case.number("Ro"))).collect()
                } else {
                    vec![1.0; samples.len()]
                };
                vec![("Ft", Some(f.iter().map(|f| 1.0 - f).collect())), ("Fr", Some(f))]
            }
            other => panic!("{other}"),
        }
    });
}
