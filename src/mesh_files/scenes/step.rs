//! The triangles of STEP files that have no faces, in millimetres.

use super::Scene;
use crate::brep::read_step_meshes;
use crate::error::Result;
use crate::mesh_files::{MeshFormat, Soup};

pub(in crate::mesh_files) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut scene = Scene { format: MeshFormat::Step, soup: Soup::default(), places: 0 };
    let unit = read_step_meshes(bytes, |name, mesh, transform| {
        scene.place(name, &mesh.vertices, &mesh.triangles, transform)
    })?;
    scene.soup.unit = unit;
    Ok(scene.soup)
}
