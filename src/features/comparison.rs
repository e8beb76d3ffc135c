//! Whether the points of a part of a feature edge have counterparts among those of another model.

use super::{FeatureEdges, Piece, Sharpness};
use crate::normals::{Likeness, Looked, Reach};

/// A piece of B whose sharpness is open is halved while it is larger than this part of A's.
const HALVED_RATIO: f64 = 0.5;

/// A piece of B that bends by more than this part of the size of A's is halved.
const BENT_RATIO: f64 = 0.125;

/// The pieces of B that are looked at for a piece of A before it is left undecided.
const MAX_VISITS: usize = 1024;

/// The question whether points have counterparts: points of feature edges of B within a threshold.
pub(crate) struct Counterparts<'a> {
    target: &'a FeatureEdges<'a>,
    reach: Reach,
}

impl<'a> Counterparts<'a> {
    pub(crate) fn new(target: &'a FeatureEdges<'a>, reach: Reach) -> Self {
        Self { target, reach }
    }

    /// The largest distance of a counterpart.
    pub(crate) fn reach(&self) -> &Reach {
        &self.reach
    }

    /// Returns whether all points of a piece have counterparts, or none has one (lemmas E3 and E4 of docs/score.md).
    pub(crate) fn of(&self, piece: &Piece) -> Likeness {
        let (mut looked, mut found) = (Looked::default(), false);
        self.target.near(&piece.hull.aabb, self.reach.beyond(self.reach.threshold()), &mut |other| {
            found = self.is_near(piece, other, &mut looked);
            !found && looked.visits < MAX_VISITS
        });
        looked.likeness(found, MAX_VISITS)
    }

    /// Returns whether one part of a piece of B is certainly a feature and within the threshold of all of A's.
    fn is_near(&self, piece: &Piece, other: &Piece, looked: &mut Looked) -> bool {
        looked.visits += 1;
        let reach = self.reach.beyond(self.reach.threshold());
        let is_beyond =
            piece.hull.aabb.gap(&other.hull.aabb).length() > reach || other.least_distance_of(piece) > reach;
        if is_beyond || other.sharpness == Sharpness::Smooth {
            return false;
        }
        let is_sharp = other.sharpness == Sharpness::Sharp;
        if is_sharp && other.largest_distance_of(piece) <= self.reach.certain() {
            return true;
        }
        let is_halved = if is_sharp {
            other.off > BENT_RATIO * piece.hull.radius
        } else {
            other.hull.radius > HALVED_RATIO * piece.hull.radius
        };
        if is_halved
            && looked.visits < MAX_VISITS
            && let Some(halves) = self.target.halves(other)
        {
            return halves.iter().any(|half| self.is_near(piece, half, looked));
        }
        looked.is_open = true;
        false
    }
}
