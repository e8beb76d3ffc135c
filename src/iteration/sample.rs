//! Stage `sample`: the points at the parameters of a sampling.

use super::Sampling;
use crate::bezier::BezierModel;
use crate::model::RigidTransform;
use glam::DVec3;

/// The moved point of sample `index`, which must be below the sampling's
/// length. O(p q).
#[must_use]
pub fn sample(model: &BezierModel, sampling: &Sampling, index: usize, transform: &RigidTransform) -> DVec3 {
    let surface = sampling.surface(index);
    let grid = &sampling.grids[surface];
    let (i, j) = grid.row_and_column(index);
    let ((row, s), (column, t)) = (grid.places[0][i], grid.places[1][j]);
    let patches = &model.grids[surface];
    let patch = model.patches.patch(patches.first + row * patches.counts()[1] + column);
    transform.apply(patch.point([s, t]))
}
