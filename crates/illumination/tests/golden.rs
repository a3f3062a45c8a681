//! The golden cases of the historical models (book III.6, with the corrections of its errata).

use illuminant_illumination::{
    Coefficients, Highlight, Illumination, Light, Masking, Side, filter_attenuation, shade,
};
use illuminant_optics::Vector;
use illuminant_optics::distribution::Distribution;
use illuminant_optics::vectors::{cross, dot, normalize};
use serde_json::Value;
use std::cell::RefCell;

fn vector(value: &Value) -> Vector<f64> {
    std::array::from_fn(|i| value[i].as_f64().unwrap())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

/// The scale and the spectrum of one coefficient: the sample `i`.
fn scaled(material: &Value, name: &str, i: usize) -> f64 {
    number(&material[format!("{name}_scale")]) * number(&material[name][i])
}

fn coefficients(material: &Value, i: usize) -> Coefficients<f64> {
    let distribution = match material["D"].as_str() {
        Some("phong") => Distribution::Phong,
        Some("gaussian") => Distribution::Gaussian,
        Some("reitz") => Distribution::TrowbridgeReitz,
        Some("cook") => Distribution::Cook,
        _ => Distribution::Blinn,
    };
    let masking = match material["G"].as_str() {
        Some("torrance") => Masking::TorranceSparrow,
        Some("sancer") => Masking::Sancer(number(&material["G_coeff"])),
        _ => Masking::None,
    };
    let is_conductor = material["conductor"].as_bool() == Some(true);
    Coefficients {
        ambient: scaled(material, "Ka", i),
        diffuse: scaled(material, "Kd", i),
        specular: number(&material["Ks"][i]),
        specular_scale: number(&material["Ks_scale"]),
        transmitted: scaled(material, "Kt", i),
        highlight: Highlight { distribution, coefficient: number(&material["D_coeff"]), masking },
        mean_reflectance: number(&material["Ro"]),
        conductor: is_conductor.then(|| [number(&material["nt"]), number(&material["k"])]),
        transparent: material["transparent"].as_bool() == Some(true),
        terminator: 1.0,
    }
}

#[test]
fn the_golden_cases_hold() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/illumination_models.json");
    let golden: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let mut count = 0;
    for set in golden["sets"].as_array().unwrap() {
        let function = set["function"].as_str().unwrap();
        let model: Illumination = function.trim_start_matches("IM_").parse().unwrap();
        let close = |found: f64, expected: f64| {
            let [abs, rel] = ["abs", "rel"].map(|key| number(&set["tolerance"][key]));
            (found - expected).abs() <= abs + rel * expected.abs()
        };
        for case in set["cases"].as_array().unwrap() {
            check(case, model, &close);
            count += 1;
        }
    }
    assert_eq!(count, 90);
}

fn check(case: &Value, model: Illumination, close: &dyn Fn(f64, f64) -> bool) {
    let (id, given, wanted) = (case["id"].as_str().unwrap(), &case["in"], &case["out"]);
    let material = &given["material"];
    let n = normalize(vector(&given["N"]));
    let other = if n[0].abs() > 0.5 { [0.0, 1.0, 0.0] } else { [1.0, 0.0, 0.0] };
    let t = normalize(cross(other, n));
    let b = cross(n, t);
    let local = |v: Vector<f64>| [dot(v, t), dot(v, b), dot(v, n)];
    let world =
        |v: Vector<f64>| -> Vector<f64> { std::array::from_fn(|i| v[0] * t[i] + v[1] * b[i] + v[2] * n[i]) };
    let point = vector(&given["surface_point"]);
    let towards = |target: Vector<f64>| {
        let span: Vector<f64> = std::array::from_fn(|i| target[i] - point[i]);
        (dot(span, span) > 0.0).then(|| local(normalize(span)))
    };
    let v = local(vector(&given["V"]));
    let or_one = |value: &Value| value.as_f64().unwrap_or(1.0);
    let side = Side {
        outside: or_one(&material["nr"]),
        inside: or_one(&material["nt"]),
        outside_is_air: material["r_is_air"].as_bool() != Some(false),
    };
    let traces = given["trace_rays"].as_bool() == Some(true);
    for (i, expected) in wanted["color"].as_array().unwrap().iter().enumerate() {
        let surface = coefficients(material, i);
        let intensity = |light: &Value| number(&light["I_scale"]) * number(&light["I"][i]);
        let lights: Vec<Light<f64>> = given["lights"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(|light| {
                Some(Light { direction: towards(vector(&light["center"]))?, intensity: intensity(light) })
            })
            .collect();
        let asked: RefCell<[Option<Vector<f64>>; 2]> = RefCell::default();
        let ask = |direction: Vector<f64>| {
            let through = direction[2] * v[2] < 0.0;
            if !traces {
                return None;
            }
            asked.borrow_mut()[usize::from(through)] = Some(world(direction));
            given[["reflected_color", "refracted_color"][usize::from(through)]][i].as_f64()
        };
        let shaded = shade(model, &surface, &side, v, intensity(&given["ambient"]), &lights, ask);
        let medium = if v[2] < 0.0 { &material["At"] } else { &material["Ar"] };
        let span: Vector<f64> = std::array::from_fn(|c| vector(&given["view_start"])[c] - point[c]);
        let kept = match medium[i].as_f64() {
            Some(a) if model == Illumination::Hall => filter_attenuation(a, dot(span, span).sqrt()),
            _ => 1.0,
        };
        let found = shaded.sum() * kept;
        assert!(close(found, number(expected)), "{id} sample {i}: {found} {expected} {shaded:?}");
        for (found, key) in asked.borrow().iter().zip(["reflected_dir", "refracted_dir"]) {
            let Some(expected) = wanted.get(key) else { continue };
            match found {
                Some(found) if !expected.is_null() => {
                    let expected = vector(expected);
                    assert!(
                        (0..3).all(|c| close(found[c], expected[c])),
                        "{id} {key}: {found:?} {expected:?}"
                    );
                }
                other => assert!(other.is_none() && expected.is_null(), "{id} {key}: {other:?} {expected}"),
            }
        }
    }
}
