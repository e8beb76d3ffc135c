//! The difference of a block of A and a surface of B as a B-spline.
//!
//! Lemma (3.16 of docs/method.md). Let A's surface over a block and B's over its image be polynomials
//! between their knots, φ one affine map for each axis from the block's parameters to B's, and T the
//! union of A's knots and those that φ maps to B's. Along an axis of degree `d = max(p, m)` let a line of T have the multiplicity μ + d - p
//! or ν + d - m where A or B has a knot of multiplicity μ or ν there, the larger of both, and the block's
//! ends d + 1. Then `A - B∘φ` is a spline of degree d over T. Its coefficient i is the blossom of A at
//! `T_(i+1), …, T_(i+d)` less that of B at their images, taken from the polynomial of A and from that of
//! B over any intervals between `T_i` and `T_(i+d+1)`. So its length on a patch of A is at most that of the
//! longest coefficient whose basis function is not zero there.
//!
//! One coefficient for each patch takes the place of two nets, and a map that is affine on
//! a block suffices where A and B correspond by their parameters up to the scale. Rounding is that of
//! lemma R16 of docs/rounding.md.

mod blossom;
mod coefficients;
mod knots;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

use super::orientation::Orientation;
use crate::axis::Axis;
use crate::certified::rounding::gamma;
use crate::certified::sheets::{Chart, Sheets};
use crate::certified::{Block, Pair};
use blossom::Coefficients;
use coefficients::Lengths;
use knots::{AxisMap, KnotSequence};

/// The largest number of coefficients of one block: of 512 for each of its patches.
const MAX_COEFFICIENTS: usize = 1 << 17;

/// Roundings of a point of a stored patch, relative to the weight of its first control, for each degree and
/// besides: twice those of lemma R3.
const STORED_ROUNDINGS: [f64; 2] = [24.0, 16.0];

/// Those of a coefficient's terms, for each degree and besides.
const TERM_ROUNDINGS: [f64; 2] = [8.0, 24.0];

/// Those of A's rotation (lemma R2).
const ROTATION_ROUNDINGS: f64 = 66.0;

/// Those of a length and of the difference of two centres, relative to it.
const LENGTH_ROUNDINGS: f64 = 16.0;

/// What the sizes of weights, changes and diagonals may be larger than computed, relative to them.
const MARGIN: f64 = 1.02;

/// A block of A with the affine map of its parameters to those of a surface of B.
pub(super) struct BlockMap<'a> {
    pub(super) pair: &'a Pair<'a>,
    pub(super) sheets: Sheets<'a>,
    pub(super) block: &'a Block,
    pub(super) chart: &'a Chart<'a>,
    pub(super) orientation: Orientation,
    /// The parameters of the chart, by A's axes, to which the block's first and last lines are mapped.
    pub(super) images: [[f64; 2]; 2],
}

impl BlockMap<'_> {
    /// Upper bounds on the distances of the block's patches from B, v fastest; `None` where a
    /// surface is rational, the image leaves B's surface, or it has too many knots.
    /// O((patches of A + patches of B) d²).
    pub(super) fn upper_bounds(&self) -> Option<Vec<f64>> {
        let [u, v] = [self.coefficients(Axis::U)?, self.coefficients(Axis::V)?];
        let axes = [&u, &v];
        if u.of_a.len() * v.of_a.len() > MAX_COEFFICIENTS || !self.are_polynomial(axes) {
            return None;
        }
        let mut bounds = Lengths::new(self, axes).longest([&u.windows, &v.windows]);
        let error = self.error(axes);
        for bound in &mut bounds {
            *bound = (1.0 + gamma(LENGTH_ROUNDINGS)) * *bound + error;
        }
        Some(bounds)
    }

    /// The coefficients along an axis.
    fn coefficients(&self, axis: Axis) -> Option<Coefficients> {
        let map = self.axis(axis);
        Coefficients::new(&map, &KnotSequence::new(&map)?)
    }

    /// The map of an axis.
    fn axis(&self, axis: Axis) -> AxisMap<'_> {
        let Self { sheets, block, chart, .. } = *self;
        let grid = &sheets.bezier.grids[block.surface as usize];
        let [start, end] = block.range(axis).map(|line| line as usize);
        let on_b = self.orientation.axis_of_b(axis);
        let of_a = sheets.bezier.patches.patch(grid.first);
        AxisMap {
            chart,
            on_b,
            degrees: [of_a.degree[axis], chart.neighbour([0; 2]).degree[on_b]],
            breaks: &grid.breaks[axis][start..=end],
            multiplicities: &grid.multiplicities[axis][start..=end],
            images: self.images[axis.index()],
        }
    }

    /// The error of lemma R16 besides that relative to the lengths.
    fn error(&self, axes: [&Coefficients; 2]) -> f64 {
        let degrees: usize = axes.iter().map(|axis| axis.degree).sum();
        let roundings = |[each, more]: [f64; 2]| each * degrees as f64 + more;
        let of_terms = roundings(STORED_ROUNDINGS) + roundings(TERM_ROUNDINGS);
        let [a, b] = [&self.pair.a, &self.pair.b].map(|model| MARGIN * model.control_box.diagonal());
        let [u, v] = axes;
        let of_sizes = |side: usize| MARGIN * u.sizes[side] * v.sizes[side];
        let change = MARGIN * (u.change + v.change) * of_sizes(1);
        let drift = MARGIN * 2.0 * (u.drift * v.sizes[1] + u.sizes[1] * v.drift);
        gamma(of_terms + ROTATION_ROUNDINGS) * of_sizes(0) * a
            + (gamma(of_terms) * of_sizes(1) + change + drift) * b
    }
}
