//! Planes that part two bodies but for a tolerance.

use crate::clearance::Nearest;
use crate::engine::PreparedModel;
use glam::DVec3;

/// The length of a direction that is taken for one of length 1 differs from it by less than this part.
const UNIT_ROUNDING: f64 = 1e-14;

/// The length of the cross product of two unit vectors up to which they are one direction: patches of one plane have
/// normals that differ by rounding.
const SAME_DIRECTION: f64 = 1e-12;

/// Returns whether a motion of A by at most `tolerance` certainly leaves both bodies without a common inside.
///
/// Directions are those of [`parting_distance`], then the normals of all patches as near to the nearest points: these may
/// be on an edge of the face on which a body stands, or on a fillet beside it. `false` says nothing.
/// O(directions patches).
pub(super) fn are_parted_within(models: [&PreparedModel; 2], nearest: &Nearest, tolerance: f64) -> bool {
    let mut tried = directions(models, nearest);
    let origin = nearest.points[1];
    let is_parting = |along: DVec3| {
        [along, -along].into_iter().any(|along| parting_along(models, along, origin) <= tolerance)
    };
    if tried.iter().any(|&along| is_parting(along)) {
        return true;
    }
    for normal in normals_about(models, nearest, tolerance) {
        if tried.iter().any(|known| known.cross(normal).length() <= SAME_DIRECTION) {
            continue;
        }
        if is_parting(normal) {
            return true;
        }
        tried.push(normal);
    }
    false
}

/// Returns the length of a motion of A that certainly leaves both bodies without a common inside, the least of those
/// tried. O(directions patches).
pub(super) fn parting_distance(models: [&PreparedModel; 2], nearest: &Nearest) -> f64 {
    let origin = nearest.points[1];
    let all = directions(models, nearest).into_iter().flat_map(|along| [along, -along]);
    all.fold(f64::INFINITY, |least, along| {
        let distance = parting_along(models, along, origin);
        let distance = if distance > 0.0 { distance } else { 0.0 };
        if distance < least { distance } else { least }
    })
}

/// Returns the height along a direction n of A above the least height of B: lemma K1 of docs/assemblies.md, with the bounds
/// on heights of lemma V5 of docs/facts.md.
fn parting_along(models: [&PreparedModel; 2], along: DVec3, origin: DVec3) -> f64 {
    let above = models[0].largest(None, along, origin) + models[1].largest(None, -along, origin);
    above.upper * (1.0 + UNIT_ROUNDING)
}

/// Returns the axes, the normals where the bodies are nearest and the direction from one to the other.
fn directions(models: [&PreparedModel; 2], nearest: &Nearest) -> Vec<DVec3> {
    let normal = |side: usize| {
        let target = models[side].certified_target();
        let patch = target.target.patches.patch(nearest.patches[side] as usize);
        patch.jet(nearest.parameters[side]).normal().and_then(DVec3::try_normalize)
    };
    let between = (nearest.points[1] - nearest.points[0]).try_normalize();
    DVec3::AXES.into_iter().chain([normal(0), normal(1), between].into_iter().flatten()).collect()
}

/// Returns the normals, in their middles, of the patches of both bodies whose boxes are within a distance of the two
/// nearest points.
fn normals_about(
    models: [&PreparedModel; 2],
    nearest: &Nearest,
    distance: f64,
) -> impl Iterator<Item = DVec3> {
    let of_side = move |(model, point): (&PreparedModel, DVec3)| {
        let target = model.certified_target();
        let leaves = target.target.tree.leaves_within(point, distance * distance);
        leaves.into_iter().filter_map(move |leaf| {
            let patch = target.target.patches.patch(target.target.tree.primitive(&leaf) as usize);
            patch.jet([0.5; 2]).normal().and_then(DVec3::try_normalize)
        })
    };
    models.into_iter().zip(nearest.points).flat_map(of_side)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::model::{Model, SurfaceArrays};

    /// The face of a cuboid at x = 0, by its number.
    const SIDE: usize = 0;

    /// Returns a point of a frame that is askew.
    fn askew([x, y, z]: [f64; 3]) -> DVec3 {
        let axes = [DVec3::new(2.0, 1.0, 2.0), DVec3::new(-2.0, 2.0, 1.0), DVec3::new(-1.0, -2.0, 2.0)];
        (x * axes[0] + y * axes[1] + z * axes[2]) / 3.0
    }

    /// The cuboid [0, 1]² × [low, high] of that frame.
    fn cuboid(low: f64, high: f64) -> PreparedModel {
        let ends = [[0.0, 1.0], [0.0, 1.0], [low, high]];
        let face = |axis: usize, end: usize| {
            let corner = |s: usize, t: usize| {
                let mut at = [0.0; 3];
                for (k, place) in [end, s, t].into_iter().enumerate() {
                    let axis = (axis + k) % 3;
                    at[axis] = ends[axis][place];
                }
                let [x, y, z] = askew(at).to_array();
                [x, y, z, 1.0]
            };
            let knots = [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]];
            let control_points = vec![corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1)];
            SurfaceArrays { degree: [1, 1], knots, counts: [2, 2], control_points }
        };
        let faces = (0..3).flat_map(|axis| [face(axis, 0), face(axis, 1)]);
        PreparedModel::new(&Model::from_arrays(None, faces.collect()).unwrap()).unwrap()
    }

    /// A cuboid stands on another one, sunk into it by a little. The points that were found to be nearest are on two sides
    /// that are flush, beside the faces in contact: the normals of those part both by what is sunk, attained.
    #[test]
    fn the_faces_beside_the_nearest_points_part_two_bodies() {
        let sunk = 1e-3;
        let models = [&cuboid(1.0 - sunk, 2.0), &cuboid(0.0, 1.0)];
        let patches = models.map(|model| {
            let target = model.certified_target();
            target.target.patches.iter().position(|patch| patch.surface == SIDE).unwrap() as u32
        });
        let parameters = [[0.5, sunk / (1.0 + sunk)], [0.5, 1.0]];
        let nearest =
            Nearest { patches, parameters, points: [askew([0.0, 0.5, 1.0]); 2], distance_squared: 0.0 };
        assert!(parting_distance(models, &nearest) > 0.5, "the axes and the normals of the sides");
        assert!(are_parted_within(models, &nearest, 1.001 * sunk));
        assert!(!are_parted_within(models, &nearest, 0.999 * sunk));
    }
}
