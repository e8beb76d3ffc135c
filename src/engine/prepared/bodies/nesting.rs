//! Which closed shells of a model lie within each other.

use super::ShellParts;
use crate::bvh::Aabb;
use crate::engine::PreparedModel;
use crate::engine::prepared::shells::MAX_PAIRS;
use crate::solid::SourceSolid;
use crate::sorting::sort_by_number;
use std::collections::BTreeMap;

/// The number of pairs of cells that the comparisons of a model's shells may take together, about a second of work. Each
/// comparison still takes [`MIN_PAIRS`] after that. A damaged file may have some hundred shells that are all nearer to
/// each other than its gap.
pub(super) const MAX_PAIRS_OF_ALL: usize = 8 * MAX_PAIRS;

/// The least number of pairs of cells for one comparison. Fewer show of most shells that they are apart.
pub(super) const MIN_PAIRS: usize = 1_024;

/// Two boxes of a shell.
pub(super) struct ShellBoxes {
    /// The box of its control points, which contains the shell.
    pub(super) around: Aabb,
    /// The box of some of its points. A shell that encloses this one contains it; the control points may lie outside.
    of_points: Aabb,
}

/// The shells about a closed shell.
#[derive(Debug, Default)]
pub(super) struct Around {
    /// Those that are certainly about it and apart from it.
    pub(super) shells: Vec<usize>,
    /// The shells that may be about it, and those that may be a void together with it: it is not known which of the two.
    pub(super) unknown: Vec<usize>,
    /// `Some(true)` if the normals in the source show that the shell is a void, `Some(false)` if they show that it is not.
    /// Normals are compared only for shells that meet within a common shell.
    pub(super) is_void: Option<bool>,
}

/// Two shells that have points in common.
struct Meeting {
    pair: [usize; 2],
    /// Whether the first one may lie within the second but for these points.
    is_nested: bool,
}

impl PreparedModel {
    /// Returns the boxes of a shell.
    pub(super) fn boxes_of(&self, shell: &ShellParts) -> ShellBoxes {
        let mut boxes = ShellBoxes { around: Aabb::EMPTY, of_points: Aabb::EMPTY };
        for &surface in &shell.surfaces {
            let around = match &self.facets {
                Some(facets) => facets.target.facet(surface).bounding_box(),
                None => self.box_of_piece(surface as usize),
            };
            boxes.around = boxes.around.union(around);
            boxes.of_points = boxes.of_points.union(self.box_of_points(surface));
        }
        boxes
    }

    /// Returns what is known of the shells about each closed shell.
    pub(super) fn arounds(
        &self,
        shells: &[ShellParts],
        boxes: &[ShellBoxes],
        budget: &mut Budget,
    ) -> Vec<Around> {
        let mut around: Vec<Around> = shells.iter().map(|_| Around::default()).collect();
        // Shells of larger meshes have no tree to be compared by.
        if !self.may_compare() {
            let nested = self.nested_boxes(shells, boxes);
            nested.into_iter().for_each(|[inner, outer]| around[inner].unknown.push(outer));
            return around;
        }
        let to_compare = self.nested_pairs(shells, boxes);
        let mut meetings = self.compare_nested(shells, &to_compare, budget, &mut around);
        let mut siblings = self.siblings(shells, boxes, &around);
        siblings.retain(|pair| !to_compare.contains_key(pair));
        meetings.extend(self.compare_siblings(shells, &siblings, budget, &mut around));
        // Pairs with opposite normals come first: what they show decides other pairs.
        for are_opposite in [true, false] {
            for meeting in &meetings {
                self.tell_apart(meeting, are_opposite, shells, &mut around);
            }
        }
        for pair in self.of_open_solids(shells) {
            do_not_know(&mut around, pair);
        }
        around
    }

    /// Returns the pairs of shells that may be nested. Each pair has one or two possible orders, the inner shell first.
    fn nested_pairs(
        &self,
        shells: &[ShellParts],
        boxes: &[ShellBoxes],
    ) -> BTreeMap<[usize; 2], Vec<[usize; 2]>> {
        let mut pairs: BTreeMap<[usize; 2], Vec<[usize; 2]>> = BTreeMap::new();
        for [inner, outer] in self.nested_boxes(shells, boxes) {
            if self.shells().may_be_within(shells[inner].shell, shells[outer].shell) {
                pairs.entry([inner.min(outer), inner.max(outer)]).or_default().push([inner, outer]);
            }
        }
        pairs
    }

