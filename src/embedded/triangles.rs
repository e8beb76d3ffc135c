//! Whether triangles meet each other beyond the corners and edges that they share.

use super::{Doubt, Limits, Verdict};
use crate::bvh::{Aabb, Bvh};
use crate::clearance::hull_distance;
use crate::rounding::{VANISHING_LENGTH, gamma};
use crate::solid::Clusters;
use glam::DVec3;
use std::collections::HashMap;

/// The pairs between two looks at the time.
const PAIRS_AT_ONCE: usize = 1 << 16;

/// The roundings of the distance of two triangles, relative to the largest length of a corner (lemma C2 of
/// docs/clearance.md).
const DISTANCE_ROUNDINGS: f64 = 64.0;

/// The roundings of a determinant of three edges, relative to the product of their lengths: of each edge, of six products
/// of three factors and of their sum (lemma S9 of docs/solids.md).
const DETERMINANT_ROUNDINGS: f64 = 32.0;

/// The same for products of two products.
const PRODUCT_ROUNDINGS: f64 = 64.0;

/// Decides whether triangles are embedded, by their corners and the numbers of these, equal for equal points.
///
/// Guarantee (lemma S9 of docs/solids.md): if the verdict is [`Verdict::Embedded`], the triangles, as they are stored,
/// meet in the corners and edges that they share and nowhere else, at most two share an edge, and those about a corner
/// are joined by edges. Triangles with two equal corners are left out. O(n log n) in general position.
pub(crate) fn verdict_on_triangles(triangles: &[([DVec3; 3], [u32; 3])], limits: &Limits<'_>) -> Verdict {
    let is_whole = |[a, b, c]: [u32; 3]| a != b && b != c && c != a;
    let kept: Vec<u32> = (0..triangles.len() as u32).filter(|&k| is_whole(triangles[k as usize].1)).collect();
    let undecided = |doubt, parts: [u32; 2]| {
        let middles = parts.map(|part| triangles[part as usize].0.iter().sum::<DVec3>() / 3.0);
        Verdict::Undecided { doubt, parts, point: 0.5 * (middles[0] + middles[1]) }
    };
    if let Some(parts) = branching(triangles, &kept) {
        return undecided(Doubt::Contact, parts);
    }
    let corners = |place: u32| triangles[kept[place as usize] as usize];
    let boxes: Vec<Aabb> = (0..kept.len() as u32)
        .map(|place| corners(place).0.into_iter().fold(Aabb::EMPTY, Aabb::with))
        .collect();
    let length = boxes.iter().fold(Aabb::EMPTY, |all, &aabb| all.union(aabb)).farthest_from_origin();
    let apart = limits.nearness + gamma(DISTANCE_ROUNDINGS) * length + VANISHING_LENGTH;
    let grown: Vec<Aabb> = boxes.iter().map(|aabb| aabb.grown(apart)).collect();
    let (mut found, mut count) = (None, 0_usize);
    Bvh::new(&grown).for_each_pair(|a, b| {
        if found.is_some() {
            return;
        }
        count += 1;
        let parts = [a, b].map(|place| kept[place as usize]);
        if count % PAIRS_AT_ONCE == 0 && (limits.is_late)() {
            found = Some((Doubt::Budget, parts));
        } else if !are_clear([corners(a), corners(b)], apart) {
            found = Some((Doubt::Contact, parts));
        }
    });
    found.map_or(Verdict::Embedded { within: 0.0 }, |(doubt, parts)| undecided(doubt, parts))
}

