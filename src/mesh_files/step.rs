//! The triangles of STEP files that have no faces, in millimetres.

use super::scene::place;
use super::{MeshFormat, Soup};
use crate::brep::read_step_meshes;
use crate::error::Result;

pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut soup = Soup::default();
    soup.unit = read_step_meshes(bytes, |name, mesh, transform| {
        place(&mut soup, name, &mesh.vertices, &mesh.triangles, transform, MeshFormat::Step)
    })?;
    Ok(soup)
}
