//! `technique`: renders.

use crate::radiosity::PySolution;
use crate::scene::PyScene;
use crate::waiting::{interruptible, watched};
use illuminant_illumination::Illumination;
use illuminant_radiosity::Cancel;
use illuminant_sampling::Role;
use illuminant_technique::pairs::{Pair, pair};
use illuminant_technique::{
    Part, Progress, Render, RenderError, Settings, Share, Technique, Vertex, reflectances,
};
use numpy::ndarray::{Array2, Array3};
use numpy::{PyArray1, PyArray2, PyArray3, ToPyArray};
use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::sync::Arc;

/// Ranges of samples, in order.
type Ranges = Vec<(u64, u64)>;

/// Name, spectrum and samples of a lamp.
type LampSpectrum<'py> = (String, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// A render under way.
#[pyclass(name = "Render", module = "illuminant._core")]
pub(crate) struct PyRender(Render);

/// Settings from JSON; a mistake names its key.
pub(crate) fn settings(json: &str) -> PyResult<Settings> {
    let mut reader = serde_json::Deserializer::from_str(json);
    serde_path_to_error::deserialize(&mut reader)
        .map_err(|e| PyValueError::new_err(format!("{}: {}", e.path(), e.inner())))
}

pub(crate) fn shaped<T>(result: Result<T, numpy::ndarray::ShapeError>) -> PyResult<T> {
    result.map_err(|e| PyMemoryError::new_err(e.to_string()))
}

fn vertex<'py>(py: Python<'py>, render: &Render, vertex: &Vertex) -> PyResult<Bound<'py, PyDict>> {
    let object = &render.scene().objects[vertex.object as usize];
    let dict = PyDict::new(py);
    dict.set_item("object", &object.name)?;
    dict.set_item("material", &render.scene().materials[object.material].name)?;
    dict.set_item("primitive", vertex.primitive)?;
    dict.set_item("position", vertex.position.to_array())?;
    dict.set_item("throughput", vertex.throughput.clone())?;
    dict.set_item("added", vertex.added.clone())?;
    Ok(dict)
}

#[pymethods]
impl PyRender {
    #[new]
    #[pyo3(signature = (scene, settings, solution=None))]
    fn new(py: Python<'_>, scene: &PyScene, settings: &str, solution: Option<&PySolution>) -> PyResult<Self> {
        let settings = self::settings(settings)?;
        let scene = Arc::clone(&scene.0);
        let solution = solution.map(|solution| Arc::clone(&solution.0));
        let cancel = Cancel::default();
        let render =
            interruptible(py, &cancel, || Render::unless_cancelled(scene, settings, solution, &cancel))?;
        Ok(Self(render.map_err(|e: RenderError| PyValueError::new_err(e.to_string()))?))
    }

    /// A render of a scene that differs in its camera, or by other settings, in the same wavelengths.
    #[pyo3(signature = (scene, settings, solution=None))]
    fn again(
        &self,
        py: Python<'_>,
        scene: &PyScene,
        settings: &str,
        solution: Option<&PySolution>,
    ) -> PyResult<Self> {
        let settings = self::settings(settings)?;
        let scene = Arc::clone(&scene.0);
        let solution = solution.map(|solution| Arc::clone(&solution.0));
        let render = py.detach(|| self.0.again(scene, settings, solution));
        Ok(Self(render.map_err(|e: RenderError| PyValueError::new_err(e.to_string()))?))
    }

    /// Renders samples first..last of every pixel; `progress(fraction)` is called about ten times a second on this
    /// thread, and may return False to cancel, as may Ctrl-C (which is raised). True when complete. Of `tiles`, first and
    /// last, only; and without the paths from lamps, if so told.
    #[pyo3(signature = (first, last, progress=None, *, tiles=None, from_lamps=true))]
    fn run(
        &mut self,
        py: Python<'_>,
        first: u64,
        last: u64,
        progress: Option<Bound<'_, PyAny>>,
        tiles: Option<(usize, usize)>,
        from_lamps: bool,
    ) -> PyResult<bool> {
        if last < first {
            return Err(PyValueError::new_err(format!(
                "samples run from {first} to {last}, which is backwards"
            )));
        }
        let share = Share { samples: first..last, tiles: tiles.map(|(first, last)| first..last), from_lamps };
        let shared = Progress::default();
        let render = &mut self.0;
        let goes_on = || match &progress {
            Some(callback) => {
                Ok(!callback.call1((shared.fraction(),))?.is(pyo3::types::PyBool::new(py, false)))
            }
            None => Ok(true),
        };
        watched(py, &|| shared.cancel(), goes_on, || render.run(share, &shared))
    }

