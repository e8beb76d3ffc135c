//! Wavefront OBJ.

use super::{MeshFormat, Soup};
use crate::error::Result;
use glam::DVec3;
use tobj::{LoadOptions, load_obj_buf};

const FORMAT: MeshFormat = MeshFormat::Obj;

/// The name that `tobj` gives to faces without an object or a group.
const NAMELESS: &str = "unnamed_object";

pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let options = LoadOptions { triangulate: false, ..LoadOptions::default() };
    // Materials do not change the shape.
    let no_materials = |_: &std::path::Path| Ok((Vec::new(), Default::default()));
    let (models, _) = load_obj_buf(&mut std::io::Cursor::new(bytes), &options, no_materials)
        .map_err(|error| FORMAT.syntax(error.to_string()))?;
    let mut soup = Soup::default();
    for tobj::Model { mesh, name } in models {
        soup.begin_group(Some(name).filter(|name| !name.is_empty() && name != NAMELESS));
        let first = soup.vertices.len() as u32;
        let positions = mesh.positions.chunks_exact(3);
        soup.vertices.extend(positions.map(|point| DVec3::new(point[0], point[1], point[2])));
        let mut indices = mesh.indices.iter().map(|&index| first.saturating_add(index));
        let counts: Vec<u32> =
            if mesh.face_arities.is_empty() { vec![3; mesh.indices.len() / 3] } else { mesh.face_arities };
        for count in counts {
            let corners: Vec<u32> = indices.by_ref().take(count as usize).collect();
            // Points and lines are no faces.
            if count >= 3 {
                soup.push_polygon(&corners, FORMAT)?;
            }
        }
    }
    Ok(soup)
}
