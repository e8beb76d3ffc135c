//! The first line for people: the verdict, the number with its interval, and the place.

use super::digits::{bounded_beside, coordinates, number};
use crate::input::Input;
use nurbs_hausdorff::{DistanceResult, SurfacePoint};

/// The end of a line with a verdict that does not hold for every reading of the files.
pub(crate) const GAPS_DECIDE: &str = ", but the gaps of the files could change that";

/// Returns the verdict's word and the limit that it is about: `BEYOND 0.05: `.
pub(crate) fn verdict(word: &str, limit: f64) -> String {
    format!("{} {}: ", word.to_uppercase(), number(limit))
}

/// Returns the distance, its interval and where it is attained: `0.2 (0.19999 … 0.20001) on face 6,
/// cylinder, at 8.2 0 0`.
pub(crate) fn distance(result: &DistanceResult, limit: Option<f64>, a: &Input, b: &Input) -> String {
    let witness = &result.witness;
    let ends = [result.lower, result.upper];
    let place = match (&result.forward, &result.reverse) {
        (Some(forward), Some(reverse)) if reverse.computed > forward.computed => {
            place(&witness.b, b, " of B", result.diagonal)
        }
        (Some(_), Some(_)) => place(&witness.a, a, " of A", result.diagonal),
        _ => place(&witness.a, a, "", result.diagonal),
    };
    format!("{} on {place}", bounded_beside(limit, result.computed, ends))
}

/// Returns where a point is: its face, triangle or number in the model that `of` names, its name and
/// kind, and its coordinates.
pub(crate) fn place(point: &SurfacePoint, input: &Input, of: &str, diagonal: f64) -> String {
    let SurfacePoint { face, face_name, triangle, index, point, .. } = point;
    let what = match (index, triangle) {
        (Some(index), _) => format!("point {index}{of}"),
        (None, Some(triangle)) => format!("triangle {triangle}{of}"),
        _ => format!("face {face}{of}"),
    };
    let kind = input.model.as_ref().and_then(|model| model.faces().nth(*face)?.kind());
    let at = format!("at {}", coordinates(*point, diagonal));
    let parts = [Some(what.as_str()), face_name.as_deref(), kind, Some(&at)];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}
