//! Tests and benchmarks of the kernels.

#[cfg(all(test, not(target_arch = "wasm32")))]
mod adapter;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod cell_boxes;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod cell_error;
mod certified_bench;
mod iteration_bench;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod projection_error;

pub use certified_bench::{LevelBench, LevelStage};
pub use iteration_bench::StageBench;
