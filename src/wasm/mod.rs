//! The classes that JavaScript sees of the crate. The package's own API, in
//! `src/js`, is built on these classes and hides them.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public, and nothing in Rust uses it")]

mod call;
mod convert;
mod engine;
mod model;
mod progress;
mod surfaces;

use wasm_bindgen::prelude::wasm_bindgen;

/// Runs when the module is loaded: panics print their message to the console.
#[wasm_bindgen(start)]
pub fn start() {
    console_error_panic_hook::set_once();
}
