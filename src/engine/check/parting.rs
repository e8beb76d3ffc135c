//! Planes that part two bodies but for a tolerance.

use crate::clearance::Nearest;
use crate::engine::PreparedModel;
use glam::DVec3;

/// The length of a direction that is taken for one of length 1 differs from it by less than this part.
const UNIT_ROUNDING: f64 = 1e-14;

/// Returns whether a motion of A by at most `tolerance` certainly leaves both bodies without a common inside: along
/// a direction n the largest height of A is at most the tolerance above the least height of B (lemma V5 of
/// docs/facts.md bounds heights; lemma K1 of docs/assemblies.md).
///
/// The directions tried are the axes, the normals where the bodies are nearest and that from one to the other.
/// `false` says nothing. O(directions patches).
pub(super) fn are_parted(models: [&PreparedModel; 2], nearest: &Nearest, tolerance: f64) -> bool {
    let origin = nearest.points[1];
    directions(models, nearest).into_iter().flat_map(|along| [along, -along]).any(|along| {
        let above = models[0].largest(None, along, origin) + models[1].largest(None, -along, origin);
        above.upper * (1.0 + UNIT_ROUNDING) <= tolerance
    })
}

fn directions(models: [&PreparedModel; 2], nearest: &Nearest) -> Vec<DVec3> {
    let normal = |side: usize| {
        let target = models[side].certified_target();
        let patch = target.target.patches.patch(nearest.patches[side] as usize);
        patch.jet(nearest.parameters[side]).normal().and_then(DVec3::try_normalize)
    };
    let between = (nearest.points[1] - nearest.points[0]).try_normalize();
    DVec3::AXES.into_iter().chain([normal(0), normal(1), between].into_iter().flatten()).collect()
}