/// Returns two triangles at an edge of three or more, or at a corner about which triangles are not all joined by edges.
fn branching(triangles: &[([DVec3; 3], [u32; 3])], kept: &[u32]) -> Option<[u32; 2]> {
    // By the numbers of both ends, the triangle and whether it is the second one there.
    let mut edges: HashMap<[u32; 2], (u32, bool)> = HashMap::new();
    let mut fans = Clusters::separate(3 * triangles.len());
    let corner_of = |triangle: u32, number: u32| {
        let place = triangles[triangle as usize].1.iter().position(|&other| other == number);
        3 * triangle + place.unwrap_or(0) as u32
    };
    for &triangle in kept {
        let numbers = triangles[triangle as usize].1;
        for side in 0..3 {
            let [from, to] = [numbers[side], numbers[(side + 1) % 3]];
            match edges.insert([from.min(to), from.max(to)], (triangle, false)) {
                None => {}
                Some((other, true)) => return Some([other, triangle]),
                Some((other, false)) => {
                    edges.insert([from.min(to), from.max(to)], (triangle, true));
                    for number in [from, to] {
                        fans.join(corner_of(other, number), corner_of(triangle, number));
                    }
                }
            }
        }
    }
    let mut first: HashMap<u32, u32> = HashMap::new();
    for &triangle in kept {
        for number in triangles[triangle as usize].1 {
            let other = *first.entry(number).or_insert(triangle);
            if fans.of(corner_of(other, number)) != fans.of(corner_of(triangle, number)) {
                return Some([other, triangle]);
            }
        }
    }
    None
}

/// Returns true only if two triangles certainly have no points in common but those of the corners and edges that they
/// share; those that share none are farther than `apart` from each other.
fn are_clear([one, other]: [([DVec3; 3], [u32; 3]); 2], apart: f64) -> bool {
    let ([a, b], [of_a, of_b]) = ([one.0, other.0], [one.1, other.1]);
    let shared: Vec<[usize; 2]> =
        (0..3).filter_map(|k| of_b.iter().position(|&number| number == of_a[k]).map(|l| [k, l])).collect();
    match shared[..] {
        [] => hull_distance(&a, &b, a[0] - b[0], 2.0 * apart, 0.0).lower > apart,
        [[k, l]] => {
            let edges =
                |corners: [DVec3; 3], at: usize| [1, 2].map(|step| corners[(at + step) % 3] - corners[at]);
            are_apart_at_corner([edges(a, k), edges(b, l)])
        }
        [[k, l], [m, n]] => {
            let edge = a[m] - a[k];
            are_apart_at_edge(edge, [a[3 - k - m] - a[k], b[3 - l - n] - b[l]])
        }
        _ => false,
    }
}

/// Returns true only if two triangles with an edge in common, and third corners there, have no other points in common.
///
/// They do unless both third corners are in one half plane about the edge: the determinant of all three is 0, and the
/// products of each with the edge are along each other.
fn are_apart_at_edge(edge: DVec3, [a, b]: [DVec3; 2]) -> bool {
    let lengths = edge.length() * a.length() * b.length();
    let [of_a, of_b] = [edge.cross(a), edge.cross(b)];
    let determinant = of_a.dot(b).abs();
    determinant > gamma(DETERMINANT_ROUNDINGS) * lengths + VANISHING_LENGTH
        || of_a.dot(of_b) < -gamma(PRODUCT_ROUNDINGS) * edge.length() * lengths - VANISHING_LENGTH
}

/// Returns true only if two triangles with one corner in common, and these edges from it, have no other point in common.
///
/// A plane through the corner has one triangle on one side, or in itself, and the other one on the other side.
fn are_apart_at_corner([a, b]: [[DVec3; 2]; 2]) -> bool {
    let swapped = |[first, second]: [DVec3; 2]| [second, first];
    // Between both, as far from each as may be.
    let middle = |edges: [DVec3; 2]| edges.map(DVec3::normalize_or_zero).into_iter().sum::<DVec3>();
    let between = middle(a) - middle(b);
    let is_certain = |edge: DVec3, turn: f64| {
        turn * between.dot(edge)
            > gamma(DETERMINANT_ROUNDINGS) * between.length() * edge.length() + VANISHING_LENGTH
    };
    if a.iter().all(|&edge| is_certain(edge, 1.0)) && b.iter().all(|&edge| is_certain(edge, -1.0)) {
        return true;
    }
    // In the plane of one of them.
    if lies_beside(a, b) || lies_beside(b, a) {
        return true;
    }
    // Along an edge of each.
    for [first, second] in [a, swapped(a)] {
        for [third, fourth] in [b, swapped(b)] {
            let [of_a, of_b] = [second, fourth].map(|edge| sign([first, third, edge]));
            if of_a * of_b < 0 {
                return true;
            }
        }
    }
    // Upright on the plane of one of them, along its edge.
    let beside_edge = |[first, second]: [DVec3; 2], others: [DVec3; 2]| {
        others.iter().all(|&edge| height([first, second], edge) < 0)
    };
    [[a, b], [b, a]].iter().any(|&[one, other]| beside_edge(one, other) || beside_edge(swapped(one), other))
}

