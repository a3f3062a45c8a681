//! `color`: RGB systems, Lab, differences, and spectra for RGB.

use crate::arrays::{map_triples, zip_triples};
use illuminant_color::{Lab, RgbSystem, Upsampler, delta_e_2000 as ciede2000, rgb_system_names};
use illuminant_spectrum::{Curve, SpectralRange};
use numpy::{PyArray1, PyArrayDyn, PyReadonlyArrayDyn, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

pub(crate) fn system(name: &str) -> PyResult<RgbSystem> {
    RgbSystem::named(name).ok_or_else(|| {
        let known: Vec<_> = rgb_system_names().collect();
        PyValueError::new_err(format!("no RGB system {name:?}; known are {}", known.join(", ")))
    })
}

#[pyfunction]
fn rgb_systems() -> Vec<&'static str> {
    rgb_system_names().collect()
}

#[pyfunction]
fn rgb_system<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
    let system = system(name)?;
    let dict = PyDict::new(py);
    dict.set_item("name", &system.name)?;
    dict.set_item("primaries", system.primaries)?;
    dict.set_item("white", system.white)?;
    dict.set_item("transfer", system.transfer.name())?;
    dict.set_item("to_xyz", system.to_xyz_rows())?;
    dict.set_item("from_xyz", system.from_xyz_rows())?;
    Ok(dict)
}

#[pyfunction]
fn xyz_to_lab<'py>(
    py: Python<'py>,
    xyz: PyReadonlyArrayDyn<'py, f64>,
    white: [f64; 3],
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let lab = map_triples(xyz.as_array(), |xyz| {
        let Lab { l, a, b } = Lab::from_xyz(xyz, white);
        [l, a, b]
    })?;
    Ok(lab.to_pyarray(py))
}

#[pyfunction]
fn delta_e_2000<'py>(
    py: Python<'py>,
    lab_a: PyReadonlyArrayDyn<'py, f64>,
    lab_b: PyReadonlyArrayDyn<'py, f64>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    let lab = |[l, a, b]: [f64; 3]| Lab { l, a, b };
    let difference = zip_triples(lab_a.as_array(), lab_b.as_array(), |a, b| ciede2000(lab(a), lab(b)))?;
    Ok(difference.to_pyarray(py))
}

type Upsampled<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, f64);

fn arrays<'py>(py: Python<'py>, (curve, error): (Curve, f64)) -> Upsampled<'py> {
    (PyArray1::from_slice(py, curve.wavelengths_nm()), PyArray1::from_slice(py, curve.values()), error)
}

#[pyfunction]
#[pyo3(signature = (rgb, system, range_nm=[380, 780]))]
fn upsample_albedo<'py>(
    py: Python<'py>,
    rgb: [f64; 3],
    system: &str,
    range_nm: [u32; 2],
) -> PyResult<Upsampled<'py>> {
    let upsampler = Upsampler::new(&self::system(system)?, SpectralRange::from(range_nm));
    let found = upsampler.albedo(rgb).ok_or_else(|| {
        PyValueError::new_err(format!("an albedo's RGB must lie in [0, 1], and {rgb:?} does not"))
    })?;
    Ok(arrays(py, found))
}

#[pyfunction]
#[pyo3(signature = (rgb, system, range_nm=[380, 780]))]
fn upsample_emission<'py>(
    py: Python<'py>,
    rgb: [f64; 3],
    system: &str,
    range_nm: [u32; 2],
) -> PyResult<Upsampled<'py>> {
    let upsampler = Upsampler::new(&self::system(system)?, SpectralRange::from(range_nm));
    let found = upsampler
        .emission(rgb)
        .ok_or_else(|| PyValueError::new_err(format!("an emission's RGB must not be negative: {rgb:?}")))?;
    Ok(arrays(py, found))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(rgb_systems, m)?)?;
    m.add_function(wrap_pyfunction!(rgb_system, m)?)?;
    m.add_function(wrap_pyfunction!(xyz_to_lab, m)?)?;
    m.add_function(wrap_pyfunction!(delta_e_2000, m)?)?;
    m.add_function(wrap_pyfunction!(upsample_albedo, m)?)?;
    m.add_function(wrap_pyfunction!(upsample_emission, m)?)
}
