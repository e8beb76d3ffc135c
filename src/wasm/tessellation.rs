//! Triangles on their way out, as typed arrays.

use crate::tessellate;
use wasm_bindgen::prelude::*;

/// Each array is copied out of the module's memory when it is asked for.
#[wasm_bindgen]
pub struct Tessellation(tessellate::Tessellation);

#[wasm_bindgen]
impl Tessellation {
    #[wasm_bindgen(getter)]
    pub fn positions(&self) -> Vec<f32> {
        self.0.positions.clone()
    }

    #[wasm_bindgen(getter)]
    pub fn normals(&self) -> Vec<f32> {
        self.0.normals.clone()
    }

    #[wasm_bindgen(getter)]
    pub fn indices(&self) -> Vec<u32> {
        self.0.indices.clone()
    }

    #[wasm_bindgen(getter)]
    pub fn origin(&self) -> Vec<f64> {
        self.0.origin.to_array().to_vec()
    }

    /// First index and number of indices of every surface, by turns.
    #[wasm_bindgen(getter)]
    pub fn surfaces(&self) -> Vec<u32> {
        self.0.surfaces.iter().flat_map(|range| [range.start as u32, range.len() as u32]).collect()
    }
}

impl From<tessellate::Tessellation> for Tessellation {
    fn from(tessellation: tessellate::Tessellation) -> Self {
        Self(tessellation)
    }
}
