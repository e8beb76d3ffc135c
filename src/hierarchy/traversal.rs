//! The traversal of pairs of boxes level by level: stages `bound`, `extremes` and
//! `cull`.

use super::{DistanceBounds, GridTree};
use crate::bvh::Aabb;
use crate::rounding::upper_max;
use crate::threads::parallel::map;
use std::ops::Range;

/// The boxes of A on a level that are not culled, each with its partners: the
/// boxes of B that may contain the nearest point to one of its points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pairs {
    /// The boxes of A.
    nodes: Vec<u32>,
    /// The start of each box's partners, and the end of the last box's.
    starts: Vec<usize>,
    partners: Vec<u32>,
}

/// Bounds for a box of A on the level below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NodeBounds {
    /// The index of the box.
    pub node: u32,
    /// The position of its parent in the pairs.
    pub parent: u32,
    /// Bounds on the squared distance from any of its points to B.
    pub distances: DistanceBounds,
}

/// A traversal of two trees, at one level.
#[derive(Debug)]
pub struct Traversal<'a> {
    trees: [&'a GridTree; 2],
    boxes: [Vec<Vec<Aabb>>; 2],
    /// The level of the pairs.
    pub level: usize,
    pairs: Pairs,
}

impl Pairs {
    /// Returns an empty list.
    #[must_use]
    pub fn new() -> Self {
        Self { starts: vec![0], ..Self::default() }
    }

    /// Adds a box of A with its partners.
    pub fn push(&mut self, node: u32, partners: &[u32]) {
        self.nodes.push(node);
        self.partners.extend_from_slice(partners);
        self.starts.push(self.partners.len());
    }

    /// Returns the number of boxes of A.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// Returns the number of partners of the box of A at this position.
    #[must_use]
    pub fn partner_count(&self, position: usize) -> usize {
        self.partners(position).len()
    }

    fn partners(&self, position: usize) -> &[u32] {
        &self.partners[self.starts[position]..self.starts[position + 1]]
    }
}

impl<'a> Traversal<'a> {
    /// Starts at the pair of roots; `boxes` are those of the trees by [`super::pyramid`].
    #[must_use]
    pub fn new(trees: [&'a GridTree; 2], boxes: [Vec<Vec<Aabb>>; 2]) -> Self {
        let pairs = Pairs { nodes: vec![0], starts: vec![0, 1], partners: vec![0] };
        Self { trees, boxes, level: 0, pairs }
    }

    /// Returns the last level, on which both sides are cells. The side with fewer
    /// levels stays at its root until the other has as many left.
    #[must_use]
    pub fn finest(&self) -> usize {
        self.trees[0].finest.max(self.trees[1].finest)
    }

    /// Returns the pairs of the level.
    #[must_use]
    pub fn pairs(&self) -> &Pairs {
        &self.pairs
    }

    /// Returns the level of one side's tree that `level` of the traversal is at.
    fn tree_level(&self, side: usize, level: usize) -> usize {
        (level + self.trees[side].finest).saturating_sub(self.finest())
    }

    /// Returns the children of a node of one side on the level below.
    fn children(&self, side: usize, node: u32) -> Range<usize> {
        let (current, below) = (self.tree_level(side, self.level), self.tree_level(side, self.level + 1));
        if current == below {
            node as usize..node as usize + 1
        } else {
            self.trees[side].levels[current][node as usize].range()
        }
    }

    /// Returns the boxes of one side on the level below.
    fn below(&self, side: usize) -> &[Aabb] {
        &self.boxes[side][self.tree_level(side, self.level + 1)]
    }

    /// Stage `bound`: returns bounds for the children of the boxes of A at these
    /// positions in the pairs, from the children of their parents' partners.
    ///
    /// O(pairs of the children).
    #[must_use]
    pub fn bound(&self, positions: Range<usize>) -> Vec<NodeBounds> {
        let bound_children = |offset: usize| {
            let parent = positions.start + offset;
            let children = self.children(0, self.pairs.nodes[parent]);
            children.map(|node| self.bound_child(parent, node)).collect::<Vec<_>>()
        };
        map(positions.len(), bound_children).concat()
    }

    /// Bounds one child of the box of A at position `parent`.
    fn bound_child(&self, parent: usize, node: usize) -> NodeBounds {
        let (aabb, others) = (&self.below(0)[node], self.below(1));
        let mut distances = DistanceBounds::UNKNOWN;
        for &partner in self.pairs.partners(parent) {
            for other in self.children(1, partner) {
                distances = distances.nearest(DistanceBounds::between(aabb, &others[other]));
            }
        }
        NodeBounds { node: node as u32, parent: parent as u32, distances }
    }

    /// Stage `cull`: returns the boxes of B on the level below that may contain the
    /// nearest point to a point of a bounded box of A; none if that box is nearer
    /// than the squared lower bound `lower`, and so cannot contain the farthest point.
    ///
    /// These are the 2011 paper's culling rules: a pair is culled if its smallest
    /// distance exceeds the smallest of the largest distances over the pairs of its
    /// box of A, and a box of A if that distance is below another box's lower bound.
    #[must_use]
    pub fn cull(&self, bound: &NodeBounds, lower: f64) -> Vec<u32> {
        if bound.distances.far < lower {
            return Vec::new();
        }
        let (aabb, others) = (&self.below(0)[bound.node as usize], self.below(1));
        let partners = self.pairs.partners(bound.parent as usize).iter();
        let children = partners.flat_map(|&partner| self.children(1, partner));
        let near = |other: &usize| DistanceBounds::between(aabb, &others[*other]).near <= bound.distances.far;
        children.filter(near).map(|other| other as u32).collect()
    }

    /// Moves to the level below, which has these pairs.
    pub fn descend_to(&mut self, pairs: Pairs) {
        self.pairs = pairs;
        self.level += 1;
    }

    /// Returns, on the last level, the cell of A with the largest lower bound among
    /// those at these positions in the pairs, and its partner with the smallest upper
    /// bound; then that lower bound.
    #[must_use]
    pub fn farthest(&self, positions: Range<usize>) -> ([usize; 2], f64) {
        let [a, b] = [0, 1].map(|side| &self.boxes[side][self.trees[side].finest]);
        let (mut farthest, mut best) = ([0, 0], f64::NEG_INFINITY);
        for position in positions {
            let node = self.pairs.nodes[position];
            let (mut distances, mut nearest) = (DistanceBounds::UNKNOWN, 0);
            for &partner in self.pairs.partners(position) {
                let bounds = DistanceBounds::between(&a[node as usize], &b[partner as usize]);
                if bounds.far < distances.far {
                    nearest = partner;
                }
                distances = distances.nearest(bounds);
            }
            if distances.near > best {
                (farthest, best) = ([node as usize, nearest as usize], distances.near);
            }
        }
        (farthest, best)
    }
}

/// Stage `extremes`: returns the bounds on the squared directed distance, the
/// largest bounds of the boxes, and zeros if there are none.
///
/// A lower bound that is NaN leaves the others in place, an upper bound that is
/// NaN makes the result +∞.
#[must_use]
pub fn extremes(bounds: &[NodeBounds]) -> DistanceBounds {
    let distances = || bounds.iter().map(|bound| bound.distances);
    DistanceBounds {
        near: distances().map(|distances| distances.near).fold(0.0, f64::max),
        far: distances().map(|distances| distances.far).fold(0.0, upper_max),
    }
}
