//! Planes that part two bodies but for a tolerance.

use crate::clearance::Nearest;
use crate::engine::PreparedModel;
use glam::DVec3;

/// The length of a direction that is taken for one of length 1 differs from it by less than this part.
const UNIT_ROUNDING: f64 = 1e-14;

/// Returns whether a motion of A by at most `tolerance` certainly leaves both bodies without a common inside.
///
/// `false` says nothing. O(directions patches).
pub(super) fn are_parted(models: [&PreparedModel; 2], nearest: &Nearest, tolerance: f64) -> bool {
    parting_distances(models, nearest).any(|distance| distance <= tolerance)
}

/// Returns the length of a motion of A that certainly leaves both bodies without a common inside, the least of those
/// tried. O(directions patches).
pub(super) fn parting_distance(models: [&PreparedModel; 2], nearest: &Nearest) -> f64 {
    parting_distances(models, nearest).fold(f64::INFINITY, |least, distance| {
        let distance = if distance > 0.0 { distance } else { 0.0 };
        if distance < least { distance } else { least }
    })
}

/// Returns along each direction n the height of A above the least height of B: lemma K1 of docs/assemblies.md, with
/// the bounds on heights of lemma V5 of docs/facts.md.
///
/// The directions are the axes, the normals where the bodies are nearest and that from one to the other.
fn parting_distances(models: [&PreparedModel; 2], nearest: &Nearest) -> impl Iterator<Item = f64> {
    let origin = nearest.points[1];
    directions(models, nearest).into_iter().flat_map(|along| [along, -along]).map(move |along| {
        let above = models[0].largest(None, along, origin) + models[1].largest(None, -along, origin);
        above.upper * (1.0 + UNIT_ROUNDING)
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
