//! Method `iteration`: the 2012 paper's sampling and projection.
//!
//! Stages, each with the same name in the kernels: `sample` the moving model,
//! `project` every sample on the other model's flat patches, `reduce` to the
//! largest distance. The bounds `k_a` come with the samples.

mod covering_radius;
mod project;
mod reduce;
mod sample;
mod sampling;

pub use covering_radius::CoveringRadius;
pub(crate) use covering_radius::cell_pieces;
pub use project::{Culling, project};
pub(crate) use reduce::BLOCK_SIZE;
pub use reduce::reduce;
pub use sample::sample;
pub(crate) use sampling::uniform;
pub use sampling::{PAGE_SAMPLES, SampleGrid, Sampling, SamplingRule};

use crate::closest::{Projection, Status};
use serde::Serialize;

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

/// A sample that may be the farthest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// Index of the sample in its sampling.
    pub(crate) sample: usize,
    /// What its projection found.
    pub(crate) projected: Projected,
}

/// Numbers of samples by how their projection ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct StatusCounts {
    /// At a stationary point.
    pub converged: usize,
    /// At the iteration limit.
    pub iteration_limit: usize,
    /// At a patch's edge.
    pub on_edge: usize,
}

impl std::ops::AddAssign for StatusCounts {
    fn add_assign(&mut self, other: Self) {
        self.converged += other.converged;
        self.iteration_limit += other.iteration_limit;
        self.on_edge += other.on_edge;
    }
}
