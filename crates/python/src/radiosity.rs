//! `radiosity`: solutions of the light between surfaces.

use crate::scene::PyScene;
use crate::technique::{settings, shaped};
use crate::waiting::interruptible;
use glam::Vec3;
use illuminant_radiosity::{Cancel, Sparse, SpectralRows};
use illuminant_technique::{Given, RadiosityParts, RadiositySolution, RowFinder, basis, pool};
use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// A solution.
#[pyclass(name = "Solution", frozen, module = "illuminant._core")]
pub(crate) struct PySolution(pub(crate) Arc<RadiositySolution>);

/// Tells a solution under way that nobody waits for it any more; from any thread.
#[pyclass(name = "Cancel", frozen, module = "illuminant._core")]
pub(crate) struct PyCancel(Cancel);

#[pymethods]
impl PyCancel {
    #[new]
    fn new() -> Self {
        Self(Cancel::default())
    }

    /// Asks the work to stop.
    fn cancel(&self) {
        self.0.cancel();
    }

    /// Whether it was asked to.
    #[getter]
    fn cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

pyo3::create_exception!(_core, Cancelled, pyo3::exceptions::PyException, "A solution was cancelled.");

fn flag(cancel: Option<&PyCancel>) -> Cancel {
    cancel.map(|cancel| cancel.0.clone()).unwrap_or_default()
}

/// A result, or why there is none; what was cancelled has an exception of its own.
fn unless<T>(cancel: &Cancel, result: Result<T, String>) -> PyResult<T> {
    result.map_err(|e| if cancel.is_cancelled() { Cancelled::new_err(e) } else { wrong(e) })
}

/// What finds rows of form factors, for work that is shared out.
#[pyclass(name = "RowFinder", frozen, module = "illuminant._core")]
pub(crate) struct PyRowFinder(RowFinder);

#[pymethods]
impl PyRowFinder {
    #[new]
    fn new(py: Python<'_>, scene: &PyScene, settings: &str) -> PyResult<Self> {
        let (settings, scene) = (self::settings(settings)?, Arc::clone(&scene.0));
        let cancel = Cancel::default();
        interruptible(py, &cancel, || RowFinder::new(scene, &settings, &cancel))?.map(Self).map_err(wrong)
    }

    /// How many rows there are.
    fn __len__(&self) -> usize {
        self.0.sides()
    }

    /// How long rows are.
    #[getter]
    fn width(&self) -> usize {
        self.0.width()
    }

    /// Rows first..last: where each begins, columns, and values.
    #[expect(clippy::type_complexity, reason = "a tuple of arrays is what Python takes")]
    fn find<'py>(
        &self,
        py: Python<'py>,
        first: usize,
        last: usize,
    ) -> PyResult<(Bound<'py, PyArray1<u64>>, Bound<'py, PyArray1<u32>>, Bound<'py, PyArray1<f32>>)> {
        let cancel = Cancel::default();
        let rows = interruptible(py, &cancel, || self.0.find(first..last, &cancel))?;
        Ok((
            PyArray1::from_iter(py, rows.starts.iter().map(|v| *v as u64)),
            rows.columns.to_pyarray(py),
            rows.values.to_pyarray(py),
        ))
    }
}

fn wrong(error: impl ToString) -> PyErr {
    PyValueError::new_err(error.to_string())
}

fn solved(result: Result<RadiositySolution, String>) -> PyResult<PySolution> {
    result.map(|solution| PySolution(Arc::new(solution))).map_err(wrong)
}

impl From<RadiositySolution> for PySolution {
    fn from(solution: RadiositySolution) -> Self {
        Self(Arc::new(solution))
    }
}

fn item<'py, T: for<'a> FromPyObject<'a, 'py>>(dict: &Bound<'py, PyDict>, key: &str) -> PyResult<T> {
    let value = dict.get_item(key)?.ok_or_else(|| wrong(format!("the solution has no {key:?}")))?;
    value.extract().map_err(|_| wrong(format!("{key:?} of the solution has the wrong type")))
}

