//! Cells that the border of a part of B runs around.
//!
//! Lemma (3.22 of `docs/method.md`). Let Y be a box of parameters of B, or all of a pole's surroundings up to
//! some parameter, that is continuous up to jumps that add up to G. If its border, projected along n, has a
//! winding number other than 0 about the projection of each point of a cell and stays farther than G from it, then
//! each point a of the cell is above or below a point of Y: `|a - B(y) - n n·(a - B(y))| <= G` for some y, and 3.17
//! holds with `θ = 0` and `l = G`.
//!
//! Where the cell goes beyond an end of the surface, that end is moved outwards in the plane by as much as it takes;
//! l is larger by how far the cell is beyond it at most (`open_side`).
//!
//! No map of space to parameters has to be followed, so that cells at poles, at lines where the derivatives vanish
//! and at any distance from them are bounded as elsewhere.

mod loops;
mod open_side;
mod part;
mod shadow;

use super::Place;
use super::comparison::{Candidate, Comparison, candidates};
use super::frame::Frame;
use super::over::piece_of_a;
use super::piece::Piece;
use crate::certified::cell_context::CellContext;
use crate::certified::sheets::Pole;
use part::Part;

/// The largest distance of a cell's centre from a pole, relative to the cell's radius, at which the part is that
/// around the pole.
const MAX_POLE_DISTANCE: f64 = 2.0;

/// The bound of a cell by the part of B about its foot; `None` where it exceeds the threshold.
pub(super) fn upper_bound(
    context: &CellContext<'_>,
    (chart, face): Place<'_>,
    threshold: f64,
) -> Option<f64> {
    let is_near =
        |pole: &Pole<'_>| pole.point.distance(context.jet.point) <= MAX_POLE_DISTANCE * context.radius;
    let (frame, pole) = match chart.poles().find(is_near) {
        Some(pole) => (Frame::of_plane(pole.chart, pole.normal)?, Some(pole)),
        None => (Frame::of_plane(chart, chart.jet().normal()?)?, None),
    };
    let a = piece_of_a(context, &frame);
    let mut functions = candidates(&a, frame.normal, frame.tangents[0], threshold);
    let bound = match &pole {
        Some(pole) => {
            // A few points of B say whether it is of use.
            let extent = part::first_extent(&frame, &a, pole);
            let points = part::points_around(&frame, pole, extent);
            let is_near =
                |function: &Candidate| points.iter().all(|point| function.is_near(*point, threshold));
            let functions: Vec<Candidate> = functions.filter(is_near).collect();
            if functions.is_empty() {
                return None;
            }
            let part = Part::around_pole(&frame, &a, (pole, extent), face.as_ref())?;
            bound(&frame, &a, &part, &mut functions.into_iter(), threshold)
        }
        None => {
            let part = Part::about_foot(&frame, &a, face.as_ref(), threshold)?;
            if part.beyond > threshold {
                return None;
            }
            bound(&frame, &a, &part, &mut *functions, threshold)
        }
    };
    // How far the cell is beyond an open side was bounded for points within the threshold.
    (bound <= threshold).then(|| bound + face.map_or(0.0, |face| face.point_error))
}

/// The bound by a part of B.
fn bound(
    frame: &Frame<'_>,
    a: &Piece,
    part: &Part,
    functions: &mut dyn Iterator<Item = Candidate>,
    threshold: f64,
) -> f64 {
    let is_near = |function: &Candidate| {
        let corners = part.pieces.iter().flat_map(|piece| piece.corners());
        corners.into_iter().all(|corner| function.is_near(corner, threshold))
    };
    let comparison = Comparison {
        a,
        b: part.pieces.iter().collect(),
        normal: frame.normal,
        skew: frame.skew,
        bend: 0.0,
        beyond: part.beyond,
    };
    comparison.least_bound(&mut functions.filter(is_near), threshold)
}
