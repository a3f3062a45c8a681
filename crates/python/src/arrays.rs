//! NumPy arrays in and out.

use numpy::ndarray::{ArrayD, ArrayViewD, Axis, IxDyn};
use pyo3::PyResult;
use pyo3::exceptions::PyValueError;

/// Applies a function of three values along the last axis, which must have length three.
pub(crate) fn map_triples(
    input: ArrayViewD<'_, f64>,
    f: impl Fn([f64; 3]) -> [f64; 3],
) -> PyResult<ArrayD<f64>> {
    check_triples(&input)?;
    let mut output = ArrayD::zeros(input.raw_dim());
    let last = Axis(input.ndim() - 1);
    for (from, mut to) in input.lanes(last).into_iter().zip(output.lanes_mut(last)) {
        for (slot, value) in to.iter_mut().zip(f([from[0], from[1], from[2]])) {
            *slot = value;
        }
    }
    Ok(output)
}

/// Applies a function of two triples along the last axes of two arrays of one shape.
pub(crate) fn zip_triples(
    a: ArrayViewD<'_, f64>,
    b: ArrayViewD<'_, f64>,
    f: impl Fn([f64; 3], [f64; 3]) -> f64,
) -> PyResult<ArrayD<f64>> {
    check_triples(&a)?;
    if a.shape() != b.shape() {
        return Err(PyValueError::new_err(format!("shapes {:?} and {:?} differ", a.shape(), b.shape())));
    }
    let last = Axis(a.ndim() - 1);
    let values =
        a.lanes(last).into_iter().zip(b.lanes(last)).map(|(a, b)| f([a[0], a[1], a[2]], [b[0], b[1], b[2]]));
    let shape = IxDyn(&a.shape()[..a.ndim() - 1]);
    ArrayD::from_shape_vec(shape, values.collect()).map_err(|e| PyValueError::new_err(e.to_string()))
}

fn check_triples(array: &ArrayViewD<'_, f64>) -> PyResult<()> {
    if array.shape().last() == Some(&3) {
        return Ok(());
    }
    Err(PyValueError::new_err(format!(
        "the last axis must have length 3, and the shape is {:?}",
        array.shape()
    )))
}
