//! The readers of CAD files: STEP, IGES, the BREP text of OpenCASCADE and FreeCAD's documents, as models of
//! [`nurbs_hausdorff`] with the account of what was read.
//!
//! The stages: `text`, `step` and `iges` each read a format into the curves, surfaces and shapes of a `topology`;
//! `nurbs` evaluates them and makes exact NURBS of them; `faces` turns a face into a surface and closed loops in its
//! parameters, with `gap` bounding their distance from the edges; `instances` collects the faces and their placements;
//! `file` recognises files by their content, and names foreign ones; `archive` opens those within others.

#[cfg(feature = "archives")]
mod archive;
mod digits;
mod edges;
mod faces;
mod file;
mod format;
mod gap;
mod iges;
mod instances;
mod meshes;
mod nurbs;
mod outline;
mod report;
mod step;
mod text;
mod topology;
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
mod wasm;

use instances::{assembly, foreign, levels, placed};

#[cfg(feature = "archives")]
pub use archive::inflated;
pub(crate) use assembly::OnFace;
pub use file::{FileKind, from_file};
pub use format::is_cad;
use glam::{DAffine3, DVec3};
pub use meshes::MeshAccount;
use nurbs_hausdorff::workspace::{Assembled, into_model};
use nurbs_hausdorff::{Error, Model, ReadReport, Result};

/// Reads the text of a BREP file of OpenCASCADE, versions 1 to 3, with every face
/// trimmed as it is.
///
/// Elementary and swept surfaces become exact NURBS over the region that their loops
/// cover; offsets that are not rational are approximated, with the deviation in the
/// face's gap. Trimming curves stay exact on planes and B-splines, along parameter lines
/// and as plane sections of ruled surfaces; others are fitted, with the deviation in
/// their gap. Edges without a curve in the parameters are projected. A face
/// that cannot be read is in the report, never dropped silently; a face that cannot be cut
/// into patches is left out by [`nurbs_hausdorff::PreparedModel::new_skipping`]. O(size).
///
/// # Errors
/// [`Error::FileTooLarge`] over [`Model::MAX_JSON_BYTES`], [`Error::BrepSyntax`],
/// [`Error::BrepUnreadable`] if no face can be read, [`Error::EmptyModel`] without faces.
pub fn from_brep(text: &str) -> Result<(Model, ReadReport)> {
    into_model(read_brep(text, None)?)
}

/// Reads a STEP file of AP203, AP214 or AP242, in millimetres, with every face trimmed as
/// [`from_brep`] does.
///
/// Read are the boundary representations of solids and shells, faces, sets of surfaces, primitives of
/// constructive geometry, mapped items and assemblies with their placements. Whatever else the file represents
/// that may have a surface is in the report with its number in the file, as a face that cannot be read.
/// O(length).
///
/// # Errors
/// [`Error::FileTooLarge`] over [`Model::MAX_JSON_BYTES`], [`Error::StepSyntax`],
/// [`Error::StepUnreadable`], [`Error::BrepUnreadable`] if no face can be read, [`Error::TooManyFaces`],
/// [`Error::StepTriangles`] of a file of triangles alone, [`Error::StepEmpty`] without faces.
pub fn from_step(bytes: &[u8]) -> Result<(Model, ReadReport)> {
    into_model(read_step(bytes, None)?)
}

/// Reads an IGES file of version 5.3 or earlier, in millimetres, with every face trimmed as
/// [`from_brep`] does.
///
/// Read are trimmed, bounded and whole surfaces, solids and shells, groups and subfigures
/// with their placements. Curves in the parameters that the file has are used where they lie
/// on the curves in space that they stand for, and made anew from these where not. A face
/// that cannot be read is in the report with its number in the directory. O(length).
///
/// # Errors
/// [`Error::FileTooLarge`] over [`Model::MAX_JSON_BYTES`], [`Error::IgesSyntax`],
/// [`Error::IgesUnreadable`], [`Error::BrepUnreadable`] if no face can be read,
/// [`Error::EmptyModel`] without faces.
pub fn from_iges(bytes: &[u8]) -> Result<(Model, ReadReport)> {
    into_model(read_iges(bytes, None)?)
}

/// Reads the text of a BREP file. The model is not yet validated.
///
/// # Errors
/// Those of [`from_brep`] on the text.
pub(crate) fn read_brep(text: &str, on_face: Option<OnFace<'_>>) -> Result<Assembled> {
    check_length(text.len())?;
    assembly::assemble(&text::parse(text)?, on_face)
}

/// Reads a STEP file. The model is not yet validated.
///
/// # Errors
/// Those of [`from_step`] on the file.
pub(crate) fn read_step(bytes: &[u8], on_face: Option<OnFace<'_>>) -> Result<Assembled> {
    check_length(bytes.len())?;
    match assembly::assemble(&step::parse(bytes)?, on_face) {
        Err(Error::EmptyModel) => Err(Error::StepEmpty { found: step::contents_of(bytes)? }),
        assembled => assembled,
    }
}

/// Reads the triangles of a STEP file without faces that can be read: calls a function for each mesh, with its name,
/// its vertices, its triangles and its place, and returns the unit and what is left out or remarked.
///
/// # Errors
/// [`Error::FileTooLarge`], [`Error::StepSyntax`]; [`Error::StepUnreadable`] for a file with faces; those of the
/// function.
pub fn read_step_meshes(
    bytes: &[u8],
    on_mesh: impl FnMut(Option<&str>, &[DVec3], &[[u32; 3]], &DAffine3) -> Result<()>,
) -> Result<MeshAccount> {
    check_length(bytes.len())?;
    meshes::each_mesh(&step::parse(bytes)?, on_mesh)
}

/// Reads an IGES file. The model is not yet validated.
///
/// # Errors
/// Those of [`from_iges`] on the file.
pub(crate) fn read_iges(bytes: &[u8], on_face: Option<OnFace<'_>>) -> Result<Assembled> {
    check_length(bytes.len())?;
    assembly::assemble(&iges::parse(bytes)?, on_face)
}

fn check_length(length: usize) -> Result<()> {
    let found = length as u64;
    if found > Model::MAX_JSON_BYTES {
        return Err(Error::FileTooLarge { found, expected: Model::MAX_JSON_BYTES });
    }
    Ok(())
}
