//! The order of the arcs across a slab, and the gaps between neighbours.

use super::Gap;
use crate::untrim::boundary::{Arc, Side};

/// Arcs nearer than this at the middle of a slab are ordered by their mean at
/// [`HEIGHTS`]: the largest width by which validated loops may cross.
const NEAR: f64 = 1e-6;

/// The heights, in parts of a slab, of the mean that orders arcs that touch in its middle.
const HEIGHTS: [f64; 4] = [0.125, 0.375, 0.625, 0.875];

/// Returns the pairs of neighbouring arcs across a slab with a winding number that is not 0
/// between them, from left to right.
///
/// A wrong order shows later: the width of a cell is negative then, or the cells are not
/// balanced.
pub(super) fn gaps(arcs: &[Arc], active: &[usize], slab: [f64; 2]) -> Vec<Gap> {
    let order = ordered(arcs, active, slab);
    let arc = |index: usize| order.get(index).map(|&arc| &arcs[arc]);
    let same = |index: usize| matches!((arc(index), arc(index + 1)), (Some(a), Some(b)) if is_equal(a, b));
    // Nothing lies between a knot line and an arc on it; the gap on the other side of the line,
    // of equal winding number, has the points of both.
    let is_covered = |index: usize| {
        let is_line = |index: usize| arc(index).is_some_and(|arc| arc.change == 0);
        let from_right = is_line(index + 1) && !same(index + 1);
        let from_left = index > 0 && is_line(index) && !same(index - 1);
        same(index) && (from_left || from_right)
    };
    let (mut winding, mut span) = (0, 0);
    let mut found = Vec::new();
    for (index, pair) in order.windows(2).enumerate() {
        let change = arcs[pair[0]].change;
        winding += change;
        // Only knot lines change no winding number.
        span += usize::from(change == 0);
        if winding != 0 && !is_covered(index) {
            found.push(Gap { sides: [pair[0], pair[1]], span, winding });
        }
    }
    found
}

/// Returns whether two arcs are the same line of constant u, so that nothing lies between them.
fn is_equal(left: &Arc, right: &Arc) -> bool {
    matches!((constant(left), constant(right)), (Some(left), Some(right)) if left == right)
}

/// Returns u of an arc of constant u.
pub(super) fn constant(arc: &Arc) -> Option<f64> {
    match &arc.side {
        Side::Graph(graph) if graph.degree() == 0 => Some(graph.coefficients[0]),
        _ => None,
    }
}

/// Returns the arcs from left to right. Equal arcs that enter come first, so that coincident
/// loops cancel in order.
fn ordered(arcs: &[Arc], active: &[usize], [low, high]: [f64; 2]) -> Vec<usize> {
    let at = |arc: usize, share: f64| arcs[arc].side.at((1.0 - share) * low + share * high);
    let sort = |order: &mut [(f64, usize)]| {
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(arcs[b.1].change.cmp(&arcs[a.1].change)));
    };
    let mut order: Vec<(f64, usize)> = active.iter().map(|&arc| (at(arc, 0.5), arc)).collect();
    sort(&mut order);
    for group in order.chunk_by_mut(|a, b| b.0 - a.0 <= NEAR).filter(|group| group.len() > 1) {
        for (key, arc) in group.iter_mut() {
            *key = HEIGHTS.iter().map(|&share| at(*arc, share)).sum();
        }
        sort(group);
    }
    order.into_iter().map(|(_, arc)| arc).collect()
}
