//! `color`: RGB systems, conversions and differences over arrays, spectra to XYZ, and spectra for RGB.

use crate::arrays::{check_last_axis, check_same, numbers, numbers_mut, readable, with_type, writable};
use illuminant_color::{
    Adaptation, Conversion, Difference, HslSolid, Interpolation, Lightness, LuvWhite, Matrix, RGB_TO_YIQ,
    RgbSystem, Scale, SpectralWeights, Transfer, Triple, Upsampler, XYZ_TO_AC1C2, YIQ_TO_RGB, convert as run,
    convert_in_place, differences, published, published_names, rgb_system_names,
};
use illuminant_spectrum::{Curve, Outside, SpectralRange};
use numpy::{PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
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
    described(py, &system(name)?)
}

#[pyfunction]
fn rgb_system_of<'py>(
    py: Python<'py>,
    name: &str,
    primaries: [[f64; 2]; 3],
    white: [f64; 2],
    transfer: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let system = RgbSystem::new(name, primaries, white, self::transfer(transfer)?).ok_or_else(|| {
        PyValueError::new_err(format!(
            "primaries {primaries:?} and white {white:?} make no RGB system: the primaries lie on one line, or the \
             white has y = 0 or is a mixture of two of them"
        ))
    })?;
    described(py, &system)
}

fn described<'py>(py: Python<'py>, system: &RgbSystem) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("name", &system.name)?;
    dict.set_item("primaries", system.primaries)?;
    dict.set_item("white", system.white)?;
    dict.set_item("transfer", system.transfer.name())?;
    dict.set_item("to_xyz", system.to_xyz_rows())?;
    dict.set_item("from_xyz", system.from_xyz_rows())?;
    Ok(dict)
}

/// What a name stands for, or the names there are.
fn known<T>(found: Option<T>, what: &str, name: &str, names: &str) -> PyResult<T> {
    found.ok_or_else(|| PyValueError::new_err(format!("no {what} {name:?}; known are {names}")))
}

fn transfer(name: &str) -> PyResult<Transfer> {
    known(
        Transfer::named(name),
        "transfer function",
        name,
        "sRGB, Rec.709, linear, and gamma with its exponent",
    )
}

fn lightness(name: &str) -> PyResult<Lightness> {
    known(Lightness::named(name), "form of lightness", name, "CIE and book")
}

fn solid(name: &str) -> PyResult<HslSolid> {
    known(HslSolid::named(name), "solid of HSL", name, "double hexcone, double cone and cylinder")
}

#[pyfunction]
fn published_matrices() -> Vec<&'static str> {
    published_names().collect()
}

#[pyfunction]
fn published_matrix(name: &str) -> PyResult<[Triple; 3]> {
    let names: Vec<_> = published_names().collect();
    Ok(known(published(name), "printed matrix", name, &names.join(", "))?.0)
}

#[pyfunction]
fn matrix_product(second: [Triple; 3], first: [Triple; 3]) -> [Triple; 3] {
    Matrix(second).after(&Matrix(first)).0
}

#[pyfunction]
fn matrix_inverse(rows: [Triple; 3]) -> PyResult<[Triple; 3]> {
    Matrix(rows).inverse().map(|m| m.0).map_err(|e| PyValueError::new_err(e.to_string()))
}

#[pyfunction]
fn adaptation_matrix(method: &str, white_from: Triple, white_to: Triple) -> PyResult<[Triple; 3]> {
    let names = Adaptation::ALL.map(Adaptation::name).join(", ");
    let method = known(Adaptation::named(method), "chromatic adaptation", method, &names)?;
    let matrix = method.matrix(white_from, white_to).ok_or_else(|| {
        PyValueError::new_err(format!(
            "{} does not lead from white {white_from:?} to {white_to:?}: a cone has no response",
            method.name()
        ))
    })?;
    Ok(matrix.0)
}

/// One step of `convert`.
#[pyclass(name = "Conversion", module = "illuminant._core", frozen)]
struct PyConversion(Conversion);

#[pymethods]
impl PyConversion {
    #[staticmethod]
    fn matrix(rows: [Triple; 3]) -> Self {
        Self(Conversion::Matrix(Matrix(rows)))
    }

    #[staticmethod]
    fn encode(transfer: &str) -> PyResult<Self> {
        Ok(Self(Conversion::Encode(self::transfer(transfer)?)))
    }

    #[staticmethod]
    fn decode(transfer: &str) -> PyResult<Self> {
        Ok(Self(Conversion::Decode(self::transfer(transfer)?)))
    }

    #[staticmethod]
    fn xyz_to_lab(white: Triple, form: &str) -> PyResult<Self> {
        Ok(Self(Conversion::XyzToLab(white, lightness(form)?)))
    }

    #[staticmethod]
    fn lab_to_xyz(white: Triple, form: &str) -> PyResult<Self> {
        Ok(Self(Conversion::LabToXyz(white, lightness(form)?)))
    }

