//! Benchmarks of single stages, which are no part of the interface, and tests
//! of the kernels' layouts and of the float32 error bounds.

#[cfg(test)]
pub(crate) mod adapter;
#[cfg(test)]
mod attained;
#[cfg(test)]
mod cell_boxes;
#[cfg(test)]
mod cell_error;
mod certified_bench;
#[cfg(test)]
mod closest_points;
mod iteration_bench;
#[cfg(test)]
mod layouts;
#[cfg(test)]
mod projection_error;

pub use certified_bench::{CertifiedBench, CertifiedStage};
pub use iteration_bench::IterationBench;
