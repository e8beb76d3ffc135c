//! What a backend does for method `iteration`.

use super::{Progress, StatusCounts};
use crate::error::Result;
use crate::iteration::Projected;
use std::ops::Range;

/// A sample that may be the farthest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// Index of the sample in its sampling.
    pub(crate) sample: usize,
    /// What its projection found.
    pub(crate) projected: Projected,
}

/// The stages `sample`, `project` and `reduce` on one page of samples at a time.
pub(crate) trait Stages {
    /// How much a distance of [`Candidate::projected`] can be off, besides
    /// belonging to a point of the target.
    fn distance_error(&self) -> f64;

    /// Samples and projects page `index` of the sampling.
    async fn project(&mut self, index: usize, page: &Range<usize>, progress: &mut Progress<'_>)
    -> Result<()>;

    /// The page's farthest sample and, as they come at no cost, more of the
    /// far ones; farthest first.
    async fn reduce(&mut self) -> Result<Vec<Candidate>>;

    /// Puts a better squared distance in the place of a sample's.
    fn settle(&mut self, sample: usize, distance_squared: f64);

    /// How the page's projections ended.
    async fn statuses(&mut self) -> Result<StatusCounts>;

    /// Everything found on the page.
    async fn field(&mut self) -> Result<Vec<Projected>>;
}
