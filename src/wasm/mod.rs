//! The exports of the npm package's core, with the feature `wasm`, and what all of the package's wasm modules have in
//! common. The package's own API, in `src/js`, is built on them and hides them.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public, and nothing in Rust uses it")]

#[cfg(feature = "wasm")]
mod call;
#[cfg(feature = "wasm")]
mod convert;
#[cfg(feature = "wasm")]
mod engine;
mod failure;
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

pub use failure::to_object;
use wasm_bindgen::prelude::wasm_bindgen;

/// Runs when the module is loaded: panics print their message to the console.
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}
