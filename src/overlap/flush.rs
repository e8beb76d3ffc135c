//! Plane pieces that lie on the other boundary: lemma O3 of docs/facts.md.

use super::PlacedSolid;
use super::piece::{Piece, Whole};
use super::separation::{heights, normal};
use super::solid::{MAX_DEPTH, Sides};
use crate::rounding::{gamma, upper_max};
use crate::solid::Side;
use glam::DVec3;
use std::f64::consts::PI;

/// The distance from a plane up to which a piece counts as plane, relative to the larger diagonal.
pub(super) const RELATIVE_FLATNESS: f64 = 1e-11;

/// The largest error that a piece may add, relative to the bound that it has while it is undecided.
const MAX_ERROR: f64 = 0.05;

/// The size of pieces about a plane piece, relative to it, that are not halved further.
const SMALL_PART: f64 = 0.125;

/// The largest number of pieces about a plane piece that are looked at.
const MAX_PIECES: usize = 512;

/// The roundings of an error, which is a sum of products of positive numbers, relative to it.
const ERROR_ROUNDINGS: f64 = 32.0;

/// A plane piece on both boundaries.
pub(super) struct Flush {
    /// The part of its cone that counts: a half where both bodies are on one side of it, none where they are not.
    pub(super) part: f64,
    /// An upper bound on what is off by that.
    pub(super) error: f64,
}

/// The pair of solids, with what their slabs have in common.
pub(super) struct Slabs<'a> {
    pub(super) solids: [&'a PlacedSolid; 2],
    pub(super) sides: &'a dyn Sides,
    /// The largest height of control points of plane pieces.
    pub(super) flatness: f64,
    /// The largest height of points of the boundaries, with their strips and rounding.
    pub(super) height: f64,
    pub(super) origin: DVec3,
}

impl Slabs<'_> {
    /// Returns how a piece lies on the other boundary, if both boundaries are within the slab about its plane as far as
    /// a ball about it reaches. `near` has pieces of the other boundary, `bound` is that of the piece.
    pub(super) fn flush(
        &self,
        piece: (&Whole, &Piece),
        near: &[(&Whole, &Piece)],
        bound: f64,
    ) -> Option<Flush> {
        let (middle, radius) = (piece.1.middle, piece.1.radius);
        let normal = normal(piece);
        let is_flat = |piece: &Piece| {
            let [low, high] = heights(piece, normal, middle);
            low >= -self.flatness && high <= self.flatness
        };
        if normal == DVec3::ZERO || !is_flat(piece.1) || !near.iter().any(|near| is_flat(near.1)) {
            return None;
        }
        let error = self.error(middle, radius);
        // Points half of the radius off the plane are to be off the slab.
        if !(error <= MAX_ERROR * bound) || !(radius > 8.0 * self.height) {
            return None;
        }
        let ball = (middle, radius + 4.0 * self.height);
        if !self.solids.iter().all(|solid| is_within_slab(solid, ball, self.height, is_flat)) {
            return None;
        }
        let above = middle + 0.5 * radius * normal;
        let below = middle - 0.5 * radius * normal;
        let side = |solid: usize, point: DVec3| match self.sides.side(solid, point, None)?.1 {
            Side::Inside => Some(true),
            Side::Outside => Some(false),
            Side::Undecided => None,
        };
        let [a, b] = [0, 1].map(|solid| Some([side(solid, above)?, side(solid, below)?]));
        let (a, b) = (a?, b?);
        let are_crossed = a[0] != a[1] && b[0] != b[1];
        are_crossed.then_some(Flush { part: if a == b { 0.5 } else { 0.0 }, error })
    }

    /// Returns an upper bound on the volume in a slab within a ball, and on the integral of |(x − origin)·n| / 3 over
    /// the part of its sphere in the slab.
    fn error(&self, middle: DVec3, radius: f64) -> f64 {
        let reach = middle.distance(self.origin) + radius;
        let volume = 2.0 * PI * radius * radius * self.height;
        let zone = 4.0 * PI * radius * self.height;
        (volume + zone * reach / 3.0) * (1.0 + gamma(ERROR_ROUNDINGS))
    }
}

/// Returns whether all pieces of a boundary in a ball are flat, with respect to the plane that `is_flat` knows.
fn is_within_slab(
    solid: &PlacedSolid,
    (middle, radius): (DVec3, f64),
    height: f64,
    is_flat: impl Fn(&Piece) -> bool,
) -> bool {
    let reach = radius + height;
    let wholes = &solid.patches.wholes;
    let around = crate::bvh::Aabb { min: middle, max: middle };
    let found = solid.patches.near(&around, reach);
    let mut stack: Vec<(&Whole, &Piece)> =
        found.into_iter().map(|index| &wholes[index as usize]).map(|whole| (whole, &whole.root)).collect();
    let mut count = 0;
    while let Some((whole, piece)) = stack.pop() {
        count += 1;
        if piece.aabb.min_distance_squared(middle) > reach * reach || is_flat(piece) {
            continue;
        }
        let is_small = piece.radius <= SMALL_PART * radius || piece.depth >= MAX_DEPTH;
        let Some(halves) = whole.halves(piece).filter(|_| !is_small && count < MAX_PIECES) else {
            return false;
        };
        stack.extend(halves.map(|half| (whole, half)));
    }
    true
}

/// Returns the largest height of points of the boundaries about a plane, for these margins and shared patches that are
/// this near to each other.
pub(super) fn height(flatness: f64, margins: [f64; 2], reach: f64) -> f64 {
    flatness + upper_max(margins[0], margins[1]) + reach
}
