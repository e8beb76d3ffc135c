//! The readers of CAD files: each takes a file's bytes, and gives what the core's
//! `PreparedModel.fromRead` takes. The function, if any, is called for every face that was read with
//! the part of the faces that is read and ends of segments along the face's edges, x, y, z each.

use crate::OnFace;
use glam::DVec3;
use js_sys::{Float64Array, Function};
use nurbs_hausdorff::workspace::Assembled;
use nurbs_hausdorff::{Error, Result};
use wasm_bindgen::prelude::*;

/// Reads the BREP text of OpenCASCADE.
#[wasm_bindgen(js_name = readBrep)]
pub fn read_brep(bytes: &[u8], on_face: Option<Function>) -> std::result::Result<Vec<u8>, JsValue> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        Error::BrepSyntax { line, found: "bytes that are no text".to_owned(), expected: "UTF-8".to_owned() }
    })?;
    watched(on_face, |tell| crate::read_brep(text, tell))
}

/// Reads a STEP file.
#[wasm_bindgen(js_name = readStep)]
pub fn read_step(bytes: &[u8], on_face: Option<Function>) -> std::result::Result<Vec<u8>, JsValue> {
    watched(on_face, |tell| crate::read_step(bytes, tell))
}

/// Reads an IGES file.
#[wasm_bindgen(js_name = readIges)]
pub fn read_iges(bytes: &[u8], on_face: Option<Function>) -> std::result::Result<Vec<u8>, JsValue> {
    watched(on_face, |tell| crate::read_iges(bytes, tell))
}

/// Reads with the listener of the caller; what it throws is thrown when the file is read.
fn watched(
    on_face: Option<Function>,
    read: impl FnOnce(Option<OnFace<'_>>) -> Result<Assembled>,
) -> std::result::Result<Vec<u8>, JsValue> {
    let Some(on_face) = on_face else { return Ok(read(None)?.to_bytes()?) };
    let mut thrown = None;
    let mut tell = |part: f64, ends: &[DVec3]| {
        let ends: Vec<f64> = ends.iter().flat_map(DVec3::to_array).collect();
        let ends = Float64Array::from(ends.as_slice());
        if thrown.is_none() {
            thrown = on_face.call2(&JsValue::UNDEFINED, &part.into(), &ends).err();
        }
    };
    let bytes = read(Some(&mut tell))?.to_bytes()?;
    thrown.map_or(Ok(bytes), Err)
}
