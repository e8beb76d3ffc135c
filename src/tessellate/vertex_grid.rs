//! The grid of vertices of one surface.

use super::divisions::Divisions;
use crate::axis::Axis;
use crate::bezier::{Jet, Patch, PatchGrid, PatchSet};
use glam::DVec3;

/// The smallest angle, in degrees, between the normals of the two sides of a knot
/// line at which the line is displayed as a crease; below, the facets look smooth.
const CREASE_DEGREES: f64 = 8.0;

/// Where a patch has no normal, as at a sphere's pole, the normal at the first of
/// these fractions of the way to the patch's middle that has one is used instead.
const NEIGHBOURS: [f64; 3] = [1e-4, 1e-2, 0.5];

/// A tangent shorter than the other by this factor belongs to a degenerate edge,
/// such as a pole: its direction, and so the normal's, is rounding.
const DEGENERATE_RATIO: f64 = 1e-7;

/// A point of a surface with its unit normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
}

/// A grid line: a knot span, and the patch parameter on it.
#[derive(Debug, Clone, Copy)]
struct GridLine {
    span: usize,
    local: f64,
}

/// The vertices of a surface: rows along u, columns along v.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct VertexGrid {
    /// The vertices, v fastest.
    pub(super) vertices: Vec<Vertex>,
    pub(super) columns: usize,
    /// For every row and every column, whether the surface continues to the next.
    pub(super) joined: [Vec<bool>; 2],
}

impl VertexGrid {
    /// Evaluates the vertices of a surface and closes gaps up to `tolerance`.
    /// O(vertices p q).
    pub(super) fn new(patches: &PatchSet, grid: &PatchGrid, divisions: &Divisions, tolerance: f64) -> Self {
        let [rows, columns] = [0, 1].map(|axis| lines(&divisions.parts[axis]));
        let mut vertices = Vec::with_capacity(rows.len() * columns.len());
        for row in &rows {
            for column in &columns {
                let patch = patches.patch(grid.first + row.span * grid.counts()[1] + column.span);
                vertices.push(vertex(&patch, [row.local, column.local]));
            }
        }
        let joined: [Vec<bool>; 2] = [rows, columns].map(|lines| {
            let next = |line: usize| lines.get(line + 1).map(|line| line.span);
            (0..lines.len()).map(|line| next(line) == Some(lines[line].span)).collect()
        });
        let mut grid = Self { vertices, columns: joined[Axis::V].len(), joined };
        for axis in Axis::BOTH {
            grid.close(axis, tolerance);
        }
        grid
    }

    /// Returns the triangles between the vertices, by the places of these: cells are divided along their shorter diagonal.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let lines = |axis: Axis| {
            self.joined[axis].iter().enumerate().filter(|&(_, &joined)| joined).map(|(line, _)| line)
        };
        let cells = lines(Axis::U).flat_map(move |row| lines(Axis::V).map(move |column| [row, column]));
        cells.flat_map(|[row, column]| {
            let at = |i: usize, j: usize| (row + i) * self.columns + column + j;
            let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
            let length = |p: usize, q: usize| self.vertices[p].point.distance_squared(self.vertices[q].point);
            if length(a, c) <= length(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
        })
    }

    /// Merges the two grid lines of each inner knot where the surface is smooth
    /// across it, and makes their points equal where it is only continuous.
    fn close(&mut self, axis: Axis, tolerance: f64) {
        let lines = self.joined[axis].len();
        let across = self.joined[axis.other()].len();
        let stride = if axis == Axis::U { [self.columns, 1] } else { [1, self.columns] };
        let at = |line: usize, index: usize| line * stride[0] + index * stride[1];
        let mut kept = vec![true; lines];
        for line in 0..lines.saturating_sub(1) {
            if self.joined[axis][line] {
                continue;
            }
            let pairs = || (0..across).map(|index| (at(line, index), at(line + 1, index)));
            let gap = |(a, b): (usize, usize)| self.vertices[a].point.distance(self.vertices[b].point);
            if pairs().any(|pair| gap(pair) > tolerance) {
                continue;
            }
            let cosine = CREASE_DEGREES.to_radians().cos();
            let turn = |(a, b): (usize, usize)| self.vertices[a].normal.dot(self.vertices[b].normal);
            if pairs().all(|pair| turn(pair) >= cosine) {
                // The first line continues as the merged one did.
                kept[line + 1] = false;
                self.joined[axis][line] = self.joined[axis][line + 1];
            } else {
                for (a, b) in pairs() {
                    self.vertices[b].point = self.vertices[a].point;
                }
            }
        }
        self.keep(axis, &kept);
    }

    /// Removes the lines along `axis` that are not kept.
    fn keep(&mut self, axis: Axis, kept: &[bool]) {
        let columns = self.columns;
        let mut index = 0;
        self.vertices.retain(|_| {
            let line = if axis == Axis::U { index / columns } else { index % columns };
            index += 1;
            kept[line]
        });
        let mut line = 0;
        self.joined[axis].retain(|_| {
            line += 1;
            kept[line - 1]
        });
        self.columns = self.joined[Axis::V].len();
    }
}

/// Returns the grid lines of every span, both ends included, so that there are two
/// for every inner knot.
fn lines(parts: &[usize]) -> Vec<GridLine> {
    let mut lines = Vec::new();
    for (span, &parts) in parts.iter().enumerate() {
        for index in 0..=parts {
            lines.push(GridLine { span, local: index as f64 / parts as f64 });
        }
    }
    lines
}

/// Evaluates a vertex.
fn vertex(patch: &Patch<'_>, [s, t]: [f64; 2]) -> Vertex {
    let jet = patch.jet([s, t]);
    let normal = normal(&jet).or_else(|| {
        let towards_middle = |x: f64, fraction: f64| x + fraction * (0.5 - x);
        NEIGHBOURS
            .iter()
            .find_map(|&fraction| normal(&patch.jet([s, t].map(|x| towards_middle(x, fraction)))))
    });
    // A patch without normals has no area and is not visible.
    Vertex { point: jet.point, normal: normal.unwrap_or(DVec3::Z) }
}

/// Returns the unit normal unless the point is degenerate.
fn normal(jet: &Jet) -> Option<DVec3> {
    let [s, t] = [jet.s.length(), jet.t.length()];
    if s.min(t) > DEGENERATE_RATIO * s.max(t) { jet.normal() } else { None }
}
