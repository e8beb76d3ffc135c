//! The command line.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod align;
mod archives;
mod batch;
mod check;
mod commands;
mod edge_cases;
mod gaps;
mod grid;
mod mesh_files;
mod meshes;
mod overlap;
mod pairs;
mod pictures;
mod readme;
mod rhino;
mod score;
mod trimmed;
mod verdicts;