    /// The number of tiles, and x₀, y₀, x₁, y₁ of each.
    fn tiles(&self) -> Vec<[u32; 4]> {
        self.0.film().tiles.iter().map(|tile| tile.area).collect()
    }

    /// The samples that each tile holds, as ranges in order; and those of which the paths from lamps have been followed.
    fn seen(&self) -> (Vec<Ranges>, Ranges) {
        let of = |tile: &illuminant_technique::TileFilm| {
            tile.seen().iter().map(|range| (range.start, range.end)).collect::<Vec<_>>()
        };
        let film = self.0.film();
        (film.tiles.iter().map(of).collect(), film.from_lamps.as_ref().map(of).unwrap_or_default())
    }

    /// What the film holds, as bytes for `join`.
    fn part<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = py.detach(|| self.0.part());
        Ok(PyBytes::new(py, &bytes.map_err(|e| PyValueError::new_err(e.to_string()))?))
    }

    /// Adds what another render of the same scene with the same settings has found.
    fn join(&mut self, py: Python<'_>, part: &[u8]) -> PyResult<()> {
        let render = &mut self.0;
        let joined = py.detach(|| Part::from_bytes(part).and_then(|part| render.join(part)));
        joined.map_err(|e| PyValueError::new_err(e.to_string()))
    }

    /// Forgets all samples.
    fn clear(&mut self) {
        self.0.clear();
    }

    /// The error of the spectral sampling in this scene: ΔE00 against 1 nm.
    fn spectral_error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let cancel = Cancel::default();
        let found = interruptible(py, &cancel, || self.0.spectral_error(&cancel))?;
        let scene = self.0.scene();
        let dict = PyDict::new(py);
        dict.set_item("mean", found.mean)?;
        dict.set_item("p95", found.p95)?;
        dict.set_item("max", found.max)?;
        dict.set_item("judged", found.judged)?;
        dict.set_item("lamp", scene.lamps.get(found.lamp).map(|l| l.name.clone()))?;
        let names: Vec<_> = found.materials.iter().map(|&m| scene.materials[m].name.clone()).collect();
        dict.set_item("material", (!names.is_empty()).then(|| names.join(" × ")))?;
        Ok(dict)
    }

    /// The light between surfaces, if the technique has solved for it.
    fn solution(&self) -> Option<PySolution> {
        self.0.solution().map(|solution| PySolution(Arc::clone(solution)))
    }

    /// Sentences on what the user should know before rendering.
    fn warnings(&self) -> Vec<String> {
        self.0.warnings()
    }

    /// The names of the layers.
    fn layers(&self) -> Vec<String> {
        let kept = |name: &&illuminant_technique::LayerPlan| name.name != "halves";
        self.0.film().plan.iter().filter(kept).map(|plan| plan.name.clone()).collect()
    }

    /// The mean of a layer, (h, w, channels).
    fn layer<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let (values, channels) = self.0.film().layer(name).ok_or_else(|| {
            PyValueError::new_err(format!("no layer {name:?}; there are {}", self.layers().join(", ")))
        })?;
        let [w, h] = self.0.film().size();
        Ok(shaped(Array3::from_shape_vec((h, w, channels), values))?.to_pyarray(py))
    }

    /// Samples that each pixel holds, (h, w).
    fn samples<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<u32>>> {
        let [w, h] = self.0.film().size();
        Ok(shaped(Array2::from_shape_vec((h, w), self.0.film().samples()))?.to_pyarray(py))
    }

    /// Standard error of Y, (h, w); needs replicates = 2.
    fn standard_error<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let values = self.0.film().standard_error();
        let values = values.ok_or_else(|| PyValueError::new_err("the error needs replicates = 2"))?;
        let [w, h] = self.0.film().size();
        Ok(shaped(Array2::from_shape_vec((h, w), values))?.to_pyarray(py))
    }

    /// What has been done so far.
    fn statistics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let statistics = self.0.statistics();
        let dict = PyDict::new(py);
        dict.set_item("seconds", statistics.elapsed.as_secs_f64())?;
        dict.set_item("samples", statistics.samples)?;
        dict.set_item("spans", statistics.spans)?;
        dict.set_item("pruned", statistics.pruned)?;
        dict.set_item("rays", statistics.closest + statistics.occlusion)?;
        dict.set_item("closest", statistics.closest)?;
        dict.set_item("occlusion", statistics.occlusion)?;
        dict.set_item("dropped", statistics.dropped)?;
        let details = statistics.details.iter().map(|dropped| {
            let dict = PyDict::new(py);
            dict.set_item("pixel", dropped.pixel)?;
            dict.set_item("sample", dropped.sample)?;
            dict.set_item("object", &dropped.object)?;
            dict.set_item("material", &dropped.material)?;
            Ok(dict)
        });
        dict.set_item("dropped_samples", details.collect::<PyResult<Vec<_>>>()?)?;
        Ok(dict)
    }

    /// The wavelength that stands for each spectral sample, nm.
    fn wavelengths<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let basis = self.0.basis();
        PyArray1::from_iter(py, (0..basis.len()).map(|i| basis.wavelength_nm(i)))
    }

    /// The map from spectral samples to XYZ for light of a lamp, (3, N).
    #[pyo3(signature = (lamp=0))]
    fn to_xyz<'py>(&self, py: Python<'py>, lamp: usize) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let lamps = self.0.scene().lamps.len();
        if lamp >= lamps {
            return Err(PyValueError::new_err(format!(
                "lamps are numbered from 0 to {}, not {lamp}",
                lamps - 1
            )));
        }
        let rows = self.0.basis().to_xyz(lamp);
        let flat: Vec<f64> = rows.iter().flatten().copied().collect();
        Ok(shaped(Array2::from_shape_vec((3, flat.len() / 3), flat))?.to_pyarray(py))
    }

    /// Each lamp: its name, its spectrum at each nm of the scene's range, and its light in the spectral samples.
    fn lamp_spectra<'py>(&self, py: Python<'py>) -> Vec<LampSpectrum<'py>> {
        let scene = self.0.scene();
        let of = |lamp: &illuminant_scene::Lamp| {
            let samples = self.0.basis().reduce(&lamp.spectrum, Role::Emission);
            let every_nm = lamp.spectrum.tabulate(scene.range);
            (lamp.name.clone(), PyArray1::from_vec(py, every_nm), PyArray1::from_vec(py, samples))
        };
        scene.lamps.iter().map(of).collect()
    }

    /// The reflectances of what stands in the scene at each nm of its range: each once, and none that changes no colour.
    fn reflectances<'py>(&self, py: Python<'py>) -> Vec<Bound<'py, PyArray1<f64>>> {
        let scene = self.0.scene();
        let tables = reflectances(scene).into_iter().map(|curve| curve.tabulate(scene.range));
        tables.map(|table| PyArray1::from_vec(py, table)).collect()
    }

    /// The queries of these samples again, without shading: their number and the seconds they take.
    fn ray_rate<'py>(&self, py: Python<'py>, first: u64, last: u64) -> PyResult<Bound<'py, PyDict>> {
        let (rays, elapsed) = py.detach(|| self.0.ray_rate(first..last));
        let dict = PyDict::new(py);
        dict.set_item("rays", rays)?;
        dict.set_item("seconds", elapsed.as_secs_f64())?;
        Ok(dict)
    }

    /// The vertices of the path of one sample of one pixel, pass by pass, and what it brought.
    fn replay<'py>(&self, py: Python<'py>, x: u32, y: u32, sample: u64) -> PyResult<Bound<'py, PyDict>> {
        let [x0, y0, x1, y1] = self.0.film().crop;
        if !((x0..x1).contains(&x) && (y0..y1).contains(&y)) {
            return Err(PyValueError::new_err(format!(
                "pixel {x},{y} lies outside the image, whose pixels run from {x0},{y0} to {},{}",
                x1 - 1,
                y1 - 1
            )));
        }
        let replay = py.detach(|| self.0.replay([x, y], sample));
        let passes = replay
            .passes
            .iter()
            .map(|vertices| vertices.iter().map(|v| vertex(py, &self.0, v)).collect::<PyResult<Vec<_>>>());
        let dict = PyDict::new(py);
        dict.set_item("passes", passes.collect::<PyResult<Vec<_>>>()?)?;
        dict.set_item("xyz", replay.xyz)?;
        dict.set_item("spectrum", replay.spectrum)?;
        Ok(dict)
    }
}

/// Every technique with every illumination model: names, verdict, reason.
#[pyfunction]
fn pairs() -> Vec<(String, String, &'static str, &'static str)> {
    let mut all = Vec::new();
    for &technique in Technique::ALL {
        for &illumination in Illumination::ALL {
            let (verdict, reason) = match pair(technique, illumination) {
                Pair::Sensible(reason) => ("sensible", reason),
                Pair::Warned(reason) => ("warned", reason),
                Pair::Refused(reason) => ("refused", reason),
            };
            all.push((technique.to_string(), illumination.to_string(), verdict, reason));
        }
    }
    all
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(pairs, m)?)?;
    m.add_class::<PyRender>()
}
