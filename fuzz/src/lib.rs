//! The fuzz targets' properties, which the test binary `soundness` also checks.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs, reason = "a panic is how a fuzz target fails")]

#[path = "../../tests/soundness/fuzz/mod.rs"]
pub mod fuzz;

mod support;
