//! Whether the points of a part of a feature edge have counterparts among those of another model.

use super::piece::distance_to_box;
use super::{FeatureEdges, Piece, Sharpness};
use crate::normals::Likeness;
use crate::rounding::gamma;

/// The roundings of distances, relative to the largest length.
const DISTANCE_ROUNDINGS: f64 = 64.0;

/// A piece of B whose sharpness is open is halved while it is larger than this part of A's.
const HALVED_RATIO: f64 = 0.5;

/// A piece of B that bends by more than this part of the size of A's is halved.
const BENT_RATIO: f64 = 0.125;

/// The pieces of B that are looked at for a piece of A before it is left undecided.
const MAX_VISITS: usize = 1024;

/// The question whether points have counterparts: points of feature edges of B within a threshold.
pub(crate) struct Counterparts<'a> {
    target: &'a FeatureEdges<'a>,
    threshold: f64,
    /// What rounding adds to distances.
    slack: f64,
}

struct Looked {
    visits: usize,
    is_open: bool,
}

impl<'a> Counterparts<'a> {
    /// `error` bounds the errors of points of both models together, `length` their distances from the origin.
    pub(crate) fn new(target: &'a FeatureEdges<'a>, threshold: f64, [error, length]: [f64; 2]) -> Self {
        Self { target, threshold, slack: error + gamma(DISTANCE_ROUNDINGS) * length }
    }

    /// Whether no distance can be shown to be within the threshold, for rounding.
    pub(crate) fn is_hopeless(&self) -> bool {
        !(self.threshold > self.slack)
    }

    /// Returns whether all points of a piece have counterparts, or none has one (lemmas E3 and E4 of docs/score.md).
    pub(crate) fn of(&self, piece: &Piece) -> Likeness {
        let (mut looked, mut found) = (Looked { visits: 0, is_open: false }, false);
        self.target.near(&piece.aabb, self.threshold + self.slack, &mut |other| {
            found = self.is_near(piece, other, &mut looked);
            !found && looked.visits < MAX_VISITS
        });
        if found {
            Likeness::Alike
        } else if looked.is_open || looked.visits >= MAX_VISITS {
            Likeness::Open
        } else {
            Likeness::Unlike
        }
    }

    /// Returns whether one part of a piece of B is certainly a feature and within the threshold of all of A's.
    fn is_near(&self, piece: &Piece, other: &Piece, looked: &mut Looked) -> bool {
        looked.visits += 1;
        let reach = self.threshold + self.slack;
        let is_beyond =
            distance_to_box(&piece.aabb, &other.aabb) > reach || other.least_distance_of(piece) > reach;
        if is_beyond || other.sharpness == Sharpness::Smooth {
            return false;
        }
        let is_sharp = other.sharpness == Sharpness::Sharp;
        if is_sharp && other.largest_distance_of(piece) <= self.threshold - self.slack {
            return true;
        }
        let is_halved = if is_sharp {
            other.off > BENT_RATIO * piece.radius
        } else {
            other.radius > HALVED_RATIO * piece.radius
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
