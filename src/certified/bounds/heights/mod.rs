//! The bound by heights over a tangent plane of B, for cells that lie on B or nearly so, in
//! whatever parameters.
//!
//! Lemma (3.17 of `docs/method.md`). Let b be a point, P a linear map of space to parameter steps, T two
//! vectors, n a unit vector, `|I - T P - n nᵀ| <= ν` and `|n·T_i| <= ν |T_i|`. Let Y be a box of B's
//! parameters with β, functions `g_i(b + v) = P_i·v + v·G_i v`, and o_i a bound on how far
//! `y_i + g_i(a) - g_i(B(y))` is beyond an end of Y along axis i, for all points a of the cell and all y at that
//! end. For any function `f(b + v) = (n + τ)·v + v·M v + C[v, v, v]` whose values on the cell differ from those on
//! B(Y) by at most Δ,
//!
//! `d(a, B) <= ((Δ + (ν + μ) l) / (1 - μ_n) + l) / (1 - θ - ν - (ν (1 + θ) + μ (θ + ν)) / (1 - μ_n))`
//!
//! with `l = |T_s| o_s + |T_t| o_t`, `θ = (|T_s| |G_s| + |T_t| |G_t|) r`, `μ = |τ| + |M| r + |C| r²`,
//! `μ_n = |n·τ| + |M n| r + |C[n, ·, ·]| r²` and r the sum of the largest distances of the cell's points and of
//! those of B(Y) from b, if `μ <= 1`, `μ_n <= 1/2` and the divisor is at least 1/2.
//!
//! Lemma (3.18). Where B is one or several trimmed faces that end over the cell, the same holds with the sides at
//! which they do: [`border`], [`rim`] and [`faces`].
//!
//! The feet are fixed points (Brouwer), so that no map of the cell into B's parameters is needed. With f that
//! vanishes on a plane, a sphere, a cylinder or a cone, A and B on it are at no distance however their
//! parameters run.
//!
//! # Words
//!
//! | word | meaning |
//! |---|---|
//! | foot | b, a point of B near the cell |
//! | frame | T, P and n: tangents at the foot, the map to steps of parameters, the normal |
//! | skew | ν, how far the frame is from a right one |
//! | fixed point | the parameters y of the point of B that a point a of the cell is compared with |
//! | placement | where the fixed points are, by functions g that follow B's parameters |
//! | lag | how far a function g is from the parameter that it follows |
//! | overhang | how far a cell is beyond an end of a surface or a side of a face; o, and as a length l |
//! | drift | how far points of B are moved to come back from an overhang into the face |
//! | turn, bend | μ and θ, the change of a function's gradient between a point of the cell and its fixed point |
//! | rim | where a face has no boundary: within one or two conics of its parameters, its sides |
//! | border | the ends of a surface and the sides of its rim; open where others take over |

mod border;
mod candidate;
mod cell_comparison;
mod faces;
mod fit;
mod frame;
mod piece;
mod quadric;
mod rim;
#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests;

use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::faces::FaceChart;
use crate::certified::nearest::Foot;
use crate::certified::sheets::Chart;
use cell_comparison::CellComparison;
use faces::FaceOver;
use frame::Frame;

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
        let mut about_foot = None;
        for (frame, face) in places(context, &foot)?.into_iter().flatten().filter_map(framed) {
            if !frame.is_left_slowly(context, threshold) {
                continue;
            }
            let Some(cell) = CellComparison::new(context, frame, face) else { continue };
            let face = FaceOver::new(cell, threshold);
            if let Some(bound) = face.upper_bound(threshold) {
                return Some(bound);
            }
            about_foot.get_or_insert(face);
        }
        faces::upper_bound(context, about_foot?, threshold)
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
