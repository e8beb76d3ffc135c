//! Models with the data that is computed from them once.

use crate::convert::to_dict;
use crate::failure;
use crate::running::on_live_threads;
use numpy::IntoPyArray;
use nurbs_hausdorff::tessellate::{TessellationOptions, tessellate};
use nurbs_hausdorff::{FileKind, ModelInfo, PreparedModel, ReadReport};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// A model that was read and prepared, with the report on reading it.
#[pyclass(frozen, module = "nurbs_hausdorff._native")]
pub(crate) struct Model {
    model: nurbs_hausdorff::Model,
    prepared: PreparedModel,
    report: ReadReport,
    kind: FileKind,
}

impl Model {
    pub(crate) fn prepared(&self) -> &PreparedModel {
        &self.prepared
    }
}

#[pymethods]
impl Model {
    /// Reads and prepares a file; `path` names it in errors.
    #[new]
    fn new(py: Python<'_>, file: &Bound<'_, PyBytes>, path: &str) -> PyResult<Self> {
        let bytes = file.as_bytes();
        let read = py.detach(|| on_live_threads(|| read(bytes, path)))?;
        read.map_err(|error| failure::of_error(py, &error))
    }

    #[getter]
    fn kind(&self) -> &'static str {
        self.kind.name()
    }

    #[getter]
    fn name(&self) -> Option<&str> {
        self.model.name()
    }

    #[getter]
    fn unit(&self) -> Option<f64> {
        self.model.unit()
    }

    #[getter]
    fn gap(&self) -> f64 {
        self.prepared.gap()
    }

    #[getter]
    fn bounding_box(&self) -> [[f64; 3]; 2] {
        let aabb = self.prepared.bounding_box();
        [aabb.min.to_array(), aabb.max.to_array()]
    }

    #[getter]
    fn face_names(&self) -> Vec<Option<String>> {
        self.model.faces().map(|face| face.name().map(str::to_owned)).collect()
    }

    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        to_dict(py, &self.report)
    }

    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let info = py.detach(|| on_live_threads(|| ModelInfo::of_prepared(&self.model, &self.prepared)))?;
        to_dict(py, &info)
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| self.model.to_json()).map_err(|error| failure::of_error(py, &error))
    }

    /// Returns triangles within the options' tolerance, as flat arrays.
    fn tessellate<'py>(&self, py: Python<'py>, options: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
        let options: TessellationOptions = crate::convert::options(options)?;
        let made = py.detach(|| on_live_threads(|| tessellate(&self.model, &options)))?;
        let made = made.map_err(|error| failure::of_error(py, &error))?;
        let mut vertices = Vec::with_capacity(made.positions.len());
        for position in made.positions.as_chunks::<3>().0 {
            for (coordinate, origin) in position.iter().zip(made.origin.to_array()) {
                vertices.push(f64::from(*coordinate) + origin);
            }
        }
        let ends: Vec<usize> = made.faces.iter().map(|range| range.end / 3).collect();
        let dict = PyDict::new(py);
        dict.set_item("vertices", vertices.into_pyarray(py))?;
        dict.set_item("normals", made.normals.into_pyarray(py))?;
        dict.set_item("triangles", made.indices.into_pyarray(py))?;
        dict.set_item("face_ends", ends.into_pyarray(py))?;
        Ok(dict)
    }
}

/// Faces of a CAD file that cannot be cut into patches are left out, and reported.
fn read(bytes: &[u8], path: &str) -> nurbs_hausdorff::Result<Model> {
    let (model, mut report, kind) = nurbs_hausdorff::Model::from_file(bytes.to_vec(), path)?;
    let (model, prepared) = match kind {
        FileKind::Json => {
            let prepared = PreparedModel::new(&model)?;
            (model, prepared)
        }
        _ => PreparedModel::new_skipping(model, &mut report)?,
    };
    Ok(Model { model, prepared, report, kind })
}
