//! Motions that may lay one part on another. Which are found decides how often a motion is proven, never whether a
//! word is right.

use super::part::Part;
use crate::alignment::PointPair;
use crate::model::RigidTransform;
use crate::sorting::sort_by_number;
use glam::{DMat3, DQuat, DVec3};
use std::collections::BTreeMap;

/// The largest number of motions that are tried for two parts.
const MAX_TRIED: usize = 12;

/// The relative difference of two principal moments above which their axes are taken for distinct.
const DISTINCT: f64 = 1e-3;

/// The angle, in radians, up to which two rotations count as one.
const SAME_ROTATION: f64 = 1e-5;

/// The part of a part's size within which vertices are matched first; it is halved until it is [`FINEST`].
const COARSEST: f64 = 0.04;
const FINEST: f64 = 1e-6;

/// The part of a length to which distances of vertices agree in a frame of them.
const FRAME_PART: f64 = 1e-4;

/// The number of translations that are tried for parts that changed.
const VOTED_MOVES: usize = 2;

/// The vertices that a motion must lay on such of B to be worth a comparison: one more than give it. Of parts with
/// few vertices half are enough. Patches have corners about every hole, so that no share of all would do.
const ENOUGH_VERTICES: f64 = 4.0;

/// Returns motions that may lay A on B, those that turn least and match most vertices first. `rest` is the motion
/// that counts as none.
pub(super) fn candidates(a: &Part, b: &Part, rest: &RigidTransform) -> Vec<RigidTransform> {
    let mut rotations = vec![rest.rotation()];
    rotations.extend(by_axes(a, b, rest.rotation()));
    rotations.extend(by_vertices(a, b));
    let turn =
        |rotation: &DQuat| (*rotation * rest.rotation().inverse()).normalize().angle_between(DQuat::IDENTITY);
    sort_by_number(&mut rotations, turn);
    let mut distinct: Vec<DQuat> = Vec::new();
    for rotation in rotations {
        let is_new = |known: &DQuat| known.dot(rotation).abs() < (0.5 * SAME_ROTATION).cos();
        if distinct.iter().all(is_new) {
            distinct.push(rotation);
        }
    }
    let [mut matching, mut rough] = [const { Vec::new() }; 2];
    for rotation in distinct {
        let start = RigidTransform::about(rotation, a.center, b.center);
        let motion = refined(a, b, &start, COARSEST * a.aabb.diagonal(), rotation == rest.rotation());
        if matched(a, b, &motion) < 1.0 { &mut rough } else { &mut matching }.push(motion);
    }
    matching.into_iter().chain(rough).take(MAX_TRIED).collect()
}

/// Returns motions that lay enough vertices of A on vertices of B, for parts that changed. Translations come first, each
/// for vertices that those before it do not match, and then the motion with a rotation that matches most.
///
/// What stayed may have fewer vertices than a hole that moved, so that the motion of most alone would not do.
pub(super) fn most_matching(a: &Part, b: &Part, rest: &RigidTransform) -> Vec<RigidTransform> {
    let count = a.vertices.len() as f64;
    let enough = if 0.5 * count < ENOUGH_VERTICES { 0.5 * count } else { ENOUGH_VERTICES };
    let counted = |motion: RigidTransform| (count * matched(a, b, &motion), motion);
    // Of equal ones the first, which turns least.
    let turned = candidates(a, b, rest).into_iter().map(counted).rev();
    let turned = turned.max_by(|one, other| one.0.total_cmp(&other.0));
    let found = most_voted(a, b, rest).into_iter().map(counted).chain(turned);
    found.filter(|&(matched, _)| matched > 0.0 && matched >= enough).map(|(_, motion)| motion).collect()
}

