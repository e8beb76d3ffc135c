//! The descent through pairs of boxes, level by level: stages `bound`,
//! `extremes` and `cull`.

use super::{Distances, GridTree};
use crate::bvh::Aabb;
use crate::parallel::map;
use std::ops::Range;

/// Boxes of A in work on a level, each with the boxes of B that may contain
/// the nearest point to any of its points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Pairs {
    /// The boxes of A.
    nodes: Vec<u32>,
    /// Where each one's partners begin, and where the last one's end.
    starts: Vec<usize>,
    partners: Vec<u32>,
}

/// A box of A on the level below, bounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// The box.
    pub node: u32,
    /// Place of its parent in the pairs.
    pub parent: u32,
    /// Squared bounds of the distance of any of its points to B.
    pub distances: Distances,
}

/// A level of the descent.
#[derive(Debug)]
pub struct Traversal<'a> {
    trees: [&'a GridTree; 2],
    boxes: [Vec<Vec<Aabb>>; 2],
    /// The level of the pairs.
    pub level: usize,
    pairs: Pairs,
}

impl Pairs {
    /// Without pairs.
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

    /// Number of boxes of A.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    fn partners(&self, place: usize) -> &[u32] {
        &self.partners[self.starts[place]..self.starts[place + 1]]
    }
}

impl<'a> Traversal<'a> {
    /// At the pair of roots. `boxes` are the trees' own, of [`super::pyramid`].
    #[must_use]
    pub fn new(trees: [&'a GridTree; 2], boxes: [Vec<Vec<Aabb>>; 2]) -> Self {
        let pairs = Pairs { nodes: vec![0], starts: vec![0, 1], partners: vec![0] };
        Self { trees, boxes, level: 0, pairs }
    }

    /// The last level, on which both sides are cells. The side with fewer
    /// levels waits at its root for the other.
    #[must_use]
    pub fn finest(&self) -> usize {
        self.trees[0].finest.max(self.trees[1].finest)
    }

    /// The pairs of the level.
    #[must_use]
    pub fn pairs(&self) -> &Pairs {
        &self.pairs
    }

    /// The level of the side's own tree that `level` of the descent is.
    fn own(&self, side: usize, level: usize) -> usize {
        (level + self.trees[side].finest).saturating_sub(self.finest())
    }

    /// The side's node's children, below the level.
    fn children(&self, side: usize, node: u32) -> Range<usize> {
        let (this, below) = (self.own(side, self.level), self.own(side, self.level + 1));
        if this == below {
            node as usize..node as usize + 1
        } else {
            self.trees[side].levels[this][node as usize].range()
        }
    }

    fn below(&self, side: usize) -> &[Aabb] {
        &self.boxes[side][self.own(side, self.level + 1)]
    }

    /// Stage `bound`: the children of the boxes of A at these places in the
    /// pairs, each bounded by the children of its parent's partners.
    ///
    /// O(pairs of the children).
    #[must_use]
    pub fn bound(&self, places: Range<usize>) -> Vec<Bound> {
        let of_place = |offset: usize| {
            let place = places.start + offset;
            let children = self.children(0, self.pairs.nodes[place]);
            children.map(|node| self.bound_child(place, node)).collect::<Vec<_>>()
        };
        map(places.len(), of_place).concat()
    }

    fn bound_child(&self, place: usize, node: usize) -> Bound {
        let (aabb, others) = (&self.below(0)[node], self.below(1));
        let mut distances = Distances::UNKNOWN;
        for &partner in self.pairs.partners(place) {
            for other in self.children(1, partner) {
                distances = distances.nearest(Distances::of(aabb, &others[other]));
            }
        }
        Bound { node: node as u32, parent: place as u32, distances }
    }

    /// Stage `cull`: which boxes of B below the level may contain the nearest
    /// point to a point of a bounded box of A; none if the box of A cannot
    /// contain the farthest point, as it is nearer than `lower`, squared.
    ///
    /// The rules of the 2011 paper: a pair is dropped if its least distance
    /// exceeds the least of the greatest distances of the box of A's pairs,
    /// and a box of A if that is below another's bound from below.
    #[must_use]
    pub fn cull(&self, bound: &Bound, lower: f64) -> Vec<u32> {
        if bound.distances.far < lower {
            return Vec::new();
        }
        let (aabb, others) = (&self.below(0)[bound.node as usize], self.below(1));
        let partners = self.pairs.partners(bound.parent as usize).iter();
        let children = partners.flat_map(|&partner| self.children(1, partner));
        let near = |other: &usize| Distances::of(aabb, &others[*other]).near <= bound.distances.far;
        children.filter(near).map(|other| other as u32).collect()
    }

    /// Goes to the level below, whose pairs these are.
    pub fn descend_to(&mut self, pairs: Pairs) {
        self.pairs = pairs;
        self.level += 1;
    }

    /// On the last level: the cell of A that is the farthest from B by its
    /// bound from below, and of its partners the one that bounds it from above.
    #[must_use]
    pub fn farthest(&self) -> [usize; 2] {
        let [a, b] = [0, 1].map(|side| &self.boxes[side][self.trees[side].finest]);
        let of_pair = |place: usize, partner: u32| {
            Distances::of(&a[self.pairs.nodes[place] as usize], &b[partner as usize])
        };
        let (mut farthest, mut best) = ([0, 0], f64::NEG_INFINITY);
        for (place, &node) in self.pairs.nodes.iter().enumerate() {
            let (mut distances, mut nearest) = (Distances::UNKNOWN, 0);
            for &partner in self.pairs.partners(place) {
                let of_partner = of_pair(place, partner);
                if of_partner.far < distances.far {
                    nearest = partner;
                }
                distances = distances.nearest(of_partner);
            }
            if distances.near > best {
                (farthest, best) = ([node as usize, nearest as usize], distances.near);
            }
        }
        farthest
    }
}

/// Stage `extremes`: the squared bounds of the directed distance, the largest
/// of the boxes' bounds; `[0, 0]` for none.
#[must_use]
pub fn extremes(bounds: &[Bound]) -> Distances {
    let largest = |of: fn(&Bound) -> f64| bounds.iter().map(of).fold(0.0, f64::max);
    Distances { near: largest(|bound| bound.distances.near), far: largest(|bound| bound.distances.far) }
}
