//! The exports of the crate's four wasm modules: the classes of the core, with the feature
//! `wasm`, the readers of CAD files, with `wasm-readers`, those of meshes, with `wasm-meshes`,
//! and those of scans, with `wasm-scans`. The package's own API, in `src/js`, is built on them and
//! hides them.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public, and nothing in Rust uses it")]

#[cfg(feature = "wasm")]
mod call;
#[cfg(feature = "wasm")]
mod convert;
#[cfg(feature = "wasm")]
mod engine;
mod failure;
mod files;
#[cfg(feature = "wasm")]
mod maps;
#[cfg(feature = "wasm")]
mod model;
#[cfg(feature = "wasm")]
mod progress;
#[cfg(feature = "wasm")]
mod surfaces;
#[cfg(feature = "wasm")]
mod workers;

use wasm_bindgen::prelude::wasm_bindgen;

/// Runs when the module is loaded: panics print their message to the console.
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}
