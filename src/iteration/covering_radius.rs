//! The covering radius of a sampling, the error K_A of the 2012 paper.

use super::sample_grid::SampleGrid;
use crate::bezier::{BezierModel, Patch, cell_pieces};
use crate::bvh::Aabb;
use crate::rounding::{gamma, upper_max};
use crate::threads::parallel::map;
use glam::DVec3;

/// The largest distance of a point of the sampled model from its nearest sample,
/// as published and as a bound.
///
/// The box of a cell between neighbouring samples is that of the control nets of
/// the pieces of patches in it. It contains the cell, whatever the surface does
/// between the samples, and its excess is of second order.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CoveringRadius {
    /// Half the longest diagonal of a cell's box, the 2012 paper's K_A. It is no
    /// bound: a half circle sampled at its ends has a half-diagonal of 1.118
    /// radii, and its apex is 1.414 radii from both ends.
    pub published: f64,
    /// An upper bound: the largest over the cells of the smallest, over the
    /// cell's four samples, of the distance to the farthest corner of its box.
    /// By the triangle inequality, the directed distance exceeds the largest
    /// distance of a sample by at most this radius.
    pub rigorous: f64,
}

/// A factor that exceeds the rounding of a radius.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-12;

impl CoveringRadius {
    /// Returns the radius over all cells of all surfaces. O(cells + patches) times
    /// p q (p + q).
    pub(super) fn of_model(model: &BezierModel, grids: &[SampleGrid]) -> Self {
        let radii = map(grids.len(), |surface| Self::of_surface(model, surface, &grids[surface]));
        let Self { published, rigorous } = radii.into_iter().fold(Self::default(), Self::larger);
        let errors = model.patches.iter().map(|patch| box_error(&patch));
        Self { published, rigorous: rigorous + errors.fold(0.0, upper_max) }
    }

    /// Returns the larger of both radii each.
    fn larger(self, other: Self) -> Self {
        Self {
            published: self.published.max(other.published),
            rigorous: upper_max(self.rigorous, other.rigorous),
        }
    }

    /// Returns the radius over the cells of one surface.
    fn of_surface(model: &BezierModel, surface: usize, grid: &SampleGrid) -> Self {
        let patches = &model.grids[surface];
        let pieces = grid.locations.each_ref().map(|locations| cell_pieces(locations));
        let columns = grid.counts()[1] - 1;
        let mut boxes = vec![Aabb::EMPTY; columns];
        let mut radius = Self::default();
        let sample = |i: usize, j: usize| {
            let ((row, s), (column, t)) = (grid.locations[0][i], grid.locations[1][j]);
            model.patches.patch(patches.first + row * patches.counts()[1] + column).point([s, t])
        };
        for (i, row) in pieces[0].iter().enumerate() {
            boxes.fill(Aabb::EMPTY);
            for &(u, s) in row {
                for (j, cell) in pieces[1].iter().enumerate() {
                    for &(v, t) in cell {
                        let patch = model.patches.patch(patches.first + u * patches.counts()[1] + v);
                        boxes[j] = boxes[j].union(piece_box(&patch, s, t));
                    }
                }
            }
            for (j, aabb) in boxes.iter().enumerate() {
                let corners = [sample(i, j), sample(i + 1, j), sample(i, j + 1), sample(i + 1, j + 1)];
                radius = radius.larger(Self::of_cell(aabb, corners));
            }
        }
        radius
    }

    /// Returns the radius of a cell with this box and these samples at its corners.
    fn of_cell(aabb: &Aabb, samples: [DVec3; 4]) -> Self {
        let farthest = |sample: DVec3| aabb.max_distance_squared(sample);
        Self {
            published: 0.5 * aabb.diagonal(),
            rigorous: samples.into_iter().map(farthest).fold(f64::INFINITY, f64::min).sqrt()
                * ROUNDING_FACTOR,
        }
    }
}

/// Returns an upper bound on how far the box of a piece of `patch`, as computed, is
/// from containing the piece: the restriction is off by `16 (p + q)` roundings of the
/// patch's radius (lemma R6 of docs/rounding.md) and each side of the box by three of
/// the radius and the centre, √3 times that at a corner.
fn box_error(patch: &Patch<'_>) -> f64 {
    let radius = patch.local_points().map(DVec3::length).fold(0.0, upper_max);
    let restriction = gamma(16.0 * (patch.degree[0] + patch.degree[1]) as f64);
    restriction * radius + gamma(6.0) * (radius + patch.center.length())
}

/// Returns the box of the control net of the piece `s` × `t` of `patch`.
fn piece_box(patch: &Patch<'_>, s: [f64; 2], t: [f64; 2]) -> Aabb {
    let controls = patch.restricted(s, t);
    Patch { controls: &controls, ..*patch }.bounding_box()
}
