//! The triangles of STEP files that have no faces that can be read, in millimetres.

use super::Scene;
use crate::{MeshFormat, Soup};
use nurbs_hausdorff::Result;
use nurbs_hausdorff_cad::{MeshAccount, read_step_meshes};

pub(crate) fn read(bytes: &[u8]) -> Result<Soup> {
    let mut scene = Scene { format: MeshFormat::Step, soup: Soup::default(), places: 0 };
    let account = read_step_meshes(bytes, |name, vertices, triangles, transform| {
        scene.place(name, vertices, triangles, transform)
    })?;
    let MeshAccount { unit, notes, skipped, .. } = account;
    scene.soup.unit = unit;
    notes.into_iter().for_each(|note| scene.soup.push_note(note));
    skipped.into_iter().for_each(|part| scene.soup.push_skipped(part));
    Ok(scene.soup)
}
