//! Models with the data that is computed from them once.

use crate::convert::to_dict;
use crate::failure;
use crate::running::on_live_threads;
use glam::DVec3;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use nurbs_hausdorff::tessellate::{TessellationOptions, tessellate};
use nurbs_hausdorff::{
    BodyInfo, Error, Facets, MeshReport, ModelInfo, PointCloud, PreparedModel, ReadReport, Side,
    TriangleMesh, face_path,
};
use nurbs_hausdorff_files::Opened;
use nurbs_hausdorff_meshes::{Beside, MeshFile, MeshFormat};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::collections::HashMap;

/// A model that was read and prepared, with the report on reading it.
#[pyclass(frozen, module = "nurbs_hausdorff._native")]
pub(crate) struct Model {
    content: Content,
    prepared: PreparedModel,
    report: ReadReport,
    kind: &'static str,
}

/// What is measured.
enum Content {
    Surfaces(nurbs_hausdorff::Model),
    Facets { count: usize, mesh: Option<MeshReport>, unit: Option<f64> },
}

impl Model {
    pub(crate) fn prepared(&self) -> &PreparedModel {
        &self.prepared
    }

    /// # Errors
    /// `FACETS_UNSUPPORTED` of a mesh or a cloud, with what needs surfaces.
    fn surfaces(&self, py: Python<'_>, found: &'static str) -> PyResult<&nurbs_hausdorff::Model> {
        match &self.content {
            Content::Surfaces(model) => Ok(model),
            Content::Facets { .. } => Err(failure::of_error(py, &Error::FacetsUnsupported { found })),
        }
    }
}

#[pymethods]
impl Model {
    /// Reads and prepares a file with those of [`names_beside`]; `path` names it in errors, and its ending
    /// distinguishes meshes.
    #[new]
    fn new(
        py: Python<'_>,
        file: &Bound<'_, PyBytes>,
        path: &str,
        beside: HashMap<String, Vec<u8>>,
    ) -> PyResult<Self> {
        let bytes = file.as_bytes();
        let beside = beside.into_iter().collect();
        let read = py.detach(|| on_live_threads(|| read(bytes, path, &beside)))?;
        read.map_err(|error| failure::of_error(py, &error))
    }

    /// Prepares triangles, or points if there are none.
    #[staticmethod]
    fn of_facets(
        py: Python<'_>,
        vertices: PyReadonlyArray1<'_, f64>,
        triangles: Option<PyReadonlyArray1<'_, u32>>,
        unit: Option<f64>,
    ) -> PyResult<Self> {
        // Copied, because other threads may write to the arrays meanwhile.
        let vertices: Vec<f64> = vertices.as_array().to_vec();
        let triangles: Option<Vec<u32>> = triangles.map(|triangles| triangles.as_array().to_vec());
        let made = py.detach(|| on_live_threads(|| of_facets(&vertices, triangles.as_deref(), unit)))?;
        made.map_err(|error| failure::of_error(py, &error))
    }

