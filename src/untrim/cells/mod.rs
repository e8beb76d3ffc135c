//! The decomposition of a face into cells between two neighbouring arcs, and its proof.

mod balance;
mod flats;
mod order;
pub(super) mod ruling;
mod sides;
mod unfolded;

use super::boundary::graph::Graph;
use super::boundary::{Arc, Boundary, Side};
use super::face::UnitFace;
use crate::axis::Axis;
use crate::sorting::sort_by_number;
use std::collections::HashMap;

pub(super) use balance::balance;

/// A cell: the points between two arcs at v in an interval, within one rectangle of knots.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    /// The arcs on its left and on its right, by their index.
    pub(super) sides: [usize; 2],
    /// Its levels; equal ones for a cell without height.
    pub(super) v: [f64; 2],
    /// The numbers of the knot spans in u and v.
    pub(super) rectangle: [usize; 2],
    /// The winding number between the sides, which is not 0.
    pub(super) winding: i32,
}

/// The cells of a face, and the arcs that they lie between.
pub(super) struct Cells {
    pub(super) arcs: Vec<Arc>,
    pub(super) cells: Vec<Cell>,
}

impl Side {
    /// Returns u at this v.
    pub(super) fn at(&self, v: f64) -> f64 {
        match self {
            Self::Graph(graph) => graph.at(v),
            Self::Own(curve) => curve.point(curve.solve(v)).x,
        }
    }
}

/// Two neighbouring arcs, the number of the knot span between them, and the winding number
/// there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Gap {
    sides: [usize; 2],
    span: usize,
    winding: i32,
}

/// Returns the cells of the face: the parts of slabs between neighbouring arcs where the
/// winding number is not 0, joined over consecutive slabs. [`balance`] proves of them, as they
/// are after all later cuts, that they cover the face once (lemma T1 of docs/trimming.md).
/// O(slabs × arcs across one).
pub(super) fn cells(face: &UnitFace, boundary: &Boundary) -> Cells {
    let mut arcs = boundary.arcs.clone();
    let range = arcs
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], arc| [low.min(arc.v[0]), high.max(arc.v[1])]);
    if range[0] < range[1] {
        let inner = &face.breaks[0][1..face.breaks[0].len() - 1];
        arcs.extend(inner.iter().map(|&knot| {
            let side = Side::Graph(Graph::line([knot, knot], range));
            Arc { side, v: range, change: 0 }
        }));
    }
    let levels = levels(face, boundary, &arcs, range);
    let mut starts: Vec<usize> = (0..arcs.len()).collect();
    sort_by_number(&mut starts, |&arc| arcs[arc].v[0]);
    let mut starts = starts.into_iter().peekable();
    let (mut active, mut open) = (Vec::new(), HashMap::new());
    let mut cells: Vec<Cell> = Vec::new();
    for slab in levels.windows(2) {
        let v = [slab[0], slab[1]];
        active.retain(|&arc: &usize| arcs[arc].v[1] > v[0]);
        while let Some(arc) = starts.next_if(|&arc| arcs[arc].v[0] <= v[0]) {
            active.push(arc);
        }
        let is_knot = face.breaks[1].binary_search_by(|knot| knot.total_cmp(&v[0])).is_ok();
        let before = std::mem::take(&mut open);
        for gap in order::gaps(&arcs, &active, v) {
            let cell = match before.get(&gap) {
                Some(&index) if !is_knot => index,
                _ => {
                    let rectangle = [gap.span, face.span(Axis::V, 0.5 * (v[0] + v[1]))];
                    cells.push(Cell { sides: gap.sides, v, rectangle, winding: gap.winding });
                    cells.len() - 1
                }
            };
            let cell_v: &mut [f64; 2] = &mut cells[cell].v;
            cell_v[1] = v[1];
            open.insert(gap, cell);
        }
    }
    flats::add(face, &boundary.flats, &mut arcs, &mut cells);
    Cells { arcs, cells }
}

/// Returns the values of v between which no arc begins, ends or crosses a knot line, increasing.
fn levels(face: &UnitFace, boundary: &Boundary, arcs: &[Arc], range: [f64; 2]) -> Vec<f64> {
    let mut levels: Vec<f64> = arcs.iter().flat_map(|arc| arc.v).collect();
    levels.extend(&boundary.crossings);
    levels.extend(face.breaks[1].iter().filter(|&&knot| range[0] < knot && knot < range[1]));
    sort_by_number(&mut levels, |level| *level);
    levels.dedup();
    levels
}
