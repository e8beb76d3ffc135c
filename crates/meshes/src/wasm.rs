//! The readers of meshes and clouds of points: what they give, the core's
//! `PreparedModel.fromFacets` takes. Those of scans are a module of their own, as their
//! decompression would add a third to what a mesh needs.

#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public, and nothing in Rust uses it")]

#[cfg(feature = "wasm-meshes")]
use crate::Beside;
use crate::{MeshFile, MeshFormat};
#[cfg(feature = "wasm-meshes")]
use js_sys::Uint8Array;
use nurbs_hausdorff::workspace::to_object;
use nurbs_hausdorff::{Error, Facets, MeshGroup, Note, Result, Skipped};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A mesh or a cloud of points that was read.
#[wasm_bindgen]
pub struct ReadMesh(MeshFile);

#[wasm_bindgen]
impl ReadMesh {
    /// x, y, z of every vertex or point.
    #[wasm_bindgen(getter)]
    pub fn positions(&self) -> Vec<f64> {
        let points = match &self.0.facets {
            Facets::Mesh(mesh) => mesh.vertices(),
            Facets::Cloud(cloud) => cloud.points(),
        };
        points.iter().flat_map(|point| point.to_array()).collect()
    }

    /// The indices of the corners of every triangle; undefined for a cloud.
    #[wasm_bindgen(getter)]
    pub fn triangles(&self) -> Option<Vec<u32>> {
        match &self.0.facets {
            Facets::Mesh(mesh) => Some(mesh.triangles().concat()),
            Facets::Cloud(_) => None,
        }
    }

    /// The number of triangles of each group; of a cloud none.
    #[wasm_bindgen(getter, js_name = groupCounts)]
    pub fn group_counts(&self) -> Vec<u32> {
        self.groups().iter().map(|group| group.triangles as u32).collect()
    }

    /// The names of the groups. A group without a name has an empty one.
    #[wasm_bindgen(getter, js_name = groupNames)]
    pub fn group_names(&self) -> Vec<String> {
        self.groups().iter().map(|group| group.name.clone().unwrap_or_default()).collect()
    }

    /// The distance of the triangles from the surface that they stand for, in units of the positions.
    #[wasm_bindgen(getter)]
    pub fn gap(&self) -> f64 {
        self.0.report().gap
    }

    /// Metres per unit of the positions; undefined if the file does not state it.
    #[wasm_bindgen(getter)]
    pub fn unit(&self) -> Option<f64> {
        self.0.unit
    }

    /// `{notes, skipped}`: the parts of the file with a decision about them, and those that are not read.
    #[wasm_bindgen(getter)]
    pub fn account(&self) -> std::result::Result<JsValue, JsValue> {
        to_object(&Account { notes: &self.0.notes, skipped: &self.0.skipped })
    }
}

/// What the report says of parts.
#[derive(Serialize)]
struct Account<'a> {
    notes: &'a [Note],
    skipped: &'a [Skipped],
}

/// Reads a mesh or a cloud of points of a file with this ending of its name, of all formats but
/// those of scans. The files beside it, as the buffers of a glTF, have these paths from its folder, as many as
/// contents.
#[cfg(feature = "wasm-meshes")]
#[wasm_bindgen(js_name = readMesh)]
pub fn read_mesh(
    bytes: &[u8],
    ending: &str,
    paths: Vec<String>,
    contents: Vec<Uint8Array>,
) -> Result<ReadMesh> {
    let beside: Beside = paths.into_iter().zip(contents.iter().map(Uint8Array::to_vec)).collect();
    Ok(ReadMesh(MeshFile::read_mesh(bytes, format_of(bytes, ending)?, &beside)?))
}

/// Reads a scan of a file with this ending of its name: LAS, LAZ or E57.
#[cfg(feature = "wasm-scans")]
#[wasm_bindgen(js_name = readScan)]
pub fn read_scan(bytes: &[u8], ending: &str) -> Result<ReadMesh> {
    Ok(ReadMesh(MeshFile::read_scan(bytes, format_of(bytes, ending)?)?))
}

fn format_of(bytes: &[u8], ending: &str) -> Result<MeshFormat> {
    MeshFormat::of_file(bytes, &format!(".{ending}"))?.ok_or_else(|| Error::OptionInvalid {
        found: format!("the format is {ending:?}, expected the ending of a name of a mesh's file"),
    })
}

impl ReadMesh {
    fn groups(&self) -> &[MeshGroup] {
        match &self.0.facets {
            Facets::Mesh(mesh) => mesh.groups(),
            Facets::Cloud(_) => &[],
        }
    }
}
