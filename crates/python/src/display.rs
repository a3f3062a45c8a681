//! `display`: displays, developing for them, gamut methods and tone operators, and PNG.

use crate::arrays::{check_last_axis, numbers, readable};
use illuminant_color::{Oklab, RgbSystem, Transfer, Triple};
use illuminant_display::{
    Code, Development, Display, Dither, Gamut, GamutMap, Met, Pixels, PngTags, Response, Sample, Tone,
    develop as develop_image, develop_codes, encode_png as encode,
};
use numpy::{Element, PyArray1, PyArray3, PyArrayMethods, PyUntypedArrayMethods, ToPyArray};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// A display of the core.
#[pyclass(name = "Display", module = "illuminant._core", frozen)]
struct PyDisplay(Display);

fn response(found: &Bound<'_, PyAny>, peak: f64, black: f64) -> PyResult<Response> {
    if let Ok(name) = found.extract::<String>() {
        return Response::named(&name, peak, black)
            .ok_or_else(|| PyValueError::new_err(format!("no response {name:?}")));
    }
    Ok(Response::Table(found.extract()?))
}

/// What a name stands for among the names there are.
fn named<T>(
    found: Option<T>,
    what: &str,
    name: &str,
    names: impl Iterator<Item = &'static str>,
) -> PyResult<T> {
    found.ok_or_else(|| {
        let names: Vec<_> = names.collect();
        PyValueError::new_err(format!("there is no {what} {name:?}: known are {}", names.join(", ")))
    })
}

fn gamut(name: &str) -> PyResult<Gamut> {
    named(Gamut::named(name), "gamut method", name, Gamut::names())
}

fn tone(name: &str) -> PyResult<Tone> {
    named(Tone::named(name), "tone operator", name, Tone::names())
}

/// Triples of an array (..., 3), each taken through a function, as a flat array.
fn each<'py>(
    py: Python<'py>,
    array: &Bound<'py, PyAny>,
    function: impl Fn(Triple) -> Triple + Sync,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let array = readable::<f64>(array)?;
    check_last_axis(array.shape(), 3)?;
    let values = numbers(&array)?;
    let result: Vec<f64> =
        py.detach(|| values.chunks_exact(3).flat_map(|v| function([v[0], v[1], v[2]])).collect());
    Ok(result.to_pyarray(py))
}

// `from_xyz` is the field's word for XYZ to the display's light, no constructor.
#[allow(clippy::wrong_self_convention)]
#[pymethods]
impl PyDisplay {
    #[new]
    fn new(
        name: &str,
        primaries: [[f64; 2]; 3],
        white: [f64; 2],
        responses: [Bound<'_, PyAny>; 3],
        peak: f64,
        black: f64,
    ) -> PyResult<Self> {
        let system = RgbSystem::new(name, primaries, white, Transfer::Linear).ok_or_else(|| {
            PyValueError::new_err(
                "its primaries lie on one line, or its white has y = 0 or is a mixture of two of them",
            )
        })?;
        let [r, g, b] = responses;
        let responses = [response(&r, peak, black)?, response(&g, peak, black)?, response(&b, peak, black)?];
        let display = Display::new(system, responses, peak, black);
        display.map(Self).map_err(|e| PyValueError::new_err(e.to_string()))
    }

    fn to_xyz_matrix(&self) -> [Triple; 3] {
        self.0.system().to_xyz_rows()
    }

    fn from_xyz_matrix(&self) -> [Triple; 3] {
        self.0.system().from_xyz_rows()
    }

    fn decode<'py>(&self, py: Python<'py>, code: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        each(py, code, |v| self.0.decode(v))
    }

    fn encode<'py>(&self, py: Python<'py>, light: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        each(py, light, |v| self.0.encode(v))
    }

    fn to_xyz<'py>(&self, py: Python<'py>, code: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        each(py, code, |v| self.0.to_xyz(v))
    }

    fn from_xyz<'py>(&self, py: Python<'py>, xyz: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        each(py, xyz, |v| self.0.from_xyz(v))
    }

    fn map_gamut<'py>(
        &self,
        py: Python<'py>,
        light: &Bound<'py, PyAny>,
        method: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let map = GamutMap::new(gamut(method)?, self.0.system());
        each(py, light, |v| map.map(v))
    }

    fn oklab<'py>(&self, py: Python<'py>, light: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let system = self.0.system();
        let oklab = Oklab::new(system.to_xyz([1.0; 3]))
            .ok_or_else(|| PyValueError::new_err("its white has a cone response of zero"))?;
        each(py, light, |v| oklab.from_xyz(system.to_xyz(v)))
    }

    fn apply_tone<'py>(
        &self,
        py: Python<'py>,
        light: &Bound<'py, PyAny>,
        operator: &str,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let tone = tone(operator)?;
        let luminance = self.0.system().to_xyz_rows()[1];
        each(py, light, |v| tone.apply(v, luminance))
    }

    /// Code values from 0 to 1, and what was met.
    #[pyo3(signature = (xyz, *, exposure, reference, tone, gamut))]
    fn develop<'py>(
        &self,
        py: Python<'py>,
        xyz: &Bound<'py, PyAny>,
        exposure: f64,
        reference: f64,
        tone: &str,
        gamut: &str,
    ) -> PyResult<(Bound<'py, PyArray3<f32>>, Bound<'py, PyDict>)> {
        let development = self.development(exposure, reference, tone, gamut)?;
        if xyz.cast::<numpy::PyArrayDyn<f32>>().is_ok() {
            developed::<f32>(py, xyz, &development)
        } else {
            developed::<f64>(py, xyz, &development)
        }
    }

    /// Codes of `bits` bits, and what was met.
    #[pyo3(signature = (xyz, *, exposure, reference, tone, gamut, bits, dither, seed))]
    fn show<'py>(
        &self,
        py: Python<'py>,
        xyz: &Bound<'py, PyAny>,
        exposure: f64,
        reference: f64,
        tone: &str,
        gamut: &str,
        bits: u32,
        dither: &str,
        seed: u64,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
        let development = self.development(exposure, reference, tone, gamut)?;
        let dither = Dither::named(dither).map_err(|e| PyValueError::new_err(e.to_string()))?.with_seed(seed);
        let single = xyz.cast::<numpy::PyArrayDyn<f32>>().is_ok();
        match (single, bits <= 8) {
            (true, true) => shown::<f32, u8>(py, xyz, &development, bits, &dither),
            (true, false) => shown::<f32, u16>(py, xyz, &development, bits, &dither),
            (false, true) => shown::<f64, u8>(py, xyz, &development, bits, &dither),
            (false, false) => shown::<f64, u16>(py, xyz, &development, bits, &dither),
        }
    }
}

