//! The regions that wait to be bounded.

use super::region::{Domain, SearchNode};
use std::collections::VecDeque;

/// Regions kept, at most, before those of the largest bounds are taken first,
/// and their parts before others, which adds only a few a level: some hundred MiB.
const CAPACITY: usize = 1 << 21;

/// Part of the capacity that is chosen for its bounds at a time: choosing looks
/// at all regions, so it is seldom done.
const CHOSEN_PART: usize = 32;

/// Cells, at most, of which as few follow as a certificate takes the time of.
const ENDING: usize = 16;

/// Breadth first, so that a far point is met soon; when it is full, the largest
/// bounds first.
#[derive(Debug)]
pub(super) struct Queue {
    regions: VecDeque<SearchNode>,
    /// Regions that only float64 can bound; they come first.
    undecided: Vec<SearchNode>,
    capacity: usize,
    /// Regions still to be taken from the end before others are chosen.
    chosen: usize,
}

impl Queue {
    pub(super) fn new(first: SearchNode) -> Self {
        Self { regions: VecDeque::from([first]), undecided: Vec::new(), capacity: CAPACITY, chosen: 0 }
    }

    pub(super) fn len(&self) -> usize {
        self.regions.len()
    }

    pub(super) fn is_empty(&self) -> bool {
        self.regions.is_empty() && self.undecided.is_empty()
    }

    pub(super) fn has_undecided(&self) -> bool {
        !self.undecided.is_empty()
    }

    /// Whether only cells wait, and few: mostly parts about the farthest point,
    /// which leave a thread to spare.
    pub(super) fn is_ending(&self) -> bool {
        self.len() <= ENDING
            && self.regions.front().is_some_and(|region| matches!(region.domain, Domain::Cell(_)))
    }

    /// The largest bound of all that waits.
    pub(super) fn upper(&self) -> f64 {
        self.regions.iter().chain(&self.undecided).fold(0.0, |upper, region| upper.max(region.upper))
    }

    pub(super) fn extend(&mut self, regions: Vec<SearchNode>) {
        self.regions.extend(regions);
    }

    pub(super) fn extend_undecided(&mut self, regions: Vec<SearchNode>) {
        self.undecided.extend(regions);
    }

    /// Takes out the next regions, up to `most`.
    pub(super) fn next(&mut self, most: usize) -> Vec<SearchNode> {
        if !self.undecided.is_empty() {
            let keep = self.undecided.len().saturating_sub(most);
            return self.undecided.drain(keep..).collect();
        }
        let mut next = Vec::with_capacity(most.min(self.regions.len()));
        while next.len() < most
            && let Some(region) = self.pop()
        {
            next.push(region);
        }
        next
    }

    /// Takes out the next cells, up to `most`, and how large the bounds were of
    /// the regions before them that were at most `prune_threshold`.
    pub(super) fn next_cells(&mut self, most: usize, prune_threshold: f64) -> (Vec<SearchNode>, f64) {
        let (mut cells, mut nodes, mut dropped) = (Vec::new(), Vec::new(), 0.0_f64);
        while cells.len() < most
            && let Some(region) = self.pop()
        {
            if region.upper <= prune_threshold {
                dropped = dropped.max(region.upper);
            } else if matches!(region.domain, Domain::Cell(_)) {
                cells.push(region);
            } else {
                nodes.push(region);
            }
        }
        self.extend(nodes);
        (cells, dropped)
    }

    /// The oldest region, or one of the largest bounds if there are too many.
    fn pop(&mut self) -> Option<SearchNode> {
        if self.regions.len() <= self.capacity {
            return self.regions.pop_front();
        }
        if self.chosen == 0 {
            self.choose();
        }
        self.chosen = self.chosen.saturating_sub(1);
        self.regions.pop_back()
    }

    /// Brings regions of the largest bounds to the end.
    fn choose(&mut self) {
        self.chosen = self.capacity / CHOSEN_PART;
        let regions = &self.regions;
        let mut order: Vec<u32> = (0..regions.len() as u32).collect();
        let first = regions.len() - self.chosen;
        order.select_nth_unstable_by(first, |&a, &b| {
            regions[a as usize].upper.total_cmp(&regions[b as usize].upper)
        });
        self.regions = order.iter().map(|&index| regions[index as usize]).collect();
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::feet::Foot;
    use super::super::region::Cell;
    use super::*;

    fn region(upper: f64) -> SearchNode {
        SearchNode { domain: Domain::Node(0), upper, foot: Foot::start(0, [0.5; 2]), level: 0 }
    }

    fn uppers(regions: &[SearchNode]) -> Vec<f64> {
        regions.iter().map(|region| region.upper).collect()
    }

    #[test]
    fn the_oldest_come_first_while_there_is_room() {
        let mut queue = Queue::new(region(1.0));
        queue.extend(vec![region(3.0), region(2.0)]);
        assert_eq!(uppers(&queue.next(2)), [1.0, 3.0]);
        assert_eq!(queue.upper(), 2.0);
    }

    #[test]
    fn the_largest_bounds_come_first_when_it_is_full() {
        let random = &mut fastrand::Rng::with_seed(3);
        let mut queue = Queue { capacity: 320, ..Queue::new(region(0.0)) };
        queue.extend((0..1000).map(|_| region(random.f64())).collect());
        let mut rest = queue.upper();
        for _ in 0..20 {
            // Ten at a time are chosen; what is taken is at least what is left.
            let taken = uppers(&queue.next(10));
            assert_eq!(taken.len(), 10);
            assert!(taken.iter().all(|upper| *upper <= rest && *upper >= queue.upper()));
            rest = queue.upper();
        }
    }

    #[test]
    fn cells_are_lent_by_the_same_rule() {
        let cell = |upper: f64| SearchNode { domain: Domain::Cell(Cell::whole(0)), ..region(upper) };
        let mut queue = Queue { capacity: 64, ..Queue::new(region(0.0)) };
        queue.extend((1..=100).map(|k| cell(f64::from(k % 50))).collect());
        let (cells, dropped) = queue.next_cells(2, 0.0);
        assert_eq!((uppers(&cells), dropped), (vec![49.0, 49.0], 0.0));
        // With room, the oldest: what is small enough is dropped.
        let mut queue = Queue::new(region(0.0));
        queue.extend((1..=10).map(|k| cell(f64::from(k))).collect());
        let (cells, dropped) = queue.next_cells(2, 3.0);
        assert_eq!((uppers(&cells), dropped), (vec![4.0, 5.0], 3.0));
    }

    #[test]
    fn nothing_is_lost() {
        let random = &mut fastrand::Rng::with_seed(4);
        let mut queue = Queue { capacity: 64, ..Queue::new(region(0.0)) };
        let (mut given, mut taken) = (1, 0);
        for _ in 0..50 {
            queue.extend(
                (0..random.usize(0..30)).map(|_| region(random.f64())).inspect(|_| given += 1).collect(),
            );
            queue.extend_undecided(
                (0..random.usize(0..5)).map(|_| region(1.0)).inspect(|_| given += 1).collect(),
            );
            taken += queue.next(random.usize(1..16)).len();
        }
        while !queue.is_empty() {
            taken += queue.next(7).len();
        }
        assert_eq!(given, taken);
    }
}
