//! How far a point of the sampled model can be from its nearest sample: `K_A`.

use super::SampleGrid;
use crate::bezier::{BezierModel, Patch};
use crate::bvh::Aabb;
use crate::parallel::map;
use glam::DVec3;

/// The largest radii of the cells between neighbouring samples.
///
/// A cell's box is that of the control nets of the pieces of patches inside
/// it, so it contains the cell whatever the surface does between the samples,
/// and exceeds it by second order only.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CoveringRadius {
    /// Half the longest diagonal of a cell's box: the 2012 paper's `K_A`. Not
    /// a bound: a half circle sampled at its ends has half-diagonal 1.118
    /// radii and an apex 1.414 radii from both.
    pub published: f64,
    /// The largest over the cells of the least, over the cell's four samples,
    /// of the distance to the farthest corner of its box. Every point of the
    /// model is at most this far from a sample, so the directed distance
    /// exceeds the largest distance of a sample by no more (triangle inequality).
    pub rigorous: f64,
}

/// Room for rounding in a radius, relative.
const ROUNDING_ROOM: f64 = 1.0 + 1e-12;

impl CoveringRadius {
    /// Over all cells of all surfaces. O(cells + patches), times p q (p + q).
    pub(super) fn of_all(model: &BezierModel, grids: &[SampleGrid]) -> Self {
        let of = |surface: usize| Self::of_surface(model, surface, &grids[surface]);
        map(grids.len(), of).into_iter().fold(Self::default(), Self::larger)
    }

    fn larger(self, other: Self) -> Self {
        Self { published: self.published.max(other.published), rigorous: self.rigorous.max(other.rigorous) }
    }

    fn of_surface(model: &BezierModel, surface: usize, grid: &SampleGrid) -> Self {
        let patches = &model.grids[surface];
        let pieces = [0, 1].map(|axis| cell_pieces(&grid.places[axis]));
        let columns = grid.counts()[1] - 1;
        let mut boxes = vec![Aabb::EMPTY; columns];
        let mut radius = Self::default();
        let samples = |i: usize, j: usize| {
            let ((row, s), (column, t)) = (grid.places[0][i], grid.places[1][j]);
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
                let corners = [samples(i, j), samples(i + 1, j), samples(i, j + 1), samples(i + 1, j + 1)];
                radius = radius.larger(Self::of_cell(aabb, corners));
            }
        }
        radius
    }

    fn of_cell(aabb: &Aabb, samples: [DVec3; 4]) -> Self {
        let farthest = |sample: DVec3| aabb.max_distance_squared(sample);
        Self {
            published: 0.5 * aabb.diagonal(),
            rigorous: samples.into_iter().map(farthest).fold(f64::INFINITY, f64::min).sqrt() * ROUNDING_ROOM,
        }
    }
}

/// For every interval between neighbouring places: the patches it touches and
/// its part of each.
pub(crate) fn cell_pieces(places: &[(usize, f64)]) -> Vec<Vec<(usize, [f64; 2])>> {
    let between = |pair: &[(usize, f64)]| {
        let ((first, start), (last, end)) = (pair[0], pair[1]);
        (first..=last)
            .map(|patch| {
                (patch, [if patch == first { start } else { 0.0 }, if patch == last { end } else { 1.0 }])
            })
            .filter(|(_, [start, end])| start < end || first == last)
            .collect()
    };
    places.windows(2).map(between).collect()
}

/// The box of the control net of the piece s x t of `patch`.
fn piece_box(patch: &Patch<'_>, s: [f64; 2], t: [f64; 2]) -> Aabb {
    let controls = patch.restricted(s, t);
    Patch { controls: &controls, ..*patch }.bounding_box()
}
