//! The readers of CAD files: each takes a file's bytes, and gives what the core's
//! `PreparedModel.fromRead` takes.

use crate::brep;
use crate::error::{Error, Result};
use wasm_bindgen::prelude::*;

/// Reads the BREP text of OpenCASCADE.
#[wasm_bindgen(js_name = readBrep)]
pub fn read_brep(bytes: &[u8]) -> Result<Vec<u8>> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        Error::BrepSyntax { line, found: "bytes that are no text".to_owned(), expected: "UTF-8".to_owned() }
    })?;
    brep::read_brep(text)?.to_bytes()
}

/// Reads a STEP file.
#[wasm_bindgen(js_name = readStep)]
pub fn read_step(bytes: &[u8]) -> Result<Vec<u8>> {
    brep::read_step(bytes)?.to_bytes()
}

/// Reads an IGES file.
#[wasm_bindgen(js_name = readIges)]
pub fn read_iges(bytes: &[u8]) -> Result<Vec<u8>> {
    brep::read_iges(bytes)?.to_bytes()
}
