//! Models, Bézier patches, shapes, display triangles and closest points: the geometry that the methods stand on.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod attained_bounds;
mod bezier_patches;
mod bvh;
mod closest_point;
mod local_derivative_bounds;
mod model_properties;
mod model_validation;
mod newton_and_tangent_plane;
mod shape_operations;
mod shapes;
mod tessellation;
mod trim_validation;
mod untrim;