/// Returns rotations that map the principal axes of A to those of B: four if all three moments are distinct, two if
/// only one of them differs from the others, none if all are equal.
fn by_axes(a: &Part, b: &Part, rest: DQuat) -> Vec<DQuat> {
    let (Some((moments, of_a)), Some((_, of_b))) = (&a.principal, &b.principal) else { return Vec::new() };
    let differ = |i: usize, j: usize| (moments[i] - moments[j]).abs() > DISTINCT * (moments[i] + moments[j]);
    match (differ(0, 1), differ(1, 2)) {
        (true, true) => {
            let from = DMat3::from_cols(of_a[0], of_a[1], of_a[2]);
            let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
            let to = signs.map(|[x, y]| {
                let onto = DMat3::from_cols(x * of_b[0], y * of_b[1], of_b[2]);
                let is_mirror = (onto * from.transpose()).determinant() < 0.0;
                DMat3::from_cols(onto.x_axis, onto.y_axis, if is_mirror { -onto.z_axis } else { onto.z_axis })
            });
            to.map(|to| DQuat::from_mat3(&(to * from.transpose())).normalize()).to_vec()
        }
        (false, false) => Vec::new(),
        (is_first, _) => {
            let axis = if is_first { 0 } else { 2 };
            let from = (rest * of_a[axis]).normalize_or_zero();
            [of_b[axis], -of_b[axis]]
                .map(|to| (DQuat::from_rotation_arc(from, to) * rest).normalize())
                .to_vec()
        }
    }
}

/// Rotations that lay a frame of the centre and two vertices of A on such frames of B.
fn by_vertices(a: &Part, b: &Part) -> Vec<DQuat> {
    let Some((p, q)) = frame_of(a) else { return Vec::new() };
    let slack = FRAME_PART * a.aabb.diagonal();
    let frame = |p: DVec3, q: DVec3| {
        let x = p.normalize_or_zero();
        let z = p.cross(q).normalize_or_zero();
        DMat3::from_cols(x, z.cross(x), z)
    };
    let from = frame(p, q).transpose();
    let is_near = |one: f64, other: f64| (one - other).abs() <= slack;
    let arms: Vec<DVec3> = b.vertices.iter().map(|&vertex| vertex - b.center).collect();
    let mut rotations = Vec::new();
    for first in arms.iter().filter(|first| is_near(first.length(), p.length())) {
        for second in arms.iter().filter(|second| is_near(second.length(), q.length())) {
            if is_near(first.distance(*second), p.distance(q)) {
                rotations.push(DQuat::from_mat3(&(frame(*first, *second) * from)).normalize());
            }
        }
    }
    rotations
}

/// Returns the arms from the centre of A to its farthest vertex, and to that with the largest area beside it.
fn frame_of(a: &Part) -> Option<(DVec3, DVec3)> {
    let p = *a.vertices.first()? - a.center;
    let arms = a.vertices.iter().map(|&vertex| vertex - a.center);
    let q = arms.max_by(|one, other| p.cross(*one).length().total_cmp(&p.cross(*other).length()))?;
    (p.cross(q).length() > FRAME_PART * p.length_squared()).then_some((p, q))
}

/// Narrows a motion by the vertices that it lays within `coarsest` of each other; `moves` only, or turns, too.
fn refined(a: &Part, b: &Part, start: &RigidTransform, coarsest: f64, moves: bool) -> RigidTransform {
    let size = a.aabb.diagonal();
    let (mut motion, mut radius) = (*start, coarsest);
    while radius > FINEST * size {
        let pairs = pairs_within(a, b, &motion, radius);
        let next = if moves { shifted(&pairs, &motion) } else { fitted(&pairs) };
        motion = next.unwrap_or(motion);
        radius *= 0.25;
    }
    motion
}

/// Returns the motion with the rotation of another one and the mean way of pairs.
fn shifted(pairs: &[[DVec3; 2]], motion: &RigidTransform) -> Option<RigidTransform> {
    let sum: DVec3 = pairs.iter().map(|[a, b]| b - motion.rotate(*a)).sum();
    (!pairs.is_empty()).then(|| RigidTransform::new(motion.rotation(), sum / pairs.len() as f64).ok())?
}

/// Returns the motion that fits pairs best.
fn fitted(pairs: &[[DVec3; 2]]) -> Option<RigidTransform> {
    let pairs: Vec<PointPair> =
        pairs.iter().map(|[a, b]| PointPair { a: a.to_array(), b: b.to_array(), weight: 1.0 }).collect();
    RigidTransform::from_point_pairs(&pairs).ok()
}

