//! The bounding volume hierarchy with several primitives a leaf.

use super::Aabb;
use super::tree::longest_axis;
use crate::threads::parallel::join;
use bytemuck::{Zeroable, zeroed_vec};
use glam::DVec3;
use std::ops::Range;

/// A node of a [`RangeTree`].
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub(crate) struct RangeNode {
    /// A box that contains the boxes of all primitives below.
    pub(crate) aabb: Aabb,
    /// The index of the right child, 0 in a leaf. The left child follows its parent.
    right_child: u32,
    /// The positions in [`RangeTree::order`] of the primitives below.
    first: u32,
    end: u32,
}

impl RangeNode {
    /// Returns the indices of the children of the node at `index`; a leaf has none.
    pub(crate) fn children(&self, index: u32) -> Option<[u32; 2]> {
        (self.right_child != 0).then_some([index + 1, self.right_child])
    }

    /// Returns the positions of the primitives below.
    pub(crate) fn range(&self) -> Range<usize> {
        self.first as usize..self.end as usize
    }
}

/// A binary tree of boxes over the primitives `0..n` with leaves of up to a fixed number of them:
/// for primitives that cost less than the test of a box, and for numbers of them at which a node for
/// each would take more memory than they do.
#[derive(Debug, Clone, Default)]
pub(crate) struct RangeTree {
    nodes: Vec<RangeNode>,
    order: Vec<u32>,
}

/// The number of primitives from which on the two halves of a tree are built at a time.
const MIN_PARALLEL: usize = 4096;

impl RangeTree {
    /// Builds the tree over `count` primitives of these boxes, at most 2^31, with up to `leaf`
    /// of them a leaf. Every node is split along the longest axis of its boxes' centres, so that
    /// all leaves but one are full. O(n log n) on average, on all cores.
    pub(crate) fn new(count: usize, leaf: usize, boxes: &(impl Fn(u32) -> Aabb + Sync)) -> Self {
        let leaves = count.div_ceil(leaf);
        let mut nodes: Vec<RangeNode> = zeroed_vec((2 * leaves).saturating_sub(1));
        let mut order: Vec<u32> = (0..count as u32).collect();
        build(boxes, leaf, Subtree { nodes: &mut nodes, first_node: 0, order: &mut order, first: 0 });
        Self { nodes, order }
    }

    /// Returns the same tree over primitives that are scaled: multiplication by a positive factor
    /// keeps the order of coordinates, rounded too.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let mut tree = self.clone();
        for RangeNode { aabb, .. } in &mut tree.nodes {
            *aabb = Aabb { min: factor * aabb.min, max: factor * aabb.max };
        }
        tree
    }

    /// Returns the nodes, root first; without primitives there are none.
    pub(crate) fn nodes(&self) -> &[RangeNode] {
        &self.nodes
    }

    /// Returns the primitives in the order of the leaves.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    /// Returns the box of all primitives.
    pub(crate) fn bounding_box(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.aabb)
    }
}

/// A part of a tree to be built.
struct Subtree<'a> {
    nodes: &'a mut [RangeNode],
    /// The position of the first of them in the tree.
    first_node: usize,
    order: &'a mut [u32],
    /// The position of the first primitive in [`RangeTree::order`].
    first: usize,
}

/// Fills in a tree; over no primitives there is nothing to fill in.
fn build(boxes: &(impl Fn(u32) -> Aabb + Sync), leaf: usize, subtree: Subtree<'_>) {
    let Subtree { nodes, first_node, order, first } = subtree;
    let Some((root, below)) = nodes.split_first_mut() else { return };
    let (count, end) = (order.len(), (first + order.len()) as u32);
    if count <= leaf {
        let aabb = order.iter().fold(Aabb::EMPTY, |aabb, &index| aabb.union(boxes(index)));
        *root = RangeNode { aabb, right_child: 0, first: first as u32, end };
        return;
    }
    let left_leaves = count.div_ceil(leaf) / 2;
    let middle = left_leaves * leaf;
    let center = |index: u32| -> DVec3 { boxes(index).center() };
    let around = order.iter().fold(Aabb::EMPTY, |aabb, &index| aabb.with(center(index)));
    let axis = longest_axis(around.extent());
    order.select_nth_unstable_by(middle, |&a, &b| center(a)[axis].total_cmp(&center(b)[axis]));
    let (left_order, right_order) = order.split_at_mut(middle);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * left_leaves - 1);
    let right_child = first_node + 2 * left_leaves;
    let left = Subtree { nodes: &mut *left_nodes, first_node: first_node + 1, order: left_order, first };
    let right = Subtree {
        nodes: &mut *right_nodes,
        first_node: right_child,
        order: right_order,
        first: first + middle,
    };
    join(count >= MIN_PARALLEL, || build(boxes, leaf, left), || build(boxes, leaf, right));
    let aabb = left_nodes[0].aabb.union(right_nodes[0].aabb);
    *root = RangeNode { aabb, right_child: right_child as u32, first: first as u32, end };
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Every primitive is in one leaf, in all boxes above it, and leaves hold no more than allowed.
    #[test]
    fn the_leaves_hold_every_primitive_once() {
        let random = &mut fastrand::Rng::with_seed(4);
        for count in [0, 1, 2, 7, 8, 9, 100, 10_000] {
            let points: Vec<DVec3> =
                (0..count).map(|_| DVec3::new(random.f64(), random.f64(), random.f64())).collect();
            let boxes = |index: u32| Aabb::EMPTY.with(points[index as usize]);
            let tree = RangeTree::new(count, 8, &boxes);
            let mut found: Vec<u32> = Vec::new();
            for (index, node) in tree.nodes().iter().enumerate() {
                let below = &tree.order()[node.range()];
                let is_inside = |&&primitive: &&u32| {
                    let aabb = boxes(primitive);
                    node.aabb.union(aabb) == node.aabb
                };
                assert_eq!(below.iter().filter(is_inside).count(), below.len());
                match node.children(index as u32) {
                    None => {
                        assert!((1..=8).contains(&below.len()));
                        found.extend(below);
                    }
                    Some([left, right]) => {
                        let ranges = [left, right].map(|child| tree.nodes()[child as usize].range());
                        assert_eq!(ranges[0].start..ranges[1].end, node.range());
                        assert_eq!(ranges[0].end, ranges[1].start);
                    }
                }
            }
            found.sort_unstable();
            assert_eq!(found, (0..count as u32).collect::<Vec<_>>());
        }
    }
}