    #[staticmethod]
    fn xyz_to_luv(white: Triple, form: &str) -> PyResult<Self> {
        Ok(Self(Conversion::XyzToLuv(LuvWhite::new(white), lightness(form)?)))
    }

    #[staticmethod]
    fn luv_to_xyz(white: Triple, form: &str) -> PyResult<Self> {
        Ok(Self(Conversion::LuvToXyz(LuvWhite::new(white), lightness(form)?)))
    }

    #[staticmethod]
    fn rgb_to_hsl(solid: &str) -> PyResult<Self> {
        Ok(Self(Conversion::RgbToHsl(self::solid(solid)?)))
    }

    #[staticmethod]
    fn hsl_to_rgb(solid: &str) -> PyResult<Self> {
        Ok(Self(Conversion::HslToRgb(self::solid(solid)?)))
    }

    #[staticmethod]
    fn named(name: &str) -> PyResult<Self> {
        let inverse = |m: Matrix| m.inverse().map_err(|e| PyValueError::new_err(e.to_string()));
        Ok(Self(match name {
            "xyz_to_xyy" => Conversion::XyzToXyy,
            "xyy_to_xyz" => Conversion::XyyToXyz,
            "xyz_to_uvy" => Conversion::XyzToUvy,
            "uvy_to_xyz" => Conversion::UvyToXyz,
            "project" => Conversion::Project,
            "rgb_to_hsv" => Conversion::RgbToHsv,
            "hsv_to_rgb" => Conversion::HsvToRgb,
            "rgb_to_yiq" => Conversion::Matrix(RGB_TO_YIQ),
            "yiq_to_rgb" => Conversion::Matrix(YIQ_TO_RGB),
            "xyz_to_ac1c2" => Conversion::Matrix(XYZ_TO_AC1C2),
            "ac1c2_to_xyz" => Conversion::Matrix(inverse(XYZ_TO_AC1C2)?),
            _ => return Err(PyValueError::new_err(format!("no conversion {name:?}"))),
        }))
    }
}

#[pyfunction]
fn convert(
    py: Python<'_>,
    chain: Vec<Bound<'_, PyConversion>>,
    values: &Bound<'_, PyAny>,
    out: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let chain: Vec<Conversion> = chain.iter().map(|step| step.get().0).collect();
    with_type!(out, T => {
        let mut to = writable_or_input::<T>(values, out)?;
        check_last_axis(to.out.shape(), 3)?;
        let from = to.input.as_ref().map(|input| {
            check_same(input.shape(), to.out.shape())?;
            numbers(input)
        }).transpose()?;
        let to = numbers_mut(&mut to.out)?;
        py.detach(|| match from {
            Some(from) => run(&chain, from, to),
            None => convert_in_place(&chain, to),
        });
        Ok(())
    })
}

/// An output, and the input unless it is the same array.
struct Ends<'py, T: numpy::Element> {
    input: Option<numpy::PyReadonlyArrayDyn<'py, T>>,
    out: numpy::PyReadwriteArrayDyn<'py, T>,
}

fn writable_or_input<'py, T: numpy::Element>(
    values: &Bound<'py, PyAny>,
    out: &Bound<'py, PyAny>,
) -> PyResult<Ends<'py, T>> {
    let input = if values.is(out) { None } else { Some(readable(values)?) };
    Ok(Ends { input, out: writable(out)? })
}

#[pyfunction]
fn difference(
    py: Python<'_>,
    formula: &str,
    first: &Bound<'_, PyAny>,
    second: &Bound<'_, PyAny>,
    out: &Bound<'_, PyAny>,
) -> PyResult<()> {
    let names = "1976, 1994 graphic arts, 1994 textiles and 2000";
    let formula = known(Difference::named(formula), "formula of difference", formula, names)?;
    with_type!(out, T => {
        let (first, second) = (readable::<T>(first)?, readable::<T>(second)?);
        let mut out = writable::<T>(out)?;
        for colours in [&first, &second] {
            check_last_axis(colours.shape(), 3)?;
            if colours.len() != 3 {
                check_same(&colours.shape()[..colours.ndim() - 1], out.shape())?;
            }
        }
        let (first, second) = (numbers(&first)?, numbers(&second)?);
        let out = numbers_mut(&mut out)?;
        py.detach(|| differences(formula, first, second, out));
        Ok(())
    })
}

#[pyfunction]
fn xyz_to_lab<'py>(
    py: Python<'py>,
    xyz: numpy::PyReadonlyArrayDyn<'py, f64>,
    white: Triple,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    check_last_axis(xyz.shape(), 3)?;
    let out = PyArrayDyn::<f64>::zeros(py, xyz.shape(), false);
    let chain = [Conversion::XyzToLab(white, Lightness::Cie)];
    let values: Vec<f64> = xyz.as_array().iter().copied().collect(); // in the order of C
    run(&chain, &values, numbers_mut(&mut out.readwrite())?);
    Ok(out)
}

