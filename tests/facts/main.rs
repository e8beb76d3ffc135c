//! Bodies of models, and their facts: intervals that contain what formulas and exact arithmetic state.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod bodies;
mod check;
mod coincidence;
mod embedding;
mod exact;
mod formulas;
mod hints;
mod models;
mod overlap;
mod revisions;
mod shells;
