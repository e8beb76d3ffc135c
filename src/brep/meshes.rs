//! The triangles of a file without faces, where its assemblies place them.

use super::assembly::placed_faces;
use super::topology::{Mesh, ShapeKind, Topology};
use crate::error::{Error, Result};
use glam::DAffine3;

/// Calls a function for each mesh with its name and its place.
///
/// # Errors
/// [`Error::StepUnreadable`] for a file with faces, or with bodies that are not read; those of the function.
pub(super) fn each_mesh(
    file: &Topology,
    mut on_mesh: impl FnMut(Option<&str>, &Mesh, &DAffine3) -> Result<()>,
) -> Result<()> {
    let (placed, levels) = placed_faces(file)?;
    for placed in &placed {
        let ShapeKind::Mesh(mesh) = &file.shapes[placed.shape].kind else {
            let entity = placed.entity(file).unwrap_or_default();
            let found = format!("#{entity} is no triangles, expected a mesh of these alone");
            return Err(Error::StepUnreadable { found });
        };
        let name = mesh.label.name.clone().or_else(|| levels.path(placed.part));
        on_mesh(name.as_deref(), mesh, &placed.location)?;
    }
    Ok(())
}