#[pyfunction]
fn delta_e_2000<'py>(
    py: Python<'py>,
    lab_a: numpy::PyReadonlyArrayDyn<'py, f64>,
    lab_b: numpy::PyReadonlyArrayDyn<'py, f64>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
    check_last_axis(lab_a.shape(), 3)?;
    check_same(lab_a.shape(), lab_b.shape())?;
    let out = PyArrayDyn::<f64>::zeros(py, &lab_a.shape()[..lab_a.ndim() - 1], false);
    let [a, b] = [lab_a, lab_b].map(|lab| lab.as_array().iter().copied().collect::<Vec<f64>>());
    differences(Difference::Cie2000, &a, &b, numbers_mut(&mut out.readwrite())?);
    Ok(out)
}

/// Weights from the bands of a spectrum to XYZ.
#[pyclass(name = "SpectralWeights", module = "illuminant._core", frozen)]
struct PySpectralWeights(SpectralWeights);

#[pymethods]
impl PySpectralWeights {
    #[new]
    #[pyo3(signature = (bands_nm, observer, illuminant, range_nm, outside, interpolation, scale))]
    fn new(
        bands_nm: Vec<f64>,
        observer: (Vec<f64>, PyReadonlyArray2<'_, f64>),
        illuminant: Option<crate::spectrum::Given>,
        range_nm: [f64; 2],
        outside: &str,
        interpolation: &str,
        scale: &str,
    ) -> PyResult<Self> {
        let message = |e: &dyn std::fmt::Display| PyValueError::new_err(e.to_string());
        let curve = |wavelengths: &[f64], values: Vec<f64>, outside: &str| {
            crate::spectrum::curve(wavelengths.to_vec(), values, outside)
        };
        let (wavelengths, table) = observer;
        check_last_axis(table.shape(), 3)?;
        let table = table.as_array();
        let matching = |c: usize| curve(&wavelengths, table.column(c).to_vec(), "zero");
        let matching = [matching(0)?, matching(1)?, matching(2)?];
        let lamp = illuminant.map(|(w, v, outside)| curve(&w, v, &outside)).transpose()?;
        let range = SpectralRange::try_from(range_nm).map_err(|e| message(&e))?;
        let outside = match outside {
            "zero" => Outside::Zero,
            "hold" => Outside::Hold,
            other => return known(None, "rule outside", other, "zero and hold"),
        };
        let interpolation = match interpolation {
            "linear" => Interpolation::Linear,
            "none" => Interpolation::Bands,
            other => return known(None, "interpolation", other, "linear and none"),
        };
        let scale = match scale {
            "relative" => Scale::Relative,
            "absolute" => Scale::Absolute,
            other => return known(None, "scale", other, "relative and absolute"),
        };
        SpectralWeights::new(&bands_nm, &matching, lamp.as_ref(), range, outside, interpolation, scale)
            .map(Self)
            .map_err(|e| message(&e))
    }

    #[getter]
    fn rows(&self) -> [Vec<f64>; 3] {
        self.0.rows().clone()
    }

    fn xyz(&self, py: Python<'_>, spectra: &Bound<'_, PyAny>, out: &Bound<'_, PyAny>) -> PyResult<()> {
        with_type!(out, T => {
            let spectra = readable::<T>(spectra)?;
            let mut out = writable::<T>(out)?;
            check_last_axis(spectra.shape(), self.0.bands())?;
            check_last_axis(out.shape(), 3)?;
            check_same(&spectra.shape()[..spectra.ndim() - 1], &out.shape()[..out.ndim() - 1])?;
            let (spectra, out) = (numbers(&spectra)?, numbers_mut(&mut out)?);
            py.detach(|| self.0.xyz(spectra, out));
            Ok(())
        })
    }
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
    m.add_class::<PyConversion>()?;
    m.add_class::<PySpectralWeights>()?;
    m.add_function(wrap_pyfunction!(rgb_systems, m)?)?;
    m.add_function(wrap_pyfunction!(rgb_system, m)?)?;
    m.add_function(wrap_pyfunction!(rgb_system_of, m)?)?;
    m.add_function(wrap_pyfunction!(published_matrices, m)?)?;
    m.add_function(wrap_pyfunction!(published_matrix, m)?)?;
    m.add_function(wrap_pyfunction!(matrix_product, m)?)?;
    m.add_function(wrap_pyfunction!(matrix_inverse, m)?)?;
    m.add_function(wrap_pyfunction!(adaptation_matrix, m)?)?;
    m.add_function(wrap_pyfunction!(convert, m)?)?;
    m.add_function(wrap_pyfunction!(difference, m)?)?;
    m.add_function(wrap_pyfunction!(xyz_to_lab, m)?)?;
    m.add_function(wrap_pyfunction!(delta_e_2000, m)?)?;
    m.add_function(wrap_pyfunction!(upsample_albedo, m)?)?;
    m.add_function(wrap_pyfunction!(upsample_emission, m)?)
}
