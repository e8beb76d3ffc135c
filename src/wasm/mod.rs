//! What JavaScript sees of the crate. The package's own API, in `src/js`, is
//! made of these classes and hides them.
#![expect(unreachable_pub, reason = "wasm-bindgen exports what is public, and nothing in Rust uses it")]

mod engine;
mod failure;
mod model;
mod monitor;
mod object;
mod options;
mod plain;
mod result;
mod surfaces;
mod tessellation;
mod value;
