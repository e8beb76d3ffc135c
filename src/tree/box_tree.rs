//! A binary tree of boxes over patches.

use super::Aabb;
use crate::gather::Gather;
use crate::order::select;
use glam::DVec3;

/// A node: an inner one has two children, a leaf some boxes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Contains all boxes below.
    pub aabb: Aabb,
    /// Index of the second child; the first follows its parent. 0 in a leaf.
    pub second: u32,
    /// First of the leaf's places in [`BoxTree::order`].
    pub first: u32,
    /// Number of boxes in a leaf, 0 in an inner node.
    pub count: u32,
}

/// A tree over boxes `0..n`, nodes in depth-first order, root first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BoxTree {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

/// Boxes in a leaf, at most: what is done with a patch costs more than the two
/// box tests that spare one.
const LEAF_SIZE: usize = 1;

impl BoxTree {
    /// Halves the boxes at the median of their centres along the longest axis,
    /// so that the depth is at most `ceil(log2 n)`. O(n log n) on average.
    #[must_use]
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree = Self {
            nodes: Vec::with_capacity(2 * boxes.len().div_ceil(LEAF_SIZE)),
            order: (0..boxes.len() as u32).gather(),
        };
        if !boxes.is_empty() {
            let mut order = std::mem::take(&mut tree.order);
            tree.build(boxes, &mut order, 0);
            tree.order = order;
        }
        tree
    }

    fn build(&mut self, boxes: &[Aabb], order: &mut [u32], first: u32) {
        let of = |index: &u32| boxes[*index as usize];
        let aabb = order.iter().fold(Aabb::EMPTY, |aabb, index| aabb.union(of(index)));
        let node = self.nodes.len();
        if order.len() <= LEAF_SIZE {
            self.nodes.push(Node { aabb, second: 0, first, count: order.len() as u32 });
            return;
        }
        self.nodes.push(Node { aabb, second: 0, first: 0, count: 0 });
        let centers = order.iter().fold(Aabb::EMPTY, |aabb, index| aabb.with(of(index).center()));
        let axis = longest_axis(centers.extent());
        let middle = order.len() / 2;
        select(order, middle, &|index| boxes[index as usize].center()[axis]);
        let (low, high) = order.split_at_mut(middle);
        self.build(boxes, low, first);
        self.nodes[node].second = self.nodes.len() as u32;
        self.build(boxes, high, first + middle as u32);
    }

    /// The nodes, root first; empty without boxes.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The boxes' indices in the order of the leaves.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.order
    }
}

fn longest_axis(extent: DVec3) -> usize {
    if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    }
}
