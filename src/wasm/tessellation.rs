//! Triangles on their way out, as typed arrays.

use super::object::object;
use crate::tessellate::Tessellation;
use js_sys::{Array, Float32Array, Uint32Array};
use wasm_bindgen::JsValue;

/// The package's own shape of it.
pub(super) fn plain(tessellation: &Tessellation) -> JsValue {
    let number = |count: usize| JsValue::from_f64(count as f64);
    let surfaces = Array::new();
    for range in &tessellation.surfaces {
        surfaces.push(&object(&[("firstIndex", number(range.start)), ("indexCount", number(range.len()))]));
    }
    let origin = Array::new();
    for coordinate in tessellation.origin.to_array() {
        origin.push(&coordinate.into());
    }
    object(&[
        ("positions", Float32Array::from(tessellation.positions.as_slice()).into()),
        ("normals", Float32Array::from(tessellation.normals.as_slice()).into()),
        ("indices", Uint32Array::from(tessellation.indices.as_slice()).into()),
        ("origin", origin.into()),
        ("surfaces", surfaces.into()),
    ])
}
