//! `verify`: the testers, for materials of a scene and for functions of the user's.

use crate::scene::PyScene;
use illuminant_illumination::Illumination;
use illuminant_verify::audit::{Largest, Question, audit};
use illuminant_verify::chi_square::{sidak, survival};
use illuminant_verify::integrate::book_hemisphere;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What becomes of the light that reaches a material of a scene.
#[pyfunction]
fn audit_material<'py>(
    py: Python<'py>,
    scene: &PyScene,
    material: usize,
    illumination: &str,
    wavelengths_nm: Vec<f64>,
    angles_deg: Vec<f64>,
    draws: u64,
) -> PyResult<Bound<'py, PyDict>> {
    let illumination: Illumination = illumination.parse().map_err(PyValueError::new_err)?;
    let material = scene
        .0
        .materials
        .get(material)
        .ok_or_else(|| PyValueError::new_err(format!("the scene has no material number {material}")))?;
    let question = Question { wavelengths_nm, angles_deg, draws };
    let found = py.detach(|| audit(material, illumination, &question));
    let dict = PyDict::new(py);
    dict.set_item("angles_deg", found.angles_deg)?;
    dict.set_item("coherent_reflection", found.coherent_reflection)?;
    dict.set_item("scattered_reflection", found.scattered_reflection)?;
    dict.set_item("coherent_transmission", found.coherent_transmission)?;
    dict.set_item("scattered_transmission", found.scattered_transmission)?;
    let largest = |law: Largest| (law.largest, law.angle_deg, law.wavelength_nm);
    dict.set_item("gain", largest(found.gain))?;
    dict.set_item("equilibrium", largest(found.equilibrium))?;
    dict.set_item("reciprocity", found.reciprocity)?;
    dict.set_item("normalisation", found.normalisation)?;
    dict.set_item("p_value", found.p_value)?;
    dict.set_item("weight", found.weight)?;
    dict.set_item("claims_reciprocity", found.claims.reciprocal)?;
    dict.set_item("claims_conservation", found.claims.energy_conserving)?;
    dict.set_item("claims_equilibrium", found.claims.equilibrium)?;
    dict.set_item("source", found.claims.source)?;
    Ok(dict)
}

/// The chance of so large a chi-square.
#[pyfunction]
fn chi_square_p_value(statistic: f64, degrees_of_freedom: usize) -> f64 {
    survival(statistic, degrees_of_freedom)
}

/// The significance of each of several tests (Šidák).
#[pyfunction]
fn sidak_significance(significance: f64, tests: usize) -> f64 {
    sidak(significance, tests)
}

/// The directions of the book's hemispherical integrator and the solid angle of each.
#[pyfunction]
fn hemisphere_directions(increments: usize) -> Vec<([f64; 3], f64)> {
    let mut all = Vec::new();
    book_hemisphere(increments, |direction, solid_angle| all.push((direction, solid_angle)));
    all
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(audit_material, m)?)?;
    m.add_function(wrap_pyfunction!(chi_square_p_value, m)?)?;
    m.add_function(wrap_pyfunction!(sidak_significance, m)?)?;
    m.add_function(wrap_pyfunction!(hemisphere_directions, m)?)
}