/// Returns whether both edges of a triangle are certainly on one side of the plane of another one.
fn lies_beside([first, second]: [DVec3; 2], others: [DVec3; 2]) -> bool {
    let [one, other] = others.map(|edge| sign([first, second, edge]));
    one * other > 0
}

/// Returns the sign of the determinant of three vectors, 0 where it is not certain.
fn sign([a, b, c]: [DVec3; 3]) -> i32 {
    let bound = gamma(DETERMINANT_ROUNDINGS) * a.length() * b.length() * c.length() + VANISHING_LENGTH;
    certain(a.cross(b).dot(c), bound)
}

/// Returns the sign of the product of a vector with the part of the second edge of a triangle across the first one, 0
/// where it is not certain.
fn height([first, second]: [DVec3; 2], vector: DVec3) -> i32 {
    let value = vector.dot(second) * first.dot(first) - vector.dot(first) * first.dot(second);
    let bound = gamma(PRODUCT_ROUNDINGS) * first.length_squared() * second.length() * vector.length();
    certain(value, bound + VANISHING_LENGTH)
}

fn certain(value: f64, bound: f64) -> i32 {
    if value > bound {
        1
    } else if value < -bound {
        -1
    } else {
        0
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    type Edge = [i128; 3];

    fn cross([a, b, c]: Edge, [d, e, f]: Edge) -> Edge {
        [b * f - c * e, c * d - a * f, a * e - b * d]
    }

    fn dot(a: Edge, b: Edge) -> i128 {
        (0..3).map(|k| a[k] * b[k]).sum()
    }

    fn is_zero(a: Edge) -> bool {
        a == [0; 3]
    }

    /// Whether a vector in the plane of two is a sum of them with coefficients of 0 or more.
    fn is_between(vector: Edge, [a, b]: [Edge; 2]) -> bool {
        let normal = cross(a, b);
        dot(cross(a, vector), normal) >= 0 && dot(cross(vector, b), normal) >= 0
    }

    /// Whether two triangles with these edges from a common corner have another point in common, in whole numbers: the
    /// direction in which their planes meet is between both, or one has an edge between those of the other in one plane.
    fn do_meet([one, other]: [[Edge; 2]; 2]) -> bool {
        let [first, second] = [one, other].map(|[a, b]| cross(a, b));
        let along = cross(first, second);
        if !is_zero(along) {
            let back = along.map(|coordinate| -coordinate);
            return [along, back].iter().any(|&way| is_between(way, one) && is_between(way, other));
        }
        one.iter().any(|&edge| is_between(edge, other)) || other.iter().any(|&edge| is_between(edge, one))
    }

    fn vector(edge: Edge) -> DVec3 {
        DVec3::from_array(edge.map(|coordinate| coordinate as f64))
    }

    fn drawn(random: &mut fastrand::Rng, size: i128, is_plane: bool) -> [[Edge; 2]; 2] {
        [0; 2].map(|_| {
            [0; 2].map(|_| {
                let [x, y, z] = [0; 3].map(|_| random.i128(-size..=size));
                [x, y, if is_plane { 0 } else { z }]
            })
        })
    }

    /// Lemma S9 is compared with whole numbers. Many of the small ones lie in one plane or along each other.
    #[test]
    fn triangles_at_a_corner_are_apart_only_if_they_have_no_other_common_point() {
        let random = &mut fastrand::Rng::with_seed(3);
        let mut counts = [[0; 2]; 2];
        for round in 0..60_000 {
            let both = drawn(random, [2, 3, 1000][round % 3], round % 4 == 0);
            if both.iter().any(|&[a, b]| is_zero(cross(a, b))) {
                continue;
            }
            let found = are_apart_at_corner(both.map(|edges| edges.map(vector)));
            let expected = !do_meet(both);
            assert!(expected || !found, "{both:?} meet");
            counts[usize::from(expected)][usize::from(found)] += 1;
        }
        let [[meeting, _], [missed, told]] = counts;
        assert!(meeting > 10_000 && told > 20_000, "{counts:?}");
        assert!(missed * 200 < told, "{counts:?}");
    }

    /// Two triangles about an edge have more in common only if both are on one side of it in one plane.
    #[test]
    fn triangles_at_an_edge_are_apart_unless_one_lies_on_the_other() {
        let random = &mut fastrand::Rng::with_seed(4);
        let mut counts = [0; 2];
        for round in 0..30_000 {
            let [[edge, a], [b, _]] = drawn(random, [2, 1000][round % 2], round % 3 == 0);
            let [of_a, of_b] = [a, b].map(|third| cross(edge, third));
            if is_zero(of_a) || is_zero(of_b) {
                continue;
            }
            let expected = !is_zero(cross(of_a, of_b)) || dot(of_a, of_b) < 0;
            assert_eq!(are_apart_at_edge(vector(edge), [vector(a), vector(b)]), expected);
            counts[usize::from(expected)] += 1;
        }
        assert!(counts[0] > 1000 && counts[1] > 1000, "{counts:?}");
    }

    fn verdict(corners: &[[f64; 3]], triangles: &[[u32; 3]]) -> Verdict {
        let of = |&numbers: &[u32; 3]| {
            (numbers.map(|number| DVec3::from_array(corners[number as usize])), numbers)
        };
        let triangles: Vec<_> = triangles.iter().map(of).collect();
        let limits = Limits { nearness: 0.0, most: 1.0, is_late: &|| false };
        verdict_on_triangles(&triangles, &limits)
    }

    const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

    /// Two tetrahedra: with a corner in common, with an edge, apart by little and in each other.
    #[test]
    fn what_shares_a_corner_or_an_edge_without_being_joined_there_touches() {
        let first = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let second = |at: f64| first.map(|corner: [f64; 3]| corner.map(|coordinate| at - coordinate));
        let with = |at: f64, numbers: [u32; 4]| {
            let mut corners = first.to_vec();
            corners.extend(second(at));
            let mut triangles = TETRAHEDRON.to_vec();
            triangles.extend(TETRAHEDRON.map(|corners| corners.map(|corner| numbers[corner as usize])));
            verdict(&corners, &triangles)
        };
        let is_embedded = |verdict| matches!(verdict, Verdict::Embedded { within: 0.0 });
        let touches = |verdict| matches!(verdict, Verdict::Undecided { doubt: Doubt::Contact, .. });
        assert!(is_embedded(verdict(&first, &TETRAHEDRON)));
        assert!(is_embedded(with(-1e-9, [4, 5, 6, 7])));
        assert!(touches(with(0.0, [4, 5, 6, 7])), "the corner stands in both");
        assert!(touches(with(0.0, [0, 5, 6, 7])), "the corner is one");
        assert!(touches(with(0.5, [4, 5, 6, 7])), "in each other");
        // The edge from the origin along x is one of both.
        let corners = [first[0], first[1], first[2], first[3], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
        let other = TETRAHEDRON.map(|triangle| triangle.map(|corner| [0, 1, 4, 5][corner as usize]));
        assert!(touches(verdict(&corners, &[TETRAHEDRON, other].concat())));
    }

    #[test]
    fn a_triangle_with_two_equal_corners_is_left_out_and_one_without_area_is_not() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.0, 0.0]];
        let is_embedded =
            |triangles: &[[u32; 3]]| matches!(verdict(&corners, triangles), Verdict::Embedded { .. });
        assert!(is_embedded(&[[0, 1, 2], [0, 0, 1]]));
        assert!(!is_embedded(&[[0, 1, 2], [0, 1, 3]]));
    }
}
