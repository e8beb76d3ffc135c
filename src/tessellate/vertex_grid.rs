//! The grid of vertices of one surface.

use super::divisions::Divisions;
use crate::bezier::{Jet, Patch, PatchGrid, PatchSet};
use glam::DVec3;

/// Angle between the normals of the two sides of a knot line from which it is
/// shown as an edge. Below, the eye takes the facets for one smooth surface.
const CREASE_DEGREES: f64 = 8.0;

/// Where a patch has no normal, as at a sphere's pole, that of a place this
/// part of the way to the patch's middle stands for it; farther, if that has none.
const NEIGHBOURS: [f64; 3] = [1e-4, 1e-2, 0.5];

/// A tangent this much shorter than the other is that of a degenerate edge, a
/// pole: its direction, and so the normal's, is rounding.
const DEGENERATE_RATIO: f64 = 1e-7;

/// A point of a surface with its unit normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Vertex {
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
}

/// A line of the grid: a place on a span of knots.
#[derive(Debug, Clone, Copy)]
struct Line {
    span: usize,
    local: f64,
}

/// Rows of vertices along u, columns along v.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sheet {
    /// v fastest.
    pub(super) vertices: Vec<Vertex>,
    pub(super) columns: usize,
    /// For every row and column, whether the surface goes on to the next.
    pub(super) joined: [Vec<bool>; 2],
}

impl Sheet {
    /// The vertices of a surface; gaps up to `tolerance` are closed.
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
        let joined = [rows, columns].map(|lines| {
            let next = |line: usize| lines.get(line + 1).map(|line| line.span);
            (0..lines.len()).map(|line| next(line) == Some(lines[line].span)).collect()
        });
        let mut sheet = Self { vertices, columns: joined_len(&joined, 1), joined };
        sheet.close(0, tolerance);
        sheet.close(1, tolerance);
        sheet
    }

    /// Makes the two lines of each knot one where the surface goes on smoothly
    /// across, and lets them meet in the same points where it only goes on.
    fn close(&mut self, axis: usize, tolerance: f64) {
        let lines = self.joined[axis].len();
        let across = joined_len(&self.joined, 1 - axis);
        let stride = if axis == 0 { [self.columns, 1] } else { [1, self.columns] };
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
                // The line before goes on where the dropped one went on.
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

    fn keep(&mut self, axis: usize, kept: &[bool]) {
        let columns = self.columns;
        let mut index = 0;
        self.vertices.retain(|_| {
            let line = if axis == 0 { index / columns } else { index % columns };
            index += 1;
            kept[line]
        });
        let mut line = 0;
        self.joined[axis].retain(|_| {
            line += 1;
            kept[line - 1]
        });
        self.columns = joined_len(&self.joined, 1);
    }
}

fn joined_len(joined: &[Vec<bool>; 2], axis: usize) -> usize {
    joined[axis].len()
}

/// Every span's parts with both of its ends, so that inner knots come twice.
fn lines(parts: &[usize]) -> Vec<Line> {
    let mut lines = Vec::new();
    for (span, &parts) in parts.iter().enumerate() {
        for index in 0..=parts {
            lines.push(Line { span, local: index as f64 / parts as f64 });
        }
    }
    lines
}

fn vertex(patch: &Patch<'_>, [s, t]: [f64; 2]) -> Vertex {
    let jet = patch.jet([s, t]);
    let normal = normal(&jet).or_else(|| {
        let toward_middle = |x: f64, part: f64| x + part * (0.5 - x);
        NEIGHBOURS
            .iter()
            .find_map(|&part| normal(&patch.jet([toward_middle(s, part), toward_middle(t, part)])))
    });
    // A patch without normals has no area, so that nothing of it is seen.
    Vertex { point: jet.point, normal: normal.unwrap_or(DVec3::Z) }
}

fn normal(jet: &Jet) -> Option<DVec3> {
    let [s, t] = [jet.s.length(), jet.t.length()];
    if s.min(t) > DEGENERATE_RATIO * s.max(t) { jet.normal() } else { None }
}
