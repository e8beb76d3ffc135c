//! The three methods against distances known from geometry.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod bisector_maxima;
mod certified;
mod closest_points;
mod copies_and_offsets;
mod diff;
mod field;
mod hierarchy_accuracy;
mod hierarchy_boxes;
mod iteration_accuracy;
mod iteration_sampling;
mod revolution_and_spheres;
mod scales;
mod trimmed;
mod update;
