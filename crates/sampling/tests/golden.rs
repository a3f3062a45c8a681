//! The golden cases of the book's sampling routines (III.8), in tests/golden/sampling.json.

use illuminant_color::{RgbSystem, Transfer};
use illuminant_sampling::{Basis, Gauss, Hall, Role, ToXyz};
use illuminant_spectrum::{Curve, LUMINOUS_EFFICACY, Observer, Outside, SpectralRange};
use serde_json::Value;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/sampling.json");

/// Runs every case of a set: the routine gives numbers, which are compared with those of the output `key`.
fn check(function: &str, key: &str, routine: impl Fn(&Value) -> Vec<f64>) {
    let text = std::fs::read_to_string(FILE).unwrap();
    let file: Value = serde_json::from_str(&text).unwrap();
    let set = file["sets"].as_array().unwrap().iter().find(|set| set["function"] == function).unwrap();
    let (abs, rel) = (set["tolerance"]["abs"].as_f64().unwrap(), set["tolerance"]["rel"].as_f64().unwrap());
    let cases = set["cases"].as_array().unwrap();
    assert!(!cases.is_empty());
    for case in cases {
        let found = routine(&case["in"]);
        let expected = flat(&case["out"][key]);
        assert_eq!(found.len(), expected.len(), "{}", case["id"]);
        for (x, y) in found.iter().zip(&expected) {
            assert!((x - y).abs() <= abs + rel * y.abs(), "{}: {x} against {y}", case["id"]);
        }
    }
}

/// The numbers of a list, or of a list of rows.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap()
}

fn range(case: &Value) -> SpectralRange {
    SpectralRange { min_nm: number(case, "min_wl") as u32, max_nm: number(case, "max_wl") as u32 }
}

/// The curve that a case describes, at each nm.
fn curve(data: &Value, range: SpectralRange) -> Curve {
    if data["type"] == "points" {
        let points = flat(&data["points"]);
        let (wavelengths, values) = points.chunks(2).map(|p| (p[0], p[1])).unzip();
        return Curve::new(wavelengths, values, Outside::Hold).unwrap();
    }
    let at = |w: f64| match data["type"].as_str().unwrap() {
        "flat" => number(data, "value"),
        "ramp" => number(data, "a") + number(data, "b") * (w - 380.0) / 400.0,
        "gaussian" => {
            let x = (w - number(data, "center")) / number(data, "width");
            number(data, "scale") * (-x * x).exp()
        }
        "box" => f64::from(u8::from((number(data, "from")..=number(data, "to")).contains(&w))),
        other => panic!("a curve of type {other}"),
    };
    Curve::tabulated(range, range.wavelengths().map(at).collect(), Outside::Zero)
}

fn boxes(case: &Value) -> Hall {
    Hall::new(flat(&case["bounds"]), range(case))
}

/// The map to XYZ with Y = 1 for a curve of 1, of the book's observer.
fn map(case: &Value) -> ToXyz {
    let (map, area) = if case["method"] == "hall" {
        let observer = Observer::book();
        (boxes(case).map(observer), observer.matching[1].area(range(case)))
    } else {
        // Meyer's rows are in units of the area of ȳ already.
        let area = Observer::cie_1931_2deg().matching[1].area(SpectralRange::default());
        (Gauss::meyer_as_printed(range(case)).to_xyz(0), area)
    };
    map.map(|row| row.iter().map(|v| v / (LUMINOUS_EFFICACY * area)).collect())
}

#[test]
fn curves_are_reduced_to_samples() {
    check("CLR_spect_to_sample", "samples", |case| {
        let curve = curve(&case["curve"], range(case));
        if case["method"] == "hall" {
            boxes(case).reduce(&curve, Role::Fraction)
        } else {
            Gauss::meyer(range(case)).reduce(&curve, Role::Fraction)
        }
    });
}

#[test]
fn samples_become_xyz() {
    check("CLR_get_sample_xyz", "matrix", |case| map(case).concat());
}

#[test]
fn samples_become_rgb() {
    check("CLR_get_sample_rgb", "matrix", |case| {
        let xy: Vec<[f64; 2]> = flat(&case["primaries"]).chunks(2).map(|p| [p[0], p[1]]).collect();
        let system = RgbSystem::new("golden", [xy[0], xy[1], xy[2]], xy[3], Transfer::Linear).unwrap();
        let [x, y, z] = map(case);
        let rgb: Vec<[f64; 3]> = (0..x.len()).map(|i| system.from_xyz([x[i], y[i], z[i]])).collect();
        (0..3).flat_map(|row| rgb.iter().map(move |c| c[row])).collect()
    });
}

#[test]
fn samples_become_a_curve_again() {
    check("CLR_reconstruct", "values", |case| {
        let built = boxes(case).reconstruct(&flat(&case["samples"]));
        let first = range(case).min_nm as usize;
        flat(&case["wavelengths"]).iter().map(|&w| built[w as usize - first]).collect()
    });
}
