//! Intervals of all methods against what others computed, brute force and the published experiments.
#![cfg(not(target_arch = "wasm32"))]
// Prepared models that threads share hold types of wgpu, nested deeper than 128.
#![recursion_limit = "256"]
#![allow(clippy::unwrap_used, clippy::panic, reason = "a panic is how a test fails")]

// Three examples are tools whose answers are tested here, by a module of each.
#[path = "../../examples/verify/cuts.rs"]
mod cuts;
#[path = "../../examples/honesty/fuzzer/mod.rs"]
mod fuzzer;
#[path = "../repro/mod.rs"]
mod pairs;
#[path = "../../examples/verify/proof/mod.rs"]
mod proof;
#[path = "../../examples/experiments/suite/mod.rs"]
mod suite;
#[path = "../support/mod.rs"]
mod support;

mod allowances;
mod experiments;
mod fuzz;
mod fuzz_seeds;
mod known_pairs;
mod nan_folds;
mod random_pairs;
mod reference_pairs;
mod verify;
