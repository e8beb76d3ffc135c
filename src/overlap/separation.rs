//! Planes and carriers between pieces.

use super::carrier::Fitted;
use super::piece::{Piece, Whole};
use crate::rounding::unit;
use glam::DVec3;
use std::ptr;

/// The least cosine of the angle of two pieces that their carriers may tell apart: planes do where they cross.
const MIN_COSINE: f64 = 0.5;

/// Returns whether the hulls of two pieces may be within `margin` of each other: no plane across an axis is between
/// them, none that is tangent to the sphere of the first one, and none along the diagonals of either.
pub(super) fn may_meet(a: (&Whole, &Piece), b: (&Whole, &Piece), margin: f64) -> bool {
    let (first, second) = (a.1, b.1);
    let grown = first.aabb.grown(margin);
    if !grown.meets(&second.aabb) {
        return false;
    }
    let reach = first.radius + margin;
    if second.aabb.min_distance_squared(first.middle) > reach * reach {
        return false;
    }
    ![normal(a), normal(b)].into_iter().any(|normal| is_between(normal, first, second, margin))
}

/// Returns whether no points of two pieces are within `margin` of each other by the carrier of either. Those in `tried`
/// do not tell the first piece from theirs, and this adds to them.
pub(super) fn are_told<'a>(
    piece: (&Whole, &Piece),
    other: (&'a Whole, &'a Piece),
    margin: f64,
    tried: &mut Vec<&'a Fitted>,
) -> bool {
    // A strip has hardly a normal.
    if !(piece.0.is_strip || other.0.is_strip) && normal(piece).dot(normal(other)).abs() < MIN_COSINE {
        return false;
    }
    let of_other = other.0.exact_carrier();
    if let Some(carrier) = of_other.filter(|carrier| !tried.iter().any(|tried| ptr::eq(*tried, *carrier))) {
        if carrier.tells(piece.0, piece.1, margin) {
            return true;
        }
        tried.push(carrier);
    }
    // That of the piece fits best there, as pieces of the other boundary are no larger.
    piece.0.carrier(piece.1).is_some_and(|carrier| carrier.tells(other.0, other.1, margin))
}

/// Returns the unit normal of the plane along both diagonals of a piece's corners; 0 where there is none.
pub(super) fn normal((whole, piece): (&Whole, &Piece)) -> DVec3 {
    let columns = whole.degree()[1];
    let last = piece.points.len() - 1;
    let diagonals =
        [[0, last], [columns, last - columns]].map(|[from, to]| piece.points[to] - piece.points[from]);
    unit(diagonals[0].cross(diagonals[1]))
}

/// Returns the least and the largest height of the control points of a piece along a normal, from `origin`.
pub(super) fn heights(piece: &Piece, normal: DVec3, origin: DVec3) -> [f64; 2] {
    piece.points.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &point| {
        let height = normal.dot(point - origin);
        // NaN is on neither side of a plane.
        [if height >= low { low } else { height }, if height <= high { high } else { height }]
    })
}

fn is_between(normal: DVec3, a: &Piece, b: &Piece, margin: f64) -> bool {
    let origin = a.middle;
    let ([a_low, a_high], [b_low, b_high]) = (heights(a, normal, origin), heights(b, normal, origin));
    a_high + margin < b_low || b_high + margin < a_low
}
