//! Stage `sample`: the points of a sampling.

use super::Sampling;
use crate::bezier::BezierModel;
use crate::model::RigidTransform;
use glam::DVec3;

/// Returns the moved point of sample `index`, which must be below the length of
/// the sampling. O(p q).
#[must_use]
pub fn sample(model: &BezierModel, sampling: &Sampling, index: usize, transform: &RigidTransform) -> DVec3 {
    let surface = sampling.surface(index);
    let grid = &sampling.grids[surface];
    let (i, j) = grid.row_and_column(index);
    let ((row, s), (column, t)) = (grid.locations[0][i], grid.locations[1][j]);
    let patches = &model.grids[surface];
    let patch = model.patches.patch(patches.first + row * patches.counts()[1] + column);
    transform.apply(patch.point([s, t]))
}
