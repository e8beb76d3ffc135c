//! The bounding volume hierarchy.

use super::Aabb;
use crate::threads::parallel::{join, map};
use bytemuck::{Zeroable, zeroed_vec};
use glam::DVec3;

/// A node of a [`Bvh`]: an inner node has two children, a leaf one primitive.
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
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
        let mut nodes: Vec<Node> = zeroed_vec((2 * boxes.len()).saturating_sub(1));
        let primitive = |index: usize| Primitive { center: boxes[index].center(), index: index as u32 };
        let mut primitives = map(boxes.len(), primitive);
        let subtree =
            Subtree { nodes: &mut nodes, first_node: 0, primitives: &mut primitives, first_leaf: 0 };
        build(boxes, subtree);
        Self { nodes, order: map(primitives.len(), |index| primitives[index].index) }
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

    /// Returns a box that contains those of all primitives, [`Aabb::EMPTY`] without any.
    pub(crate) fn bounding_box(&self) -> Aabb {
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.aabb)
    }

    /// Calls a function with each pair of primitives whose boxes meet, once. O(pairs of nodes whose boxes meet).
    pub(crate) fn for_each_pair(&self, mut each: impl FnMut(u32, u32)) {
        let nodes = self.nodes();
        let children = |index: usize| [index + 1, nodes[index].right_child as usize];
        let mut stack = if nodes.is_empty() { Vec::new() } else { vec![[0, 0]] };
        while let Some([a, b]) = stack.pop() {
            if a == b {
                if !nodes[a].is_leaf() {
                    let [left, right] = children(a);
                    stack.extend([[left, left], [left, right], [right, right]]);
                }
                continue;
            }
            let [one, other] = [&nodes[a], &nodes[b]];
            if !one.aabb.meets(&other.aabb) {
                continue;
            }
            match [one.is_leaf(), other.is_leaf()] {
                [true, true] => each(self.primitive(one), self.primitive(other)),
                [false, _] => stack.extend(children(a).map(|child| [child, b])),
                [true, false] => stack.extend(children(b).map(|child| [a, child])),
            }
        }
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

/// A primitive with the centre of its box.
struct Primitive {
    center: DVec3,
    index: u32,
}

/// A part of a tree to be built: `2 n - 1` nodes over n primitives.
struct Subtree<'a> {
    nodes: &'a mut [Node],
    /// The position of the first of them in the tree.
    first_node: usize,
    primitives: &'a mut [Primitive],
    /// The position of the first of them in [`Bvh::order`].
    first_leaf: u32,
}

/// The number of primitives from which on the two halves of a tree are built at a time.
const MIN_PARALLEL: usize = 2048;

/// Fills in a tree; over no primitives there is nothing to fill in.
fn build(boxes: &[Aabb], subtree: Subtree<'_>) {
    let Subtree { nodes, first_node, primitives, first_leaf } = subtree;
    let Some((root, below)) = nodes.split_first_mut() else { return };
    if let [primitive] = primitives {
        *root = Node { aabb: boxes[primitive.index as usize], right_child: 0, first_leaf };
        return;
    }
    let around = primitives.iter().fold(Aabb::EMPTY, |aabb, primitive| aabb.with(primitive.center));
    let axis = longest_axis(around.extent());
    let middle = primitives.len() / 2;
    primitives.select_nth_unstable_by(middle, |a, b| a.center[axis].total_cmp(&b.center[axis]));
    let is_large = primitives.len() >= MIN_PARALLEL;
    let (left_primitives, right_primitives) = primitives.split_at_mut(middle);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * middle - 1);
    let right_child = first_node + 2 * middle;
    let left = Subtree {
        nodes: &mut *left_nodes,
        first_node: first_node + 1,
        primitives: left_primitives,
        first_leaf,
    };
    let right = Subtree {
        nodes: &mut *right_nodes,
        first_node: right_child,
        primitives: right_primitives,
        first_leaf: first_leaf + middle as u32,
    };
    join(is_large, || build(boxes, left), || build(boxes, right));
    let aabb = left_nodes[0].aabb.union(right_nodes[0].aabb);
    *root = Node { aabb, right_child: right_child as u32, first_leaf };
}

/// Returns the index of the largest coordinate, the first of equals.
pub(super) fn longest_axis(extent: DVec3) -> usize {
    if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    }
}
