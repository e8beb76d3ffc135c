//! A binary tree of boxes over patches.

use super::Aabb;
use glam::DVec3;

/// A node: an inner one has two children, a leaf one box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Contains all boxes below.
    pub aabb: Aabb,
    /// Index of the second child; the first follows its parent. 0 in a leaf.
    pub second: u32,
    /// Place in [`Bvh::order`] of the leaf, of an inner node of the first leaf below.
    pub first: u32,
}

impl Node {
    /// Whether it has no children.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.second == 0
    }
}

/// A tree over boxes `0..n`, nodes in depth-first order, root first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Bvh {
    /// Halves the boxes at the median of their centres along the longest axis,
    /// so that the depth is at most `ceil(log2 n)`, down to single ones: what is
    /// done with a patch costs more than the two box tests that spare one.
    /// O(n log n) on average.
    #[must_use]
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree =
            Self { nodes: Vec::with_capacity(2 * boxes.len()), order: (0..boxes.len() as u32).collect() };
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
        self.nodes.push(Node { aabb, second: 0, first });
        if order.len() == 1 {
            return;
        }
        let centers = order.iter().fold(Aabb::EMPTY, |aabb, index| aabb.with(of(index).center()));
        let axis = longest_axis(centers.extent());
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |&a, &b| {
            boxes[a as usize].center()[axis].total_cmp(&boxes[b as usize].center()[axis])
        });
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

    /// Index of a leaf's box, of an inner node's first one below.
    #[must_use]
    pub fn item(&self, node: &Node) -> u32 {
        self.order[node.first as usize]
    }

    /// The leaves whose boxes are at most the root of `reach_squared` from a point.
    #[must_use]
    pub fn leaves_within(&self, point: DVec3, reach_squared: f64) -> Vec<Node> {
        let mut leaves = Vec::new();
        let mut waiting = vec![0];
        while let Some(index) = waiting.pop() {
            let Some(node) = self.nodes.get(index) else { continue };
            if node.aabb.min_distance_squared(point) > reach_squared {
                continue;
            }
            if node.is_leaf() {
                leaves.push(*node);
            } else {
                waiting.extend_from_slice(&[index + 1, node.second as usize]);
            }
        }
        leaves
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
