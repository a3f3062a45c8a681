//! `sampling`: the spectral samplings and what they cost in colour.

use crate::spectrum::{Given, given};
use illuminant_sampling::{
    Comparison, Products, SAMPLING_NAMES, SamplingError, SpectralError, SpectralSampling, compare,
};
use illuminant_spectrum::{Curve, SpectralRange};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

fn curves(data: Vec<Given>) -> PyResult<Vec<Curve>> {
    data.into_iter().map(given).collect()
}

fn error<'py>(py: Python<'py>, found: &[Comparison]) -> PyResult<Bound<'py, PyDict>> {
    let error = SpectralError::over(found);
    let dict = PyDict::new(py);
    dict.set_item("mean", error.mean)?;
    dict.set_item("p95", error.p95)?;
    dict.set_item("max", error.max)?;
    dict.set_item("lamp", error.lamp)?;
    dict.set_item("reflectances", error.materials)?;
    Ok(dict)
}

#[pyfunction]
fn sampling_names() -> Vec<(&'static str, &'static str)> {
    SAMPLING_NAMES.to_vec()
}

/// Errors of a sampling on products of reflectances under lamps: by lamp, as exposed and lit to half the white.
#[pyfunction]
#[pyo3(signature = (sampling, lamps, fitted_on, judged_on, depth, most_fitted, most_judged, seed, range_nm))]
fn sampling_error<'py>(
    py: Python<'py>,
    sampling: &str,
    lamps: Vec<Given>,
    fitted_on: Vec<Given>,
    judged_on: Vec<Given>,
    depth: usize,
    most_fitted: usize,
    most_judged: usize,
    seed: u64,
    range_nm: [u32; 2],
) -> PyResult<Bound<'py, PyDict>> {
    let refused = |e: SamplingError| PyValueError::new_err(e.to_string());
    let sampling: SpectralSampling = sampling.parse().map_err(refused)?;
    let (lamps, fitted_on, judged_on) = (curves(lamps)?, curves(fitted_on)?, curves(judged_on)?);
    let range = SpectralRange::from(range_nm);
    let count = lamps.len();
    let products = |reflectances: &[Curve], most, seed| {
        let mut products = Products::new(range, lamps.clone())?;
        products.add_reflectances(reflectances, depth, most, seed);
        Some(products)
    };
    let found = py.detach(|| {
        let basis = sampling.basis(range, &|| products(&fitted_on, most_fitted, seed))?;
        let wavelengths: Vec<f64> = (0..basis.len()).map(|i| basis.wavelength_nm(i)).collect();
        let judged = products(&judged_on, most_judged, seed + 1);
        let kinds: Vec<_> = (0..count).map(|l| judged.as_ref().and_then(|p| p.kind(l))).collect();
        Ok((wavelengths, kinds, judged.map(|p| compare(&*basis, &p)).unwrap_or_default()))
    });
    let (wavelengths, kinds, found) = found.map_err(refused)?;
    let dict = PyDict::new(py);
    dict.set_item("wavelengths_nm", wavelengths)?;
    let mut by_lamp = Vec::new();
    for kind in kinds {
        let exposed: Vec<Comparison> = found.iter().filter(|c| Some(c.lamp) == kind).cloned().collect();
        let lit: Vec<Comparison> =
            exposed.iter().filter(|c| c.exact[1] > 0.0).cloned().map(Comparison::lit_to_half).collect();
        let errors = PyDict::new(py);
        errors.set_item("products", exposed.len())?;
        errors.set_item("exposed", error(py, &exposed)?)?;
        errors.set_item("lit", error(py, &lit)?)?;
        by_lamp.push(errors);
    }
    dict.set_item("by_lamp", by_lamp)?;
    Ok(dict)
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(sampling_names, m)?)?;
    m.add_function(wrap_pyfunction!(sampling_error, m)?)
}
