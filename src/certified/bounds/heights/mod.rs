//! The bound by heights over a tangent plane of B, for cells that lie on B or nearly so, in
//! whatever parameters.
//!
//! Lemma (3.17 of `docs/method.md`). Let b be a point, P a linear map of space to parameter steps, T two
//! vectors, n a unit vector, `|I - T P - n nᵀ| <= ν` and `|n·T_i| <= ν |T_i|`. Let Y be a box of B's
//! parameters with β, and o_i a bound on how far `y + P (a - B(y))` is beyond an end of Y along axis i, for all
//! points a of the cell and all y at that end. For any function `f(b + v) = n·v + v·M v` whose
//! values on the cell differ from those on B(Y) by at most Δ,
//!
//! `d(a, B) <= ((Δ + (ν + μ) l) / (1 - μ_n - ν) + l) / (1 - 6 ν)`, `l = |T_s| o_s + |T_t| o_t`,
//!
//! `μ = |M| r`, `μ_n = |M n| r`, r the sum of the largest distances of the cell's points and of those of B(Y)
//! from b, if `μ <= 1` and `μ_n + ν <= 1/2`.
//!
//! Lemma (3.18). Where B is a trimmed face's whole surface, the bound holds for the face if the box of the
//! fixed points' ranges lies in the face's region.
//!
//! Lemmas 3.19, 3.21 and 3.22 are those of `rim`, `several_faces` and `around`: cells over loops of a face, over
//! lines between faces, and at poles, ends and lines of vanishing derivatives.
//!
//! The feet are fixed points (Brouwer), so that no map of the cell into B's parameters is needed. With f that
//! vanishes on a plane, a sphere, a cylinder or a cone, A and B on it are at no distance however their
//! parameters run.

mod around;
mod border;
mod comparison;
mod ends;
mod fit;
mod frame;
mod over;
mod piece;
mod quadric;
mod rim;
mod several_faces;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::faces::FaceChart;
use crate::certified::nearest::Foot;
use crate::certified::sheets::Chart;
use frame::Frame;
use over::Over;

/// The largest distance of a cell from B, relative to the cell's radius, at which it is tried.
const MAX_DISTANCE: f64 = 0.0625;

/// The bound from the nearest known foot. O(p² q²) for each patch of B that is touched.
pub(super) struct Heights;

impl UpperBound for Heights {
    fn lemma(&self) -> Lemma {
        Lemma::Heights
    }

    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let (context, foot) = (&*context, context.foot());
        let is_near = foot.distance() <= threshold && foot.distance() <= MAX_DISTANCE * context.radius;
        if !is_near {
            return None;
        }
        // The whole face first where it is a trimmed one, whose pieces end where the cut has put a line.
        let places = places(context, &foot)?;
        let mut candidates = [None; 2];
        let mut about_foot = None;
        for (place, candidate) in places.into_iter().zip(&mut candidates) {
            let Some((frame, face)) = place.and_then(framed) else {
                *candidate = place;
                continue;
            };
            if !frame.is_left_slowly(context, threshold) {
                continue;
            }
            *candidate = place;
            let Some(over) = Over::new(context, frame, face) else { continue };
            if let Some(bound) = over.upper_bound(threshold) {
                return Some(bound);
            }
            about_foot.get_or_insert(over);
        }
        if let Some(bound) = about_foot.and_then(|over| several_faces::upper_bound(context, over, threshold))
        {
            return Some(bound);
        }
        candidates.into_iter().flatten().find_map(|place| around::upper_bound(context, place, threshold))
    }
}

/// The surface of B about a foot, and the face whose surface it is, if that is trimmed.
type Place<'a> = (Chart<'a>, Option<FaceChart<'a>>);

/// The frame of a place's foot.
fn framed((chart, face): Place<'_>) -> Option<(Frame<'_>, Option<FaceChart<'_>>)> {
    Some((Frame::new(chart)?, face))
}

/// The places of a foot: in its trimmed face, and in a piece.
fn places<'a>(context: &CellContext<'a>, foot: &Foot) -> Option<[Option<Place<'a>>; 2]> {
    let piece = Chart::new(context.pair.b.sheets?, foot.patch, foot.parameters);
    let face = context.pair.b.faces.and_then(|faces| faces.chart(&piece));
    Some([face.map(|face| (face.chart, Some(face))), Some((piece, None))])
}
