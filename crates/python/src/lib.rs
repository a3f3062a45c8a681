//! The bindings: what Python calls `illuminant._core`.
//!
//! Conversion only: one thin file per room, no physics and no defaults of their own. Numbers cross as NumPy
//! arrays of f64, descriptions as JSON, and long calls let go of the interpreter.

mod arrays;
mod color;
mod colorimetry;
mod display;
mod dither;
mod icc;
mod optics;
mod radiosity;
mod sampling;
mod scene;
mod spectrum;
mod technique;
mod toml;
mod verify;
mod waiting;

use pyo3::prelude::*;

/// The compiled core of illuminant.
#[pymodule]
fn _core(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("__version__", env!("CARGO_PKG_VERSION"))?;
    toml::register(m)?;
    spectrum::register(m)?;
    color::register(m)?;
    colorimetry::register(m)?;
    display::register(m)?;
    icc::register(m)?;
    dither::register(m)?;
    optics::register(m)?;
    sampling::register(m)?;
    scene::register(m)?;
    technique::register(m)?;
    radiosity::register(m)?;
    verify::register(m)?;
    Ok(())
}
