//! The comparison of a piece with the other boundary.

use super::crossing::{CORNERS, Crossing, Level};
use super::pair::Pair;
use super::piece::{Piece, Whole};
use super::separation::{are_told, may_meet};
use super::solid::MAX_DEPTH;
use super::undecided::{Known, Undecided};
use super::{BoundarySide, Sides};
use crate::interval::Interval;
use crate::rounding::upper_max;
use crate::solid::Side;
use glam::DVec3;
use std::sync::Arc;

/// The largest ratio of the size of a piece of the other boundary to that of the piece that it is compared with.
const SIZE_RATIO: f64 = 0.5;

/// The part of the bound of a piece that is left where what is known of its parts counts.
const MAX_REMAINDER: f64 = 0.75;

/// What is found of a piece.
pub(super) enum Found<'a> {
    /// The integral over what lies within the other solid.
    Decided(Interval),
    Undecided(Undecided<'a>),
}

/// Two solids with an origin of cones.
pub(super) struct Looking<'a> {
    pub(super) pair: &'a Pair,
    pub(super) sides: &'a dyn Sides,
    pub(super) origin: DVec3,
}

impl<'a> Looking<'a> {
    /// Compares a piece with pieces of the other boundary.
    pub(super) fn look_at(
        &self,
        solid: usize,
        (whole, piece): (&'a Whole, &'a Piece),
        near: &[(&'a Whole, &'a Piece)],
        mut known: Known,
    ) -> Found<'a> {
        let near = self.still_near(solid, (whole, piece), near);
        let placed = &self.pair.solids[solid];
        let moved = placed.moved(piece.depth);
        let is_oriented = whole.side != BoundarySide::Unknown;
        let level =
            if near.is_empty() { None } else { Level::around(&near, (whole, piece), known.level.as_ref()) };
        let crossing = level.as_ref().map(|level| self.parts(solid, (whole, piece), &near, level));
        if near.is_empty() || crossing.is_some_and(|crossing| crossing.is_one_part()) {
            match self.side(solid, (whole, piece), &known) {
                Some(false) => return Found::Decided(Interval::exactly(0.0)),
                Some(true) if is_oriented => {
                    return Found::Decided(self.cone(solid, whole, piece, moved));
                }
                _ => {}
            }
        }
        let weight = placed.patches.weight(whole, piece, self.origin, moved);
        let bound = weight.bound();
        let undecided = |near, known| Undecided { solid, whole, piece, bound, value: None, near, known };
        known.level = level;
        if is_oriented
            && let Some(crossing) =
                crossing.and_then(|parts| self.sided(solid, (whole, piece), parts, &mut known))
        {
            let slopes = placed.patches.slopes(whole, piece);
            let cone = self.cone(solid, whole, piece, 0.0);
            let value = crossing.inner(&slopes, &weight, cone, moved);
            let width = value.width();
            if width <= MAX_REMAINDER * bound {
                return Found::Undecided(Undecided {
                    bound: width,
                    value: Some(value),
                    ..undecided(near, known)
                });
            }
        }
        Found::Undecided(undecided(near, known))
    }

    /// Returns what holds of a piece, these being all pieces near it, without a comparison.
    pub(super) fn not_looked_at(
        &self,
        solid: usize,
        (whole, piece): (&'a Whole, &'a Piece),
        near: Vec<(&'a Whole, &'a Piece)>,
    ) -> Found<'a> {
        let placed = &self.pair.solids[solid];
        let bound = placed.patches.weight(whole, piece, self.origin, placed.moved(piece.depth)).bound();
        Found::Undecided(Undecided { solid, whole, piece, bound, value: None, near, known: Known::default() })
    }

    /// Compares both halves of a piece; `None` where it is halved no further.
    pub(super) fn look_at_halves(&self, of: &Undecided<'a>) -> Option<[Found<'a>; 2]> {
        let &Undecided { solid, whole, piece, ref near, ref known, .. } = of;
        let halves = whole.halves(piece)?;
        let mut known = known.clone();
        if known.reference.is_none() {
            known.reference = self.reference(solid, piece.points[0]);
        }
        let axis = whole.axis(piece);
        let [low, high] = halves;
        Some([(low, false), (high, true)].map(|(half, is_high)| {
            let crossing = known.crossing.map(|crossing| crossing.half(axis, is_high));
            self.look_at(solid, (whole, half), near, Known { crossing, ..known.clone() })
        }))
    }

    /// Returns the parts of a piece that are off all near pieces.
    fn parts(
        &self,
        solid: usize,
        (whole, piece): (&Whole, &Piece),
        near: &[(&'a Whole, &'a Piece)],
        level: &Level,
    ) -> Crossing {
        let reach = near.iter().map(|near| near.0.reach).fold(0.0, upper_max);
        let levels = level.levels(piece, self.pair.margins[solid] + reach);
        Crossing::new(&level.form(whole, piece), levels)
    }

    /// Returns the parts of a piece with their sides; `None` where there are none.
    fn sided(
        &self,
        solid: usize,
        (whole, piece): (&Whole, &Piece),
        mut parts: Crossing,
        known: &mut Known,
    ) -> Option<Crossing> {
        let corners = parts.corners();
        if corners == [None; 2] {
            return None;
        }
        let points = whole.corners(piece);
        for (is_inside, corner) in parts.is_inside.iter_mut().zip(corners) {
            let Some(corner) = corner else { continue };
            let before = known.crossing.and_then(|crossing| crossing.side(corner));
            *is_inside = before.or_else(|| self.is_inside(solid, points[corner], known));
        }
        known.crossing = Some(parts);
        Some(parts)
    }

    /// Returns whether a piece that has no point of the other boundary near is inside the other solid.
    fn side(&self, solid: usize, (whole, piece): (&Whole, &Piece), known: &Known) -> Option<bool> {
        let before =
            (0..CORNERS.len()).find_map(|corner| known.crossing.and_then(|crossing| crossing.side(corner)));
        before.or_else(|| {
            whole.corners(piece).into_iter().find_map(|point| self.is_inside(solid, point, known))
        })
    }

    /// Returns whether a point is inside the other solid; `None` where that is not certain.
    fn is_inside(&self, solid: usize, point: DVec3, known: &Known) -> Option<bool> {
        let found = self.sides.side(1 - solid, self.unmoved(solid, point), known.reference.as_deref());
        match found?.1 {
            Side::Inside => Some(true),
            Side::Outside => Some(false),
            Side::Undecided => None,
        }
    }

    /// Returns a point of a piece with the shells of the other solid about it.
    fn reference(&self, solid: usize, point: DVec3) -> Option<super::undecided::Reference> {
        let point = self.unmoved(solid, point);
        self.sides.side(1 - solid, point, None).map(|(enclosing, _)| Arc::new((point, enclosing)))
    }

    /// Returns the place of a point of a piece for a question about the other solid, without what moved that.
    fn unmoved(&self, solid: usize, point: DVec3) -> DVec3 {
        if solid == 1 { point - self.pair.shift } else { point }
    }

    /// Returns the pieces of the other boundary that may meet a piece, halved until they are as small.
    fn still_near(
        &self,
        solid: usize,
        piece: (&'a Whole, &'a Piece),
        near: &[(&'a Whole, &'a Piece)],
    ) -> Vec<(&'a Whole, &'a Piece)> {
        let margin = self.pair.margins[solid];
        let (mut found, mut stack, mut tried) = (Vec::new(), near.to_vec(), Vec::new());
        while let Some(other) = stack.pop() {
            let margin = margin + other.0.reach;
            if !may_meet(piece, other, margin) || are_told(piece, other, margin, &mut tried) {
                continue;
            }
            let is_large = other.1.radius > SIZE_RATIO * piece.1.radius && other.1.depth < MAX_DEPTH;
            match other.0.halves(other.1).filter(|_| is_large) {
                Some(halves) => stack.extend(halves.map(|half| (other.0, half))),
                None => found.push(other),
            }
        }
        found
    }

    /// Returns the volume of the cone over a piece, positive where its normals are outward and it faces away.
    pub(super) fn cone(&self, solid: usize, whole: &Whole, piece: &Piece, moved: f64) -> Interval {
        let volume = self.pair.solids[solid].patches.moments(whole, piece, self.origin, moved).volume();
        if whole.side == BoundarySide::Outward { volume } else { -volume }
    }

    /// Returns what is known of the integral over the part of a piece within the other solid.
    pub(super) fn value(&self, undecided: &Undecided<'_>) -> Interval {
        let &Undecided { solid, whole, piece, bound, value, .. } = undecided;
        let bound = Interval::about(0.0, bound);
        if let Some(value) = value {
            return value;
        }
        if whole.side == BoundarySide::Unknown {
            return bound;
        }
        // Those of the parts where x·n is positive, and of those where it is negative, are at most half of the sum of
        // the bound and the whole, and of their difference.
        let cone = self.cone(solid, whole, piece, self.pair.solids[solid].moved(piece.depth));
        let (most, least) = ((bound + cone) * 0.5, (bound - cone) * 0.5);
        Interval { lower: -least.upper, upper: most.upper }
    }
}
