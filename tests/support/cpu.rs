//! Distances in float64.

use super::gpu;
use nurbs_hausdorff::Model;
use nurbs_hausdorff::internals::engine::{DistanceOptions, DistanceResult, Engine};

/// The distance of two models without a GPU, prepared for this once.
pub fn measure(a: &Model, b: &Model, options: &DistanceOptions) -> DistanceResult {
    let engine = Engine::cpu();
    gpu::measure(&engine, a, b, options)
}
