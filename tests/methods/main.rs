//! The three methods against distances known from geometry.
// Models that threads share own buffers of a GPU, whose types are nested deeply.
#![recursion_limit = "256"]
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod certified;
mod hierarchy;
mod iteration;
mod mesh_faces;
mod meshes;
mod queries;
mod statistics;
mod threads;
mod trimmed;
