//! Models, Bézier patches, shapes, display triangles and closest points: the geometry that the methods stand on.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod bezier;
mod closest;
mod models;
mod trims;
