//! A threshold of distances with their rounding, and what a search within it found.

use super::Likeness;
use crate::rounding::gamma;

/// The roundings of distances of points and of boxes, relative to the largest length, besides the errors of points.
pub(crate) const DISTANCE_ROUNDINGS: f64 = 64.0;

/// The largest distance of a counterpart.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reach {
    threshold: f64,
    /// What rounding adds to distances.
    slack: f64,
}

impl Reach {
    /// `error` bounds the errors of points of A, moved, and of B together, `length` their distances from the origin.
    pub(crate) fn new(threshold: f64, [error, length]: [f64; 2]) -> Self {
        Self { threshold, slack: error + gamma(DISTANCE_ROUNDINGS) * length }
    }

    /// Returns whether no distance can be shown to be within the threshold, for rounding.
    pub(crate) fn is_hopeless(&self) -> bool {
        !(self.threshold > self.slack)
    }

    /// Returns the threshold.
    pub(crate) fn threshold(&self) -> f64 {
        self.threshold
    }

    /// Returns a length that computed distances exceed only if the exact ones exceed `distance`.
    pub(crate) fn beyond(&self, distance: f64) -> f64 {
        distance + self.slack
    }

    /// Returns the length within which exact distances are within the threshold if computed ones are.
    pub(crate) fn certain(&self) -> f64 {
        self.threshold - self.slack
    }
}

/// What was found among the parts of B that are looked at for a part of A.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Looked {
    /// The number of parts of B that were looked at.
    pub(crate) visits: usize,
    /// Whether one of them may hold counterparts.
    pub(crate) is_open: bool,
}

impl Looked {
    /// Returns what is known of the part of A, if one part of B has counterparts of all of its points, and if none has.
    pub(crate) fn likeness(self, is_found: bool, max_visits: usize) -> Likeness {
        if is_found {
            Likeness::Alike
        } else if self.is_open || self.visits >= max_visits {
            Likeness::Open
        } else {
            Likeness::Unlike
        }
    }
}
