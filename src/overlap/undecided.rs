//! Pieces that may have points on either side of the other boundary.

use super::crossing::Slab;
use super::piece::{Piece, Whole};
use crate::facts::Interval;
use crate::solid::Enclosing;
use glam::DVec3;
use std::cmp::Ordering;
use std::sync::Arc;

/// A point of a piece, with the shells of the other solid about it.
pub(super) type Reference = Arc<(DVec3, Enclosing)>;

/// A piece that may have points on either side of the other boundary.
pub(super) struct Undecided<'a> {
    pub(super) solid: usize,
    pub(super) whole: &'a Whole,
    pub(super) piece: &'a Piece,
    /// An upper bound on what is not known of its integral.
    pub(super) bound: f64,
    /// What is known of its integral, where that is more than its size.
    pub(super) value: Option<Interval>,
    /// The pieces of the other boundary that may be near.
    pub(super) near: Vec<(&'a Whole, &'a Piece)>,
    pub(super) known: Known,
}

/// What is known of the sides of points of a piece's hull.
#[derive(Clone, Default)]
pub(super) struct Known {
    pub(super) reference: Option<Reference>,
    /// The slab of a piece that this one is a part of.
    pub(super) slab: Option<Slab>,
}

impl PartialEq for Undecided<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Undecided<'_> {}
impl PartialOrd for Undecided<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Undecided<'_> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}
