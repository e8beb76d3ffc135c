//! Pieces that may have points on either side of the other boundary.

use super::crossing::{Crossing, Level};
use super::piece::{Piece, Whole};
use crate::interval::Interval;
use crate::solid::Enclosing;
use crate::sorting::ordered_by;
use glam::DVec3;
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

/// What is known of the sides of points of a piece.
#[derive(Clone, Default)]
pub(super) struct Known {
    pub(super) reference: Option<Reference>,
    /// The carrier of what is near a piece that this one is a part of.
    pub(super) level: Option<Level>,
    /// The parts of the square of this piece's parameters that are known from that piece.
    pub(super) crossing: Option<Crossing>,
}

ordered_by!(Undecided<'_>, |piece| piece.bound);
