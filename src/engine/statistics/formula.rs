//! Points of parts of a patch by its formula, with normals.

use crate::bezier::Patch;
use crate::model::RigidTransform;
use crate::normals::OrientedPoint;
use crate::param_box::ParamBox;
use glam::DVec3;

/// Returns the corners and the middle of a part of a patch, moved.
pub(super) fn points_of(patch: &Patch<'_>, part: ParamBox, transform: &RigidTransform) -> Vec<DVec3> {
    let [s, t] = part.intervals();
    let corners = s.into_iter().flat_map(|s| t.map(|t| [s, t]));
    corners.chain([part.middle()]).map(|at| transform.apply(patch.point(at))).collect()
}

/// Returns the point of a patch at parameters and its normal; `None` where it has none.
pub(super) fn oriented(patch: &Patch<'_>, parameters: [f64; 2]) -> Option<OrientedPoint> {
    Some(OrientedPoint { point: patch.point(parameters), normal: patch.jet(parameters).normal()? })
}

/// Returns a point that is moved with its normal.
pub(super) fn moved(
    OrientedPoint { point, normal }: OrientedPoint,
    transform: &RigidTransform,
) -> OrientedPoint {
    OrientedPoint { point: transform.apply(point), normal: transform.rotate(normal) }
}
