//! Planes and carriers between pieces.

use super::carrier::Fitted;
use super::piece::{Piece, Whole};
use crate::rounding::unit;
use glam::DVec3;
use std::ptr;

/// The least cosine of the angle of two pieces that their carriers may tell apart: planes do where they cross.
const MIN_COSINE: f64 = 0.5;

/// The least sine of the angle of the diagonals of a piece that has a normal. It is far larger than the rounding of
/// points, and far smaller than the sine of a piece with an area that matters.
const MIN_SINE: f64 = 1e-9;

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
    let normals = [normal(piece), normal(other)];
    let have_normals =
        !(piece.0.is_strip || other.0.is_strip) && normals.iter().all(|normal| *normal != DVec3::ZERO);
    if have_normals && normals[0].dot(normals[1]).abs() < MIN_COSINE {
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

/// Returns the unit normal of the plane along both diagonals of a piece's corners; 0 where they are parallel, as those of a
/// piece without a width are.
pub(super) fn normal((whole, piece): (&Whole, &Piece)) -> DVec3 {
    let columns = whole.degree()[1];
    let last = piece.points.len() - 1;
    let diagonals =
        [[0, last], [columns, last - columns]].map(|[from, to]| piece.points[to] - piece.points[from]);
    let cross = diagonals[0].cross(diagonals[1]);
    if cross.length() > MIN_SINE * diagonals[0].length() * diagonals[1].length() {
        unit(cross)
    } else {
        DVec3::ZERO
    }
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

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::super::BoundarySide;
    use super::super::piece::Patches;
    use super::*;
    use crate::bezier::{Patch, PatchSet, extract};
    use crate::shapes::sphere;

    /// The patch of a sphere about the origin, and one whose rows are both the first row of that: it has no width.
    fn patch_and_row(radius: f64) -> Patches {
        let ball = extract(&sphere(DVec3::ZERO, radius).unwrap()).patches;
        let first = ball.patch(0);
        let row = &first.controls[..=first.degree[1]];
        let mut patches = PatchSet::default();
        patches.push(Patch { ..first });
        patches.push(Patch { degree: [1, first.degree[1]], controls: &[row, row].concat(), ..first });
        Patches::new(&patches, std::iter::empty(), None, |_| BoundarySide::Outward)
    }

    /// A carrier separates a patch without a width from a sphere beside it, although the patch has no normal. It does not
    /// separate the patch from a sphere on which it lies.
    #[test]
    fn a_patch_without_a_width_is_told_by_a_carrier() {
        let [outer, inner] = [2.0, 1.999].map(patch_and_row);
        let told = |row: &Patches, margin: f64| {
            let (whole, thin) = (&outer.wholes[0], &row.wholes[1]);
            assert_eq!(normal((thin, &thin.root)), DVec3::ZERO);
            are_told((whole, &whole.root), (thin, &thin.root), margin, &mut Vec::new())
        };
        assert_eq!([told(&inner, 1e-9), told(&inner, 2e-3), told(&outer, 1e-9)], [true, false, false]);
    }
}
