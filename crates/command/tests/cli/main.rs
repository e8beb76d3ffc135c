//! The command line.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../../../../tests/support/mod.rs"]
mod support;

mod commands;
mod edge_cases;
mod files;
mod many;
mod measures;
mod memory;
mod pictures;
mod readme;
