//! The bindings: what Python calls `illuminant._core`.
use pyo3::prelude::*;

/// The compiled core of illuminant.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    Ok(())
}
