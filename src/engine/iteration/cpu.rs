//! The stages of method `iteration` in float64 on the CPU: reference and fallback.

use crate::bezier::BezierModel;
use crate::closest::{Status, Target};
use crate::error::Result;
use crate::iteration::{Candidate, Projected, Rule, Sampling, StatusCounts, project, reduce, sample};
use crate::model::RigidTransform;
use crate::progress::Progress;
use crate::threads::parallel::map;
use std::ops::Range;

/// The number of samples between two checkpoints.
const CHUNK: usize = 512;

/// The data of one direction, and the current page.
pub(super) struct CpuIteration<'a> {
    model: &'a BezierModel,
    sampling: &'a Sampling,
    target: &'a Target,
    transform: RigidTransform,
    rule: Rule,
    /// The first sample of the page.
    first: usize,
    projected: Vec<Projected>,
}

impl<'a> CpuIteration<'a> {
    pub(super) fn new(
        model: &'a BezierModel,
        sampling: &'a Sampling,
        target: &'a Target,
        transform: RigidTransform,
        rule: Rule,
    ) -> Self {
        Self { model, sampling, target, transform, rule, first: 0, projected: Vec::new() }
    }

    pub(super) async fn project(&mut self, page: &Range<usize>, progress: &mut Progress<'_>) -> Result<()> {
        self.first = page.start;
        self.projected.clear();
        let project_sample = |index: usize| {
            project(self.target, sample(self.model, self.sampling, index, &self.transform), &self.rule)
        };
        for start in page.clone().step_by(CHUNK) {
            progress.checkpoint((start - page.start) as f64 / page.len() as f64).await?;
            let chunk = start..(start + CHUNK).min(page.end);
            self.projected.append(&mut map(chunk.len(), |offset| project_sample(chunk.start + offset)));
        }
        Ok(())
    }

    pub(super) fn reduce(&self) -> Vec<Candidate> {
        let candidate = |index| Candidate { sample: self.first + index, projected: self.projected[index] };
        reduce(&self.projected).into_iter().map(candidate).collect()
    }

    pub(super) fn set_distance_squared(&mut self, sample: usize, distance_squared: f64) {
        self.projected[sample - self.first].distance_squared = distance_squared;
    }

    pub(super) fn statuses(&self) -> StatusCounts {
        let mut counts = StatusCounts::default();
        for projected in &self.projected {
            match projected.status {
                Status::Converged => counts.converged += 1,
                Status::IterationLimit => counts.iteration_limit += 1,
                Status::OnEdge => counts.on_edge += 1,
            }
        }
        counts
    }

    pub(super) fn field(&self) -> Vec<Projected> {
        self.projected.clone()
    }
}
