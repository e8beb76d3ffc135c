//! Method `iteration`: sampling of one model and projection on the other.
//!
//! The method is that of I. Hanniel, A. Krishnamurthy and S. McMains, *Computing
//! the Hausdorff distance between NURBS surfaces using numerical iteration on the
//! GPU*, Graphical Models 74 (2012), 255–264, "the 2012 paper" below. Its stages
//! have the same names in the kernels: `sample` evaluates points of the moving
//! model, `project` finds the foot of every sample on the other model's flat
//! patches, and `reduce` finds the largest distance. The sampling error, the
//! paper's K_A, is computed with the sampling ([`CoveringRadius`]).

mod covering_radius;
mod project;
mod reduce;
mod sample;
mod sample_grid;
mod sampling;

pub use covering_radius::CoveringRadius;
pub use project::{Culling, project};
pub(crate) use reduce::BLOCK_SIZE;
pub use reduce::reduce;
pub use sample::sample;
pub use sample_grid::SampleGrid;
#[cfg(feature = "internals")]
pub use sampling::PAGE_SAMPLES;
pub use sampling::{Sampling, SamplingRule};

use crate::closest::{Projection, Status};
use serde::Serialize;

/// The projection of one sample on the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projected {
    /// The squared distance from the sample to its foot.
    pub distance_squared: f64,
    /// The index of the flat patch on which the foot lies.
    pub patch: usize,
    /// The parameters (s, t) of the foot on it.
    pub parameters: [f64; 2],
    /// The way in which the iteration on that patch ended.
    pub status: Status,
}

/// The parameters of the projection of samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule {
    /// The step of the iteration.
    pub projection: Projection,
    /// The largest number of steps on one patch.
    pub iterations: u32,
    /// The change of distance below which the tangent-plane iteration ends, the paper's E_B.
    pub step_tolerance: f64,
    /// The choice of patches that a sample is projected on.
    pub culling: Culling,
}

/// A sample that may be the farthest one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// The index of the sample in its sampling.
    pub(crate) sample: usize,
    /// Its projection.
    pub(crate) projected: Projected,
}

/// The numbers of samples by the status of their projection.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct StatusCounts {
    /// Projections that ended at a stationary point.
    pub converged: usize,
    /// Projections that ended at the iteration limit.
    pub iteration_limit: usize,
    /// Projections that ended at an edge of a patch.
    pub on_edge: usize,
}

impl std::ops::AddAssign for StatusCounts {
    fn add_assign(&mut self, other: Self) {
        self.converged += other.converged;
        self.iteration_limit += other.iteration_limit;
        self.on_edge += other.on_edge;
    }
}
