//! Distances in float64.

use super::gpu;
use nurbs_hausdorff::Model;
use nurbs_hausdorff::engine::{DistanceResult, Engine, Options};

/// The distance of two models without a GPU, prepared for this once.
pub fn measure(a: &Model, b: &Model, options: &Options) -> DistanceResult {
    let engine = Engine::cpu();
    gpu::measure(&engine, a, b, options)
}