fn shown<'py, T: Sample + Element, C: Code + Element>(
    py: Python<'py>,
    xyz: &Bound<'py, PyAny>,
    development: &Development,
    bits: u32,
    dither: &Dither,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
    let array = readable::<T>(xyz)?;
    let (rows, columns) = size(array.shape())?;
    let values = numbers(&array)?;
    let codes = PyArray3::<C>::zeros(py, [rows, columns, 3], false);
    let met = {
        let mut writable = codes.readwrite();
        let codes = writable.as_slice_mut().map_err(|e| PyValueError::new_err(e.to_string()))?;
        py.detach(|| develop_codes(values, columns, development, bits, dither, codes))
            .map_err(|e| PyValueError::new_err(e.to_string()))?
    };
    Ok((codes.into_any(), told(py, met)?))
}

/// Height and width of an image.
fn size(shape: &[usize]) -> PyResult<(usize, usize)> {
    match *shape {
        [rows, columns, 3] => Ok((rows, columns)),
        _ => Err(PyValueError::new_err(format!("an image is an array (height, width, 3), not {shape:?}"))),
    }
}

fn told(py: Python<'_>, met: Met) -> PyResult<Bound<'_, PyDict>> {
    let told = PyDict::new(py);
    told.set_item("negative", met.negative)?;
    told.set_item("above", met.above)?;
    told.set_item("not_finite", met.not_finite)?;
    Ok(told)
}

impl PyDisplay {
    fn development(&self, exposure: f64, reference: f64, tone: &str, gamut: &str) -> PyResult<Development> {
        let (tone, gamut) = (self::tone(tone)?, self::gamut(gamut)?);
        Ok(Development::new(self.0.clone(), exposure, reference, tone, gamut))
    }
}

fn developed<'py, T: Sample + Element>(
    py: Python<'py>,
    xyz: &Bound<'py, PyAny>,
    development: &Development,
) -> PyResult<(Bound<'py, PyArray3<f32>>, Bound<'py, PyDict>)> {
    let array = readable::<T>(xyz)?;
    let (rows, columns) = size(array.shape())?;
    let values = numbers(&array)?;
    let mut codes = vec![0.0f32; values.len()];
    let met = py.detach(|| develop_image(values, columns, development, &mut codes));
    Ok((PyArray1::from_vec(py, codes).reshape([rows, columns, 3])?, told(py, met)?))
}

#[pyfunction]
fn gamut_methods() -> Vec<&'static str> {
    Gamut::names().collect()
}

#[pyfunction]
fn tone_operators() -> Vec<&'static str> {
    Tone::names().collect()
}

#[pyfunction]
#[pyo3(signature = (pixels, *, chromaticities=None, gamma=None, cicp=None, srgb=false, icc=None, significant_bits=None, text=Vec::new()))]
fn encode_png<'py>(
    py: Python<'py>,
    pixels: &Bound<'py, PyAny>,
    chromaticities: Option<[f64; 8]>,
    gamma: Option<f64>,
    cicp: Option<[u8; 4]>,
    srgb: bool,
    icc: Option<(String, Vec<u8>)>,
    significant_bits: Option<u8>,
    text: Vec<(String, String)>,
) -> PyResult<Bound<'py, PyBytes>> {
    let (codes, rows, columns) = if let Ok(array) = pixels.cast::<PyArray3<u8>>() {
        let (rows, columns, _) = array.readonly().as_array().dim();
        (Pixels::Eight(array.readonly().as_array().iter().copied().collect()), rows, columns)
    } else if let Ok(array) = pixels.cast::<PyArray3<u16>>() {
        let (rows, columns, _) = array.readonly().as_array().dim();
        (Pixels::Sixteen(array.readonly().as_array().iter().copied().collect()), rows, columns)
    } else {
        return Err(PyTypeError::new_err("pixels must be an array (h, w, 3) of uint8 or uint16"));
    };
    let chromaticities = chromaticities.map(|c| [[c[0], c[1]], [c[2], c[3]], [c[4], c[5]], [c[6], c[7]]]);
    let tags = PngTags { chromaticities, gamma, cicp, srgb, icc, significant_bits, text };
    let file = py.detach(|| encode(&codes, columns as u32, rows as u32, &tags));
    Ok(PyBytes::new(py, &file.map_err(|e| PyValueError::new_err(e.to_string()))?))
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_class::<PyDisplay>()?;
    m.add_function(wrap_pyfunction!(gamut_methods, m)?)?;
    m.add_function(wrap_pyfunction!(tone_operators, m)?)?;
    m.add_function(wrap_pyfunction!(encode_png, m)?)
}
