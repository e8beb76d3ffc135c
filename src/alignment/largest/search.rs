//! The interval of the least largest distance over a box of motions, by branch and bound.

use super::bound::{Clearance, Contacts};
use super::chart::Cell;
use crate::threads::parallel::map;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The number of cells that are halved between two checkpoints.
const CELLS_AT_ONCE: usize = 8;

/// When the search has found what it looks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Goal {
    /// The lower bound from which the interval is narrow enough.
    pub(crate) lower: f64,
    /// The largest number of cells that are bounded.
    pub(crate) most_cells: usize,
}

/// A cell with its lower bound.
struct Entry {
    lower: f64,
    cell: Cell,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Entry {}
impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Entry {
    /// The least bound is the heap's largest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.lower.total_cmp(&self.lower)
    }
}

/// A search over the cells of a box, those with the least bounds first.
pub(crate) struct BoxSearch<'a, C> {
    contacts: Contacts<'a, C>,
    queue: BinaryHeap<Entry>,
    cells: usize,
}

impl<'a, C: Clearance> BoxSearch<'a, C> {
    /// Bounds the whole box.
    pub(crate) fn new(contacts: Contacts<'a, C>, cell: Cell) -> Self {
        let lower = contacts.lower(&cell);
        Self { contacts, queue: BinaryHeap::from([Entry { lower, cell }]), cells: 1 }
    }

    /// Halves some cells; returns whether the goal is reached or the number of cells is spent.
    pub(crate) fn advance(&mut self, goal: Goal) -> bool {
        if self.lower() >= goal.lower || self.cells >= goal.most_cells {
            return true;
        }
        let mut halved = Vec::new();
        while halved.len() < 2 * CELLS_AT_ONCE && self.queue.peek().is_some_and(|one| one.lower < goal.lower)
        {
            let Some(Entry { lower, cell }) = self.queue.pop() else { break };
            halved.extend(cell.halves().map(|half| (lower, half)));
        }
        let bounds = map(halved.len(), |index| self.contacts.lower(&halved[index].1));
        self.cells += bounds.len();
        self.queue.extend(halved.into_iter().zip(bounds).map(|((before, cell), found)| Entry {
            // What holds in a cell holds in its halves.
            lower: if found > before { found } else { before },
            cell,
        }));
        false
    }

    /// Returns a lower bound on the largest distance over the box.
    pub(crate) fn lower(&self) -> f64 {
        self.queue.peek().map_or(0.0, |one| one.lower)
    }

    /// Returns the number of cells that were bounded.
    pub(crate) fn cells(&self) -> usize {
        self.cells
    }
}
