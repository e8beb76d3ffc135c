//! What a backend does for method `iteration`.

use super::iteration_cpu::CpuStages;
use crate::error::Result;
use crate::gpu::GpuIteration;
use crate::iteration::{Candidate, Projected, StatusCounts};
use crate::progress::Progress;
use std::ops::Range;

/// The stages `sample`, `project` and `reduce` on one page of samples at a
/// time, on either backend: what drives them is compiled once.
pub(super) enum Stages<'a> {
    Cpu(CpuStages<'a>),
    Gpu(Box<GpuIteration>),
}

impl Stages<'_> {
    /// Seconds that making new pipelines took.
    pub(super) fn compile_seconds(&self) -> f64 {
        match self {
            Self::Cpu(_) => 0.0,
            Self::Gpu(stages) => stages.compile_seconds(),
        }
    }

    /// How much a distance of [`Candidate::projected`] can be off, besides
    /// belonging to a point of the target.
    pub(super) fn distance_error(&self) -> f64 {
        match self {
            Self::Cpu(_) => 0.0,
            Self::Gpu(stages) => stages.distance_error(),
        }
    }

    /// Samples and projects page `index` of the sampling.
    pub(super) async fn project(
        &mut self,
        index: usize,
        page: &Range<usize>,
        progress: &mut Progress<'_>,
    ) -> Result<()> {
        match self {
            Self::Cpu(stages) => stages.project(page, progress).await,
            Self::Gpu(stages) => stages.project(index, page, progress).await,
        }
    }

    /// The page's farthest sample and, as they come at no cost, more of the
    /// far ones; farthest first.
    pub(super) async fn reduce(&mut self) -> Result<Vec<Candidate>> {
        match self {
            Self::Cpu(stages) => Ok(stages.reduce()),
            Self::Gpu(stages) => stages.reduce().await,
        }
    }

    /// Puts a better squared distance in the place of a sample's.
    pub(super) fn settle(&mut self, sample: usize, distance_squared: f64) {
        match self {
            Self::Cpu(stages) => stages.settle(sample, distance_squared),
            Self::Gpu(stages) => stages.set_distance_squared(sample, distance_squared),
        }
    }

    /// How the page's projections ended.
    pub(super) fn statuses(&self) -> StatusCounts {
        match self {
            Self::Cpu(stages) => stages.statuses(),
            Self::Gpu(stages) => stages.statuses(),
        }
    }

    /// Everything found on the page.
    pub(super) async fn field(&self) -> Result<Vec<Projected>> {
        match self {
            Self::Cpu(stages) => Ok(stages.field()),
            Self::Gpu(stages) => stages.field().await,
        }
    }
}