    /// Compares each of these pairs once. Enters which shells lie within which, and returns those that meet.
    fn compare_nested(
        &self,
        shells: &[ShellParts],
        pairs: &BTreeMap<[usize; 2], Vec<[usize; 2]>>,
        budget: &mut Budget,
        around: &mut [Around],
    ) -> Vec<Meeting> {
        let mut meetings = Vec::new();
        for (place, (&pair, ways)) in pairs.iter().enumerate() {
            let are_apart =
                self.are_apart(pair.map(|index| shells[index].shell), pairs.len() - place, budget);
            for &[inner, outer] in ways {
                let is_within = match are_apart {
                    Some(true) => self.shells().has_within(shells[outer].shell, shells[inner].shell),
                    Some(false) => {
                        meetings.push(Meeting { pair: [inner, outer], is_nested: true });
                        continue;
                    }
                    None => None,
                };
                match is_within {
                    Some(true) => around[inner].shells.push(outer),
                    Some(false) => {}
                    None => around[inner].unknown.push(outer),
                }
            }
        }
        meetings
    }

    /// Compares pairs of shells that are not nested, and returns those that meet.
    fn compare_siblings(
        &self,
        shells: &[ShellParts],
        pairs: &[[usize; 2]],
        budget: &mut Budget,
        around: &mut [Around],
    ) -> Vec<Meeting> {
        let mut meetings = Vec::new();
        for (place, &pair) in pairs.iter().enumerate() {
            match self.are_apart(pair.map(|index| shells[index].shell), pairs.len() - place, budget) {
                Some(true) => {}
                Some(false) => meetings.push(Meeting { pair, is_nested: false }),
                None => do_not_know(around, pair),
            }
        }
        meetings
    }

    /// Returns the pairs of a closed shell and an open shell that bound one solid of the source. The closed shell may be a
    /// void of that solid, whose outer shell has lost a face.
    fn of_open_solids(&self, shells: &[ShellParts]) -> Vec<[usize; 2]> {
        let (joined, solids) = (self.joined(), self.solids());
        let is_open = |index: usize| joined.of_shell[shells[index].shell as usize].free > 0;
        let mut open: BTreeMap<u32, usize> = BTreeMap::new();
        let solid = |index: usize| match solids[shells[index].shell as usize] {
            SourceSolid::Alone(solid) => solid,
            SourceSolid::Several => None,
        };
        for index in (0..shells.len()).filter(|&index| is_open(index)) {
            open.extend(solid(index).map(|solid| (solid, index)));
        }
        let of_open =
            |index: usize| solid(index).and_then(|solid| open.get(&solid)).map(|&other| [index, other]);
        (0..shells.len()).filter(|&index| !is_open(index)).filter_map(of_open).collect()
    }

    /// Whether the shells have trees to be compared by.
    fn may_compare(&self) -> bool {
        self.facets.as_ref().is_none_or(|facets| facets.may_close())
    }

    /// Returns whether two shells are apart, by a share of the budget.
    fn are_apart(&self, pair: [u32; 2], comparisons: usize, budget: &mut Budget) -> Option<bool> {
        let (are_apart, pairs) = self.shells().apart_after(pair, budget.share(comparisons));
        budget.spend(pairs);
        are_apart
    }

    /// Returns the distance up to which edges are joined. A void may protrude from its shell by as much.
    fn slack(&self) -> f64 {
        if self.may_compare() { self.boundary().reach() } else { 0.0 }
    }

    /// Returns whether one of two shells may be a void of the other: the source does not state that they bound different
    /// solids.
    fn may_be_of_one_solid(&self, pair: [u32; 2]) -> bool {
        let [one, other] = pair.map(|shell| self.solids()[shell as usize]);
        one.may_be_of(other)
    }

    /// Returns the pairs of closed shells that may bound one solid and be nested, the inner shell first. The corners of the
    /// inner shell's patches lie in the box of the outer shell, enlarged by the distance up to which edges are joined.
    pub(super) fn nested_boxes(&self, shells: &[ShellParts], boxes: &[ShellBoxes]) -> Vec<[usize; 2]> {
        let (joined, slack) = (self.joined(), self.slack());
        let is_closed = |index: usize| joined.of_shell[shells[index].shell as usize].free == 0;
        let mut order: Vec<usize> = (0..shells.len()).filter(|&index| is_closed(index)).collect();
        sort_by_number(&mut order, |&index| boxes[index].of_points.min.x);
        let mut pairs = Vec::new();
        for &outer in &order {
            let around = boxes[outer].around.grown(slack);
            let first = order.partition_point(|&inner| boxes[inner].of_points.min.x < around.min.x);
            let begin_within =
                order[first..].iter().take_while(|&&inner| boxes[inner].of_points.min.x <= around.max.x);
            let nested = begin_within.filter(|&&inner| {
                inner != outer
                    && around.contains(&boxes[inner].of_points)
                    && self.may_be_of_one_solid([inner, outer].map(|index| shells[index].shell))
            });
            pairs.extend(nested.map(|&inner| [inner, outer]));
        }
        pairs
    }

