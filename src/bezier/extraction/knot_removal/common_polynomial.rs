//! Polynomials that several spans of a spline have in common.

use crate::bezier::basis::{Interpolation, bernstein};
use crate::limits::MAX_ORDER;
use crate::model::{Span, blossom_coefficients};
use crate::rounding::upper_max;
use glam::{DVec4, Vec4Swizzles};
use std::ops::Range;

/// The lines of homogeneous controls of a net along one axis.
#[derive(Clone, Copy)]
pub(super) struct Lines<'a> {
    /// The first controls of all lines, then the second ones, and so on.
    pub(super) rows: &'a [DVec4],
    /// The number of lines.
    pub(super) count: usize,
}

impl Lines<'_> {
    /// Returns the controls of one line.
    pub(super) fn line(&self, line: usize) -> Vec<DVec4> {
        self.rows[line..].iter().step_by(self.count).copied().collect()
    }

    /// Adds, for every line, the sum of its controls from `first` on times the coefficients.
    fn add_combination(&self, first: usize, coefficients: &[f64], sums: &mut [DVec4]) {
        let rows = self.rows[first * self.count..].chunks_exact(self.count);
        for (row, &coefficient) in rows.zip(coefficients) {
            for (sum, &control) in sums.iter_mut().zip(row) {
                *sum += coefficient * control;
            }
        }
    }
}

/// The conditions under which a line is one polynomial over two neighbouring spans.
pub(super) struct Continuation {
    first_control: usize,
    /// For each condition the coefficients of the controls of both spans whose sum vanishes,
    /// and the growth of the tolerance by extrapolation.
    conditions: Vec<([f64; 2 * MAX_ORDER], f64)>,
    /// The number of controls of both spans.
    controls: usize,
}

impl Continuation {
    /// States that the polynomial of the longer span, continued, is that of the shorter one.
    ///
    /// Control k of the continuation over `[1, 1 + ratio]` is the blossom at 1, degree - k times,
    /// and `1 + ratio`, k times: the last of each level of de Casteljau's algorithm. Across a
    /// knot of multiplicity m, the controls 0 to degree - m agree by themselves.
    /// O(degree³).
    pub(super) fn new(left: &Span, right: &Span, degree: usize) -> Self {
        let multiplicity = right.first_control - left.first_control;
        let width = |span: &Span| span.ends[1] - span.ends[0];
        let is_reversed = width(left) < width(right);
        let [long, short] = if is_reversed { [right, left] } else { [left, right] };
        let ratio = width(short) / width(long);
        // The index in a span of the control that is k-th in the direction of the continuation.
        let place = |k: usize| if is_reversed { degree - k } else { k };
        let offset = |span: &Span| span.first_control - left.first_control;
        let mut controls = [[0.0; 2 * MAX_ORDER]; MAX_ORDER];
        for (k, control) in controls.iter_mut().enumerate().take(degree + 1) {
            control[offset(long)..][..=degree].copy_from_slice(&long.operator[place(k)][..=degree]);
        }
        let mut conditions = Vec::with_capacity(multiplicity);
        for k in 0..=degree {
            if k + multiplicity > degree {
                let mut difference = controls[degree - k];
                let own = difference[offset(short)..].iter_mut().zip(&short.operator[place(k)][..=degree]);
                own.for_each(|(value, other)| *value -= other);
                conditions.push((difference, (1.0 + 2.0 * ratio).powi(k as i32)));
            }
            for index in (1..=degree - k).rev() {
                let (before, from) = controls.split_at_mut(index);
                for (value, below) in from[0].iter_mut().zip(&before[index - 1]) {
                    *value = (1.0 + ratio) * *value - ratio * below;
                }
            }
            // The blossom's arguments move from the end to beyond it, one a level.
            controls.copy_within(1..=degree - k, 0);
        }
        Self { first_control: left.first_control, conditions, controls: multiplicity + degree + 1 }
    }

    /// Returns whether the lines fulfil the conditions to within the tolerance, times what
    /// extrapolation may grow it by.
    pub(super) fn holds(&self, lines: Lines<'_>, tolerance: f64) -> bool {
        let mut sums = vec![DVec4::ZERO; lines.count];
        self.conditions.iter().all(|(coefficients, growth)| {
            sums.fill(DVec4::ZERO);
            lines.add_combination(self.first_control, &coefficients[..self.controls], &mut sums);
            // False for NaN.
            sums.iter().all(|sum| sum.xyz().length() <= tolerance * growth)
        })
    }
}

/// A run of spans as one polynomial.
pub(super) struct Piece {
    pub(super) spans: Range<usize>,
    /// The first Bézier controls of all lines, then the second ones, and so on.
    pub(super) controls: Vec<DVec4>,
}

/// The pieces found so far.
pub(super) struct Pieces<'a> {
    pub(super) degree: usize,
    pub(super) spans: &'a [Span],
    pub(super) interpolation: &'a Interpolation,
    pub(super) lines: Lines<'a>,
    /// One of the lines.
    pub(super) sample: Lines<'a>,
    pub(super) list: Vec<Piece>,
}

