//! `scene`: geometry, scenes and the ray library.

use glam::{Affine3A, Mat3, Vec2, Vec3};
use illuminant_scene::description::Description;
use illuminant_scene::{Geometry, GeometryError, ImageData, Mesh, Motion, Placement, Scene, Shape, embree};
use numpy::{PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

#[pyfunction]
fn load_embree(path: PathBuf) -> PyResult<String> {
    embree::load(&path).map_err(|e| PyRuntimeError::new_err(e.to_string()))
}

fn geometry_error(error: GeometryError) -> PyErr {
    match error {
        GeometryError::Embree(e) => PyRuntimeError::new_err(e.to_string()),
        other => PyValueError::new_err(other.to_string()),
    }
}

fn required<'py, T: for<'a> FromPyObject<'a, 'py>>(dict: &Bound<'py, PyDict>, key: &str) -> PyResult<T> {
    let value = dict.get_item(key)?.ok_or_else(|| PyValueError::new_err(format!("a shape needs {key:?}")))?;
    value
        .extract()
        .map_err(|_| PyValueError::new_err(format!("{key:?} of a shape has the wrong type or shape")))
}

fn columns<const C: usize>(array: &PyReadonlyArray2<'_, f32>, key: &str) -> PyResult<Vec<[f32; C]>> {
    let view = array.as_array();
    if view.ncols() != C {
        return Err(PyValueError::new_err(format!("{key} must have {C} columns, not {}", view.ncols())));
    }
    Ok(view.rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}

fn optional<'py, const C: usize>(dict: &Bound<'py, PyDict>, key: &str) -> PyResult<Option<Vec<[f32; C]>>> {
    match dict.get_item(key)? {
        None => Ok(None),
        Some(value) if value.is_none() => Ok(None),
        Some(_) => columns(&required(dict, key)?, key).map(Some),
    }
}

fn shape(dict: &Bound<'_, PyDict>) -> PyResult<Shape> {
    match required::<String>(dict, "kind")?.as_str() {
        "sphere" => {
            let center: [f32; 3] = required(dict, "center")?;
            Ok(Shape::Sphere {
                center: Vec3::from(center),
                radius: required(dict, "radius")?,
                turn: Mat3::IDENTITY,
            })
        }
        "mesh" => {
            let positions = columns::<3>(&required(dict, "positions")?, "positions")?;
            let indices: PyReadonlyArray2<'_, u32> = required(dict, "indices")?;
            let indices = indices.as_array();
            if indices.ncols() != 3 {
                return Err(PyValueError::new_err("indices must have 3 columns"));
            }
            Ok(Shape::Mesh(Mesh {
                positions: positions.into_iter().map(Vec3::from).collect(),
                indices: indices.rows().into_iter().map(|r| [r[0], r[1], r[2]]).collect(),
                normals: optional::<3>(dict, "normals")?.map(|v| v.into_iter().map(Vec3::from).collect()),
                uvs: optional::<2>(dict, "uvs")?.map(|v| v.into_iter().map(Vec2::from).collect()),
            }))
        }
        other => Err(PyValueError::new_err(format!("a shape is a 'mesh' or a 'sphere', not {other:?}"))),
    }
}

fn placement((shape, keys): (usize, PyReadonlyArray3<'_, f64>)) -> PyResult<Placement> {
    let keys = keys.as_array();
    if keys.dim().1 != 3 || keys.dim().2 != 4 {
        return Err(PyValueError::new_err(format!(
            "transforms must have shape (keys, 3, 4), not {:?}",
            keys.dim()
        )));
    }
    let keys = keys.outer_iter().map(|m| {
        let column = |j: usize| Vec3::new(m[[0, j]] as f32, m[[1, j]] as f32, m[[2, j]] as f32);
        Affine3A::from_cols(column(0).into(), column(1).into(), column(2).into(), column(3).into())
    });
    let motion = Motion::new(keys.collect()).ok_or_else(|| {
        PyValueError::new_err("a transform must be finite and not singular, and there must be one")
    })?;
    Ok(Placement { shape, motion })
}

/// The ray structure.
#[pyclass(name = "Geometry", frozen, module = "illuminant._core")]
pub(crate) struct PyGeometry(Arc<Geometry>);

#[pymethods]
impl PyGeometry {
    #[new]
    #[pyo3(signature = (shapes, placements, threads=0))]
    fn new(
        py: Python<'_>,
        shapes: Vec<Bound<'_, PyDict>>,
        placements: Vec<(usize, PyReadonlyArray3<'_, f64>)>,
        threads: usize,
    ) -> PyResult<Self> {
        let shapes = shapes.iter().map(shape).collect::<PyResult<Vec<_>>>()?;
        let placements = placements.into_iter().map(placement).collect::<PyResult<Vec<_>>>()?;
        let geometry = py.detach(|| Geometry::new(shapes, placements, threads)).map_err(geometry_error)?;
        Ok(Self(Arc::new(geometry)))
    }

    /// Corners of the box around everything.
    #[getter]
    fn bounds(&self) -> ([f32; 3], [f32; 3]) {
        let (low, high) = self.0.bounds();
        (low.to_array(), high.to_array())
    }

    /// Triangles placed, instances counted each time.
    #[getter]
    fn triangles(&self) -> usize {
        self.0.triangles()
    }
}

/// A scene ready for rendering.
#[pyclass(name = "Scene", frozen, module = "illuminant._core")]
pub(crate) struct PyScene(pub(crate) Arc<Scene>);

#[pymethods]
impl PyScene {
    #[new]
    fn new(
        py: Python<'_>,
        geometry: &PyGeometry,
        description: &str,
        images: HashMap<String, PyReadonlyArray3<'_, f32>>,
    ) -> PyResult<Self> {
        let mut reader = serde_json::Deserializer::from_str(description);
        let description: Description = serde_path_to_error::deserialize(&mut reader)
            .map_err(|e| PyValueError::new_err(format!("{}: {}", e.path(), e.inner())))?;
        let images: HashMap<String, ImageData> = images
            .into_iter()
            .map(|(key, image)| {
                let view = image.as_array();
                let (rows, columns, channels) = view.dim();
                if channels != 3 {
                    let text = format!("image {key:?} must have 3 channels, not {channels}");
                    return Err(PyValueError::new_err(text));
                }
                Ok((key, (columns, rows, view.iter().copied().collect())))
            })
            .collect::<PyResult<_>>()?;
        let geometry = Arc::clone(&geometry.0);
        let scene = py
            .detach(|| Scene::new(geometry, &description, &images))
            .map_err(|e| PyValueError::new_err(e.to_string()))?;
        Ok(Self(Arc::new(scene)))
    }

    /// The names of the lamps.
    #[getter]
    fn lamps(&self) -> Vec<String> {
        self.0.lamps.iter().map(|lamp| lamp.name.clone()).collect()
    }

    /// From how far a picture of this width shows what the camera saw, in the unit of the width.
    fn viewing_distance(&self, picture_width: f64) -> f64 {
        self.0.camera.viewing_distance(picture_width)
    }

    /// Where a point of the world appears, in pixels; None behind the eye.
    fn project(&self, point: [f64; 3]) -> Option<[f64; 2]> {
        self.0.camera.project(point.into())
    }

    /// Whether any object or surroundings lie in the camera's view.
    fn sees_anything(&self) -> bool {
        self.0.sees_anything()
    }
}

pub(crate) fn register(m: &Bound<'_, PyModule>) -> PyResult<()> {
    m.add_function(wrap_pyfunction!(load_embree, m)?)?;
    m.add_class::<PyGeometry>()?;
    m.add_class::<PyScene>()
}
