//! The normal of a sheet where its faces meet, and at its rim.

use crate::bezier::{Jet, Patch};
use crate::closest::{Target, nearest_control, newton};
use glam::DVec3;
use std::f64::consts::PI;

/// The part of a patch's parameters within which a point counts as one on the border: projections
/// onto a border end on it but for the rounding of their last step.
const BORDER: f64 = 1e-6;

/// The largest number of Newton steps to a point that is known to be near the patch.
const MAX_ITERATIONS: u32 = 16;

/// The length of the sum of normals, relative to the sum of angles, below which faces are opposite
/// to each other and the sum has no direction.
const MIN_SUM: f64 = 1e-6;

/// Returns the angle-weighted normal at `point` over all patches within `reach` of it (Bærentzen and
/// Aanæs 2005, equation 2), of unit length; `None` where no patch has a normal, or where their sum
/// vanishes. The normal of a patch is reversed if `is_turned` holds for its surface.
///
/// Inside a face it is the face's normal, on the rim of a sheet that of its one face, on an edge the
/// mean of two. O(p q) a patch near the point.
pub(crate) fn pseudonormal(
    target: &Target,
    point: DVec3,
    reach: f64,
    is_turned: impl Fn(usize) -> bool,
) -> Option<DVec3> {
    let (mut sum, mut angles) = (DVec3::ZERO, 0.0);
    for leaf in target.tree.leaves_within(point, reach * reach) {
        let patch = target.patches.patch(target.tree.primitive(&leaf) as usize);
        let foot = newton(&patch, point, nearest_control(&patch, point), MAX_ITERATIONS);
        if foot.distance_squared > reach * reach {
            continue;
        }
        if let Some((normal, angle)) = sector(&patch, foot.parameters) {
            sum += if is_turned(patch.surface) { -angle } else { angle } * normal;
            angles += angle;
        }
    }
    (sum.length() > MIN_SUM * angles).then(|| sum.normalize())
}

/// Returns the normal of a patch at these parameters and the angle that it fills there; `None` where
/// it has no normal.
///
/// A triangle is a bilinear patch with an edge that is a point: there its edges enclose the angle.
fn sector(patch: &Patch<'_>, parameters: [f64; 2]) -> Option<(DVec3, f64)> {
    let jet = patch.jet(parameters);
    if let Some(normal) = jet.normal() {
        return Some((normal, angle(&jet, parameters)));
    }
    let is_apex = patch.degree == [1, 1] && jet.t == DVec3::ZERO;
    let edges = [0.0, 1.0].map(|t| patch.jet([parameters[0], t]).s);
    let inward = if parameters[0] < 0.5 { 1.0 } else { -1.0 };
    let normal = (inward * edges[0].cross(edges[1])).try_normalize().filter(|_| is_apex)?;
    Some((normal, edges[0].angle_between(edges[1])))
}

/// Returns the angle of a patch's tangent plane at these parameters that the patch fills.
fn angle(jet: &Jet, parameters: [f64; 2]) -> f64 {
    let on_border = parameters.map(|parameter| !(BORDER..=1.0 - BORDER).contains(&parameter));
    match on_border {
        [false, false] => 2.0 * PI,
        [true, true] => {
            let inward = |parameter: f64| if parameter < 0.5 { 1.0 } else { -1.0 };
            (inward(parameters[0]) * jet.s).angle_between(inward(parameters[1]) * jet.t)
        }
        _ => PI,
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::model::{Model, SurfaceArrays};
    use glam::DQuat;

    /// Two halves of a square, turned so that their normals are rounded: oriented against each other
    /// they have no normal on their common edge, however the sum of both is rounded.
    #[test]
    fn normals_that_cancel_but_for_rounding_have_no_sum() {
        for turn in 1..40 {
            let rotation =
                DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.1 * f64::from(turn));
            let half = |x: f64, rows: [f64; 2]| {
                let control = |x: f64, y: f64| {
                    let point = rotation * DVec3::new(x, y, 0.0);
                    [point.x, point.y, point.z, 1.0]
                };
                let knots = vec![0.0, 0.0, 1.0, 1.0];
                let control_points = rows.iter().flat_map(|&y| [control(0.0, y), control(x, y)]).collect();
                SurfaceArrays {
                    degree: [1, 1],
                    knots: [knots.clone(), knots],
                    counts: [2, 2],
                    control_points,
                }
            };
            let normal = |other: [f64; 2]| {
                let model = Model::from_arrays(None, vec![half(1.0, [0.0, 1.0]), half(-1.0, other)]).unwrap();
                let target = Target::new(extract(&model).patches);
                pseudonormal(&target, rotation * DVec3::new(0.0, 0.5, 0.0), 1e-9, |_| false)
            };
            assert_eq!(normal([0.0, 1.0]), None, "{turn}");
            let along = normal([1.0, 0.0]).unwrap();
            assert!(along.distance(rotation * DVec3::NEG_Z) < 1e-12, "{along}");
        }
    }
}
