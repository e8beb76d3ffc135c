//! Method `iteration`: the 2012 paper's sampling and projection.
//!
//! Stages, each with the same name in the kernels: `sample` the moving model,
//! `project` every sample on the other model's flat patches, `reduce` to the
//! largest distance. The bounds `k_a` come with the samples.

mod cells;
mod project;
mod reduce;
mod sample;
mod sampling;

pub use cells::CellRadius;
pub(crate) use cells::cell_pieces;
pub use project::{Culling, project};
pub use reduce::reduce;
pub use sample::sample;
pub(crate) use sampling::uniform;
pub use sampling::{PAGE_SAMPLES, SampleGrid, Sampling, SamplingRule};

use crate::project::{Projection, Status};

/// What the projection of one sample found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projected {
    /// Squared distance from the sample to the foot.
    pub distance_squared: f64,
    /// Index of the flat patch the foot lies on.
    pub patch: usize,
    /// The foot's (s, t) on it.
    pub parameters: [f64; 2],
    /// How the iteration on that patch ended.
    pub status: Status,
}

/// How samples are projected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule {
    /// The step.
    pub projection: Projection,
    /// Steps on one patch, at most.
    pub iterations: u32,
    /// The change of distance that ends the tangent-plane iteration.
    pub step_tolerance: f64,
    /// Which patches are tried.
    pub culling: Culling,
}
