//! The triangles of STEP files without faces: what is given, the core's `PreparedModel.fromFacets` takes, as what
//! the readers of meshes give. They are read by the module of CAD files, which has the rest of STEP.

use crate::MeshAccount;
use nurbs_hausdorff::workspace::to_object;
use nurbs_hausdorff::{Error, Result};
use wasm_bindgen::prelude::*;

/// The most vertices, and triangles, of all meshes where they are placed: placed ones may be exponentially many in
/// the size of the file, and memory has 4 GiB.
const MAX_PLACED: usize = 1 << 25;

/// The triangles of a STEP file, in the order of its meshes, each mesh a group.
#[wasm_bindgen]
pub struct StepTriangles {
    positions: Vec<f64>,
    indices: Vec<u32>,
    names: Vec<String>,
    counts: Vec<u32>,
    account: MeshAccount,
}

#[wasm_bindgen]
impl StepTriangles {
    /// x, y, z of every vertex.
    #[wasm_bindgen(getter)]
    pub fn positions(&self) -> Vec<f64> {
        self.positions.clone()
    }

    /// The indices of the corners of every triangle.
    #[wasm_bindgen(getter)]
    pub fn triangles(&self) -> Option<Vec<u32>> {
        Some(self.indices.clone())
    }

    /// The number of triangles of each group.
    #[wasm_bindgen(getter, js_name = groupCounts)]
    pub fn group_counts(&self) -> Vec<u32> {
        self.counts.clone()
    }

    /// The names of the groups. A group without a name has an empty one.
    #[wasm_bindgen(getter, js_name = groupNames)]
    pub fn group_names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// 0: the triangles are the surface.
    #[wasm_bindgen(getter)]
    pub fn gap(&self) -> f64 {
        0.0
    }

    /// Metres per unit of the positions; undefined if the file does not state it.
    #[wasm_bindgen(getter)]
    pub fn unit(&self) -> Option<f64> {
        self.account.unit
    }

    /// `{notes, skipped}`, as those of a mesh.
    #[wasm_bindgen(getter)]
    pub fn account(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(&self.account)
    }
}

/// Reads the triangles of a STEP file without faces that can be read.
#[wasm_bindgen(js_name = readStepTriangles)]
pub fn read_step_triangles(bytes: &[u8]) -> Result<StepTriangles> {
    let (mut positions, mut indices) = (Vec::new(), Vec::new());
    let (mut names, mut counts) = (Vec::new(), Vec::new());
    let account = crate::read_step_meshes(bytes, |name, vertices, triangles, place| {
        let first = positions.len() / 3;
        if first + vertices.len() > MAX_PLACED || indices.len() / 3 + triangles.len() > MAX_PLACED {
            let found = format!("more than {MAX_PLACED} vertices or triangles");
            return Err(Error::StepUnreadable { found });
        }
        positions.extend(vertices.iter().flat_map(|&vertex| place.transform_point3(vertex).to_array()));
        // Under a map that mirrors, triangles are turned: what was outside stays outside.
        let is_mirrored = place.matrix3.determinant() < 0.0;
        let placed = |&[a, b, c]: &[u32; 3]| if is_mirrored { [a, c, b] } else { [a, b, c] };
        indices.extend(triangles.iter().flat_map(placed).map(|corner| corner + first as u32));
        if !triangles.is_empty() {
            names.push(name.unwrap_or_default().to_owned());
            counts.push(triangles.len() as u32);
        }
        Ok(())
    })?;
    Ok(StepTriangles { positions, indices, names, counts, account })
}
