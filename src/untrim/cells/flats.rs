//! Cells without height.

use super::Cell;
use crate::axis::Axis;
use crate::sorting::sort_by_number;
use crate::untrim::boundary::graph::Graph;
use crate::untrim::boundary::{Arc, Flat, Side};
use crate::untrim::face::UnitFace;

/// Adds cells without height for the flat parts of the boundary that no cell touches: slivers
/// lower than the tolerance.
pub(super) fn add(face: &UnitFace, flats: &[Flat], arcs: &mut Vec<Arc>, cells: &mut Vec<Cell>) {
    let margin = face.tolerances.snap[0];
    for flat in flats {
        let touching = cells.iter().filter(|cell| cell.v.contains(&flat.v));
        let mut covers: Vec<[f64; 2]> =
            touching.map(|cell| cell.sides.map(|arc| arcs[arc].side.at(flat.v))).collect();
        sort_by_number(&mut covers, |cover| cover[0]);
        covers.push([f64::INFINITY; 2]);
        let mut reached = flat.u[0];
        for [low, high] in covers {
            let end = low.min(flat.u[1]);
            if end > reached + margin {
                add_part(face, [reached, end], flat.v, arcs, cells);
            }
            reached = reached.max(high);
            if reached >= flat.u[1] {
                break;
            }
        }
    }
}

/// Adds a cell without height for each knot span of an interval of u.
fn add_part(face: &UnitFace, [from, to]: [f64; 2], v: f64, arcs: &mut Vec<Arc>, cells: &mut Vec<Cell>) {
    let mut ends = vec![from];
    ends.extend(face.breaks[0].iter().copied().filter(|&knot| from < knot && knot < to));
    ends.push(to);
    for pair in ends.windows(2) {
        let sides = [0, 1].map(|side| arcs.len() + side);
        arcs.extend(pair.iter().map(|&u| {
            let side = Side::Graph(Graph::line([u, u], [v, v]));
            Arc { side, v: [v, v], change: 0 }
        }));
        let rectangle = [face.span(Axis::U, 0.5 * (pair[0] + pair[1])), face.span(Axis::V, v)];
        cells.push(Cell { sides, v: [v, v], rectangle, winding: 1 });
    }
}