/// Returns vertices of A with the nearest ones of B within a distance of them. O(vertices²).
fn pairs_within(a: &Part, b: &Part, motion: &RigidTransform, radius: f64) -> Vec<[DVec3; 2]> {
    let pair = |&of_a: &DVec3| {
        let at = motion.apply(of_a);
        let nearest =
            b.vertices.iter().min_by(|x, y| x.distance_squared(at).total_cmp(&y.distance_squared(at)))?;
        (nearest.distance(at) <= radius).then_some([of_a, *nearest])
    };
    a.vertices.iter().filter_map(pair).collect()
}

/// Returns the part of A's vertices that a motion lays on such of B.
fn matched(a: &Part, b: &Part, motion: &RigidTransform) -> f64 {
    pairs_within(a, b, motion, matching_distance(a)).len() as f64 / a.vertices.len().max(1) as f64
}

/// Returns translations after the rotation of `rest`: the one that lays most vertices on vertices of B, then the one that
/// lays most of the others there, and so on. O(vertices² log).
fn most_voted(a: &Part, b: &Part, rest: &RigidTransform) -> Vec<RigidTransform> {
    let cell = FRAME_PART * a.aabb.diagonal();
    let (mut left, mut found) = (a.vertices.clone(), Vec::new());
    for _ in 0..VOTED_MOVES {
        let mut votes: BTreeMap<[i64; 3], (usize, DVec3)> = BTreeMap::new();
        for of_a in &left {
            for of_b in &b.vertices {
                let shift = of_b - rest.rotate(*of_a);
                let key = (shift / cell).round().to_array().map(|x| x as i64);
                votes.entry(key).or_insert((0, shift)).0 += 1;
            }
        }
        let Some((_, shift)) = votes.into_values().max_by_key(|&(count, _)| count) else { break };
        let Ok(start) = RigidTransform::new(rest.rotation(), shift) else { break };
        let motion = refined(a, b, &start, cell, true);
        let explained = pairs_within(a, b, &motion, matching_distance(a));
        left.retain(|vertex| explained.iter().all(|[of_a, _]| of_a != vertex));
        found.push(motion);
    }
    found
}

/// Returns the distance up to which vertices lie on each other.
fn matching_distance(a: &Part) -> f64 {
    10.0 * FINEST * a.aabb.diagonal()
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use crate::engine::diff::parts::part::parts_of;
    use crate::{PreparedModel, shapes};

    /// A part with these vertices.
    fn part(vertices: Vec<DVec3>) -> Part {
        let ball = PreparedModel::new(&shapes::sphere(DVec3::ZERO, 20.0).unwrap()).unwrap();
        let mut only = parts_of(&ball).unwrap().swap_remove(0);
        only.vertices = vertices;
        only
    }

    #[test]
    fn what_stayed_gives_a_motion_also_where_what_moved_has_more_vertices() {
        let corner =
            |index: i32| DVec3::new(f64::from(index & 1), f64::from(index >> 1 & 1), f64::from(index >> 2));
        let (move_of_all, move_of_hole) = (DVec3::new(3.0, 9.0, 4.0), DVec3::new(0.1, 0.2, 0.2));
        let vertices = |by: DVec3, of_hole: DVec3| {
            let corners = (0..8).map(|index| by + DVec3::new(29.0, 20.0, 17.0) * corner(index));
            let hole = (0..26).map(|index| {
                let angle = 0.24 * f64::from(index);
                by + of_hole + DVec3::new(3.0, 9.0 + 1.5 * angle.cos(), 8.0 + 1.5 * angle.sin())
            });
            corners.chain(hole).collect::<Vec<_>>()
        };
        let (a, b) = (part(vertices(DVec3::ZERO, DVec3::ZERO)), part(vertices(move_of_all, move_of_hole)));
        let found = most_matching(&a, &b, &RigidTransform::IDENTITY);
        let is_near = |motion: &RigidTransform, by: DVec3| {
            (0..8).all(|index| motion.apply(corner(index)).distance(corner(index) + by) < 1e-9)
        };
        assert!(is_near(&found[0], move_of_all + move_of_hole), "{found:?}");
        assert!(is_near(&found[1], move_of_all), "{found:?}");
    }
}
