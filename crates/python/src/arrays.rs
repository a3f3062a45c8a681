//! NumPy arrays in and out.
//!
//! Arrays cross as they are: C-contiguous, f64 or f32, and the result is written into an array of the caller's, which
//! may be the input itself.

use numpy::{
    Element, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArrayMethods,
};
use pyo3::PyResult;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Runs the body with `$T` as the type of the numbers in an array: f64 or f32.
macro_rules! with_type {
    ($array:expr, $T:ident => $body:expr) => {
        if $array.cast::<numpy::PyArrayDyn<f64>>().is_ok() {
            type $T = f64;
            $body
        } else if $array.cast::<numpy::PyArrayDyn<f32>>().is_ok() {
            type $T = f32;
            $body
        } else {
            Err(pyo3::exceptions::PyTypeError::new_err("expected an array of float64 or float32"))
        }
    };
}
pub(crate) use with_type;

/// An array that is only read.
pub(crate) fn readable<'py, T: Element>(array: &Bound<'py, PyAny>) -> PyResult<PyReadonlyArrayDyn<'py, T>> {
    let array = array
        .cast::<PyArrayDyn<T>>()
        .map_err(|_| PyTypeError::new_err("expected arrays of one type, float64 or float32"))?;
    array.try_readonly().map_err(|e| PyValueError::new_err(format!("an array cannot be read: {e}")))
}

/// An array that is written.
pub(crate) fn writable<'py, T: Element>(array: &Bound<'py, PyAny>) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    let array = array
        .cast::<PyArrayDyn<T>>()
        .map_err(|_| PyTypeError::new_err("expected arrays of one type, float64 or float32"))?;
    array.try_readwrite().map_err(|e| PyValueError::new_err(format!("an array cannot be written: {e}")))
}

/// The numbers of an array that lies in one piece.
pub(crate) fn numbers<'a, T: Element>(array: &'a PyReadonlyArrayDyn<'_, T>) -> PyResult<&'a [T]> {
    if !array.is_c_contiguous() {
        return Err(not_contiguous());
    }
    array.as_slice().map_err(|_| not_contiguous())
}

/// The numbers of an array that lies in one piece, to be written.
pub(crate) fn numbers_mut<'a, T: Element>(
    array: &'a mut PyReadwriteArrayDyn<'_, T>,
) -> PyResult<&'a mut [T]> {
    if !array.is_c_contiguous() {
        return Err(not_contiguous());
    }
    array.as_slice_mut().map_err(|_| not_contiguous())
}

fn not_contiguous() -> PyErr {
    PyValueError::new_err("expected an array that lies in one piece, in the order of C")
}

/// Refuses an array whose last axis has not the length that is needed.
pub(crate) fn check_last_axis(shape: &[usize], length: usize) -> PyResult<()> {
    if shape.last() == Some(&length) {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("the last axis must have length {length}, and the shape is {shape:?}")))
}

/// Refuses two shapes that should be one.
pub(crate) fn check_same(a: &[usize], b: &[usize]) -> PyResult<()> {
    if a == b {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("shapes {a:?} and {b:?} differ")))
}
