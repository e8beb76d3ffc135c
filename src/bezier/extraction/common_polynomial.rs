//! Polynomials that several spans of a spline have in common.

use crate::bezier::basis::Interpolation;
use crate::bezier::basis::bernstein::MAX_ORDER;
use crate::bezier::extraction::extract::Span;
use crate::bezier::patch::subdivide::restrict_line;
use crate::rounding::upper_max;
use glam::{DVec4, Vec4Swizzles};
use std::ops::Range;

/// The Bézier controls of a span of one line.
fn bezier(span: &Span, degree: usize, line: &[DVec4]) -> [DVec4; MAX_ORDER] {
    let mut controls = [DVec4::ZERO; MAX_ORDER];
    let line = &line[span.first_control..=span.first_control + degree];
    for (control, operator) in controls.iter_mut().zip(&span.operator) {
        for (coefficient, point) in operator.iter().zip(line) {
            *control += *coefficient * *point;
        }
    }
    controls
}

/// Whether the polynomial of one of two neighbouring spans, the longer one,
/// is that of the other, to within the tolerance times what extrapolation may grow it by.
pub(super) fn continues(left: &Span, right: &Span, degree: usize, line: &[DVec4], tolerance: f64) -> bool {
    let mut controls = [left, right].map(|span| bezier(span, degree, line));
    let mut widths = [left, right].map(|span| span.ends[1] - span.ends[0]);
    if widths[0] < widths[1] {
        widths.swap(0, 1);
        controls.swap(0, 1);
        controls.iter_mut().for_each(|controls| controls[..=degree].reverse());
    }
    let ratio = widths[1] / widths[0];
    let [longer, shorter] = &mut controls;
    // Control k of the continuation over [1, 1 + ratio] is the blossom at 1, degree - k
    // times, and 1 + ratio, k times: the last of each level of de Casteljau's algorithm.
    for k in 0..=degree {
        let difference = longer[degree - k] - shorter[k];
        let growth = (1.0 + 2.0 * ratio).powi(k as i32);
        // False for NaN.
        let is_equal = difference.xyz().length() <= tolerance * growth;
        if !is_equal {
            return false;
        }
        for index in (1..=degree - k).rev() {
            longer[index] = (1.0 + ratio) * longer[index] - ratio * longer[index - 1];
        }
        // The blossom's arguments move from the end to beyond it, one a level.
        for index in 0..degree - k {
            longer[index] = longer[index + 1];
        }
    }
    true
}

/// A run of spans as one polynomial, with the controls of all lines.
pub(super) struct Piece {
    pub(super) spans: Range<usize>,
    pub(super) controls: Vec<DVec4>,
}

/// The pieces found so far.
pub(super) struct Pieces<'a> {
    pub(super) degree: usize,
    pub(super) spans: &'a [Span],
    pub(super) interpolation: &'a Interpolation,
    pub(super) lines: &'a [Vec<DVec4>],
    pub(super) list: Vec<Piece>,
}

impl Pieces<'_> {
    /// Appends a run of spans as one piece, or as several where the differences
    /// from one exceed the tolerance.
    pub(super) fn add(&mut self, run: Range<usize>, tolerance: f64, differences: &mut [f64; 2]) {
        let mut largest = [0.0_f64; 2];
        let mut controls = Vec::with_capacity(self.lines.len() * (self.degree + 1));
        for line in self.lines {
            if run.len() == 1 {
                controls
                    .extend_from_slice(&bezier(&self.spans[run.start], self.degree, line)[..=self.degree]);
                continue;
            }
            let piece = self.interpolated(&run, line);
            self.include_differences(&run, line, &piece, &mut largest);
            let is_within = largest[0] <= tolerance && largest[1] <= tolerance;
            if !is_within {
                let middle = run.start + run.len() / 2;
                self.add(run.start..middle, tolerance, differences);
                self.add(middle..run.end, tolerance, differences);
                return;
            }
            controls.extend(piece);
        }
        *differences = [0, 1].map(|kind| upper_max(differences[kind], largest[kind]));
        self.list.push(Piece { spans: run, controls });
    }

    /// The Bézier controls over the run of the polynomial through points of the line.
    fn interpolated(&self, run: &Range<usize>, line: &[DVec4]) -> Vec<DVec4> {
        let spans = &self.spans[run.clone()];
        let (start, end) = (spans[0].ends[0], spans[spans.len() - 1].ends[1]);
        let values: Vec<DVec4> = self
            .interpolation
            .nodes()
            .iter()
            .map(|node| {
                let parameter = (1.0 - node) * start + node * end;
                let index = spans.partition_point(|span| span.ends[1] < parameter).min(spans.len() - 1);
                let [low, high] = spans[index].ends;
                let local = ((parameter - low) / (high - low)).clamp(0.0, 1.0);
                let mut controls = bezier(&spans[index], self.degree, line);
                for level in 1..=self.degree {
                    for k in 0..=self.degree - level {
                        controls[k] = (1.0 - local) * controls[k] + local * controls[k + 1];
                    }
                }
                controls[0]
            })
            .collect();
        self.interpolation.coefficients(&values)
    }

    /// Includes the differences between the run's spans and a polynomial over all of it.
    fn include_differences(
        &self,
        run: &Range<usize>,
        line: &[DVec4],
        piece: &[DVec4],
        largest: &mut [f64; 2],
    ) {
        let spans = &self.spans[run.clone()];
        let (start, end) = (spans[0].ends[0], spans[spans.len() - 1].ends[1]);
        let order = self.degree + 1;
        for span in spans {
            let own = bezier(span, self.degree, line);
            let mut part = piece.to_vec();
            let ends = span.ends.map(|parameter| (parameter - start) / (end - start));
            restrict_line(&mut part, 0, 1, order, ends);
            for (own, part) in own.iter().zip(&part) {
                let difference = *own - *part;
                largest[0] = upper_max(largest[0], difference.xyz().length());
                largest[1] = upper_max(largest[1], difference.w.abs());
            }
        }
    }
}
