//! Stage `sample`: the points at the parameters of a sampling.

use super::SampleGrid;
use crate::bezier::BezierModel;
use crate::model::RigidTransform;
use glam::DVec3;

/// The moved points of one surface's grid, v fastest. O(samples p q).
#[must_use]
pub fn sample(
    model: &BezierModel,
    surface: usize,
    grid: &SampleGrid,
    transform: &RigidTransform,
) -> Vec<DVec3> {
    let patches = &model.grids[surface];
    let mut points = Vec::with_capacity(grid.len());
    for &(row, s) in &grid.places[0] {
        for &(column, t) in &grid.places[1] {
            let patch = model.patches.patch(patches.first + row * patches.counts()[1] + column);
            points.push(transform.apply(patch.point([s, t])));
        }
    }
    points
}
