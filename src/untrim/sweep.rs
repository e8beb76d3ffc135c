//! The decomposition of a face into cells between two neighbouring arcs.

use super::arcs::{Arc, Boundary, Side};
use super::face::Face;
use super::graph::Graph;
use crate::axis::Axis;
use std::collections::HashMap;

/// A cell: the points between two arcs at v in an interval, within one rectangle of knots.
#[derive(Debug, Clone)]
pub(super) struct Cell {
    pub(super) sides: [Side; 2],
    pub(super) v: [f64; 2],
    /// The numbers of the knot spans in u and v.
    pub(super) rectangle: [usize; 2],
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

/// Two neighbouring arcs over a slab or several.
#[derive(Debug, Clone, Copy)]
struct Gap {
    arcs: [usize; 2],
    v: [f64; 2],
    /// The middle of the gap in the first slab.
    middle: [f64; 2],
}

/// The width, in parts of the domain, below which a gap counts as empty if its
/// neighbour across a knot line covers it.
const EMPTY_WIDTH: f64 = 4.0 * f64::EPSILON;

/// Returns the cells of the face. They cover the region within the snapped boundary, and
/// overlap only in their edges (lemma T1 of docs/trimming.md). O(slabs × arcs across one).
pub(super) fn cells(face: &Face, boundary: &Boundary) -> Vec<Cell> {
    let mut arcs = boundary.arcs.clone();
    let range = arcs
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], arc| [low.min(arc.v[0]), high.max(arc.v[1])]);
    let knots_v = &face.breaks[1];
    for &knot in &face.breaks[0][1..face.breaks[0].len() - 1] {
        if range[0] < range[1] {
            let side = Side::Graph(Graph::line([knot, knot], range));
            arcs.push(Arc { side, v: range, change: 0 });
        }
    }
    let mut levels: Vec<f64> = arcs.iter().flat_map(|arc| arc.v).collect();
    // The order of the arcs changes also where one crosses a knot line of u.
    levels.extend(&boundary.crossings);
    levels.extend(knots_v.iter().filter(|&&knot| range[0] < knot && knot < range[1]));
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut starts: Vec<usize> = (0..arcs.len()).collect();
    starts.sort_by(|&a, &b| arcs[a].v[0].total_cmp(&arcs[b].v[0]));
    let mut starts = starts.into_iter().peekable();
    let (mut active, mut open, mut gaps) = (Vec::new(), HashMap::new(), Vec::new());
    for slab in levels.windows(2) {
        let [low, high] = [slab[0], slab[1]];
        active.retain(|&arc: &usize| arcs[arc].v[1] > low);
        while let Some(arc) = starts.next_if(|&arc| arcs[arc].v[0] <= low) {
            active.push(arc);
        }
        let is_knot = knots_v.binary_search_by(|knot| knot.total_cmp(&low)).is_ok();
        let before = std::mem::take(&mut open);
        for (arcs, middle) in neighbors(&arcs, &active, 0.5 * (low + high)) {
            let gap = match before.get(&arcs) {
                Some(&index) if !is_knot => index,
                _ => {
                    gaps.push(Gap { arcs, v: [low, high], middle });
                    gaps.len() - 1
                }
            };
            gaps[gap].v[1] = high;
            open.insert(arcs, gap);
        }
    }
    let mut cells: Vec<Cell> = gaps
        .iter()
        .map(|gap| Cell {
            sides: gap.arcs.map(|arc| arcs[arc].side.clone()),
            v: gap.v,
            rectangle: rectangle(face, gap.middle),
        })
        .collect();
    let flat = flat_cells(face, boundary, &cells);
    cells.extend(flat);
    cells
}

/// Returns the numbers of the knot spans that contain a point.
fn rectangle(face: &Face, [u, v]: [f64; 2]) -> [usize; 2] {
    [face.span(Axis::U, u), face.span(Axis::V, v)]
}

/// Returns the pairs of neighbouring arcs with material between them at v, each with the
/// point in the middle.
fn neighbors(arcs: &[Arc], active: &[usize], v: f64) -> Vec<([usize; 2], [f64; 2])> {
    let mut order: Vec<(f64, usize)> = active.iter().map(|&arc| (arcs[arc].side.at(v), arc)).collect();
    // Equal arcs that enter come first, so that coincident loops cancel in order.
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(arcs[b.1].change.cmp(&arcs[a.1].change)));
    let mut winding = 0;
    let windings: Vec<i32> = order
        .iter()
        .map(|&(_, arc)| {
            winding += arcs[arc].change;
            winding
        })
        .collect();
    let width = |index: usize| order[index + 1].0 - order[index].0;
    let mut found = Vec::new();
    for index in 0..order.len().saturating_sub(1) {
        if windings[index] == 0 {
            continue;
        }
        let covers = |other: usize, line: usize| {
            arcs[order[line].1].change == 0
                && other + 1 < order.len()
                && windings[other] != 0
                && width(other) > EMPTY_WIDTH
        };
        let is_covered = (index > 0 && covers(index - 1, index)) || covers(index + 1, index + 1);
        if width(index) <= EMPTY_WIDTH && is_covered {
            continue;
        }
        let middle = 0.5 * (order[index].0 + order[index + 1].0);
        found.push(([order[index].1, order[index + 1].1], [middle, v]));
    }
    found
}

/// Returns cells without area for the flat parts of the boundary that no cell touches:
/// slivers lower than the tolerance.
fn flat_cells(face: &Face, boundary: &Boundary, cells: &[Cell]) -> Vec<Cell> {
    let mut found = Vec::new();
    if boundary.flats.is_empty() {
        return found;
    }
    let margin = face.tolerances.snap[0];
    for flat in &boundary.flats {
        let mut covers: Vec<[f64; 2]> = cells
            .iter()
            .filter(|cell| cell.v.contains(&flat.v))
            .map(|cell| [cell.sides[0].at(flat.v), cell.sides[1].at(flat.v)])
            .collect();
        covers.sort_by(|a, b| a[0].total_cmp(&b[0]));
        covers.push([f64::INFINITY; 2]);
        let mut reached = flat.u[0];
        for [low, high] in covers {
            let end = low.min(flat.u[1]);
            if end > reached + margin {
                found.extend(flat_pieces(face, [reached, end], flat.v));
            }
            reached = reached.max(high);
            if reached >= flat.u[1] {
                break;
            }
        }
    }
    found
}

/// Returns a cell without height for each knot span of an interval of u.
fn flat_pieces(face: &Face, [from, to]: [f64; 2], v: f64) -> Vec<Cell> {
    let inner = face.breaks[0].iter().copied().filter(|&knot| from < knot && knot < to);
    let mut ends: Vec<f64> = inner.collect();
    ends.insert(0, from);
    ends.push(to);
    ends.windows(2)
        .map(|pair| {
            let line =
                |u: f64| Side::Own(super::curve::Curve::line(glam::DVec2::new(u, v), glam::DVec2::new(u, v)));
            Cell {
                sides: [line(pair[0]), line(pair[1])],
                v: [v, v],
                rectangle: rectangle(face, [0.5 * (pair[0] + pair[1]), v]),
            }
        })
        .collect()
}
