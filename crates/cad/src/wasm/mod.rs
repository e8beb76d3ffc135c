//! The exports of the npm package's module that reads CAD files.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public, and nothing in Rust uses it")]

mod models;
mod triangles;
