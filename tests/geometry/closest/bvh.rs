//! Boxes, and the tree over them.

use glam::DVec3;
use nurbs_hausdorff::internals::bvh::{Aabb, Bvh};
use proptest::collection::vec;
use proptest::prelude::*;

/// Rounding of squared distances of size up to 1e3.
const ROUNDING: f64 = 1e-12;

/// Coordinates on a coarse grid as often as not, so that many are equal.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0, (-3_i8..3).prop_map(f64::from)]
}

fn any_point() -> impl Strategy<Value = DVec3> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn any_box() -> impl Strategy<Value = Aabb> {
    (any_point(), any_point()).prop_map(|(a, b)| Aabb::EMPTY.with(a).with(b))
}

fn contains(outer: &Aabb, inner: &Aabb) -> bool {
    outer.min.cmple(inner.min).all() && outer.max.cmpge(inner.max).all()
}

/// Checks the subtree at `index` and returns its boxes in order, the index
/// after its last node and its depth.
fn check(tree: &Bvh, boxes: &[Aabb], index: usize) -> (Vec<u32>, usize, u32) {
    let node = tree.nodes()[index];
    let (members, end, depth) = if node.is_leaf() {
        (vec![tree.primitive(&node)], index + 1, 0)
    } else {
        let (mut members, second, low) = check(tree, boxes, index + 1);
        assert_eq!(node.right_child as usize, second, "the second child follows the first's nodes");
        let (more, end, high) = check(tree, boxes, second);
        members.extend(more);
        (members, end, low.max(high) + 1)
    };
    assert_eq!(members[0], tree.primitive(&node));
    let union = members.iter().fold(Aabb::EMPTY, |union, &member| union.union(boxes[member as usize]));
    assert_eq!(node.aabb, union);
    assert!(members.iter().all(|&member| contains(&node.aabb, &boxes[member as usize])));
    (members, end, depth)
}

#[test]
fn a_tree_over_nothing_is_empty() {
    let tree = Bvh::new(&[]);
    assert!(tree.nodes().is_empty() && tree.order().is_empty());
}

#[test]
fn equal_boxes_make_no_deep_tree() {
    let boxes = vec![Aabb { min: DVec3::ZERO, max: DVec3::ONE }; 10_000];
    let (members, _, depth) = check(&Bvh::new(&boxes), &boxes, 0);
    assert_eq!(members.len(), boxes.len());
    // ceil(log2 10,000).
    assert!(depth <= 14, "{depth}");
}

#[test]
fn distances_to_a_box() {
    let aabb = Aabb { min: DVec3::new(-1.0, 0.0, 2.0), max: DVec3::new(1.0, 4.0, 2.0) };
    assert_eq!(aabb.min_distance_squared(DVec3::new(0.5, 3.0, 2.0)), 0.0);
    assert_eq!(aabb.min_distance_squared(DVec3::new(2.0, 2.0, 5.0)), 1.0 + 9.0);
    assert_eq!(aabb.min_distance_squared(DVec3::new(-3.0, 6.0, 1.0)), 4.0 + 4.0 + 1.0);
    assert_eq!(aabb.max_distance_squared(DVec3::new(0.5, 3.0, 2.0)), 1.5 * 1.5 + 9.0);
    assert_eq!(Aabb::EMPTY.union(aabb), aabb);
    assert_eq!((aabb.center(), aabb.extent()), (DVec3::new(0.0, 2.0, 2.0), DVec3::new(2.0, 4.0, 0.0)));
    assert_eq!(aabb.diagonal(), 20.0_f64.sqrt());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_box_is_in_one_leaf(boxes in vec(any_box(), 1..200)) {
        let tree = Bvh::new(&boxes);
        let (mut members, end, depth) = check(&tree, &boxes, 0);
        prop_assert_eq!(end, tree.nodes().len());
        prop_assert_eq!(&members, tree.order());
        members.sort_unstable();
        prop_assert!(members.iter().copied().eq(0..boxes.len() as u32));
        prop_assert!(depth <= usize::BITS - (boxes.len() - 1).leading_zeros());
    }

    #[test]
    fn leaves_within_a_reach_are_those_whose_boxes_are(
        boxes in vec(any_box(), 0..60), point in any_point(), reach in 0.0..100.0_f64,
    ) {
        let tree = Bvh::new(&boxes);
        let mut found: Vec<u32> =
            tree.leaves_within(point, reach * reach).iter().map(|leaf| tree.primitive(leaf)).collect();
        found.sort_unstable();
        let is_within = |index: &u32| boxes[*index as usize].min_distance_squared(point) <= reach * reach;
        prop_assert_eq!(found, (0..boxes.len() as u32).filter(is_within).collect::<Vec<_>>());
    }

    #[test]
    fn corners_and_inner_points_are_between_the_two_distances(
        aabb in any_box(),
        point in any_point(),
        part in [0.0..=1.0, 0.0..=1.0, 0.0..=1.0],
    ) {
        let inside = aabb.min + DVec3::from_array(part) * aabb.extent();
        let distance = inside.distance_squared(point);
        prop_assert!(aabb.min_distance_squared(point) <= distance + ROUNDING * (1.0 + distance));
        prop_assert!(distance <= aabb.max_distance_squared(point) + ROUNDING * (1.0 + distance));
        // The nearest point is the clamped one, the farthest a corner.
        let nearest = point.clamp(aabb.min, aabb.max).distance_squared(point);
        prop_assert!((aabb.min_distance_squared(point) - nearest).abs() <= ROUNDING * (1.0 + nearest));
        let corner = |bits: usize| DVec3::new(
            if bits & 1 == 0 { aabb.min.x } else { aabb.max.x },
            if bits & 2 == 0 { aabb.min.y } else { aabb.max.y },
            if bits & 4 == 0 { aabb.min.z } else { aabb.max.z },
        );
        let farthest = (0..8).map(|bits| corner(bits).distance_squared(point)).fold(0.0, f64::max);
        prop_assert!((aabb.max_distance_squared(point) - farthest).abs() <= ROUNDING * (1.0 + farthest));
    }
}
