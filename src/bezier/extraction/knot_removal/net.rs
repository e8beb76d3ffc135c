//! Removal of knots from a surface's homogeneous control net, along both axes in turn.

use super::common_polynomial::{Continuation, Lines, Piece, Pieces};
use crate::axis::Axis;
use crate::bezier::basis::Interpolation;
use crate::bezier::extraction::extract::power_of_two_below;
use crate::bvh::Aabb;
use crate::model::{NurbsSurface, Span, SurfaceArrays, spans};
use crate::rounding::{UNIT_ROUNDOFF, gamma, lower_min, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::borrow::Cow;
use std::ops::Range;

/// The largest difference of a span's control from the common polynomial's, in
/// units of the rounding of the model's largest coordinate and weight. The solution of
/// an interpolation problem, which a refit is, carries some units.
const MAX_DIFFERENCE: f64 = 64.0;

/// Upper bound on the weights of a surface: the largest is in [1, 2).
const MAX_WEIGHT: f64 = 2.0;

/// The roundings in a difference of two controls, for each degree: six of the span's
/// own and six of the common polynomial's over the span (lemma R3 of docs/rounding.md).
const ROUNDINGS_PER_DEGREE: f64 = 12.0;

/// The further roundings: two products of lemma R3, forming homogeneous controls and the
/// difference, and the common polynomial's control points of the model.
const ROUNDINGS: f64 = 18.0;

/// A surface's homogeneous control points.
pub(super) struct Net {
    pub(super) degree: [usize; 2],
    pub(super) knots: [Vec<f64>; 2],
    pub(super) counts: [usize; 2],
    /// `(w (p - center), w)`, v fastest, with the weights divided by `scale`.
    pub(super) controls: Vec<DVec4>,
    pub(super) center: DVec3,
    /// The largest distance of a control point from the centre.
    pub(super) radius: f64,
    /// The smallest weight.
    pub(super) lightest: f64,
    /// The common weight of a polynomial surface.
    pub(super) weight: Option<f64>,
    /// Bounds on the differences from the given surface, in space and in weight.
    pub(super) differences: [f64; 2],
}

impl Net {
    pub(super) fn new(surface: &NurbsSurface) -> Self {
        let points = surface.control_points();
        let position = |&[x, y, z, _]: &[f64; 4]| DVec3::new(x, y, z);
        let center = points.iter().map(position).fold(Aabb::EMPTY, Aabb::with).center();
        let heaviest = points.iter().map(|point| point[3]).fold(0.0, upper_max);
        let scale = power_of_two_below(heaviest).recip();
        let controls: Vec<DVec4> = points
            .iter()
            .map(|point| {
                let weight = scale * point[3];
                (weight * (position(point) - center)).extend(weight)
            })
            .collect();
        let first = controls[0].w;
        let mut net = Self {
            degree: surface.degree(),
            knots: Axis::BOTH.map(|axis| surface.knots(axis).to_vec()),
            counts: surface.counts(),
            controls,
            center,
            radius: 0.0,
            lightest: f64::INFINITY,
            weight: None,
            differences: [0.0; 2],
        };
        net.weight = net.controls.iter().all(|control| control.w == first).then_some(first);
        net.measure();
        net
    }

    /// Makes the radius and the smallest weight hold for the present controls, too.
    fn measure(&mut self) {
        let length = |control: &DVec4| control.xyz().length() / control.w;
        self.radius = self.controls.iter().map(length).fold(self.radius, upper_max);
        self.lightest = self.controls.iter().map(|control| control.w).fold(self.lightest, lower_min);
    }

    /// The largest length of a coordinate vector.
    pub(super) fn largest(&self) -> f64 {
        self.radius + self.center.length()
    }

    /// The error of the lemma, with that of the control points' own rounding.
    pub(super) fn error(&self) -> f64 {
        let [space, weight] = self.differences;
        (space + weight * self.radius) / self.lightest * (1.0 + gamma(ROUNDINGS))
            + gamma(ROUNDINGS) * self.largest()
    }

    /// The largest difference of controls at which they count as equal.
    fn tolerance(&self) -> f64 {
        MAX_WEIGHT * MAX_DIFFERENCE * UNIT_ROUNDOFF * self.largest()
    }

    /// Replaces runs of spans along `axis` that are one polynomial by one span each;
    /// returns whether there are any.
    pub(super) fn reduce(&mut self, axis: Axis) -> bool {
        let (degree, count) = (self.degree[axis], self.counts[axis]);
        let spans = spans(&self.knots[axis], degree, count);
        let rows = self.rows(axis);
        let lines = Lines { rows: &rows, count: self.counts[axis.other()] };
        // The middle one: edges are often straight where the surface is not.
        let sample = lines.line(lines.count / 2);
        let sample = Lines { rows: &sample, count: 1 };
        let runs = self.runs(axis, &spans, [sample, lines]);
        if runs.len() == spans.len() {
            return false;
        }
        let interpolation = &Interpolation::new(degree);
        let mut pieces = Pieces { degree, spans: &spans, interpolation, lines, sample, list: Vec::new() };
        let mut differences = [0.0_f64; 2];
        for run in runs {
            pieces.add(run, self.tolerance(), &mut differences);
        }
        let pieces = pieces.list;
        if pieces.len() == spans.len() {
            return false;
        }
        self.replace(axis, &spans, &pieces);
        let roundings = gamma(ROUNDINGS_PER_DEGREE * degree as f64 + ROUNDINGS);
        let heaviest = self.controls.iter().map(|control| control.w).fold(MAX_WEIGHT, upper_max);
        self.differences[0] += differences[0] + roundings * heaviest * self.radius;
        // Equal weights stay as they are.
        if self.weight.is_none() {
            self.differences[1] += differences[1] + roundings * heaviest;
        }
        true
    }

    /// The controls with those of a line along `axis` apart from each other by the number of lines.
    fn rows(&self, axis: Axis) -> Cow<'_, [DVec4]> {
        match axis {
            Axis::U => Cow::Borrowed(&self.controls),
            Axis::V => Cow::Owned(transposed(&self.controls, self.counts[1])),
        }
    }

    /// The maximal runs of spans that seem to be one polynomial on every line; the first of
    /// both sets of lines is examined first.
    fn runs(&self, axis: Axis, spans: &[Span], lines: [Lines<'_>; 2]) -> Vec<Range<usize>> {
        let tolerance = self.tolerance();
        let joined: Vec<bool> = spans
            .windows(2)
            .map(|pair| {
                let continuation = Continuation::new(&pair[0], &pair[1], self.degree[axis]);
                lines.iter().all(|&lines| continuation.holds(lines, tolerance))
            })
            .collect();
        let mut runs = Vec::new();
        let mut start = 0;
        for end in 1..=spans.len() {
            if end == spans.len() || !joined[end - 1] {
                runs.push(start..end);
                start = end;
            }
        }
        runs
    }

    /// Takes the Bézier controls of pieces, all lines of each, as the net along `axis`.
    fn replace(&mut self, axis: Axis, spans: &[Span], pieces: &[Piece]) {
        let order = self.degree[axis] + 1;
        let mut knots = Vec::with_capacity((pieces.len() + 1) * order);
        for piece in pieces {
            knots.extend(std::iter::repeat_n(spans[piece.spans.start].ends[0], order));
        }
        if let Some(last) = spans.last() {
            knots.extend(std::iter::repeat_n(last.ends[1], order));
        }
        let mut rows: Vec<DVec4> = pieces.iter().flat_map(|piece| piece.controls.iter().copied()).collect();
        if let Some(weight) = self.weight {
            rows.iter_mut().for_each(|control| control.w = weight);
        }
        self.controls = if axis == Axis::U { rows } else { transposed(&rows, self.counts[0]) };
        self.knots[axis] = knots;
        self.counts[axis] = pieces.len() * order;
        self.measure();
    }

    pub(super) fn into_arrays(self) -> SurfaceArrays {
        let point = |control: &DVec4| {
            let DVec3 { x, y, z } = self.center + control.xyz() / control.w;
            [x, y, z, control.w]
        };
        SurfaceArrays {
            degree: self.degree,
            control_points: self.controls.iter().map(point).collect(),
            knots: self.knots,
            counts: self.counts,
        }
    }
}

/// Returns the transpose of a matrix with this many columns.
fn transposed(matrix: &[DVec4], columns: usize) -> Vec<DVec4> {
    (0..columns).flat_map(|column| matrix[column..].iter().step_by(columns).copied()).collect()
}