    #[getter]
    fn kind(&self) -> &'static str {
        self.kind
    }

    #[getter]
    fn name(&self) -> Option<&str> {
        match &self.content {
            Content::Surfaces(model) => model.name(),
            Content::Facets { .. } => None,
        }
    }

    #[getter]
    fn unit(&self) -> Option<f64> {
        match &self.content {
            Content::Surfaces(model) => model.unit(),
            Content::Facets { unit, .. } => *unit,
        }
    }

    /// The number of triangles or points; none of surfaces.
    #[getter]
    fn facet_count(&self) -> Option<usize> {
        match &self.content {
            Content::Surfaces(_) => None,
            Content::Facets { count, .. } => Some(*count),
        }
    }

    /// The findings about a mesh; none of anything else.
    fn mesh_report<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        match &self.content {
            Content::Facets { mesh: Some(mesh), .. } => to_dict(py, mesh).map(Some),
            _ => Ok(None),
        }
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
        match &self.content {
            Content::Surfaces(model) => model.faces().map(|face| face.name().map(str::to_owned)).collect(),
            Content::Facets { .. } => {
                let name = |face| self.prepared.face_name(face).map(str::to_owned);
                (0..self.prepared.face_count()).map(name).collect()
            }
        }
    }

    #[getter]
    fn face_paths(&self) -> Vec<Vec<String>> {
        let path = |name: Option<String>| name.map_or_else(Vec::new, |name| face_path(&name));
        self.face_names().into_iter().map(path).collect()
    }

    #[getter]
    fn face_colors(&self) -> Vec<Option<(f64, f64, f64)>> {
        let color = |face| self.prepared.face_color(face).map(|[red, green, blue]| (red, green, blue));
        (0..self.prepared.face_count()).map(color).collect()
    }

    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        to_dict(py, &self.report)
    }

    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let model = self.surfaces(py, "a description of faces and patches")?;
        let info = py.detach(|| on_live_threads(|| ModelInfo::of_prepared(model, &self.prepared)))?;
        to_dict(py, &info)
    }

    /// Returns volume, area, extents and the like, as intervals.
    fn facts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let facts = py.detach(|| on_live_threads(|| self.prepared.facts()))?;
        to_dict(py, facts)
    }

    /// Returns the elementary surfaces that the faces lie on; None for other surfaces.
    fn face_forms<'py>(&self, py: Python<'py>) -> PyResult<Vec<Option<Bound<'py, PyDict>>>> {
        let forms = py.detach(|| on_live_threads(|| self.prepared.face_forms()))?;
        forms.iter().map(|form| form.as_ref().map(|form| to_dict(py, form)).transpose()).collect()
    }

    /// Returns the bodies with their facts.
    fn bodies<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let bodies = py.detach(|| on_live_threads(|| BodyInfo::of(&self.prepared)))?;
        bodies.iter().map(|body| to_dict(py, body)).collect()
    }

    /// Returns whether the faces close, the shells, and the edges where they do not.
    fn solid<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let solid = py.detach(|| on_live_threads(|| self.prepared.solid()))?;
        to_dict(py, &solid)
    }

    /// Returns the sides of points, x, y, z each: -1 inside, 1 outside, 0 where neither is certain.
    fn sides<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i8>>> {
        // Copied, because other threads may write to the array meanwhile.
        let points: Vec<f64> = points.as_array().to_vec();
        let side = |point: &[f64; 3]| match self.prepared.side(*point) {
            Side::Inside => -1,
            Side::Outside => 1,
            _ => 0,
        };
        let sides: Vec<i8> =
            py.detach(|| on_live_threads(|| points.as_chunks().0.iter().map(side).collect()))?;
        Ok(sides.into_pyarray(py))
    }

    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        let model = self.surfaces(py, "a conversion to interchange JSON")?;
        py.detach(|| model.to_json()).map_err(|error| failure::of_error(py, &error))
    }

    /// Returns triangles within the options' tolerance, as flat arrays.
    fn tessellate<'py>(&self, py: Python<'py>, options: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyDict>> {
        let options: TessellationOptions = crate::convert::options(options)?;
        let model = self.surfaces(py, "a tessellation")?;
        let made = py.detach(|| on_live_threads(|| tessellate(model, &options)))?;
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

/// Returns the paths of the other files that belong to a mesh's file, as the files of its buffers belong to a glTF.
/// They are relative to the folder of the mesh's file.
#[pyfunction]
pub(crate) fn names_beside(file: &Bound<'_, PyBytes>, path: &str) -> Vec<String> {
    let bytes = file.as_bytes();
    match MeshFormat::of_file(bytes, path) {
        Ok(Some(format)) => MeshFile::names_beside(bytes, format),
        _ => Vec::new(),
    }
}

/// Faces of a CAD file that cannot be cut into patches are left out, and reported.
fn read(bytes: &[u8], path: &str, beside: &Beside) -> nurbs_hausdorff::Result<Model> {
    let Opened { content, prepared, report, kind, .. } =
        nurbs_hausdorff_files::read(bytes.to_vec(), path, beside)?;
    match content {
        nurbs_hausdorff_files::Content::Surfaces(model) => {
            Ok(Model { content: Content::Surfaces(model), prepared, report, kind })
        }
        nurbs_hausdorff_files::Content::Facets(facets) => with_facets(&facets, prepared, report),
    }
}

fn of_facets(
    vertices: &[f64],
    triangles: Option<&[u32]>,
    unit: Option<f64>,
) -> nurbs_hausdorff::Result<Model> {
    let vertices: Vec<DVec3> = vertices.as_chunks::<3>().0.iter().map(|&point| point.into()).collect();
    let facets = match triangles {
        Some(triangles) => Facets::Mesh(TriangleMesh::new(&vertices, triangles.as_chunks::<3>().0)?),
        None => Facets::Cloud(PointCloud::new(vertices)?),
    };
    with_facets(&facets, PreparedModel::of_facets(&facets, unit)?, ReadReport::of_facets(unit))
}

fn with_facets(
    facets: &Facets,
    prepared: PreparedModel,
    report: ReadReport,
) -> nurbs_hausdorff::Result<Model> {
    let (kind, count, mesh) = match facets {
        Facets::Mesh(mesh) => ("mesh", mesh.triangles().len(), Some(mesh.report())),
        Facets::Cloud(cloud) => ("points", cloud.points().len(), None),
    };
    let content = Content::Facets { count, mesh, unit: report.unit };
    Ok(Model { content, prepared, report, kind })
}
