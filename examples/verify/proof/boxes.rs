//! A tree of the boxes of patches.

use super::bezier::Patch;
use super::interval::Interval;
use super::vector::{Vector, difference, hull, norm};

/// A node: its box, and its children or its patch.
struct Node {
    bounds: Vector,
    content: Content,
}

enum Content {
    Patch(usize),
    Children([usize; 2]),
}

/// A binary tree of boxes; each contains the patches below it, rigorously.
pub(crate) struct BoxTree {
    nodes: Vec<Node>,
    root: usize,
}

impl BoxTree {
    /// Splits at the median along the longest axis of the centres. O(n log² n).
    pub(crate) fn new(patches: &[Patch]) -> Self {
        let mut items: Vec<(usize, Vector)> =
            patches.iter().map(|patch| patch.net.bounding_box()).enumerate().collect();
        let mut tree = Self { nodes: Vec::with_capacity(2 * items.len()), root: 0 };
        tree.root = tree.build(&mut items);
        tree
    }

    fn build(&mut self, items: &mut [(usize, Vector)]) -> usize {
        let node = if let [(patch, bounds)] = items {
            Node { bounds: *bounds, content: Content::Patch(*patch) }
        } else {
            let bounds = items[1..].iter().fold(items[0].1, |bounds, (_, item)| hull(&bounds, item));
            let size = |axis: &usize| bounds[*axis].hi - bounds[*axis].lo;
            let longest = (0..3).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(0);
            items.sort_by(|(_, a), (_, b)| a[longest].mid().total_cmp(&b[longest].mid()));
            let (left, right) = items.split_at_mut(items.len() / 2);
            let children = [self.build(left), self.build(right)];
            Node { bounds, content: Content::Children(children) }
        };
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Calls `visit` with patches and the distances of their boxes, near ones about first. It
    /// returns the distance from which on boxes are left out. In float64, not rigorous.
    pub(crate) fn visit(&self, point: [f64; 3], mut visit: impl FnMut(usize, f64) -> f64) {
        let distance = |node: usize| {
            let squares = self.nodes[node].bounds.iter().zip(point).map(|(bounds, coordinate)| {
                let outside = f64::max(0.0, f64::max(bounds.lo - coordinate, coordinate - bounds.hi));
                outside * outside
            });
            squares.sum::<f64>().sqrt()
        };
        let mut limit = f64::INFINITY;
        let mut stack = vec![(self.root, distance(self.root))];
        while let Some((node, bound)) = stack.pop() {
            if bound >= limit && limit.is_finite() {
                continue;
            }
            match self.nodes[node].content {
                Content::Patch(patch) => limit = visit(patch, bound),
                Content::Children(children) => {
                    let mut pair = children.map(|child| (child, distance(child)));
                    if pair[0].1 < pair[1].1 {
                        pair.reverse();
                    }
                    stack.extend(pair);
                }
            }
        }
    }

    /// Every patch whose box is not proved farther than `limit` from all of `points`.
    pub(crate) fn within(&self, points: &Vector, limit: f64) -> Vec<usize> {
        let mut found = Vec::new();
        let mut stack = vec![self.root];
        while let Some(node) = stack.pop() {
            let Node { bounds, content } = &self.nodes[node];
            if box_distance(points, bounds) > limit {
                continue;
            }
            match *content {
                Content::Patch(patch) => found.push(patch),
                Content::Children(children) => stack.extend(children),
            }
        }
        found
    }
}

/// A lower bound of the distance between two boxes.
pub(crate) fn box_distance(a: &Vector, b: &Vector) -> f64 {
    let gaps = difference(a, b).map(|gap| {
        let least = f64::max(0.0, f64::max(gap.lo, -gap.hi));
        Interval::point(least)
    });
    norm(&gaps).lo
}
