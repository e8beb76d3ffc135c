//! Planes between two bodies.

use super::Body;
use super::body::pair_error;
use super::hull::hull_distance;
use crate::bvh::{Aabb, Node};
use crate::closest::Target;
use crate::model::RigidTransform;
use glam::{DVec3, Vec4Swizzles};

/// The largest number of directions that are tried. Two nets take at most 16 (`hull.rs`); hulls of bodies have more corners,
/// and a direction takes no longer than looking down both trees.
const MAX_DIRECTIONS: usize = 24;

/// Returns true only if a plane is certainly between both bodies, so that their convex hulls have no point in common;
/// `false` says nothing.
///
/// Guarantee (lemmas C1 and C2 of docs/clearance.md): along the direction found, all control points of one body lie
/// farther than the error of both from those of the other. Directions are those from one hull to the other of the
/// outermost points along the directions before; `start` is the first. O(√patches) a direction.
pub(crate) fn are_parted(bodies: [Body<'_>; 2], start: DVec3) -> bool {
    let error = pair_error([&bodies[0], &bodies[1]], &RigidTransform::IDENTITY, 0);
    let [mut of_a, mut of_b] = [Vec::new(), Vec::new()];
    let mut toward = start;
    for _ in 0..MAX_DIRECTIONS {
        let lowest = [lowest(bodies[0].target, toward), lowest(bodies[1].target, -toward)];
        let [Some(a), Some(b)] = lowest else { return false };
        if (toward.dot(a) - toward.dot(b)) / toward.length() > error {
            return true;
        }
        if of_a.contains(&a) && of_b.contains(&b) {
            return false;
        }
        of_a.push(a);
        of_b.push(b);
        let hulls = hull_distance(&of_a, &of_b, a - b, f64::INFINITY, 0.0);
        // No plane is between all points where none is between these.
        if !(hulls.lower > error) {
            return false;
        }
        toward = hulls.direction;
    }
    false
}

/// Returns the control point that lies lowest along a direction; none of a body without patches or with a point whose
/// height is NaN, as nothing bounds it.
///
/// Boxes that lie higher are left out. A rounded product of a direction with a box's lowest corner is no larger than the
/// one with a point of the box, as rounding keeps the order of numbers.
fn lowest(target: &Target, direction: DVec3) -> Option<DVec3> {
    let nodes = target.tree.nodes();
    let height = |node: &Node| direction.dot(corner(&node.aabb, direction));
    let mut best: Option<(DVec3, f64)> = None;
    let mut stack = if nodes.is_empty() { Vec::new() } else { vec![0] };
    while let Some(index) = stack.pop() {
        let node = &nodes[index];
        if best.is_some_and(|(_, least)| height(node) >= least) {
            continue;
        }
        if !node.is_leaf() {
            let mut children = [index + 1, node.right_child as usize];
            // The lower one is looked at first.
            if height(&nodes[children[0]]) < height(&nodes[children[1]]) {
                children.reverse();
            }
            stack.extend(children);
            continue;
        }
        let patch = target.patches.patch(target.tree.primitive(node) as usize);
        for control in patch.controls {
            let point = patch.center + control.xyz() / control.w;
            let height = direction.dot(point);
            if height.is_nan() {
                return None;
            }
            if best.is_none_or(|(_, least)| height < least) {
                best = Some((point, height));
            }
        }
    }
    best.map(|(point, _)| point)
}

/// Returns the corner of a box that lies lowest along a direction.
fn corner(aabb: &Aabb, direction: DVec3) -> DVec3 {
    DVec3::select(direction.cmpge(DVec3::ZERO), aabb.min, aabb.max)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::{Patch, PatchSet, extract};
    use crate::model::{Model, SurfaceArrays};
    use crate::shapes::{sphere, torus};

    fn target(model: &Model) -> Target {
        Target::new(extract(model).patches)
    }

    fn body(target: &Target, point_error: f64) -> Body<'_> {
        Body { target, control_box: target.tree.bounding_box(), point_error }
    }

    /// The square [0, 1]² at this height above a plane that is askew.
    fn square(height: f64) -> Target {
        let [along, across] = [DVec3::new(2.0, 1.0, 2.0) / 3.0, DVec3::new(-2.0, 2.0, 1.0) / 3.0];
        let point = |s: f64, t: f64| {
            let [x, y, z] = (s * along + t * across + height * along.cross(across)).to_array();
            [x, y, z, 1.0]
        };
        let knots = [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]];
        let control_points = vec![point(0.0, 0.0), point(0.0, 1.0), point(1.0, 0.0), point(1.0, 1.0)];
        let surface = SurfaceArrays { degree: [1, 1], knots, counts: [2, 2], control_points };
        target(&Model::from_arrays(None, vec![surface]).unwrap())
    }

    /// Two squares that are as far apart as both are uncertain, and a little less or more: attained.
    #[test]
    fn a_plane_is_between_squares_that_are_farther_apart_than_their_error() {
        let below = square(0.0);
        for (height, expected) in [(0.999e-3, false), (1.001e-3, true), (0.5, true)] {
            let above = square(height);
            // The last two are the normal of both squares, of other lengths than 1.
            let normal = DVec3::new(-1.0, -2.0, 2.0);
            for start in [DVec3::X, DVec3::new(-0.2, 0.9, 0.1), DVec3::ZERO, normal, 0.1 * normal] {
                let bodies = [body(&above, 0.6e-3), body(&below, 0.4e-3)];
                assert_eq!(are_parted(bodies, start), expected, "{height} from {start}");
                assert_eq!(are_parted([bodies[1], bodies[0]], start), expected, "{height} from {start}");
            }
        }
    }

    /// A ball in the hole of a torus is apart from it, and no plane is between both; one beside it has one.
    #[test]
    fn no_plane_is_between_a_torus_and_a_ball_in_its_hole() {
        let ring = target(&torus(2.0, 0.5).unwrap());
        for (x, expected) in [(0.0, false), (0.9, false), (4.0, true)] {
            let ball = target(&sphere(x * DVec3::X, 0.5).unwrap());
            assert_eq!(are_parted([body(&ring, 0.0), body(&ball, 0.0)], DVec3::Y), expected, "{x}");
        }
    }

    /// The lowest of all control points is found, whichever boxes are left out: those of squares that are askew reach
    /// farther than their points do.
    #[test]
    fn the_lowest_point_is_that_of_all() {
        let part = |k: u32, step: f64| (step * f64::from(k)).fract() - 0.5;
        let corners = |k: u32| {
            let at = |i: u32, size: f64| {
                size * DVec3::from_array([0.371, 0.613, 0.837].map(|step| part(7 * k + i, step)))
            };
            (1..5).map(|i| (at(0, 1.0) + at(i, 0.7)).extend(1.0)).collect::<Vec<_>>()
        };
        let mut patches = PatchSet::default();
        (0..64).for_each(|k| patches.push(Patch::whole([1, 1], DVec3::ZERO, &corners(k))));
        let squares = Target::new(patches);
        for target in [squares, target(&torus(2.0, 0.5).unwrap())] {
            let of_patch =
                |patch: Patch<'_>| patch.local_points().map(|point| patch.center + point).collect::<Vec<_>>();
            let points: Vec<DVec3> = target.patches.iter().flat_map(of_patch).collect();
            for k in 0..100 {
                let direction = DVec3::from_array([0.37, 0.61, 0.83].map(|step| part(k, step)));
                let height = direction.dot(lowest(&target, direction).unwrap());
                assert!(points.iter().all(|point| height <= direction.dot(*point)), "{direction}");
            }
        }
    }
}
