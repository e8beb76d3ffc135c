//! Whether the points of a part of A have like counterparts in B.

use super::target::Node;
use super::{ByFormula, DISTANCE_ROUNDINGS, Looked, NormalCone, NormalTarget, Reach, Region, Shape};
use crate::rounding::gamma;
use glam::DVec3;

/// A part of B is halved while it is larger than this part of A's.
const HALVED_RATIO: f64 = 0.5;

/// A part of B that bends by more than this part of the threshold is halved.
const BENT_PART: f64 = 0.25;

/// The largest upper bound on the distances of a part of A, in thresholds, with which lemma N7 is tried. Farther away, B
/// mostly has parts with other normals, and the lemma would mostly fail after a search.
const MAX_THRESHOLDS: f64 = 2.0;

/// The parts of B that are looked at for a part of A before it is left undecided.
const MAX_VISITS: usize = 2048;

/// What is known of the points of a part of A.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Likeness {
    /// All have a like counterpart.
    Alike,
    /// None has one.
    Unlike,
    /// Those within the threshold of B have one, and no others.
    ByDistance,
    /// Neither is shown.
    Open,
}

/// A part of A with a cone about its normals.
pub(super) struct Own<'s> {
    pub(super) region: &'s Region,
    pub(super) cone: &'s NormalCone,
    /// The part by its formula, for audits.
    pub(super) formula: &'s dyn ByFormula,
}

/// The question whether points have like counterparts in B.
pub(crate) struct Likenesses<'a> {
    pub(super) target: &'a NormalTarget<'a>,
    pub(super) reach: Reach,
    /// The largest angle, in radians.
    pub(super) angle: f64,
}

impl<'a> Likenesses<'a> {
    pub(crate) fn new(target: &'a NormalTarget<'a>, reach: Reach, angle: f64) -> Self {
        Self { target, reach, angle }
    }

    /// The largest distance of a counterpart.
    pub(crate) fn reach(&self) -> &Reach {
        &self.reach
    }

    /// Returns what is known of a part of A whose points have these bounds on their distances from B, rounding
    /// included (lemmas N3 to N7 of docs/score.md). `formula` makes some of its points, for audits.
    pub(crate) fn of(&self, shape: &Shape, [lower, upper]: [f64; 2], formula: &dyn ByFormula) -> Likeness {
        if lower > self.reach.threshold() {
            return Likeness::Unlike;
        }
        let Shape { region, cone: Some(cone) } = shape else { return Likeness::Open };
        let own = Own { region, cone, formula };
        let all_are_alike =
            || self.all_are_alike(region, cone, upper) && !self.is_refuted_beside(&own, upper);
        if upper < self.reach.threshold() && all_are_alike() {
            return Likeness::Alike;
        }
        let may_be_by_distance = || {
            upper >= self.reach.threshold()
                && upper <= MAX_THRESHOLDS * self.reach.threshold()
                && all_are_alike()
        };
        match self.by_one_part(&own) {
            Likeness::Open if may_be_by_distance() => Likeness::ByDistance,
            likeness => likeness,
        }
    }

    /// Returns whether all parts of B within a distance of a part of A are certainly alike.
    fn all_are_alike(&self, region: &Region, cone: &NormalCone, within: f64) -> bool {
        let reach = self.reach.beyond(within);
        let mut all = true;
        let mut visits = 0;
        self.target.near(&region.aabb, reach, &mut |place| {
            let mut is_alike = |other: Option<NormalCone>| {
                visits += 1;
                other.is_some_and(|other| cone.angles(&other)[1] <= self.angle)
            };
            all = match (self.target.root(place), self.target.triangle(place)) {
                (Some(root), _) => self.node_is_alike(region, root, reach, &mut is_alike),
                (None, Some(triangle)) => {
                    region.is_beyond(&triangle.region, reach) || is_alike(triangle.cone)
                }
                (None, None) => false,
            };
            all &= visits < MAX_VISITS;
            all
        });
        all
    }

    /// Returns whether the parts of a patch within reach are alike, halved while they are large.
    fn node_is_alike(
        &self,
        region: &Region,
        node: &Node,
        reach: f64,
        is_alike: &mut dyn FnMut(Option<NormalCone>) -> bool,
    ) -> bool {
        if region.is_beyond(&node.region, reach) || is_alike(self.target.cone(node)) {
            return true;
        }
        if node.region.radius <= HALVED_RATIO * region.radius {
            return false;
        }
        let Some(halves) = self.target.halves(node) else { return false };
        halves.iter().all(|half| self.node_is_alike(region, half, reach, is_alike))
    }

