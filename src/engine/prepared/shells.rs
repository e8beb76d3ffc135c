//! The shells of a model: how they lie to each other, and the sides of the points that they enclose.

use super::PreparedModel;
use crate::bezier::{BezierModel, PatchSet};
use crate::bvh::Aabb;
use crate::clearance::{Body, Goal, Search};
use crate::closest::Target;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::solid::{Boundary, Enclosing, Relation, Side};
use crate::threads::locked;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

/// The largest number of pairs of cells after which it is not known how two shells lie: about 0.1 s.
pub(super) const MAX_PAIRS: usize = 50_000;

/// What is known of a model's shells.
#[derive(Debug, Default)]
pub(super) struct KnownShells {
    /// The patches of shells, by their numbers.
    targets: Mutex<HashMap<u32, Arc<Target>>>,
    relations: Mutex<HashMap<[u32; 2], Relation>>,
}

/// The shells of a model, to be shared by threads.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct Shells<'a> {
    pub(in crate::engine) boundary: &'a Boundary,
    bezier: &'a BezierModel,
    control_box: Aabb,
    known: &'a KnownShells,
}

impl PreparedModel {
    /// Returns the shells that joined edges connect.
    pub(in crate::engine) fn shells(&self) -> Shells<'_> {
        let (boundary, bezier) = (self.boundary(), self.bezier());
        Shells { boundary, bezier, control_box: self.control_box, known: &self.kept.shells }
    }
}

impl Shells<'_> {
    /// Returns the side of the points that these shells of the model enclose, by the rule of
    /// docs/solids.md, section 2. Shells are compared at first use.
    pub(in crate::engine) fn side(&self, enclosing: &Enclosing) -> Side {
        enclosing.side(|pair| self.relation(pair))
    }

    /// Returns how two shells lie, of which both enclose some point, compared at first use.
    fn relation(&self, pair: [u32; 2]) -> Relation {
        if let Some(&known) = locked(&self.known.relations).get(&pair) {
            return known;
        }
        let (found, _) = self.compared(pair, MAX_PAIRS);
        *locked(&self.known.relations).entry(pair).or_insert(found)
    }

    /// Returns whether a shell may lie within another one: whether a point of it is not certainly outside of that.
    pub(super) fn may_be_within(&self, shell: u32, other: u32) -> bool {
        let target = self.target(shell);
        let point = target.patches.patch(0).point([0.5; 2]);
        let error = self.boundary.margin_at(point);
        self.boundary.encloses(other, &self.target(other), point, error) != Some(false)
    }

    /// Returns whether a shell that may lie within another one does, apart from it; `None` where that is not known
    /// after `max_pairs` pairs of cells. The second number is that of the pairs bounded.
    pub(super) fn is_within(&self, shell: u32, other: u32, max_pairs: usize) -> (Option<bool>, usize) {
        let pair = [shell.min(other), shell.max(other)];
        let (relation, pairs) = self.compared(pair, max_pairs);
        let within = match relation {
            Relation::Within => Some(shell < other),
            Relation::About => Some(shell > other),
            Relation::Meeting => Some(false),
            Relation::Unknown => None,
        };
        // What is known after fewer pairs is known after more.
        if within.is_some() {
            locked(&self.known.relations).insert(pair, relation);
        }
        (within, pairs)
    }

    /// Returns how two shells lie, by the least distance of their points, and the number of pairs bounded.
    fn compared(&self, pair: [u32; 2], max_pairs: usize) -> (Relation, usize) {
        let targets = pair.map(|shell| self.target(shell));
        let (apart, pairs) = self.are_apart(&targets, max_pairs);
        let relation = match apart {
            Some(true) => self.nested(pair, &targets),
            Some(false) => Relation::Meeting,
            None => Relation::Unknown,
        };
        (relation, pairs)
    }

    /// Returns whether two shells, with their strips, have no point in common; `None` where that is not known.
    /// Points count as common if their distance is within the rounding error.
    pub(in crate::engine) fn is_apart(&self, pair: [u32; 2]) -> Option<bool> {
        self.are_apart(&pair.map(|shell| self.target(shell)), MAX_PAIRS).0
    }

    /// As [`Self::is_apart`], after at most `max_pairs` pairs of cells and those bounded at once; with their number.
    fn are_apart(&self, targets: &[Arc<Target>; 2], max_pairs: usize) -> (Option<bool>, usize) {
        let point_error = self.bezier.point_error.after(0);
        let body = |target| Body { target, control_box: self.control_box, point_error };
        let bodies = [body(&*targets[0]), body(&*targets[1])];
        let goal = Goal { tolerance: 0.0, limit: None };
        let mut search = Search::new(bodies, RigidTransform::IDENTITY, goal);
        loop {
            let stop = search.advance(usize::MAX);
            let Interval { lower, upper } = search.interval();
            if self.boundary.clear_radius(self.boundary.clear_radius(lower)) > 0.0 {
                return (Some(true), search.pairs());
            }
            if upper <= search.min_tolerance() {
                return (Some(false), search.pairs());
            }
            if stop.is_some() || search.pairs() >= max_pairs {
                return (None, search.pairs());
            }
        }
    }

    /// Returns which of two shells that are apart lies within the other, by a point of the first one.
    fn nested(&self, [_, other]: [u32; 2], targets: &[Arc<Target>; 2]) -> Relation {
        let point = targets[0].patches.patch(0).point([0.5; 2]);
        let error = self.boundary.margin_at(point);
        match self.boundary.encloses(other, &targets[1], point, error) {
            Some(true) => Relation::Within,
            // Both enclose a point, so that one lies within the other.
            Some(false) => Relation::About,
            None => Relation::Unknown,
        }
    }

    /// Returns the patches of a shell, in a tree of their own. O(n log n) at first use.
    fn target(&self, shell: u32) -> Arc<Target> {
        if let Some(known) = locked(&self.known.targets).get(&shell) {
            return Arc::clone(known);
        }
        let shells = self.boundary.shells();
        let mut patches = PatchSet::default();
        let of_shell = self.bezier.patches.iter().filter(|patch| shells[patch.surface] == shell);
        of_shell.for_each(|patch| patches.push(patch));
        let target = Arc::new(Target::new(patches));
        Arc::clone(locked(&self.known.targets).entry(shell).or_insert(target))
    }
}