    /// Returns the pairs of shells that lie within a common shell, may be of one solid and have boxes that meet, the lower
    /// index first.
    fn siblings(&self, shells: &[ShellParts], boxes: &[ShellBoxes], around: &[Around]) -> Vec<[usize; 2]> {
        let slack = self.slack();
        let inner: Vec<usize> = (0..around.len()).filter(|&index| !around[index].shells.is_empty()).collect();
        let mut pairs = Vec::new();
        for (place, &one) in inner.iter().enumerate() {
            let grown = boxes[one].around.grown(slack);
            let near = inner[place + 1..].iter().copied().filter(|&other| grown.meets(&boxes[other].around));
            pairs
                .extend(near.filter(|&other| root(around, [one, other]).is_some()).map(|other| [one, other]));
        }
        pairs.retain(|pair| self.may_be_of_one_solid(pair.map(|index| shells[index].shell)));
        pairs
    }

    /// Enters what follows from two shells that have points in common, if their normals in the source are opposite or not,
    /// as `are_opposite` asks. The normals of a void are opposite to those of the outermost shell. Two shells whose normals
    /// both agree with those of the outermost shell are bodies only if something else shows it: a void that they meet, or
    /// an even number of shells about them.
    fn tell_apart(
        &self,
        meeting: &Meeting,
        are_opposite: bool,
        shells: &[ShellParts],
        around: &mut [Around],
    ) {
        let &Meeting { pair, is_nested } = meeting;
        let faces_out = |index: usize| self.faces_out()[shells[index].shell as usize];
        let Some(outermost) = root(around, pair) else {
            let [inner, outer] = pair.map(faces_out);
            if are_opposite && is_nested && inner.zip(outer).is_some_and(|(inner, outer)| inner != outer) {
                do_not_know(around, pair);
            }
            return;
        };
        let out = faces_out(outermost);
        let are_voids = pair.map(|index| faces_out(index).zip(out).map(|(one, other)| one != other));
        if matches!(are_voids, [Some(one), Some(other)] if one != other) != are_opposite {
            return;
        }
        let is_body = |&index: &usize| {
            around[index].is_void == Some(false) || around[index].shells.len().is_multiple_of(2)
        };
        match are_voids {
            // The void may belong to the body that it touches from within, or to the body about both.
            [Some(true), Some(false)] if is_nested => do_not_know(around, pair),
            [Some(one), Some(other)] if are_opposite => {
                around[pair[0]].is_void = Some(one);
                around[pair[1]].is_void = Some(other);
            }
            [Some(false), Some(false)] if pair.iter().all(is_body) => {}
            // The common part of two voids would be subtracted twice.
            _ => do_not_know(around, pair),
        }
    }
}

/// Enters that it is not known which of two shells is a void.
fn do_not_know(around: &mut [Around], [one, other]: [usize; 2]) {
    around[one].unknown.push(other);
    around[other].unknown.push(one);
}

/// Returns an outermost shell about both of two shells.
fn root(around: &[Around], [one, other]: [usize; 2]) -> Option<usize> {
    let outer = around[one].shells.iter().copied();
    outer
        .filter(|outer| around[*outer].shells.is_empty() && around[*outer].unknown.is_empty())
        .find(|outer| around[other].shells.contains(outer))
}

/// The pairs of cells that all comparisons of a model's shells may bound.
#[derive(Debug)]
pub(super) struct Budget {
    pub(super) left: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Self { left: MAX_PAIRS_OF_ALL }
    }
}

impl Budget {
    /// Returns the number of pairs of cells for the next comparison: an equal share of the budget, for this number of
    /// comparisons that are still to be made.
    pub(super) fn share(&self, comparisons: usize) -> usize {
        (self.left / comparisons.max(1)).clamp(MIN_PAIRS, MAX_PAIRS)
    }

    pub(super) fn spend(&mut self, pairs: usize) {
        self.left = self.left.saturating_sub(pairs);
    }
}
