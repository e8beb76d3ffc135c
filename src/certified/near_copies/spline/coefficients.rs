//! The coefficients of the difference of a block and a surface of B.

use super::BlockMap;
use super::blossom::{Coefficients, Combination};
use crate::bezier::{MAX_ORDER, Patch};
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};

impl<'a> BlockMap<'a> {
    /// The patch of A in a row and a column of the block.
    pub(super) fn of_a(&self, [row, column]: [usize; 2]) -> Patch<'a> {
        let place = [self.block.rows[0] + row as u32, self.block.columns[0] + column as u32];
        self.sheets.patch(self.block.surface, place)
    }

    /// The patch of B at an offset along A's axes.
    fn of_b(&self, offsets: [isize; 2]) -> Patch<'a> {
        self.chart.neighbour(self.orientation.by_axes_of_b(offsets))
    }

    /// Whether all patches over these spans are polynomials: whether the weights of each were equal.
    pub(super) fn are_polynomial(&self, [u, v]: [&Coefficients; 2]) -> bool {
        (0..u.windows.len()).all(|row| (0..v.windows.len()).all(|column| !self.of_a([row, column]).rational))
            && u.offsets.clone().all(|s| v.offsets.clone().all(|t| !self.of_b([s, t]).rational))
    }
}

/// The controls of a patch combined along the first axis, relative to its centre, for combinations along
/// the second.
struct Line<S> {
    span: Option<S>,
    center: DVec3,
    order: usize,
    sums: [DVec4; MAX_ORDER],
}

impl<S: PartialEq + Copy> Line<S> {
    fn new() -> Self {
        Self { span: None, center: DVec3::ZERO, order: 0, sums: [DVec4::ZERO; MAX_ORDER] }
    }

    /// Takes the patch of a span along the second axis, unless it has it; `is_swapped` where its first
    /// parameter runs along the second axis.
    fn take<'p>(
        &mut self,
        along: &Combination<S>,
        span: S,
        is_swapped: bool,
        patch: impl Fn([S; 2]) -> Patch<'p>,
    ) {
        if self.span == Some(span) {
            return;
        }
        let patch = patch([along.span, span]);
        let [p, q] = patch.degree;
        self.order = if is_swapped { p } else { q } + 1;
        let sums = &mut self.sums[..self.order];
        sums.fill(DVec4::ZERO);
        let rows = patch.controls.chunks_exact(q + 1);
        if is_swapped {
            for (sum, row) in sums.iter_mut().zip(rows) {
                for (control, weight) in row.iter().zip(&along.weights) {
                    *sum += *weight * *control;
                }
            }
        } else {
            // Many arguments are ends of the span, and the weights of most rows zero.
            for (row, weight) in rows.zip(&along.weights).filter(|(_, weight)| **weight != 0.0) {
                for (sum, control) in sums.iter_mut().zip(row) {
                    *sum += *weight * *control;
                }
            }
        }
        let weight = patch.controls[0].w;
        if weight != 1.0 {
            let inverse = weight.recip();
            sums.iter_mut().for_each(|sum| *sum *= inverse);
        }
        (self.span, self.center) = (Some(span), patch.center);
    }

    /// The point of a combination along the second axis, relative to the centre.
    fn point(&self, across: &Combination<S>) -> DVec3 {
        let terms = self.sums[..self.order].iter().zip(&across.weights);
        terms.fold(DVec4::ZERO, |point, (sum, weight)| point + *weight * *sum).xyz()
    }
}

/// Calls `each` with the coefficients of the difference, v fastest. O(coefficients d²).
pub(super) fn difference(map: &BlockMap<'_>, [u, v]: [&Coefficients; 2], mut each: impl FnMut(DVec3)) {
    let transform = &map.pair.transform;
    for (row_a, row_b) in u.of_a.iter().zip(&u.of_b) {
        let (mut line_a, mut line_b) = (Line::new(), Line::new());
        let mut moved = DVec3::ZERO;
        for (column_a, column_b) in v.of_a.iter().zip(&v.of_b) {
            if line_a.span != Some(column_a.span) {
                line_a.take(row_a, column_a.span, false, |spans| map.of_a(spans));
                moved = transform.apply(line_a.center);
            }
            line_b.take(row_b, column_b.span, map.orientation.swapped, |offsets| map.of_b(offsets));
            let of_a = transform.rotate(line_a.point(column_a));
            each(of_a - line_b.point(column_b) + (moved - line_b.center));
        }
    }
}

/// The squared lengths of coefficients, v fastest.
pub(super) struct Lengths {
    columns: usize,
    squares: Vec<f64>,
}

impl Lengths {
    /// Those of all coefficients.
    pub(super) fn new(map: &BlockMap<'_>, axes: [&Coefficients; 2]) -> Self {
        let [rows, columns] = axes.map(|axis| axis.of_a.len());
        let mut squares = Vec::with_capacity(rows * columns);
        difference(map, axes, |coefficient| squares.push(coefficient.length_squared()));
        Self { columns, squares }
    }

    /// The largest length on each patch of A, v fastest, given the first and the last coefficient of
    /// its spans along both axes. O(coefficients d).
    pub(super) fn longest(&self, [rows, columns]: [&[[usize; 2]]; 2]) -> Vec<f64> {
        let of_windows = |row: &[f64]| -> Vec<f64> {
            let longest =
                |&[first, last]: &[usize; 2]| row[first..=last].iter().copied().fold(0.0, upper_max);
            columns.iter().map(longest).collect()
        };
        let along: Vec<f64> = self.squares.chunks_exact(self.columns).flat_map(of_windows).collect();
        let mut longest = vec![0.0; rows.len() * columns.len()];
        for (longest, &[first, last]) in longest.chunks_exact_mut(columns.len()).zip(rows) {
            for row in along.chunks_exact(columns.len()).take(last + 1).skip(first) {
                for (longest, square) in longest.iter_mut().zip(row) {
                    *longest = upper_max(*longest, *square);
                }
            }
            longest.iter_mut().for_each(|square| *square = square.sqrt());
        }
        longest
    }
}
