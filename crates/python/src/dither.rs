//! `dither`: codes of values, and patterning.

use illuminant_display::{Code, Dither, DitherError, Patterning, Pixels, quantise_into};
use numpy::ndarray::{Array2, Array3};
use numpy::{Element, PyArray2, PyArray3, PyArrayMethods, ToPyArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

fn refused(error: DitherError) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// Runs `work` with the values of an array (h, w, c) and its shape. They are copied only where they are not f32 or do
/// not lie in one piece.
fn with_values<R>(
    values: &Bound<'_, PyAny>,
    work: impl FnOnce(&[f32], [usize; 3]) -> PyResult<R>,
) -> PyResult<R> {
    let unreadable = |e: numpy::BorrowError| PyValueError::new_err(format!("an array cannot be read: {e}"));
    if let Ok(array) = values.cast::<PyArray3<f32>>() {
        let array = array.try_readonly().map_err(unreadable)?;
        let view = array.as_array();
        let shape = view.dim().into();
        match view.as_slice() {
            Some(slice) => work(slice, shape),
            None => work(&view.iter().copied().collect::<Vec<f32>>(), shape),
        }
    } else if let Ok(array) = values.cast::<PyArray3<f64>>() {
        let array = array.try_readonly().map_err(unreadable)?;
        let view = array.as_array();
        work(&view.iter().map(|&v| v as f32).collect::<Vec<f32>>(), view.dim().into())
    } else {
        Err(PyTypeError::new_err("expected an array (h, w, c) of float32 or float64"))
    }
}

fn codes<'py, T: Code + Element>(
    py: Python<'py>,
    values: &[f32],
    shape: [usize; 3],
    bits: u32,
    dither: &Dither,
) -> PyResult<Bound<'py, PyAny>> {
    let array = PyArray3::<T>::zeros(py, shape, false);
    {
        let mut writable = array.readwrite();
        let codes = writable.as_slice_mut().map_err(|e| PyValueError::new_err(e.to_string()))?;
        py.detach(|| quantise_into(values, shape[1], shape[2], bits, dither, codes)).map_err(refused)?;
    }
    Ok(array.into_any())
}

fn named(name: &str, seed: u64, channels_alike: bool) -> PyResult<Dither> {
    let dither = Dither::named(name).map_err(refused)?.with_seed(seed);
    Ok(if channels_alike { dither.with_channels_alike() } else { dither })
}

#[pyfunction]
fn dithers() -> Vec<&'static str> {
    Dither::names().to_vec()
}

#[pyfunction]
#[pyo3(signature = (values, bits, name, seed=0, *, channels_alike=false))]
fn dither<'py>(
    py: Python<'py>,
    values: &Bound<'py, PyAny>,
    bits: u32,
    name: &str,
    seed: u64,
    channels_alike: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let dither = py.detach(|| named(name, seed, channels_alike))?;
    with_values(values, |values, shape| {
        if bits <= 8 {
            codes::<u8>(py, values, shape, bits, &dither)
        } else {
            codes::<u16>(py, values, shape, bits, &dither)
        }
    })
}

#[pyfunction]
fn dither_thresholds<'py>(py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyArray2<f32>>>> {
    let dither = py.detach(|| named(name, 0, false))?;
    dither
        .thresholds()
        .map(|tile| {
            Array2::from_shape_vec((tile.height(), tile.width()), tile.values().to_vec())
                .map(|tile| tile.to_pyarray(py))
                .map_err(|e| PyValueError::new_err(e.to_string()))
        })
        .transpose()
}

#[pyfunction]
#[pyo3(signature = (values, bits, cell, *, enlarge))]
fn patterning<'py>(
    py: Python<'py>,
    values: &Bound<'py, PyAny>,
    bits: u32,
    cell: (usize, usize),
    enlarge: bool,
) -> PyResult<Bound<'py, PyAny>> {
    let cell = Patterning::new(cell.0, cell.1).map_err(refused)?;
    with_values(values, |values, [rows, columns, channels]| {
        let pixels = py.detach(|| {
            if enlarge {
                cell.enlarge(values, columns, channels, bits)
            } else {
                cell.replace(values, columns, channels, bits)
            }
        });
        let shape = if enlarge {
            (rows * cell.height(), columns * cell.width(), channels)
        } else {
            (rows, columns, channels)
        };
        let error = |e: numpy::ndarray::ShapeError| PyValueError::new_err(e.to_string());
        Ok(match pixels.map_err(refused)? {
            Pixels::Eight(codes) => {
                Array3::from_shape_vec(shape, codes).map_err(error)?.to_pyarray(py).into_any()
            }
            Pixels::Sixteen(codes) => {
                Array3::from_shape_vec(shape, codes).map_err(error)?.to_pyarray(py).into_any()
            }
        })
    })
}

#[pyfunction]
fn patterning_turns<'py>(py: Python<'py>, cell: (usize, usize)) -> PyResult<Bound<'py, PyArray2<u32>>> {
    let (width, height) = cell;
    let cell = Patterning::new(width, height).map_err(refused)?;
    let turns = cell.turns().iter().map(|&turn| turn as u32).collect();
    let turns = Array2::from_shape_vec((height, width), turns);
    Ok(turns.map_err(|e| PyValueError::new_err(e.to_string()))?.to_pyarray(py))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(dithers, m)?)?;
    m.add_function(wrap_pyfunction!(dither, m)?)?;
    m.add_function(wrap_pyfunction!(dither_thresholds, m)?)?;
    m.add_function(wrap_pyfunction!(patterning, m)?)?;
    m.add_function(wrap_pyfunction!(patterning_turns, m)?)
}
