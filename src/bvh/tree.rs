//! The bounding volume hierarchy.

use super::Aabb;
use glam::DVec3;

/// A node of a [`Bvh`]: an inner node has two children, a leaf one primitive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// A box that contains the boxes of all primitives below.
    pub aabb: Aabb,
    /// The index of the right child, 0 in a leaf. The left child follows its parent.
    pub right_child: u32,
    /// The position in [`Bvh::order`] of the first primitive below.
    pub first_leaf: u32,
}

impl Node {
    /// Returns whether the node has no children.
    #[must_use]
    pub fn is_leaf(&self) -> bool {
        self.right_child == 0
    }
}

/// A binary tree of boxes over the primitives `0..n`, with its nodes in
/// depth-first order, root first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    order: Vec<u32>,
}

impl Bvh {
    /// Builds the tree over the primitives' boxes, down to one primitive per leaf.
    ///
    /// Every node is split at the median of the boxes' centres along the longest
    /// axis, so the depth is at most `ceil(log2 n)`. Leaves hold single
    /// primitives because work on a patch costs more than the two box tests that
    /// may avoid it. O(n log n) on average.
    #[must_use]
    pub fn new(boxes: &[Aabb]) -> Self {
        let mut tree =
            Self { nodes: Vec::with_capacity(2 * boxes.len()), order: (0..boxes.len() as u32).collect() };
        if !boxes.is_empty() {
            let mut order = std::mem::take(&mut tree.order);
            let centers: Vec<DVec3> = boxes.iter().map(Aabb::center).collect();
            tree.build(boxes, &centers, &mut order, 0);
            tree.order = order;
        }
        tree
    }

    /// Returns the same tree over primitives that have moved: its boxes are those of
    /// `boxes`, as many as before. O(n).
    ///
    /// Sound for any boxes, and slower to search the more their order has changed.
    #[must_use]
    pub fn refitted(&self, boxes: &[Aabb]) -> Self {
        let mut tree = self.clone();
        // Children follow their parents.
        for index in (0..tree.nodes.len()).rev() {
            let node = tree.nodes[index];
            tree.nodes[index].aabb = if node.is_leaf() {
                boxes[tree.primitive(&node) as usize]
            } else {
                tree.nodes[index + 1].aabb.union(tree.nodes[node.right_child as usize].aabb)
            };
        }
        tree
    }

    /// Appends the subtree over the primitives `order`, which begin at `first_leaf`.
    fn build(&mut self, boxes: &[Aabb], centers: &[DVec3], order: &mut [u32], first_leaf: u32) {
        let box_at = |index: &u32| boxes[*index as usize];
        let aabb = order.iter().fold(Aabb::EMPTY, |aabb, index| aabb.union(box_at(index)));
        let node = self.nodes.len();
        self.nodes.push(Node { aabb, right_child: 0, first_leaf });
        if order.len() == 1 {
            return;
        }
        let around = order.iter().fold(Aabb::EMPTY, |aabb, &index| aabb.with(centers[index as usize]));
        let axis = longest_axis(around.extent());
        let middle = order.len() / 2;
        order.select_nth_unstable_by(middle, |&a, &b| {
            centers[a as usize][axis].total_cmp(&centers[b as usize][axis])
        });
        let (left, right) = order.split_at_mut(middle);
        self.build(boxes, centers, left, first_leaf);
        self.nodes[node].right_child = self.nodes.len() as u32;
        self.build(boxes, centers, right, first_leaf + middle as u32);
    }

    /// Returns the nodes, root first; without primitives there are none.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Returns the primitives in the order of the leaves.
    #[must_use]
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Returns the primitive of a leaf, or the first one below an inner node.
    #[must_use]
    pub fn primitive(&self, node: &Node) -> u32 {
        self.order[node.first_leaf as usize]
    }

    /// Returns the leaves whose boxes have a squared distance of at most
    /// `radius_squared` from `point`. O(nodes visited).
    #[must_use]
    pub fn leaves_within(&self, point: DVec3, radius_squared: f64) -> Vec<Node> {
        let mut leaves = Vec::new();
        let mut stack = vec![0];
        while let Some(index) = stack.pop() {
            let Some(node) = self.nodes.get(index) else { continue };
            if node.aabb.min_distance_squared(point) > radius_squared {
                continue;
            }
            if node.is_leaf() {
                leaves.push(*node);
            } else {
                stack.extend_from_slice(&[index + 1, node.right_child as usize]);
            }
        }
        leaves
    }
}

/// Returns the index of the largest coordinate, the first of equals.
fn longest_axis(extent: DVec3) -> usize {
    if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    }
}
