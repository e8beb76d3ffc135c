//! Nearest points on B: fast and uncertified, or certified.
//!
//! Upper bounds hold for any foot, so none of them depends on whether a query
//! found the nearest one; it only makes them tight.

mod feet;
mod shortlist;

pub(crate) use feet::Foot;
pub(super) use feet::{Feet, Sample};

use super::Operand;
use crate::closest::{self, NearbyPatch, closest_above, nearest_control, newton_below};
use glam::DVec3;
use shortlist::{Listed, Shortlist};

/// Bound on the Newton steps on one patch.
const MAX_ITERATIONS: u32 = 16;

/// Capacity of the stack of the traversal: deeper than a tree can be that
/// halves the patches and has indices of 32 bits.
const STACK: usize = 64;

/// Nearest-point queries on one operand.
#[derive(Debug)]
pub(super) struct NearestPoint<'a> {
    operand: Operand<'a>,
    shortlist: Shortlist,
}

/// A query: the target, a known foot to improve on, and when to stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Query {
    pub(super) target: DVec3,
    pub(super) known: Foot,
    /// A foot within this distance ends the query.
    pub(super) sufficient: f64,
}

impl<'a> NearestPoint<'a> {
    pub(super) fn new(operand: Operand<'a>) -> Self {
        Self { operand, shortlist: Shortlist::default() }
    }

    /// The foot on one patch by Newton's method from a start near it.
    pub(super) fn on_patch(&self, target: DVec3, patch: u32, start: [f64; 2]) -> Foot {
        self.on_patch_below(target, patch, start, f64::INFINITY)
    }

    /// The same, given up where the foot is not expected to be nearer than
    /// `bound_squared`.
    fn on_patch_below(&self, target: DVec3, patch: u32, start: [f64; 2], bound_squared: f64) -> Foot {
        let surface = self.operand.patch(patch);
        let (foot, _) = newton_below(&surface, target, start, MAX_ITERATIONS, bound_squared);
        let closest::Foot { parameters, distance_squared, status } = foot;
        Foot { patch, parameters, distance_squared, status }
    }

    /// The point of a patch at these parameters, as a foot.
    pub(super) fn at(&self, target: DVec3, patch: u32, parameters: [f64; 2]) -> Foot {
        let distance_squared = self.operand.patch(patch).point(parameters).distance_squared(target);
        Foot { distance_squared, ..Foot::start(patch, parameters) }
    }

    /// The nearest foot found, or the first within `sufficient`. O(log patches)
    /// in general position.
    pub(super) fn nearest(&self, target: DVec3, known: Foot, sufficient: f64) -> Foot {
        self.near(&Query { target, known, sufficient }).nearest()
    }

    /// The nearest foot by the certified search, whose distance is
    /// within `gap`, unless the known foot is nearer.
    pub(super) fn certified(&self, target: DVec3, known: Foot, gap: f64) -> Foot {
        let start = Some((known.patch, known.parameters));
        let nearby = self.shortlist.listed.as_ref().map(|listed| &listed.nearby);
        match closest_above(self.operand.target, target, gap, start, 0.0, nearby) {
            Some(found) if found.upper * found.upper < known.distance_squared => {
                self.on_patch(target, found.patch as u32, found.parameters)
            }
            _ => known,
        }
    }

    /// The feet found on the way to the nearest one, on different patches.
    ///
    /// Near the witness around which patches are listed only these are
    /// examined, from their feet there and in the order of their lower bounds;
    /// elsewhere the tree is traversed, nearest box first. O(log patches) in
    /// general position.
    pub(super) fn near(&self, query: &Query) -> Feet {
        let mut traversal = Traversal::new(self, query);
        if !traversal.examine_shortlist() {
            traversal.examine_tree();
        }
        traversal.feet
    }

    /// Forgets the patches queried so far; see [`NearestPoint::update_shortlist`].
    pub(super) fn reset_queries(&mut self) {
        self.shortlist.reset_queries();
    }

    /// Lists the patches around the witness at this distance, if that pays,
    /// for cells of this radius near it.
    pub(super) fn update_shortlist(&mut self, witness: DVec3, distance: f64, radius: f64) {
        self.shortlist.update(self.operand.target, witness, distance, radius);
    }
}

/// A query under way.
struct Traversal<'a> {
    service: &'a NearestPoint<'a>,
    query: Query,
    feet: Feet,
    sufficient_squared: f64,
}

impl<'a> Traversal<'a> {
    fn new(service: &'a NearestPoint<'_>, query: &Query) -> Self {
        Self {
            service,
            query: *query,
            feet: Feet::new(query.known),
            sufficient_squared: query.sufficient.max(0.0) * query.sufficient,
        }
    }

    fn is_done(&self) -> bool {
        self.bound_squared() <= self.sufficient_squared
    }

    /// The squared distance below which a patch is examined.
    fn bound_squared(&self) -> f64 {
        self.feet.nearest().distance_squared
    }

    /// Examines the listed patches; returns whether no other can be nearer.
    fn examine_shortlist(&mut self) -> bool {
        let Some(Listed { nearby, starts }) = &self.service.shortlist.listed else { return false };
        let moved = nearby.center.distance(self.query.target);
        if moved >= nearby.margin() {
            return false;
        }
        for (candidate, &start) in nearby.list.iter().zip(starts) {
            let NearbyPatch { patch, lower_bound: least, .. } = *candidate;
            let lower_bound = (least - moved).max(0.0);
            if lower_bound * lower_bound >= self.bound_squared() || self.is_done() {
                break;
            }
            if nearby.lower_bound_squared(candidate, self.query.target) < self.bound_squared() {
                self.examine(patch, start);
            }
        }
        self.bound_squared().sqrt() <= nearby.radius - moved
    }

    fn examine_tree(&mut self) {
        let Query { target, .. } = self.query;
        let operand = &self.service.operand;
        let nodes = operand.target.tree.nodes();
        let to_box = |index: usize| nodes[index].aabb.min_distance_squared(target);
        let mut stack = [(0.0_f64, 0_usize); STACK];
        let mut height = 1;
        while height > 0 && !self.is_done() {
            height -= 1;
            let (distance_squared, index) = stack[height];
            if distance_squared >= self.bound_squared() {
                continue;
            }
            let node = &nodes[index];
            if !node.is_leaf() {
                let (left, right) = (index + 1, node.right_child as usize);
                let (to_left, to_right) = (to_box(left), to_box(right));
                let children = if to_left <= to_right {
                    [(to_right, right), (to_left, left)]
                } else {
                    [(to_left, left), (to_right, right)]
                };
                for (distance_squared, child) in children {
                    if distance_squared < self.bound_squared() {
                        stack[height] = (distance_squared, child);
                        height += 1;
                    }
                }
                continue;
            }
            let patch = operand.target.tree.primitive(node);
            if operand.target.oriented_box(patch).min_distance_squared(target) < self.bound_squared() {
                self.examine(patch, nearest_control(&operand.patch(patch), target));
            }
        }
    }

    /// Adds the foot on a patch from a start.
    fn examine(&mut self, patch: u32, start: [f64; 2]) {
        self.service.shortlist.count_query();
        self.feet.add(self.service.on_patch_below(self.query.target, patch, start, self.bound_squared()));
    }
}