    /// Looks for one part of B that is alike and whose one point is near to all points of a part of A; or shows that
    /// none in reach is alike.
    fn by_one_part(&self, own: &Own<'_>) -> Likeness {
        let region = own.region;
        let reach = self.reach.beyond(self.reach.threshold());
        let (mut looked, mut found) = (Looked::default(), false);
        self.target.near(&region.aabb, reach, &mut |place| {
            found = match (self.target.root(place), self.target.triangle(place)) {
                (Some(root), _) => self.node_is_near(own, root, &mut looked),
                (None, Some(triangle)) => {
                    looked.visits += 1;
                    let of = self.compared(own, &triangle.region, || triangle.cone, reach);
                    looked.is_open |= of != Likeness::Unlike;
                    of == Likeness::Alike
                        && self.is_in_reach(region, |point| self.target.distance_squared_of(place, point))
                }
                (None, None) => false,
            };
            !found && looked.visits < MAX_VISITS
        });
        looked.likeness(found, MAX_VISITS)
    }

    /// As [`Self::by_one_part`], of the parts of one patch.
    fn node_is_near(&self, own: &Own<'_>, node: &Node, looked: &mut Looked) -> bool {
        looked.visits += 1;
        let reach = self.reach.beyond(self.reach.threshold());
        match self.compared(own, &node.region, || self.target.cone(node), reach) {
            Likeness::Unlike => false,
            Likeness::Alike => {
                if self.is_covered(own, node) {
                    return true;
                }
                if self.is_apart(own.region, node) {
                    return false;
                }
                if let Some(halves) = self.halves_of_bent(own.region, node, looked) {
                    return halves.iter().any(|half| self.node_is_near(own, half, looked));
                }
                looked.is_open = true;
                self.has_near_point(own.region, node)
            }
            Likeness::Open | Likeness::ByDistance => {
                let is_large = node.region.radius > HALVED_RATIO * own.region.radius;
                if is_large
                    && looked.visits < MAX_VISITS
                    && let Some(halves) = self.target.halves(node)
                {
                    return halves.iter().any(|half| self.node_is_near(own, half, looked));
                }
                looked.is_open = true;
                false
            }
        }
    }

    /// Returns the halves of a part that bends too much for its quadrilateral to say much, if those may still be as large
    /// as the part of A.
    fn halves_of_bent<'n>(&self, region: &Region, node: &'n Node, looked: &Looked) -> Option<&'n [Node; 2]> {
        let is_plane =
            self.target.quad(node).is_some_and(|quad| quad.off() <= BENT_PART * self.reach.certain());
        if is_plane || node.region.radius <= HALVED_RATIO * region.radius || looked.visits >= MAX_VISITS {
            return None;
        }
        self.target.halves(node)
    }

    /// Returns whether all points of a part are within the threshold of one point of a part of a patch, which is then within
    /// that of the middle.
    fn has_near_point(&self, region: &Region, node: &Node) -> bool {
        let reach = self.reach.threshold() * self.reach.threshold();
        let may_be = region.radius <= self.reach.threshold()
            && node.region.aabb.min_distance_squared(region.middle) <= reach;
        let near = may_be.then(|| self.target.near_point(node, region.middle)).flatten();
        near.is_some_and(|near| self.is_in_reach(region, |point| near.distance_squared(point)))
    }

    /// Compares the normals of two parts, and returns that they are unlike where they are out of reach of each other.
    fn compared(
        &self,
        own: &Own<'_>,
        other: &Region,
        cone: impl FnOnce() -> Option<NormalCone>,
        reach: f64,
    ) -> Likeness {
        if own.region.is_beyond(other, reach) {
            return Likeness::Unlike;
        }
        let Some(of_other) = cone() else { return Likeness::Open };
        let [least, most] = own.cone.angles(&of_other);
        if most <= self.angle {
            Likeness::Alike
        } else if least > self.angle {
            Likeness::Unlike
        } else {
            Likeness::Open
        }
    }

    /// Returns whether all points of a part are within the threshold of a convex set, by the squared distance from it.
    fn is_in_reach(&self, region: &Region, distance_squared: impl Fn(DVec3) -> f64) -> bool {
        self.are_within(region, self.reach.certain(), distance_squared)
    }

    /// The same for a length in place of the threshold without its rounding.
    pub(super) fn are_within(
        &self,
        region: &Region,
        left: f64,
        distance_squared: impl Fn(DVec3) -> f64,
    ) -> bool {
        let permitted = left * left * (1.0 - gamma(DISTANCE_ROUNDINGS));
        left > 0.0
            && !region.points.is_empty()
            && region.points.iter().all(|&point| distance_squared(point) <= permitted)
    }
}
