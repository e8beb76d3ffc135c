//! Reads any file that holds a shape: CAD files, meshes, scans and clouds of points, found by their content.
//!
//! ```no_run
//! use nurbs_hausdorff::Engine;
//!
//! # fn main() -> nurbs_hausdorff::Result<()> {
//! let [a, b] = [nurbs_hausdorff_files::open("a.step")?, nurbs_hausdorff_files::open("b.stl")?];
//! let distance = Engine::cpu().distance(&a.prepared, &b.prepared, &Default::default()).wait()?;
//! println!("between {} and {}", distance.lower, distance.upper);
//! # Ok(())
//! # }
//! ```

// Prepared models hold types of wgpu, nested deeper than 128.
#![recursion_limit = "256"]

mod bytes;

pub use bytes::{bounded, bytes, bytes_beside};
use nurbs_hausdorff::{Error, Facets, Model, PreparedModel, ReadReport, Result};
use nurbs_hausdorff_cad::{FileKind, from_file, inflated};
use nurbs_hausdorff_meshes::{Beside, MeshFile, MeshFormat};
use std::path::Path;

/// The name of the kind of meshes, scans and clouds of points.
const MESH: &str = "mesh";

/// A model that was read, prepared for measurements.
#[derive(Debug)]
#[non_exhaustive]
pub struct Opened {
    /// What the file holds.
    pub content: Content,
    /// The same, prepared.
    pub prepared: PreparedModel,
    /// The account of what was read, approximated and left out.
    pub report: ReadReport,
    /// The kind of the file: the [name](FileKind::name) of CAD files, else `mesh`.
    pub kind: &'static str,
}

/// The content of a file.
#[derive(Debug)]
pub enum Content {
    /// The surfaces, without the faces left out.
    Surfaces(Model),
    /// A mesh or a cloud of points.
    Facets(Facets),
}

/// Reads a file with those beside it that belong to it, as the buffers of a glTF. Faces of a CAD file that cannot be
/// cut into patches are left out, and reported.
///
/// # Errors
/// Those of [`bytes`], [`bytes_beside`] and [`read`].
pub fn open(path: impl AsRef<Path>) -> Result<Opened> {
    let path = path.as_ref();
    let content = bytes(path)?;
    let beside = bytes_beside(path, &content)?;
    read(content, &path.display().to_string(), &beside)
}

/// Reads the bytes of a file, which gzip may have compressed, with those of the files beside it. Errors state
/// `name`, and its ending determines the format of a mesh without a signature. O(length).
///
/// # Errors
/// Those of [`MeshFormat::of_file`], [`MeshFile::read_with`], [`from_file`] and [`PreparedModel`].
pub fn read(bytes: Vec<u8>, name: &str, beside: &Beside) -> Result<Opened> {
    let (bytes, name) = inflated(bytes, name)?;
    if let Some(format) = MeshFormat::of_file(&bytes, name)? {
        return of_mesh(MeshFile::read_with(&bytes, format, beside)?);
    }
    // Triangles of a STEP file without faces are a mesh.
    let triangles = may_hold_triangles(&bytes).then(|| bytes.clone());
    let (model, mut report, kind) = match (from_file(bytes, name), triangles) {
        (Err(Error::StepTriangles { .. }), Some(bytes)) => {
            return of_mesh(MeshFile::read(&bytes, MeshFormat::Step)?);
        }
        (read, _) => read?,
    };
    let (model, prepared) = match kind {
        // The faces of interchange JSON are all wanted: one that cannot be cut is an error.
        FileKind::Json => {
            let prepared = PreparedModel::new(&model)?;
            (model, prepared)
        }
        _ => PreparedModel::new_skipping(model, &mut report)?,
    };
    Ok(Opened { content: Content::Surfaces(model), prepared, report, kind: kind.name() })
}

/// Reads the bytes of a mesh, a scan or a cloud of points, as [`read`] does.
///
/// # Errors
/// Those of [`MeshFormat::of_file`] and [`MeshFile::read_with`]; [`Error::FormatUnsupported`] for other files.
pub fn read_facets(bytes: Vec<u8>, name: &str, beside: &Beside) -> Result<MeshFile> {
    let (bytes, name) = inflated(bytes, name)?;
    match MeshFormat::of_file(&bytes, name)? {
        Some(format) => MeshFile::read_with(&bytes, format, beside),
        None => Err(Error::FormatUnsupported {
            found: "a file without a mesh or points",
            advice: "expected a mesh, a scan, or text with three coordinates a line".to_owned(),
        }),
    }
}

/// Whether a STEP file may hold triangles: the name of each entity with triangles contains this word.
fn may_hold_triangles(bytes: &[u8]) -> bool {
    const WORD: &[u8] = b"TRIANGULATED";
    bytes.windows(WORD.len()).any(|window| window == WORD)
}

/// Prepares a mesh or a cloud of points.
fn of_mesh(file: MeshFile) -> Result<Opened> {
    let prepared = PreparedModel::of_facets(&file.facets, file.unit)?;
    let report = file.report();
    Ok(Opened { content: Content::Facets(file.facets), prepared, report, kind: MESH })
}
