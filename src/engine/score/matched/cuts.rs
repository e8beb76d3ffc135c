//! Edges at which a face was cut into pieces, which are no edges of the model.

use crate::axis::Axis;
use crate::engine::PreparedModel;
use crate::solid::{Arc, JoinedArc};
use glam::DVec2;

/// Ends that are nearer to each other than this, as a part of the extents of both pieces in the parameters of their face,
/// are one: far above what joined edges are apart, and far below a period, by which seams are.
const SAME_PLACE: f64 = 1e-6;

/// Returns whether an edge is a cut: both of its sides are pieces of one face, and straight lines between the same points
/// of the face's parameters. The two sides of a seam are a period apart. O(degree²).
pub(super) fn is_cut(model: &PreparedModel, edge: &JoinedArc) -> bool {
    let Some(other) = &edge.other else { return false };
    let [(face, one, corners), (face_of_other, other, corners_of_other)] =
        [&edge.one, other].map(|arc| in_face(model, arc));
    if face != face_of_other {
        return false;
    }
    let corners = || corners.into_iter().chain(corners_of_other);
    let ends = [DVec2::min, DVec2::max].map(|end| corners().fold(corners_of_other[0], end));
    let scale = ends[1] - ends[0];
    let is_one = |[a, b]: [DVec2; 2]| ((a - b) / scale).abs().cmple(DVec2::splat(SAME_PLACE)).all();
    let is_line = |[start, middle, end]: [DVec2; 3]| {
        let [along, across] = [(end - start) / scale, (middle - start) / scale];
        let length = along.length();
        length > SAME_PLACE && along.perp_dot(across).abs() <= SAME_PLACE * length
    };
    // Of pieces without an extent nothing is found.
    is_one([one[0], other[0]]) && is_one([one[2], other[2]]) && is_line(one) && is_line(other)
}

/// Returns the face that an arc's patch is a piece of, and in its parameters the start, the middle and the end of the arc
/// and the patch's corners.
fn in_face(model: &PreparedModel, arc: &Arc) -> (usize, [DVec2; 3], [DVec2; 4]) {
    let patch = model.bezier().patches.patch(arc.place.index as usize);
    let pieces = model.pieces();
    let at = |parameters: [f64; 2]| {
        DVec2::from_array(pieces.face_parameters(patch.surface, patch.surface_parameters(parameters)))
    };
    let along = |fraction: f64| {
        let [start, end] = arc.range;
        let (moving, fixed) = ((1.0 - fraction) * start + fraction * end, f64::from(arc.place.end));
        at(if arc.place.axis == Axis::U { [fixed, moving] } else { [moving, fixed] })
    };
    let corners = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]].map(at);
    (pieces.face(patch.surface), [0.0, 0.5, 1.0].map(along), corners)
}