fn flat(dict: &Bound<'_, PyDict>, key: &str) -> PyResult<Vec<f32>> {
    Ok(item::<PyReadonlyArray1<'_, f32>>(dict, key)?.as_array().to_vec())
}

/// The weight below which sensors follow a ray no more.
const THRESHOLD: f32 = 0.002;
const DAMAGED: &str = "the form factors of the solution are damaged";

/// Where rows of form factors begin, and their columns.
fn layout(dict: &Bound<'_, PyDict>, prefix: &str, width: usize) -> PyResult<(Vec<usize>, Vec<u32>)> {
    let starts = item::<PyReadonlyArray1<'_, u64>>(dict, &format!("{prefix}starts"))?;
    let starts: Vec<usize> = starts.as_array().iter().map(|v| *v as usize).collect();
    let columns = item::<PyReadonlyArray1<'_, u32>>(dict, &format!("{prefix}columns"))?.as_array().to_vec();
    let rising = starts.windows(2).all(|w| w[0] <= w[1]) && starts.first() == Some(&0);
    if !rising || starts.last() != Some(&columns.len()) || columns.iter().any(|&c| c as usize >= width) {
        return Err(wrong(DAMAGED));
    }
    Ok((starts, columns))
}

fn threes(values: Vec<[f64; 3]>) -> PyResult<Array2<f64>> {
    shaped(Array2::from_shape_vec((values.len(), 3), values.into_iter().flatten().collect()))
}

impl PySolution {
    /// Refuses what needs irradiance where there is none.
    fn irradiance(&self) -> PyResult<()> {
        if self.0.is_directional() {
            return Err(wrong(
                "specular-radiosity keeps radiance and no irradiance: it can be rendered, and nothing else",
            ));
        }
        Ok(())
    }
}

#[pymethods]
impl PySolution {
    /// Solves for the light between the surfaces of a scene; `rows` are all rows of form factors (`starts`, `columns`, `values`, `width`), if
    /// they are known.
    #[new]
    #[pyo3(signature = (scene, settings, cancel=None, rows=None))]
    fn new(
        py: Python<'_>,
        scene: &PyScene,
        settings: &str,
        cancel: Option<&PyCancel>,
        rows: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let (settings, scene) = (self::settings(settings)?, Arc::clone(&scene.0));
        let given = match rows {
            None => Given::Nothing,
            Some(rows) => {
                let width: usize = item(rows, "width")?;
                let (starts, columns) = layout(rows, "", width)?;
                let values = flat(rows, "values")?;
                if columns.len() != values.len() {
                    return Err(wrong(DAMAGED));
                }
                Given::Rows(Sparse { starts, columns, values, width })
            }
        };
        let cancel = flag(cancel);
        let pool = pool(settings.threads).map_err(wrong)?;
        let found = interruptible(py, &cancel, || {
            pool.install(|| {
                let basis = basis(&scene, &settings, &cancel).map_err(|e| e.to_string())?;
                RadiositySolution::new_unless_cancelled(&scene, &settings, basis, given, &cancel)
            })
        })?;
        unless(&cancel, found).map(Self::from)
    }

    /// A solution from what `parts` gave, for the scene that it was made for; `fitted_to` is the scene to which its samples were fitted.
    #[staticmethod]
    fn restored(
        py: Python<'_>,
        scene: &PyScene,
        settings: &str,
        fitted_to: &PyScene,
        parts: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let settings = self::settings(settings)?;
        let width: usize = item(parts, "width")?;
        let (starts, columns) = layout(parts, "", width)?;
        let values = flat(parts, "values")?;
        let specular = if parts.contains("specular_starts")? {
            let (starts, columns) = layout(parts, "specular_", width)?;
            let values = flat(parts, "specular_values")?;
            let samples = values.len() / columns.len().max(1);
            if samples * columns.len() != values.len() {
                return Err(wrong(DAMAGED));
            }
            Some(SpectralRows { starts, columns, values, samples })
        } else {
            None
        };
        if columns.len() != values.len() {
            return Err(wrong(DAMAGED));
        }
        let parts = RadiosityParts {
            rows: Sparse { starts, columns, values, width },
            specular,
            caustics: flat(parts, "caustics")?,
            transmittance: flat(parts, "transmittance")?,
            direct: flat(parts, "direct")?,
            irradiance: flat(parts, "irradiance")?,
            reflectance: flat(parts, "reflectance")?,
        };
        let (scene, fitted_to) = (Arc::clone(&scene.0), Arc::clone(&fitted_to.0));
        py.detach(|| {
            let basis = basis(&fitted_to, &settings, &Cancel::default()).map_err(wrong)?;
            solved(RadiositySolution::restored(&scene, &settings, basis, parts))
        })
    }

    /// What of it cannot be found again without much work.
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.irradiance()?;
        let dict = PyDict::new(py);
        let rows = &self.0.factors.rows;
        dict.set_item("starts", PyArray1::from_iter(py, rows.starts.iter().map(|v| *v as u64)))?;
        dict.set_item("columns", rows.columns.to_pyarray(py))?;
        dict.set_item("values", rows.values.to_pyarray(py))?;
        dict.set_item("width", rows.width)?;
        dict.set_item("direct", self.0.direct.to_pyarray(py))?;
        dict.set_item("irradiance", self.0.irradiance.to_pyarray(py))?;
        dict.set_item("reflectance", self.0.reflectance.to_pyarray(py))?;
        dict.set_item("caustics", self.0.caustics.to_pyarray(py))?;
        dict.set_item("transmittance", self.0.transmittance.to_pyarray(py))?;
        if let Some(rows) = &self.0.specular {
            let starts = rows.starts.iter().map(|v| *v as u64);
            dict.set_item("specular_starts", PyArray1::from_iter(py, starts))?;
            dict.set_item("specular_columns", rows.columns.to_pyarray(py))?;
            dict.set_item("specular_values", rows.values.to_pyarray(py))?;
        }
        Ok(dict)
    }

    /// The solution of the same surfaces with the materials of another scene.
    #[pyo3(signature = (scene, settings, cancel=None))]
    fn repainted(
        &self,
        py: Python<'_>,
        scene: &PyScene,
        settings: &str,
        cancel: Option<&PyCancel>,
    ) -> PyResult<Self> {
        self.irradiance()?;
        let (settings, scene, cancel) = (self::settings(settings)?, Arc::clone(&scene.0), flag(cancel));
        let found =
            interruptible(py, &cancel, || self.0.repainted_unless_cancelled(&scene, &settings, &cancel))?;
        unless(&cancel, found).map(Self::from)
    }

    /// The solution after these objects have moved, and how many rows of form factors were found again.
    #[pyo3(signature = (scene, settings, objects, cancel=None))]
    fn moved(
        &self,
        py: Python<'_>,
        scene: &PyScene,
        settings: &str,
        objects: Vec<usize>,
        cancel: Option<&PyCancel>,
    ) -> PyResult<(Self, usize)> {
        self.irradiance()?;
        let (settings, scene, cancel) = (self::settings(settings)?, Arc::clone(&scene.0), flag(cancel));
        let found = interruptible(py, &cancel, || {
            self.0.moved_unless_cancelled(&scene, &settings, &objects, &cancel)
        })?;
        unless(&cancel, found).map(|(found, rows)| (found.into(), rows))
    }

    /// XYZ of the irradiance at points with unit normals, (n, 3); Y in lx.
    fn illuminance<'py>(
        &self,
        py: Python<'py>,
        scene: &PyScene,
        points: PyReadonlyArray2<'_, f64>,
        normals: PyReadonlyArray2<'_, f64>,
        samples: u32,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.irradiance()?;
        let vectors = |array: &PyReadonlyArray2<'_, f64>| -> PyResult<Vec<Vec3>> {
            let view = array.as_array();
            if view.ncols() != 3 {
                return Err(wrong(format!("expected 3 columns, not {}", view.ncols())));
            }
            Ok(view.rows().into_iter().map(|r| Vec3::new(r[0] as f32, r[1] as f32, r[2] as f32)).collect())
        };
        let (points, normals) = (vectors(&points)?, vectors(&normals)?);
        if points.len() != normals.len() {
            return Err(wrong(format!("{} points and {} normals", points.len(), normals.len())));
        }
        let places: Vec<[Vec3; 2]> =
            points.into_iter().zip(normals).map(|(p, n)| [p, n.normalize_or(Vec3::Z)]).collect();
        let scene = Arc::clone(&scene.0);
        let found = py.detach(|| self.0.illuminance(&scene, &places, (samples, THRESHOLD)));
        Ok(threes(found)?.to_pyarray(py))
    }

    /// The elements as a mesh: `positions` and `normals` of its points; for each side that light reaches `faces` (three points),
    /// `objects`, `areas`, `patches`; and `xyz`, what points send as front and as back of the surface, (2, points, 3).
    fn mesh<'py>(&self, py: Python<'py>, scene: &PyScene) -> PyResult<Bound<'py, PyDict>> {
        self.irradiance()?;
        let (solution, scene) = (&self.0, Arc::clone(&scene.0));
        let elements = &solution.elements;
        let sent = py.detach(|| solution.radiance_of_sides(&scene));
        let flat: Vec<f32> = sent.iter().flatten().map(|v| *v as f32).collect();
        let mut xyz = Vec::new();
        for back in [false, true] {
            let of = |element| {
                let side = elements.side(element, back)? as usize;
                Some(&flat[3 * side..3 * side + 3])
            };
            xyz.extend(solution.points.values(3, &of));
        }
        let points = solution.points.positions.len();
        let three = |values: &[Vec3]| {
            let flat = values.iter().flat_map(|v| v.to_array()).collect();
            shaped(Array2::from_shape_vec((values.len(), 3), flat))
        };
        let sides = elements.sides.len();
        let faces: Vec<u32> = elements
            .sides
            .iter()
            .flat_map(|side| {
                let [a, b, c] = solution.points.of_element[side.element as usize];
                if side.back { [a, c, b] } else { [a, b, c] }
            })
            .collect();
        let dict = PyDict::new(py);
        dict.set_item("positions", three(&solution.points.positions)?.to_pyarray(py))?;
        dict.set_item("normals", three(&solution.points.normals)?.to_pyarray(py))?;
        dict.set_item("faces", shaped(Array2::from_shape_vec((sides, 3), faces))?.to_pyarray(py))?;
        dict.set_item("back", PyArray1::from_iter(py, elements.sides.iter().map(|side| side.back)))?;
        let of = |side: usize| elements.element_of(side as u32);
        dict.set_item("objects", PyArray1::from_iter(py, (0..sides).map(|s| of(s).object)))?;
        dict.set_item("areas", PyArray1::from_iter(py, (0..sides).map(|s| of(s).area)))?;
        dict.set_item("patches", elements.patch_of.to_pyarray(py))?;
        dict.set_item("sent", threes(sent)?.to_pyarray(py))?;
        let xyz = numpy::ndarray::Array3::from_shape_vec((2, points, 3), xyz);
        dict.set_item("xyz", shaped(xyz)?.to_pyarray(py))?;
        Ok(dict)
    }

    /// How it came about.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let report = &self.0.report;
        let dict = PyDict::new(py);
        dict.set_item("elements", report.elements)?;
        dict.set_item("sides", report.sides)?;
        dict.set_item("patches", report.patches)?;
        dict.set_item("form_factors", report.factors)?;
        dict.set_item("closure_mean", report.closure[0])?;
        dict.set_item("closure_worst", report.closure[1])?;
        dict.set_item("reciprocity", report.reciprocity)?;
        dict.set_item("imbalance", report.imbalance)?;
        dict.set_item("creation", report.creation)?;
        dict.set_item("history", report.history.clone())?;
        dict.set_item("seconds_cutting", report.seconds[0])?;
        dict.set_item("seconds_direct", report.seconds[1])?;
        dict.set_item("seconds_form_factors", report.seconds[2])?;
        dict.set_item("seconds_solving", report.seconds[3])?;
        dict.set_item("memory", self.0.memory())?;
        dict.set_item("per_lamp", self.0.per_unit)?;
        Ok(dict)
    }
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add("Cancelled", m.py().get_type::<Cancelled>())?;
    m.add_class::<PyCancel>()?;
    m.add_class::<PyRowFinder>()?;
    m.add_class::<PySolution>()
}
