//! The triangles of STEP files that have no faces that can be read, in millimetres.

use super::Scene;
use crate::brep::{MeshAccount, read_step_meshes};
use crate::error::Result;
use crate::mesh_files::{MeshFormat, Soup};

pub(in crate::mesh_files) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut scene = Scene { format: MeshFormat::Step, soup: Soup::default(), places: 0 };
    let account = read_step_meshes(bytes, |name, mesh, transform| {
        scene.place(name, &mesh.vertices, &mesh.triangles, transform)
    })?;
    let MeshAccount { unit, notes, skipped } = account;
    scene.soup.unit = unit;
    notes.into_iter().for_each(|note| scene.soup.push_note(note));
    skipped.into_iter().for_each(|part| scene.soup.push_skipped(part));
    Ok(scene.soup)
}
