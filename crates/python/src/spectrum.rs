//! `spectrum`: curves and observers.

use illuminant_spectrum::{Curve, CurveError, Observer, Outside, SpectralRange};
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, ToPyArray, ndarray::Array2};
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

/// The observer of a name.
pub(crate) fn observer(name: &str) -> PyResult<&'static Observer> {
    Observer::named(name).ok_or_else(|| {
        let known = Observer::NAMES.join(", ");
        PyValueError::new_err(format!("no observer {name:?}; known are {known}"))
    })
}

#[pyfunction]
fn observers() -> [&'static str; 4] {
    Observer::NAMES
}

#[pyfunction]
fn matching_functions<'py>(
    py: Python<'py>,
    wavelengths_nm: PyReadonlyArray1<'py, f64>,
    observer: &str,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let observer = self::observer(observer)?;
    let wanted = wavelengths_nm.as_array();
    let table = Array2::from_shape_fn((wanted.len(), 3), |(i, axis)| observer.matching[axis].at(wanted[i]));
    Ok(table.to_pyarray(py))
}

#[pyfunction]
#[pyo3(signature = (wavelengths_nm, values, outside, range_nm=[380, 780], observer=Observer::NAMES[0]))]
fn xyz<'py>(
    py: Python<'py>,
    wavelengths_nm: Vec<f64>,
    values: Vec<f64>,
    outside: &str,
    range_nm: [u32; 2],
    observer: &str,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let curve = curve(wavelengths_nm, values, outside)?;
    let xyz = self::observer(observer)?.xyz(&curve, SpectralRange::from(range_nm));
    Ok(PyArray1::from_slice(py, &xyz))
}

/// Points and rule of a curve.
pub(crate) type Given = (Vec<f64>, Vec<f64>, String);
type Made<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, &'static str);

pub(crate) fn given((wavelengths_nm, values, outside): Given) -> PyResult<Curve> {
    curve(wavelengths_nm, values, &outside)
}

fn made(py: Python<'_>, curve: Result<Curve, CurveError>) -> PyResult<Made<'_>> {
    let curve = curve.map_err(|e| PyValueError::new_err(e.to_string()))?;
    let outside = match curve.outside() {
        Outside::Zero => "zero",
        Outside::Hold => "hold",
    };
    let array = |values: &[f64]| PyArray1::from_slice(py, values);
    Ok((array(curve.wavelengths_nm()), array(curve.values()), outside))
}

#[pyfunction]
fn curve_sum(py: Python<'_>, a: Given, b: Given) -> PyResult<Made<'_>> {
    made(py, given(a)?.sum(&given(b)?))
}

#[pyfunction]
fn curve_difference(py: Python<'_>, a: Given, b: Given) -> PyResult<Made<'_>> {
    made(py, given(a)?.difference(&given(b)?))
}

#[pyfunction]
fn curve_product(py: Python<'_>, a: Given, b: Given) -> PyResult<Made<'_>> {
    made(py, given(a)?.product(&given(b)?))
}

#[pyfunction]
fn curve_area(curve: Given, range_nm: [u32; 2]) -> PyResult<f64> {
    Ok(given(curve)?.area(SpectralRange::from(range_nm)))
}

#[pyfunction]
fn curve_normalised(py: Python<'_>, curve: Given, wavelength_nm: f64, value: f64) -> PyResult<Made<'_>> {
    made(py, given(curve)?.normalised(wavelength_nm, value))
}

#[pyfunction]
fn curve_between(py: Python<'_>, curve: Given, first_nm: f64, last_nm: f64) -> PyResult<Made<'_>> {
    made(py, given(curve)?.between(first_nm, last_nm))
}

#[pyfunction]
fn curve_resampled<'py>(
    py: Python<'py>,
    curve: Given,
    wavelengths_nm: Vec<f64>,
    interpolation: &str,
    extrapolation: &str,
) -> PyResult<Made<'py>> {
    let interpolation = interpolation.parse().map_err(PyValueError::new_err::<String>)?;
    let extrapolation = extrapolation.parse().map_err(PyValueError::new_err::<String>)?;
    made(py, given(curve)?.resampled(&wavelengths_nm, interpolation, extrapolation))
}

#[pyfunction]
fn curve_pseudo_color(
    py: Python<'_>,
    curve: Given,
    band_nm: [f64; 2],
    visible_nm: [f64; 2],
) -> PyResult<Made<'_>> {
    made(py, given(curve)?.pseudo_color(band_nm, visible_nm))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(planck, m)?)?;
    m.add_function(wrap_pyfunction!(daylight, m)?)?;
    m.add_function(wrap_pyfunction!(observers, m)?)?;
    m.add_function(wrap_pyfunction!(matching_functions, m)?)?;
    m.add_function(wrap_pyfunction!(xyz, m)?)?;
    m.add_function(wrap_pyfunction!(curve_sum, m)?)?;
    m.add_function(wrap_pyfunction!(curve_difference, m)?)?;
    m.add_function(wrap_pyfunction!(curve_product, m)?)?;
    m.add_function(wrap_pyfunction!(curve_area, m)?)?;
    m.add_function(wrap_pyfunction!(curve_normalised, m)?)?;
    m.add_function(wrap_pyfunction!(curve_between, m)?)?;
    m.add_function(wrap_pyfunction!(curve_resampled, m)?)?;
    m.add_function(wrap_pyfunction!(curve_pseudo_color, m)?)
}
