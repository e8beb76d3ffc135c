//! The stages in float64 on the CPU: reference and fallback.

use crate::bezier::BezierModel;
use crate::closest::{Status, Target};
use crate::error::Result;
use crate::iteration::Candidate;
use crate::iteration::StatusCounts;
use crate::iteration::{Projected, Rule, Sampling, project, reduce, sample};
use crate::model::RigidTransform;
use crate::parallel::map;
use crate::progress::Progress;
use std::ops::Range;

/// Samples between two looks at the monitor.
const CHUNK: usize = 512;

/// One direction's data, and the page in work.
pub(super) struct CpuStages<'a> {
    pub(super) model: &'a BezierModel,
    pub(super) sampling: &'a Sampling,
    pub(super) target: &'a Target,
    pub(super) transform: RigidTransform,
    pub(super) rule: Rule,
    first: usize,
    projected: Vec<Projected>,
}

impl<'a> CpuStages<'a> {
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
        let one = |index: usize| {
            project(self.target, sample(self.model, self.sampling, index, &self.transform), &self.rule)
        };
        for start in page.clone().step_by(CHUNK) {
            progress.checkpoint((start - page.start) as f64 / page.len() as f64).await?;
            let chunk = start..(start + CHUNK).min(page.end);
            self.projected.append(&mut map(chunk.len(), |offset| one(chunk.start + offset)));
        }
        Ok(())
    }

    pub(super) fn reduce(&self) -> Vec<Candidate> {
        let candidate = |index| Candidate { sample: self.first + index, projected: self.projected[index] };
        reduce(&self.projected).into_iter().map(candidate).collect()
    }

    pub(super) fn settle(&mut self, sample: usize, distance_squared: f64) {
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
