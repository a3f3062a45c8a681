//! `spectrum`: curves and observers.

use illuminant_spectrum::{Curve, CurveError, Observer, Outside, SpectralRange};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

pub(crate) fn curve(wavelengths_nm: Vec<f64>, values: Vec<f64>, outside: &str) -> PyResult<Curve> {
    let outside = match outside {
        "zero" => Outside::Zero,
        "hold" => Outside::Hold,
        other => {
            return Err(PyValueError::new_err(format!("outside must be 'zero' or 'hold', not {other:?}")));
        }
    };
    Curve::new(wavelengths_nm, values, outside).map_err(|e: CurveError| PyValueError::new_err(e.to_string()))
}

#[pyfunction]
fn planck<'py>(
    py: Python<'py>,
    wavelengths_nm: PyReadonlyArray1<'py, f64>,
    temperature_k: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    if !(temperature_k > 0.0 && temperature_k.is_finite()) {
        return Err(PyValueError::new_err(format!("a temperature must be above 0 K, not {temperature_k}")));
    }
    let radiance = |&w: &f64| illuminant_spectrum::planck(w, temperature_k);
    Ok(PyArray1::from_iter(py, wavelengths_nm.as_array().iter().map(radiance)))
}

#[pyfunction]
fn daylight<'py>(
    py: Python<'py>,
    wavelengths_nm: PyReadonlyArray1<'py, f64>,
    cct_k: f64,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let curve = illuminant_spectrum::daylight(cct_k).ok_or_else(|| {
        PyValueError::new_err(format!("daylight is defined from 4000 to 25000 K, and {cct_k} K lies outside"))
    })?;
    Ok(PyArray1::from_iter(py, wavelengths_nm.as_array().iter().map(|&w| curve.at(w))))
}

#[pyfunction]
#[pyo3(signature = (wavelengths_nm, values, outside, range_nm=[380, 780]))]
fn xyz<'py>(
    py: Python<'py>,
    wavelengths_nm: Vec<f64>,
    values: Vec<f64>,
    outside: &str,
    range_nm: [u32; 2],
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let curve = curve(wavelengths_nm, values, outside)?;
    let xyz = Observer::cie_1931_2deg().xyz(&curve, SpectralRange::from(range_nm));
    Ok(PyArray1::from_slice(py, &xyz))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(planck, m)?)?;
    m.add_function(wrap_pyfunction!(daylight, m)?)?;
    m.add_function(wrap_pyfunction!(xyz, m)?)
}
