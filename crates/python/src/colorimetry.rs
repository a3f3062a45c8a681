//! `colorimetry`: what a lamp's light is like, and metamers.

use crate::spectrum::{Given, curve, given, observer};
use illuminant_spectrum::{Curve, SpectralRange};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

type Points<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

fn points<'py>(py: Python<'py>, curve: &Curve) -> Points<'py> {
    (PyArray1::from_slice(py, curve.wavelengths_nm()), PyArray1::from_slice(py, curve.values()))
}

fn mistake(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

#[pyfunction]
fn correlated_color_temperature(xy: [f64; 2], observer: &str) -> PyResult<(f64, f64)> {
    let found = illuminant_color::correlated_color_temperature(xy, self::observer(observer)?);
    found.map(|t| (t.cct_k, t.duv)).map_err(mistake)
}

#[pyfunction]
fn dominant_wavelength(
    xy: [f64; 2],
    white: [f64; 2],
    observer: &str,
) -> PyResult<(f64, bool, f64, [f64; 2])> {
    let found = illuminant_color::dominant_wavelength(xy, white, self::observer(observer)?);
    found.map(|d| (d.wavelength_nm, d.complementary, d.purity, d.boundary)).map_err(mistake)
}

#[pyfunction]
fn rendering_index(
    wavelengths_nm: Vec<f64>,
    values: Vec<f64>,
    outside: &str,
    step_nm: u32,
) -> PyResult<(f64, [f64; 14], f64, f64, f64)> {
    let found = illuminant_color::rendering_index(&curve(wavelengths_nm, values, outside)?, step_nm);
    found
        .map(|r| (r.general, r.special, r.temperature.cct_k, r.temperature.duv, r.reference_distance))
        .map_err(mistake)
}

#[pyfunction]
fn fidelity_index(lamp: Given, samples: Vec<Given>, step_nm: u32) -> PyResult<(f64, Vec<f64>, f64, f64)> {
    let samples = samples.into_iter().map(given).collect::<PyResult<Vec<_>>>()?;
    let found = illuminant_color::fidelity_index(&given(lamp)?, &samples, step_nm);
    found.map(|f| (f.general, f.special, f.temperature.cct_k, f.temperature.duv)).map_err(mistake)
}

#[pyfunction]
#[pyo3(signature = (reflectance, lamp, observer, range_nm, seed, distance))]
fn metamer<'py>(
    py: Python<'py>,
    reflectance: Given,
    lamp: Given,
    observer: &str,
    range_nm: [u32; 2],
    seed: u64,
    distance: Option<f64>,
) -> PyResult<(Points<'py>, f64, f64)> {
    let (reflectance, lamp, range) = (given(reflectance)?, given(lamp)?, SpectralRange::from(range_nm));
    let observer = self::observer(observer)?;
    let found = illuminant_color::metamer(&reflectance, &lamp, observer, range, seed, distance);
    let found = found.map_err(mistake)?;
    Ok((points(py, &found.reflectance), found.distance, found.largest))
}

#[pyfunction]
fn fundamental<'py>(
    py: Python<'py>,
    reflectance: Given,
    lamp: Given,
    observer: &str,
    range_nm: [u32; 2],
) -> PyResult<Points<'py>> {
    let (reflectance, lamp, range) = (given(reflectance)?, given(lamp)?, SpectralRange::from(range_nm));
    let observer = self::observer(observer)?;
    let found = illuminant_color::fundamental(&reflectance, &lamp, observer, range).map_err(mistake)?;
    Ok(points(py, &found))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(correlated_color_temperature, m)?)?;
    m.add_function(wrap_pyfunction!(dominant_wavelength, m)?)?;
    m.add_function(wrap_pyfunction!(rendering_index, m)?)?;
    m.add_function(wrap_pyfunction!(fidelity_index, m)?)?;
    m.add_function(wrap_pyfunction!(metamer, m)?)?;
    m.add_function(wrap_pyfunction!(fundamental, m)?)
}
