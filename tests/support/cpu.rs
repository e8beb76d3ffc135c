//! Distances in float64.

use super::gpu;
use nurbs_hausdorff::Model;
use nurbs_hausdorff::engine::{Backend, DistanceResult, Engine, Options};

/// The distance of two models without a GPU, prepared for this once.
pub fn measure(a: &Model, b: &Model, options: &Options) -> DistanceResult {
    let engine = pollster::block_on(Engine::new(Backend::Cpu)).unwrap();
    gpu::measure(&engine, a, b, options)
}
