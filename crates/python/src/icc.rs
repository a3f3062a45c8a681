//! `icc`: profiles of displays.

use illuminant_icc::{Curve, ProfileDescription, Version, decode, encode};
use numpy::ToPyArray;
use numpy::ndarray::Array2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

fn curve(kind: &str, numbers: Vec<f64>) -> PyResult<Curve> {
    let wrong = |kind: &str| {
        PyValueError::new_err(format!("the numbers of a curve of kind {kind} are too many or too few"))
    };
    match kind {
        "gamma" => match *numbers.as_slice() {
            [gamma] => Ok(Curve::Gamma(gamma)),
            _ => Err(wrong(kind)),
        },
        "parametric" => numbers.try_into().map(Curve::Parametric).map_err(|_| wrong(kind)),
        "table" => Ok(Curve::Table(numbers)),
        "sRGB" => Ok(Curve::srgb()),
        "Rec.709" => Ok(Curve::rec709()),
        other => Err(PyValueError::new_err(format!("a curve of kind {other} is unknown"))),
    }
}

fn parts(curve: Curve) -> (&'static str, Vec<f64>) {
    match curve {
        Curve::Gamma(gamma) => ("gamma", vec![gamma]),
        Curve::Parametric(numbers) => ("parametric", numbers.to_vec()),
        Curve::Table(values) => ("table", values),
    }
}

#[pyfunction]
#[pyo3(signature = (description, rights, primaries, white, curves, *, peak=None, cicp=None, version=4))]
fn encode_icc<'py>(
    py: Python<'py>,
    description: String,
    rights: String,
    primaries: [[f64; 2]; 3],
    white: [f64; 2],
    curves: [(String, Vec<f64>); 3],
    peak: Option<f64>,
    cicp: Option<[u8; 4]>,
    version: u32,
) -> PyResult<Bound<'py, PyBytes>> {
    let version = Version::of(version)
        .ok_or_else(|| PyValueError::new_err(format!("a profile is of version 2 or 4, not {version}")))?;
    let [red, green, blue] = curves;
    let curves = [curve(&red.0, red.1)?, curve(&green.0, green.1)?, curve(&blue.0, blue.1)?];
    let display = ProfileDescription {
        description,
        copyright: rights,
        version,
        primaries,
        white,
        curves,
        luminance: peak,
        cicp,
    };
    let profile = py.detach(|| encode(&display)).map_err(|e| PyValueError::new_err(e.to_string()))?;
    Ok(PyBytes::new(py, &profile))
}

#[pyfunction]
fn decode_icc<'py>(py: Python<'py>, content: &[u8], samples: usize) -> PyResult<Bound<'py, PyDict>> {
    let read = decode(content).map_err(|e| PyValueError::new_err(e.to_string()))?;
    let found = PyDict::new(py);
    found.set_item("description", read.description)?;
    found.set_item("rights", read.copyright)?;
    found.set_item("version", read.version.number())?;
    found.set_item("primaries", read.primaries)?;
    found.set_item("white", read.white)?;
    found.set_item("peak", read.luminance)?;
    found.set_item("cicp", read.cicp.map(|[p, t, m, r]| (p, t, m, r)))?;
    let table: Vec<f64> = read.curves.iter().flat_map(|curve| curve.samples(samples)).collect();
    let table =
        Array2::from_shape_vec((3, samples), table).map_err(|e| PyValueError::new_err(e.to_string()))?;
    found.set_item("table", table.to_pyarray(py))?;
    found.set_item("curves", read.curves.map(parts).to_vec())?;
    Ok(found)
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(encode_icc, m)?)?;
    m.add_function(wrap_pyfunction!(decode_icc, m)?)
}
