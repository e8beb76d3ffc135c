//! The stages of method `iteration` on either backend.

use super::cpu::CpuIteration;
use crate::error::Result;
use crate::gpu::GpuIteration;
use crate::iteration::{Candidate, Projected, StatusCounts};
use crate::progress::Progress;
use std::ops::Range;

/// The stages `sample`, `project` and `reduce`, which process one page of samples
/// at a time.
pub(super) enum IterationBackend<'a> {
    /// In float64.
    Cpu(CpuIteration<'a>),
    /// In float32.
    Gpu(Box<GpuIteration>),
}

impl IterationBackend<'_> {
    /// Returns the seconds spent on the creation of pipelines.
    pub(super) fn compile_seconds(&self) -> f64 {
        match self {
            Self::Cpu(_) => 0.0,
            Self::Gpu(stages) => stages.compile_seconds(),
        }
    }

    /// Returns an upper bound on the rounding error of a distance in
    /// [`Candidate::projected`].
    pub(super) fn distance_error(&self) -> f64 {
        match self {
            Self::Cpu(_) => 0.0,
            Self::Gpu(stages) => stages.distance_error(),
        }
    }

    /// Evaluates and projects the samples of page `index`.
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

    /// Returns far samples of the page, the farthest first: one of every block.
    pub(super) async fn reduce(&mut self) -> Result<Vec<Candidate>> {
        match self {
            Self::Cpu(stages) => Ok(stages.reduce()),
            Self::Gpu(stages) => stages.reduce().await,
        }
    }

    /// Replaces the squared distance of a sample by a better one.
    pub(super) fn set_distance_squared(&mut self, sample: usize, distance_squared: f64) {
        match self {
            Self::Cpu(stages) => stages.set_distance_squared(sample, distance_squared),
            Self::Gpu(stages) => stages.set_distance_squared(sample, distance_squared),
        }
    }

    /// Returns the numbers of the page's projections by status.
    pub(super) fn statuses(&self) -> StatusCounts {
        match self {
            Self::Cpu(stages) => stages.statuses(),
            Self::Gpu(stages) => stages.statuses(),
        }
    }

    /// Returns the projections of all samples of the page.
    pub(super) async fn field(&self) -> Result<Vec<Projected>> {
        match self {
            Self::Cpu(stages) => Ok(stages.field()),
            Self::Gpu(stages) => stages.field().await,
        }
    }
}
