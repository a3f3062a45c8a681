//! `display`: developing, and PNG.

use crate::color::system;
use illuminant_display::{Pixels, PngTags, develop as develop_image, encode_png as encode};
use numpy::ndarray::Array3;
use numpy::{PyArrayMethods, PyReadonlyArray3, ToPyArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

#[pyfunction]
fn develop<'py>(
    py: Python<'py>,
    xyz: PyReadonlyArray3<'py, f64>,
    system: &str,
    exposure: f64,
    bits: u32,
) -> PyResult<(Bound<'py, PyAny>, f64)> {
    let system = self::system(system)?;
    if bits != 8 && bits != 16 {
        return Err(PyValueError::new_err(format!("a PNG has 8 or 16 bits a channel, not {bits}")));
    }
    let view = xyz.as_array();
    let (rows, columns, channels) = view.dim();
    if channels != 3 {
        return Err(PyValueError::new_err(format!("an XYZ image has 3 channels, not {channels}")));
    }
    let contiguous = view.as_standard_layout();
    let slice = contiguous.as_slice().unwrap_or_default();
    let developed = py.detach(|| develop_image(slice, &system, exposure, bits == 16));
    let error = |e: numpy::ndarray::ShapeError| PyValueError::new_err(e.to_string());
    let shape = (rows, columns, 3);
    let array = match developed.pixels {
        Pixels::Eight(codes) => {
            Array3::from_shape_vec(shape, codes).map_err(error)?.to_pyarray(py).into_any()
        }
        Pixels::Sixteen(codes) => {
            Array3::from_shape_vec(shape, codes).map_err(error)?.to_pyarray(py).into_any()
        }
    };
    Ok((array, developed.out_of_gamut))
}

#[pyfunction]
#[pyo3(signature = (pixels, *, chromaticities=None, gamma=None, cicp=None, srgb=false, text=Vec::new()))]
fn encode_png<'py>(
    py: Python<'py>,
    pixels: &Bound<'py, PyAny>,
    chromaticities: Option<[f64; 8]>,
    gamma: Option<f64>,
    cicp: Option<[u8; 4]>,
    srgb: bool,
    text: Vec<(String, String)>,
) -> PyResult<Bound<'py, PyBytes>> {
    let (codes, rows, columns) = if let Ok(array) = pixels.cast::<numpy::PyArray3<u8>>() {
        let (rows, columns, _) = array.readonly().as_array().dim();
        (Pixels::Eight(array.readonly().as_array().iter().copied().collect()), rows, columns)
    } else if let Ok(array) = pixels.cast::<numpy::PyArray3<u16>>() {
        let (rows, columns, _) = array.readonly().as_array().dim();
        (Pixels::Sixteen(array.readonly().as_array().iter().copied().collect()), rows, columns)
    } else {
        return Err(PyTypeError::new_err("pixels must be an array (h, w, 3) of uint8 or uint16"));
    };
    let chromaticities = chromaticities.map(|c| [[c[0], c[1]], [c[2], c[3]], [c[4], c[5]], [c[6], c[7]]]);
    let tags = PngTags { chromaticities, gamma, cicp, srgb, text };
    let file = py.detach(|| encode(&codes, columns as u32, rows as u32, &tags));
    Ok(PyBytes::new(py, &file.map_err(|e| PyValueError::new_err(e.to_string()))?))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(develop, m)?)?;
    m.add_function(wrap_pyfunction!(encode_png, m)?)
}
