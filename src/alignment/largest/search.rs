//! The interval of the least largest distance over a box of motions, by branch and bound.

use super::bound::{Clearance, Contacts};
use super::chart::Cell;
use crate::rounding::upper_max;
use crate::sorting::ordered_by;
use crate::threads::parallel::map;
use std::collections::BinaryHeap;

/// The number of cells whose bounds are audited at corners, too.
const AUDITED_CELLS: usize = 16;

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

/// A cell with its lower bound, and the coordinate across whose side it is halved.
struct Entry {
    lower: f64,
    widest: usize,
    cell: Cell,
}

// The least bound comes first.
ordered_by!(Entry, |entry| -entry.lower);

/// A search over the cells of a box, those with the least bounds first.
///
/// Every bound is audited at the middle of its cell, and those that the result rests on at two of its corners as well: the
/// points of A are no farther from B there than their certified closest points. A bound above that is refuted: the floor
/// takes its place.
pub(crate) struct BoxSearch<'a, C> {
    contacts: Contacts<'a, C>,
    /// What no distance is below.
    floor: f64,
    queue: BinaryHeap<Entry>,
    cells: usize,
    refuted: usize,
}

impl<'a, C: Clearance> BoxSearch<'a, C> {
    /// Bounds the whole box; no distance is below `floor`, wherever A's points are.
    pub(crate) fn new(contacts: Contacts<'a, C>, cell: Cell, floor: f64) -> Self {
        let mut search = Self { contacts, floor, queue: BinaryHeap::new(), cells: 0, refuted: 0 };
        search.bound(vec![(floor, cell)]);
        search
    }

    /// Halves some cells; returns whether the goal is reached or the number of cells is spent.
    pub(crate) fn advance(&mut self, goal: Goal) -> bool {
        if self.lower() >= goal.lower || self.cells >= goal.most_cells {
            return true;
        }
        let mut halved = Vec::new();
        while halved.len() < 2 * CELLS_AT_ONCE && self.queue.peek().is_some_and(|one| one.lower < goal.lower)
        {
            let Some(Entry { lower, widest, cell }) = self.queue.pop() else { break };
            halved.extend(cell.halves(widest).map(|half| (lower, half)));
        }
        self.bound(halved);
        false
    }

    /// Bounds cells, each with the bound of the cell that it is a half of: what holds there holds in its halves.
    fn bound(&mut self, cells: Vec<(f64, Cell)>) {
        let bounds = map(cells.len(), |index| {
            let (before, cell) = &cells[index];
            let (found, in_middle) = self.contacts.bounds(cell);
            let lower = upper_max(*before, found.lower);
            (Entry { lower, widest: found.widest, cell: *cell }, lower > in_middle)
        });
        self.cells += bounds.len();
        for (entry, is_refuted) in bounds {
            self.enter(entry, is_refuted);
        }
    }

    fn enter(&mut self, entry: Entry, is_refuted: bool) {
        self.refuted += usize::from(is_refuted);
        self.queue.push(if is_refuted { Entry { lower: self.floor, ..entry } } else { entry });
    }

    /// Audits the least bounds, on which the result rests, at two corners of their cells.
    pub(crate) fn audit(&mut self) {
        let least: Vec<Entry> = (0..AUDITED_CELLS).map_while(|_| self.queue.pop()).collect();
        let is_refuted = map(least.len(), |index| {
            let Entry { lower, cell, .. } = &least[index];
            cell.opposite_corners().iter().any(|corner| *lower > self.contacts.largest(corner))
        });
        for (entry, is_refuted) in least.into_iter().zip(is_refuted) {
            self.enter(entry, is_refuted);
        }
    }

    /// Returns a lower bound on the largest distance over the box.
    pub(crate) fn lower(&self) -> f64 {
        self.queue.peek().map_or(self.floor, |one| one.lower)
    }

    /// Returns the number of cells that were bounded.
    pub(crate) fn cells(&self) -> usize {
        self.cells
    }

    /// Returns the number of bounds that were refuted, and not relied on: none, unless there is a fault.
    pub(crate) fn refuted(&self) -> usize {
        self.refuted
    }
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use crate::alignment::freedoms::Freedoms;
    use crate::alignment::largest::{Chart, Clear};
    use crate::model::RigidTransform;
    use glam::DVec3;

    /// The plane z = 0, whose lower bounds exceed its distances by a factor.
    struct Plane(f64);

    impl Clearance for Plane {
        type Memory = ();
        const SIGNED: bool = false;
        fn clear(&self, point: DVec3, (): &mut ()) -> Option<Clear> {
            let distance = point.z.abs();
            Some(Clear { lower: self.0 * distance, upper: distance, direction: DVec3::Z * point.z.signum() })
        }
    }

    fn search(factor: f64) -> (f64, usize) {
        let chart = Chart {
            base: RigidTransform::IDENTITY,
            freedoms: Freedoms::all(),
            center: DVec3::ZERO,
            radius: 2.0,
        };
        let contacts = Contacts {
            chart: &chart,
            clearance: &Plane(factor),
            points: &[0.2 * DVec3::Z],
            error: 0.0,
            largest_ball: 1e3,
            width: 1e-3,
        };
        let mut search = BoxSearch::new(contacts, chart.cell(0.0, 1e-3), 0.0);
        search.audit();
        (search.lower(), search.refuted())
    }

    /// A shift of the box brings the point to a distance of 0.199.
    #[test]
    fn a_refuted_bound_is_not_relied_on() {
        let (lower, refuted) = search(1.0);
        assert!(refuted == 0 && 0.1985 < lower && lower <= 0.199, "{lower} {refuted}");
        // Above the distance in the middle, and above that at a corner alone.
        for factor in [1.1, 1.004] {
            assert_eq!(search(factor), (0.0, 1), "{factor}");
        }
    }
}
