//! The edges at which the patches of a model's surfaces end.

use super::curve::Curve;
use crate::bezier::{BezierModel, Patch};

/// The edge of a patch at which its surface ends.
#[derive(Debug, Clone)]
pub(super) struct Edge {
    pub(super) surface: usize,
    pub(super) curve: Curve,
}

/// Returns all edges of the surfaces: those of patches without a neighbour in the surface, or
/// one that a knot of full multiplicity separates.
pub(super) fn edges(model: &BezierModel) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (surface, grid) in model.grids.iter().enumerate() {
        let [rows, columns] = grid.counts();
        for index in 0..rows * columns {
            let patch = model.patches.patch(grid.first + index);
            let place = [index / columns, index % columns];
            for (axis, of_axis) in grid.multiplicities.iter().enumerate() {
                for end in 0..2 {
                    let line = place[axis] + end;
                    let is_end = line == 0 || line == grid.counts()[axis];
                    if is_end || usize::from(of_axis[line]) > patch.degree[axis] {
                        edges.push(Edge { surface, curve: edge(&patch, axis, end) });
                    }
                }
            }
        }
    }
    edges
}

/// Returns the edge of a patch at an end of an axis.
fn edge(patch: &Patch<'_>, axis: usize, end: usize) -> Curve {
    let [rows, columns] = patch.degree.map(|degree| degree + 1);
    let controls = if axis == 0 {
        let first = end * (rows - 1) * columns;
        patch.controls[first..first + columns].to_vec()
    } else {
        patch.controls.iter().skip(end * (columns - 1)).step_by(columns).copied().collect()
    };
    Curve { center: patch.center, controls }
}
