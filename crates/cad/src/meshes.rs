//! The triangles of a file without faces, where its assemblies place them.

use super::assembly::placed_faces;
use super::report::Remark;
use super::topology::{Face, ShapeKind, Topology};
use glam::{DAffine3, DVec3};
use nurbs_hausdorff::{Error, FaceId, Note, Result, Skipped};
use serde::Serialize;

/// What the report says of the triangles of a file.
#[derive(Debug, Serialize)]
#[non_exhaustive]
pub struct MeshAccount {
    /// Metres per unit, if the file states it.
    #[serde(skip)]
    pub unit: Option<f64>,
    /// The parts with a decision about them.
    pub notes: Vec<Note>,
    /// The bodies and faces that cannot be read.
    pub skipped: Vec<Skipped>,
}

/// Calls a function for each mesh with its name and its place.
///
/// # Errors
/// [`Error::StepUnreadable`] for a file with faces, or without triangles; those of the function.
pub(super) fn each_mesh(
    file: &Topology,
    mut on_mesh: impl FnMut(Option<&str>, &[DVec3], &[[u32; 3]], &DAffine3) -> Result<()>,
) -> Result<MeshAccount> {
    let (placed, levels) = placed_faces(file)?;
    let mut skipped = Vec::new();
    let mut has_triangles = false;
    for placed in &placed {
        let entity = placed.entity(file);
        let mesh = match &file.shapes[placed.shape].kind {
            ShapeKind::Mesh(mesh) => mesh,
            ShapeKind::Face(Face { surface: Err(fault), .. }) => {
                let face =
                    FaceId::Name(entity.map_or_else(|| "a face".to_owned(), |entity| format!("#{entity}")));
                skipped.push(Skipped::new(face, entity, fault.code, fault.why.clone()));
                continue;
            }
            _ => return Err(no_mesh(entity)),
        };
        let name = mesh.label.name.clone().or_else(|| levels.path(placed.part));
        on_mesh(name.as_deref(), &mesh.vertices, &mesh.triangles, &placed.location)?;
        has_triangles = true;
    }
    if !has_triangles {
        return Err(no_mesh(placed.first().and_then(|placed| placed.entity(file))));
    }
    let note = |Remark { code, why }: Remark| Note::new(FaceId::Name("the file".to_owned()), code, why);
    let notes = file.remarks.iter().cloned().map(note).collect();
    Ok(MeshAccount { unit: file.unit, notes, skipped })
}

fn no_mesh(entity: Option<u64>) -> Error {
    let entity = entity.unwrap_or_default();
    Error::StepUnreadable { found: format!("#{entity} is no triangles, expected a mesh of these alone") }
}
