//! Loops whose pieces end in the floats that the next begins with.

use super::piece::TrimPiece;
use crate::param_box::ParamBox;
use glam::DVec2;

/// The distance from an edge of the domain, as a fraction of its range, within which a
/// curve of constant parameter is moved onto the edge, so that faces whose loop is the
/// domain's boundary are recognized and no sliver remains.
const EDGE_DISTANCE: f64 = 1e-9;

/// Moves the ends of a loop's pieces so that each piece ends in the floats that the next
/// begins with; a curve of constant u or v stays one.
///
/// Where one of two neighbours has a constant coordinate, their joint takes it; else the
/// joint is the end of the first. Neighbours that are constant in the same coordinate
/// take one value. O(controls).
pub(super) fn close(pieces: &mut [TrimPiece], domain: &ParamBox) {
    for axis in 0..2 {
        let constants = aligned(pieces, axis, domain[axis]);
        for (piece, constant) in pieces.iter_mut().zip(&constants) {
            if let Some(value) = constant {
                for control in &mut piece.controls {
                    control[axis] = control.z * value;
                }
            }
        }
        for next in 0..pieces.len() {
            let previous = (next + pieces.len() - 1) % pieces.len();
            let last = pieces[previous].degree();
            let joint = match (constants[previous], constants[next]) {
                (Some(value), _) | (None, Some(value)) => value,
                (None, None) => pieces[previous].controls[last][axis],
            };
            // The weights at the ends are 1.
            pieces[previous].controls[last][axis] = joint;
            pieces[next].controls[0][axis] = joint;
        }
    }
}

/// Returns the largest moves in u and v of a control point, which bound the moves of the
/// curve, as its points are convex combinations of the control points.
pub(super) fn moves(from: &TrimPiece, to: &TrimPiece) -> [f64; 2] {
    let apart = from.points().zip(to.points()).map(|(from, to)| (to - from).abs());
    apart.fold(DVec2::ZERO, DVec2::max).into()
}

/// Returns the constant coordinate of every piece that has one, equal for neighbours and
/// that of the domain's edge near it.
fn aligned(pieces: &[TrimPiece], axis: usize, [low, high]: [f64; 2]) -> Vec<Option<f64>> {
    let near = EDGE_DISTANCE * (high - low);
    let on_edge = |value: f64| match value {
        value if (value - low).abs() <= near => low,
        value if (value - high).abs() <= near => high,
        value => value,
    };
    let mut constants: Vec<Option<f64>> = pieces
        .iter()
        .map(|piece| {
            let first = piece.start()[axis];
            piece.points().all(|point| point[axis] == first).then(|| on_edge(first))
        })
        .collect();
    let count = pieces.len();
    // A run of constant pieces begins after one that is not; a loop has such a piece, or no area.
    let Some(first) = constants.iter().position(Option::is_none) else { return constants };
    for step in 1..count {
        let (previous, index) = ((first + step - 1) % count, (first + step) % count);
        if let (Some(value), Some(_)) = (constants[previous], constants[index]) {
            constants[index] = Some(value);
        }
    }
    constants
}
