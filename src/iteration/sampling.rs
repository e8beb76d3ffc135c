//! Where a model is sampled.

use crate::bezier::{BezierModel, PatchGrid};
use serde::Deserialize;
use std::ops::Range;

use super::CoveringRadius;

/// How the n parameters of a direction are spread over the domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SamplingRule {
    /// Evenly in the parameter, as in the paper.
    #[default]
    Uniform,
    /// Evenly in arc length, averaged over lines across the surface.
    ArcLength,
}

/// The tensor grid of samples of one surface.
#[derive(Debug, Clone, PartialEq)]
pub struct SampleGrid {
    /// The parameters in u and v, rising, the domain's ends included.
    pub parameters: [Vec<f64>; 2],
    /// For every parameter, the patch along its direction and the place on it in [0, 1].
    pub places: [Vec<(usize, f64)>; 2],
    /// Index of the surface's first sample; v runs fastest.
    pub first: usize,
}

/// All samples of a model, with the radii of the cells between them.
#[derive(Debug, Clone)]
pub struct Sampling {
    /// One grid a surface.
    pub grids: Vec<SampleGrid>,
    /// The largest cell radii over all surfaces.
    pub radius: CoveringRadius,
}

/// Samples of a page, at most: buffers of a few MiB on the GPU, and grids of
/// the default size enough to keep it busy.
pub const PAGE_SAMPLES: usize = 1 << 18;

/// Lines across the surface that an arc length is averaged over.
const ARC_LENGTH_LINES: usize = 9;

/// Chords a patch's side is measured by.
const ARC_LENGTH_CHORDS: usize = 8;

impl Sampling {
    /// `samples` x `samples` parameters on every surface of `model`; at least 2.
    ///
    /// O(surfaces samples^2 + patches).
    #[must_use]
    pub fn new(model: &BezierModel, samples: usize, rule: SamplingRule) -> Self {
        let mut grids: Vec<SampleGrid> = Vec::with_capacity(model.grids.len());
        for grid in &model.grids {
            let parameters = [0, 1].map(|axis| match rule {
                SamplingRule::Uniform => uniform(&grid.breaks[axis], samples),
                SamplingRule::ArcLength => arc_length(model, grid, axis, samples),
            });
            let places = [0, 1]
                .map(|axis| parameters[axis].iter().map(|&parameter| grid.locate(axis, parameter)).collect());
            grids.push(SampleGrid { parameters, places, first: grids.len() * samples * samples });
        }
        let radius = CoveringRadius::of_all(model, &grids);
        Self { grids, radius }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.grids.iter().map(SampleGrid::len).sum()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The surface of sample `index`.
    #[must_use]
    pub fn surface(&self, index: usize) -> usize {
        self.grids.partition_point(|grid| grid.first <= index).max(1) - 1
    }

    /// The (u, v) of sample `index` on its surface.
    #[must_use]
    pub fn parameters(&self, index: usize) -> [f64; 2] {
        let grid = &self.grids[self.surface(index)];
        let (i, j) = grid.row_and_column(index);
        [grid.parameters[0][i], grid.parameters[1][j]]
    }

    /// Ranges of samples, whole rows of a grid each, of at most
    /// [`PAGE_SAMPLES`] (or one row), in order: what is worked on at a time.
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

impl SampleGrid {
    /// Numbers of samples along u and v.
    #[must_use]
    pub fn counts(&self) -> [usize; 2] {
        [self.parameters[0].len(), self.parameters[1].len()]
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.parameters[0].len() * self.parameters[1].len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Along u and v, the place in the grid of the model's sample `index`.
    #[must_use]
    pub fn row_and_column(&self, index: usize) -> (usize, usize) {
        let columns = self.parameters[1].len();
        ((index - self.first) / columns, (index - self.first) % columns)
    }
}

/// `samples` parameters evenly from the first of `breaks` to the last.
pub(crate) fn uniform(breaks: &[f64], samples: usize) -> Vec<f64> {
    let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
    (0..samples)
        .map(|index| {
            let fraction = index as f64 / (samples - 1) as f64;
            (1.0 - fraction) * start + fraction * end
        })
        .collect()
}

/// Parameters that cut the summed length of a few lines along `axis` evenly.
fn arc_length(model: &BezierModel, grid: &PatchGrid, axis: usize, samples: usize) -> Vec<f64> {
    let breaks = &grid.breaks[axis];
    let mut knots = vec![breaks[0]];
    let mut lengths = vec![0.0];
    let across = uniform(&grid.breaks[1 - axis], ARC_LENGTH_LINES);
    let across: Vec<_> = across.into_iter().map(|parameter| grid.locate(1 - axis, parameter)).collect();
    for span in 0..breaks.len() - 1 {
        for chord in 1..=ARC_LENGTH_CHORDS {
            let ends = [chord - 1, chord].map(|end| end as f64 / ARC_LENGTH_CHORDS as f64);
            let length: f64 = across
                .iter()
                .map(|&(other_span, other)| {
                    let (spans, at): ([usize; 2], [[f64; 2]; 2]) = if axis == 0 {
                        ([span, other_span], ends.map(|end| [end, other]))
                    } else {
                        ([other_span, span], ends.map(|end| [other, end]))
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
        .map(|wanted| {
            let next = lengths.partition_point(|&length| length <= wanted).clamp(1, lengths.len() - 1);
            let (low, high) = (lengths[next - 1], lengths[next]);
            let fraction = if high > low { ((wanted - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
            (1.0 - fraction) * knots[next - 1] + fraction * knots[next]
        })
        .collect();
    // Lines that stand still at an end of the domain say nothing of what is between the lines.
    parameters[0] = breaks[0];
    parameters[samples - 1] = breaks[breaks.len() - 1];
    parameters
}