impl Pieces<'_> {
    /// Appends a run of spans as one piece, or as several where the differences
    /// from one exceed the tolerance.
    pub(super) fn add(&mut self, run: Range<usize>, tolerance: f64, differences: &mut [f64; 2]) {
        if run.len() == 1 {
            let controls = self.bezier(&self.spans[run.start]);
            self.list.push(Piece { spans: run, controls });
            return;
        }
        // One line first: most runs that are not one polynomial are not on it either.
        let piece = self.common(&run, self.sample, tolerance);
        let piece = piece.and_then(|_| self.common(&run, self.lines, tolerance));
        let Some((controls, largest)) = piece else {
            let middle = run.start + run.len() / 2;
            self.add(run.start..middle, tolerance, differences);
            self.add(middle..run.end, tolerance, differences);
            return;
        };
        *differences = [0, 1].map(|kind| upper_max(differences[kind], largest[kind]));
        self.list.push(Piece { spans: run, controls });
    }

    /// The Bézier controls of one span.
    fn bezier(&self, span: &Span) -> Vec<DVec4> {
        let mut controls = vec![DVec4::ZERO; (self.degree + 1) * self.lines.count];
        for (row, operator) in controls.chunks_exact_mut(self.lines.count).zip(&span.operator) {
            self.lines.add_combination(span.first_control, &operator[..=self.degree], row);
        }
        controls
    }

    /// The Bézier controls over the run of polynomials, with the differences of the lines from
    /// them; `None` if one exceeds the tolerance.
    fn common(&self, run: &Range<usize>, lines: Lines<'_>, tolerance: f64) -> Option<(Vec<DVec4>, [f64; 2])> {
        let controls = self.interpolated(run, lines);
        let largest = self.differences(run, lines, &controls, tolerance)?;
        Some((controls, largest))
    }

    /// The Bézier controls over the run of the polynomials through points of the lines.
    fn interpolated(&self, run: &Range<usize>, lines: Lines<'_>) -> Vec<DVec4> {
        let spans = &self.spans[run.clone()];
        let (start, end) = (spans[0].ends[0], spans[spans.len() - 1].ends[1]);
        let order = self.degree + 1;
        let mut values = vec![DVec4::ZERO; order * lines.count];
        for (row, node) in values.chunks_exact_mut(lines.count).zip(self.interpolation.nodes()) {
            let parameter = (1.0 - node) * start + node * end;
            let index = spans.partition_point(|span| span.ends[1] < parameter).min(spans.len() - 1);
            let span = &spans[index];
            let local = ((parameter - span.ends[0]) / (span.ends[1] - span.ends[0])).clamp(0.0, 1.0);
            let mut coefficients = [0.0; MAX_ORDER];
            for (basis, operator) in bernstein(self.degree, local).iter().zip(&span.operator) {
                for (coefficient, of_control) in coefficients.iter_mut().zip(operator) {
                    *coefficient += basis * of_control;
                }
            }
            lines.add_combination(span.first_control, &coefficients[..order], row);
        }
        let values = Lines { rows: &values, count: lines.count };
        let mut controls = vec![DVec4::ZERO; order * lines.count];
        for (row, weights) in controls.chunks_exact_mut(lines.count).zip(self.interpolation.weights()) {
            values.add_combination(0, weights, row);
        }
        controls
    }

    /// The largest differences, in space and in weight, between the controls of the run's spans
    /// and those of polynomials over all of it; `None` if one exceeds the tolerance.
    ///
    /// The polynomial's controls over a span are its blossoms at the span's ends, the knots
    /// themselves, as in extraction.
    fn differences(
        &self,
        run: &Range<usize>,
        lines: Lines<'_>,
        controls: &[DVec4],
        tolerance: f64,
    ) -> Option<[f64; 2]> {
        let spans = &self.spans[run.clone()];
        let order = self.degree + 1;
        let mut knots = vec![spans[0].ends[0]; order];
        knots.resize(2 * order, spans[spans.len() - 1].ends[1]);
        let polynomials = Lines { rows: controls, count: lines.count };
        let mut sums = vec![DVec4::ZERO; lines.count];
        let mut largest = [0.0_f64; 2];
        for span in spans {
            for (k, operator) in span.operator.iter().enumerate() {
                let restriction = blossom_coefficients(&knots, self.degree, self.degree, span.ends, k);
                sums.fill(DVec4::ZERO);
                polynomials.add_combination(0, &restriction[..order], &mut sums);
                sums.iter_mut().for_each(|sum| *sum = -*sum);
                lines.add_combination(span.first_control, &operator[..order], &mut sums);
                for difference in &sums {
                    largest[0] = upper_max(largest[0], difference.xyz().length());
                    largest[1] = upper_max(largest[1], difference.w.abs());
                }
            }
            let is_within = largest[0] <= tolerance && largest[1] <= tolerance;
            if !is_within {
                return None;
            }
        }
        Some(largest)
    }
}
