//! The samples of a model.

use crate::axis::Axis;
use crate::bezier::{BezierModel, PatchGrid, uniform};
use serde::Deserialize;
use std::ops::Range;

use super::covering_radius::CoveringRadius;
use super::sample_grid::SampleGrid;

/// The distribution of the parameters along one axis over the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum SamplingRule {
    /// Evenly spaced parameters, as in the 2012 paper.
    #[default]
    Uniform,
    /// Even spacing in arc length, averaged over a few parameter lines.
    ArcLength,
}

/// All samples of a model.
#[derive(Debug, Clone)]
pub struct Sampling {
    /// One grid a surface.
    pub grids: Vec<SampleGrid>,
}

/// The largest number of samples of a page, unless one row has more: buffers of a
/// few MiB on the GPU, and enough work to keep it busy.
pub const PAGE_SAMPLES: usize = 1 << 18;

/// The number of parameter lines over which arc length is averaged.
const ARC_LENGTH_LINES: usize = 9;

/// The number of chords that approximate a parameter line on one patch.
const ARC_LENGTH_CHORDS: usize = 8;

impl Sampling {
    /// Places a grid of `samples` × `samples` parameters, at least 2 × 2, on every
    /// surface of `model`; the pieces of a trimmed face share as many cells between
    /// samples ([`PatchGrid::share`]).
    ///
    /// O(surfaces samples² + patches).
    #[must_use]
    pub fn new(model: &BezierModel, samples: usize, rule: SamplingRule) -> Self {
        let mut grids: Vec<SampleGrid> = Vec::with_capacity(model.grids.len());
        let mut first = 0;
        for grid in &model.grids {
            let parameters = Axis::BOTH.map(|axis| {
                let samples = grid.share(axis, samples - 1) + 1;
                match rule {
                    SamplingRule::Uniform => uniform(&grid.breaks[axis], samples),
                    SamplingRule::ArcLength => arc_length(model, grid, axis, samples),
                }
            });
            let locations = Axis::BOTH
                .map(|axis| parameters[axis].iter().map(|&parameter| grid.locate(axis, parameter)).collect());
            grids.push(SampleGrid { parameters, locations, first });
            first += grids.last().map_or(0, SampleGrid::len);
        }
        Self { grids }
    }

    /// Returns the covering radius over all surfaces of `model`, which must be that of the
    /// samples. O(cells + patches) times p q (p + q).
    #[must_use]
    pub fn radius(&self, model: &BezierModel) -> CoveringRadius {
        CoveringRadius::of_model(model, &self.grids)
    }

    /// Returns the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.grids.iter().map(SampleGrid::len).sum()
    }

    /// Returns whether there are no samples.
    #[cfg(feature = "internals")]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns the surface of sample `index`.
    #[must_use]
    pub fn surface(&self, index: usize) -> usize {
        self.grids.partition_point(|grid| grid.first <= index).max(1) - 1
    }

    /// Returns the parameters (u, v) of sample `index` on its surface.
    #[must_use]
    pub fn parameters(&self, index: usize) -> [f64; 2] {
        let grid = &self.grids[self.surface(index)];
        let (i, j) = grid.row_and_column(index);
        [grid.parameters[0][i], grid.parameters[1][j]]
    }

    /// Returns consecutive ranges of samples to process at a time: whole rows of
    /// grids, at most [`PAGE_SAMPLES`] or one row each.
    #[must_use]
    pub fn pages(&self) -> Vec<Range<usize>> {
        let mut pages: Vec<Range<usize>> = Vec::new();
        for grid in &self.grids {
            let [rows, columns] = grid.counts();
            for row in 0..rows {
                let end = grid.first + (row + 1) * columns;
                match pages.last_mut() {
                    Some(page) if end - page.start <= PAGE_SAMPLES => page.end = end,
                    _ => pages.push(end - columns..end),
                }
            }
        }
        pages
    }
}

/// Returns parameters that divide the summed length of a few parameter lines
/// along `axis` evenly.
fn arc_length(model: &BezierModel, grid: &PatchGrid, axis: Axis, samples: usize) -> Vec<f64> {
    let breaks = &grid.breaks[axis];
    let mut knots = vec![breaks[0]];
    let mut lengths = vec![0.0];
    let across = uniform(&grid.breaks[axis.other()], ARC_LENGTH_LINES);
    let across: Vec<_> = across.into_iter().map(|parameter| grid.locate(axis.other(), parameter)).collect();
    for span in 0..breaks.len() - 1 {
        for chord in 1..=ARC_LENGTH_CHORDS {
            let ends = [chord - 1, chord].map(|end| end as f64 / ARC_LENGTH_CHORDS as f64);
            let length: f64 = across
                .iter()
                .map(|&(across_span, across)| {
                    let (spans, at): ([usize; 2], [[f64; 2]; 2]) = if axis == Axis::U {
                        ([span, across_span], ends.map(|end| [end, across]))
                    } else {
                        ([across_span, span], ends.map(|end| [across, end]))
                    };
                    let patch = model.patches.patch(grid.first + spans[0] * grid.counts()[1] + spans[1]);
                    patch.point(at[0]).distance(patch.point(at[1]))
                })
                .sum();
            lengths.push(lengths[lengths.len() - 1] + length);
            knots.push((1.0 - ends[1]) * breaks[span] + ends[1] * breaks[span + 1]);
        }
    }
    let total = lengths[lengths.len() - 1];
    if total <= 0.0 {
        return uniform(breaks, samples);
    }
    let mut parameters: Vec<f64> = uniform(&[0.0, total], samples)
        .into_iter()
        .map(|target| {
            let next = lengths.partition_point(|&length| length <= target).clamp(1, lengths.len() - 1);
            let (low, high) = (lengths[next - 1], lengths[next]);
            let fraction = if high > low { ((target - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
            (1.0 - fraction) * knots[next - 1] + fraction * knots[next]
        })
        .collect();
    // Lines of zero length at an end of the domain must not remove the end from the samples.
    parameters[0] = breaks[0];
    parameters[samples - 1] = breaks[breaks.len() - 1];
    parameters
}
