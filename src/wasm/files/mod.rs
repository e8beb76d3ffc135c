//! The exports of the modules that read files.

#[cfg(any(feature = "wasm-meshes", feature = "wasm-scans"))]
mod meshes;
#[cfg(feature = "wasm-readers")]
mod readers;
#[cfg(feature = "wasm-readers")]
mod triangles;
