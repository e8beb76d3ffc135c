//! The kernels against float64, and at the ends of float32.
#![cfg(not(target_arch = "wasm32"))]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod certified_gpu;
mod closest_points;
mod float32_extremes;
mod iteration_kernels;
#[cfg(target_os = "linux")]
mod trimmed;
