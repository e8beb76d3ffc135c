//! The frontier: the nodes that are still to be bounded.

use super::node::{Domain, SearchNode};
use std::collections::VecDeque;

/// Number of nodes up to which the frontier is breadth-first. Beyond it, nodes
/// of the largest upper bounds are taken first and their children before others,
/// which adds only a few nodes a level: some hundred MiB in all.
const CAPACITY: usize = 1 << 21;

/// Part of the capacity that is selected by upper bound at a time: a selection
/// visits all nodes.
const SELECTED_PART: usize = 32;

/// Breadth-first, so that a far point is found early; best-first when full.
#[derive(Debug)]
pub(super) struct Frontier {
    nodes: VecDeque<SearchNode>,
    /// Nodes that only float64 can bound; they come first.
    float64_only: Vec<SearchNode>,
    capacity: usize,
    /// Selected nodes that remain at the back.
    selected: usize,
}

impl Frontier {
    pub(super) fn new(root: SearchNode) -> Self {
        Self { nodes: VecDeque::from([root]), float64_only: Vec::new(), capacity: CAPACITY, selected: 0 }
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether the oldest node is a cell.
    pub(super) fn begins_with_cell(&self) -> bool {
        self.nodes.front().is_some_and(|node| matches!(node.domain, Domain::Cell(_)))
    }

    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.float64_only.is_empty()
    }

    pub(super) fn has_float64_only(&self) -> bool {
        !self.float64_only.is_empty()
    }

    /// The largest upper bound of all nodes.
    pub(super) fn upper_bound(&self) -> f64 {
        self.nodes.iter().chain(&self.float64_only).fold(0.0, |bound, node| bound.max(node.upper))
    }

    pub(super) fn extend(&mut self, nodes: Vec<SearchNode>) {
        self.nodes.extend(nodes);
    }

    pub(super) fn extend_float64_only(&mut self, nodes: Vec<SearchNode>) {
        self.float64_only.extend(nodes);
    }

    /// Takes out the next nodes, at most `count`.
    pub(super) fn next(&mut self, count: usize) -> Vec<SearchNode> {
        if !self.float64_only.is_empty() {
            let keep = self.float64_only.len().saturating_sub(count);
            return self.float64_only.drain(keep..).collect();
        }
        let mut next = Vec::with_capacity(count.min(self.nodes.len()));
        while next.len() < count
            && let Some(node) = self.pop()
        {
            next.push(node);
        }
        next
    }

    /// Takes out the next cells, at most `count`, and the largest upper bound of
    /// the nodes before them that the threshold prunes.
    pub(super) fn next_cells(&mut self, count: usize, prune_threshold: f64) -> (Vec<SearchNode>, f64) {
        let (mut cells, mut others, mut pruned) = (Vec::new(), Vec::new(), 0.0_f64);
        while cells.len() < count
            && let Some(node) = self.pop()
        {
            if node.upper <= prune_threshold {
                pruned = pruned.max(node.upper);
            } else if matches!(node.domain, Domain::Cell(_)) {
                cells.push(node);
            } else {
                others.push(node);
            }
        }
        self.extend(others);
        (cells, pruned)
    }

    /// The oldest node, or one of the largest upper bounds if there are too many.
    fn pop(&mut self) -> Option<SearchNode> {
        if self.nodes.len() <= self.capacity {
            return self.nodes.pop_front();
        }
        if self.selected == 0 {
            self.select_largest();
        }
        self.selected = self.selected.saturating_sub(1);
        self.nodes.pop_back()
    }

    /// Moves nodes of the largest upper bounds to the back.
    fn select_largest(&mut self) {
        self.selected = self.capacity / SELECTED_PART;
        let first = self.nodes.len() - self.selected;
        let by_bound = |a: &SearchNode, b: &SearchNode| a.upper.total_cmp(&b.upper);
        self.nodes.make_contiguous().select_nth_unstable_by(first, by_bound);
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::super::Cell;
    use super::super::super::nearest::Foot;
    use super::*;

    fn node(upper: f64) -> SearchNode {
        SearchNode { domain: Domain::BvhNode(0), upper, foot: Foot::start(0, [0.5; 2]), level: 0 }
    }

    fn uppers(nodes: &[SearchNode]) -> Vec<f64> {
        nodes.iter().map(|region| region.upper).collect()
    }

    #[test]
    fn the_oldest_come_first_while_there_is_room() {
        let mut frontier = Frontier::new(node(1.0));
        frontier.extend(vec![node(3.0), node(2.0)]);
        assert_eq!(uppers(&frontier.next(2)), [1.0, 3.0]);
        assert_eq!(frontier.upper_bound(), 2.0);
    }

    #[test]
    fn the_largest_bounds_come_first_when_it_is_full() {
        let random = &mut fastrand::Rng::with_seed(3);
        let mut frontier = Frontier { capacity: 320, ..Frontier::new(node(0.0)) };
        frontier.extend((0..1000).map(|_| node(random.f64())).collect());
        let mut rest = frontier.upper_bound();
        for _ in 0..20 {
            // Ten at a time are chosen; what is taken is at least what is left.
            let taken = uppers(&frontier.next(10));
            assert_eq!(taken.len(), 10);
            assert!(taken.iter().all(|upper| *upper <= rest && *upper >= frontier.upper_bound()));
            rest = frontier.upper_bound();
        }
    }

    #[test]
    fn cells_are_taken_by_the_same_rule() {
        let cell = |upper: f64| SearchNode { domain: Domain::Cell(Cell::whole(0)), ..node(upper) };
        let mut frontier = Frontier { capacity: 64, ..Frontier::new(node(0.0)) };
        frontier.extend((1..=100).map(|k| cell(f64::from(k % 50))).collect());
        let (cells, pruned) = frontier.next_cells(2, 0.0);
        assert_eq!((uppers(&cells), pruned), (vec![49.0, 49.0], 0.0));
        // With room, the oldest: what is small enough is pruned.
        let mut frontier = Frontier::new(node(0.0));
        frontier.extend((1..=10).map(|k| cell(f64::from(k))).collect());
        let (cells, pruned) = frontier.next_cells(2, 3.0);
        assert_eq!((uppers(&cells), pruned), (vec![4.0, 5.0], 3.0));
    }

    #[test]
    fn nothing_is_lost() {
        let random = &mut fastrand::Rng::with_seed(4);
        let mut frontier = Frontier { capacity: 64, ..Frontier::new(node(0.0)) };
        let (mut given, mut taken) = (1, 0);
        for _ in 0..50 {
            frontier.extend(
                (0..random.usize(0..30)).map(|_| node(random.f64())).inspect(|_| given += 1).collect(),
            );
            frontier.extend_float64_only(
                (0..random.usize(0..5)).map(|_| node(1.0)).inspect(|_| given += 1).collect(),
            );
            taken += frontier.next(random.usize(1..16)).len();
        }
        while !frontier.is_empty() {
            taken += frontier.next(7).len();
        }
        assert_eq!(given, taken);
    }
}
