//! The shells of a model: how they lie to each other, and the sides of the points that they enclose.

use super::{BodyParts, PreparedModel};
use crate::bezier::{BezierModel, PatchSet};
use crate::bvh::Aabb;
use crate::clearance::{Body, Goal, Search};
use crate::closest::Target;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::solid::{Boundary, Enclosing, Side, SourceSolid};
use crate::threads::{computed, locked};
use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock};

/// The largest number of pairs of cells after which it is not known how two shells lie: about 0.1 s.
pub(super) const MAX_PAIRS: usize = 50_000;

/// The largest number of points of a shell, each on another patch, that show it to be outside of another one.
const MAX_POINTS: usize = 8;

/// What is known of a model's shells.
#[derive(Debug, Default)]
pub(super) struct KnownShells {
    /// The patches of shells, by their numbers.
    targets: Mutex<HashMap<u32, Arc<Target>>>,
    /// Whether two shells have no point in common, the lower number first.
    apart: Mutex<HashMap<[u32; 2], bool>>,
    solids: OnceLock<Vec<SourceSolid>>,
    roles: OnceLock<Vec<Option<ShellRole>>>,
}

/// The shells of a model, to be shared by threads.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct Shells<'a> {
    pub(in crate::engine) boundary: &'a Boundary,
    bezier: &'a BezierModel,
    control_box: Aabb,
    known: &'a KnownShells,
    /// As [`PreparedModel::roles`] and [`PreparedModel::body_parts`]; empty while these are not known.
    roles: &'a [Option<ShellRole>],
    bodies: &'a [BodyParts],
}

/// What a shell is to its body, unless the body may be a void of another one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ShellRole {
    body: usize,
    is_void: bool,
}

impl PreparedModel {
    /// Returns the shells that joined edges connect, with the bodies that they are of.
    pub(in crate::engine) fn sides(&self) -> Shells<'_> {
        Shells { roles: self.roles(), bodies: self.body_parts(), ..self.shells() }
    }

    /// Returns what each shell is to its body; none of a shell without area.
    fn roles(&self) -> &[Option<ShellRole>] {
        computed::<Vec<Option<ShellRole>>>(&self.kept.shells.roles, || {
            let mut roles = vec![None; self.joined().of_shell.len()];
            for (body, parts) in self.body_parts().iter().enumerate() {
                for (place, shell) in parts.shells.iter().enumerate() {
                    roles[shell.shell as usize] = Some(ShellRole { body, is_void: place > 0 });
                }
            }
            roles
        })
    }

    /// Returns the shells that joined edges connect.
    pub(in crate::engine) fn shells(&self) -> Shells<'_> {
        let (boundary, bezier) = (self.boundary(), self.bezier());
        let (control_box, known) = (self.control_box, &self.kept.shells);
        Shells { boundary, bezier, control_box, known, roles: &[], bodies: &[] }
    }

    /// Returns the solid of the source that each shell bounds.
    pub(super) fn solids(&self) -> &[SourceSolid] {
        computed::<Vec<SourceSolid>>(&self.kept.shells.solids, || {
            let joined = self.joined();
            let mut solids = vec![None; joined.of_shell.len()];
            if self.facets.is_none() {
                for (surface, &shell) in joined.shells.iter().enumerate() {
                    let own = SourceSolid::Alone(self.pieces.solid(surface));
                    let known = solids[shell as usize].get_or_insert(own);
                    if *known != own {
                        *known = SourceSolid::Several;
                    }
                }
            }
            solids.into_iter().map(|solid| solid.unwrap_or(SourceSolid::Alone(None))).collect()
        })
    }
}

impl Shells<'_> {
    /// Returns the side of the points that these shells of the model enclose, by the rule of docs/solids.md, section 2.
    /// Shells are compared at first use.
    pub(in crate::engine) fn side(&self, enclosing: &Enclosing) -> Side {
        let role = |&shell: &u32| self.roles.get(shell as usize).copied().flatten();
        let roles: Vec<ShellRole> = enclosing.shells().iter().filter_map(role).collect();
        let nests = |body: usize| &self.bodies[body].may_nest_with;
        let is_void_of = |role: &ShellRole, body: usize| match role.body == body {
            true => role.is_void,
            false => nests(body).contains(&role.body),
        };
        let is_inside =
            |one: &ShellRole| !one.is_void && !roles.iter().any(|other| is_void_of(other, one.body));
        if roles.iter().any(is_inside) {
            Side::Inside
        } else if roles.iter().all(|role| nests(role.body).is_empty()) {
            Side::Outside
        } else {
            Side::Undecided
        }
    }

    /// Returns whether a shell may lie within another shell: one of its tested points is not certainly outside. A shell
    /// that protrudes by less than the distance up to which edges are joined counts as one that lies within.
    pub(super) fn may_be_within(&self, shell: u32, other: u32) -> bool {
        self.enclosed_points(shell, other).any(|is_enclosed| is_enclosed != Some(false))
    }

    /// Returns whether the first of two disjoint shells encloses the second one. Every point of the second decides this
    /// (lemma S4 of docs/solids.md). Several points are compared; `None` if they disagree, or if none decides.
    pub(in crate::engine) fn has_within(&self, other: u32, shell: u32) -> Option<bool> {
        let mut decided = self.enclosed_points(shell, other).flatten();
        let first = decided.next()?;
        decided.all(|is_enclosed| is_enclosed == first).then_some(first)
    }

    /// Returns whether another shell encloses some points of a shell, each on another patch.
    fn enclosed_points(&self, shell: u32, other: u32) -> impl Iterator<Item = Option<bool>> {
        let [target, around] = [shell, other].map(|shell| self.target(shell));
        let step = target.patches.len().div_ceil(MAX_POINTS).max(1);
        (0..target.patches.len()).step_by(step).map(move |patch| {
            let point = target.patches.patch(patch).point([0.5; 2]);
            self.boundary.encloses(other, &around, point, self.boundary.margin_at(point))
        })
    }

    /// Returns whether two shells, with their strips, have no point in common; `None` where that is not known.
    /// Points count as common if their distance is within the rounding error.
    pub(in crate::engine) fn is_apart(&self, pair: [u32; 2]) -> Option<bool> {
        self.apart_after(pair, MAX_PAIRS).0
    }

    /// As [`Self::is_apart`], after at most `max_pairs` pairs of cells and those bounded at once; with their number.
    pub(super) fn apart_after(&self, pair: [u32; 2], max_pairs: usize) -> (Option<bool>, usize) {
        let pair = [pair[0].min(pair[1]), pair[0].max(pair[1])];
        if let Some(&known) = locked(&self.known.apart).get(&pair) {
            return (Some(known), 0);
        }
        let (found, pairs) = self.are_apart(&pair.map(|shell| self.target(shell)), max_pairs);
        // What is known after fewer pairs is known after more.
        if let Some(known) = found {
            locked(&self.known.apart).insert(pair, known);
        }
        (found, pairs)
    }

    /// As [`Self::apart_after`], of the patches of two shells.
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
