//! B-spline coefficients along an axis as combinations of Bézier controls.
//!
//! Coefficient i of a spline of degree d is the blossom of any of its polynomials inside the support at
//! the knots i + 1 to i + d (Ramshaw, *Blossoms are polar forms*, Computer Aided Geometric Design 6
//! (1989)). That of a Bernstein polynomial at arguments with the local parameters t and c = 1 - t
//! is the sum over all ways to take t from k arguments and c from the others.

use super::knots::{AxisMap, Knot, KnotSequence};
use crate::bezier::{MAX_ORDER, elevation_shares};
use crate::rounding::upper_max;
use std::ops::RangeInclusive;

/// The change of both local parameters of an argument, relative to their sizes, in units of the error of its
/// image over the width of the span: twice that of the image and four times that of the span's ends.
const ARGUMENT_ERRORS: f64 = 6.0;

/// The change of a spline by that of its knots, for each degree, in units of the largest change of a knot times
/// the derivative: six for each level of de Boor's algorithm (lemma R16).
const DRIFT: f64 = 6.0;

/// The largest change of the weights of a coefficient, relative to the sum of their sizes, by the errors
/// of its arguments.
const MAX_CHANGE: f64 = 1e-2;

/// Bounds a sum of products in the errors of arguments by the sum itself, for changes up to
/// [`MAX_CHANGE`].
const COMPOUNDING: f64 = 1.02;

/// A coefficient as a combination of the controls of one span.
pub(super) struct Combination<S> {
    pub(super) span: S,
    pub(super) weights: [f64; MAX_ORDER],
}

/// The coefficients of the difference along an axis.
pub(super) struct Coefficients {
    /// The degree of the difference.
    pub(super) degree: usize,
    pub(super) of_a: Vec<Combination<usize>>,
    pub(super) of_b: Vec<Combination<isize>>,
    /// The first and the last coefficient whose basis function is not zero on a span of A.
    pub(super) windows: Vec<[usize; 2]>,
    /// The spans of B in the image.
    pub(super) offsets: RangeInclusive<isize>,
    /// Upper bounds on the sums of the sizes of A's and of B's weights.
    pub(super) sizes: [f64; 2],
    /// An upper bound on the change of B's weights by the errors of their arguments, relative to
    /// the sums of their sizes.
    pub(super) change: f64,
    /// An upper bound on the change of B as a spline by the distances of its knots from those of the
    /// difference, in differences of controls.
    pub(super) drift: f64,
}

impl Coefficients {
    /// The coefficients over a sequence of knots of a map; `None` where the errors of the images are too
    /// large. O(knots d²).
    pub(super) fn new(map: &AxisMap<'_>, sequence: &KnotSequence) -> Option<Self> {
        let &AxisMap { chart, on_b, degrees, breaks, .. } = map;
        let KnotSequence { degree, knots, spans, error } = sequence;
        let count = sequence.coefficient_count();
        let [(_, from), (_, to)] = [spans[0], spans[spans.len() - 1]];
        let mut coefficients = Self {
            degree: *degree,
            of_a: Vec::with_capacity(count),
            of_b: Vec::with_capacity(count),
            windows: vec![[usize::MAX, 0]; breaks.len() - 1],
            offsets: from.min(to)..=from.max(to),
            sizes: [0.0; 2],
            change: 0.0,
            drift: 0.0,
        };
        let ends_of_a = |span: usize| [breaks[span], breaks[span + 1]];
        let ends_of_b = |offset: isize| [offset, offset + 1].map(|line| chart.line(on_b, line));
        for first in 0..count {
            let arguments = &knots[first + 1..=first + degree];
            let (mut of_a, mut of_b) = (None, None);
            for index in (first..=first + degree).filter(|&index| sequence.is_proper(index)) {
                let (span, offset) = spans[index];
                let [low, high] = &mut coefficients.windows[span];
                (*low, *high) = (first.min(*low), first.max(*high));
                take_smaller(&mut of_a, span, sums(arguments, |knot| knot.parameter, ends_of_a(span)));
                take_smaller(&mut of_b, offset, sums(arguments, |knot| knot.image, ends_of_b(offset)));
            }
            // Without an interval that is not empty in its support a basis function is zero everywhere.
            let ((span, size_a), (offset, size_b)) = (of_a?, of_b?);
            let of_a = weights(arguments, |knot| knot.parameter, ends_of_a(span), degrees[0]);
            let ends = ends_of_b(offset);
            let of_b = weights(arguments, |knot| knot.image, ends, degrees[1]);
            let change = ARGUMENT_ERRORS * *degree as f64 * error / (ends[1] - ends[0]).abs();
            coefficients.change = upper_max(coefficients.change, COMPOUNDING * change);
            coefficients.of_a.push(Combination { span, weights: of_a });
            coefficients.of_b.push(Combination { span: offset, weights: of_b });
            coefficients.sizes[0] = upper_max(coefficients.sizes[0], size_a);
            coefficients.sizes[1] = upper_max(coefficients.sizes[1], size_b);
        }
        coefficients.drift = DRIFT * *degree as f64 * error * steepest(sequence, ends_of_b);
        let is_exact = coefficients.change <= MAX_CHANGE && coefficients.drift <= MAX_CHANGE;
        let are_covered = coefficients.windows.iter().all(|[first, last]| first <= last);
        (is_exact && are_covered).then_some(coefficients)
    }
}

/// An upper bound on the first derivative of B's surface, in differences of controls times the degree: the largest
/// coefficient of the derivative as a spline, each from the span in its support where it is the smallest.
fn steepest(sequence: &KnotSequence, ends_of_b: impl Fn(isize) -> [f64; 2]) -> f64 {
    let KnotSequence { degree, knots, spans, .. } = sequence;
    let mut steepest = 0.0_f64;
    for first in 1..sequence.coefficient_count() {
        let arguments = &knots[first + 1..first + degree];
        let mut slope = None;
        for index in (first..first + degree).filter(|&index| sequence.is_proper(index)) {
            let ends = ends_of_b(spans[index].1);
            let size = sums(arguments, |knot| knot.image, ends);
            take_smaller(&mut slope, (), size / (ends[1] - ends[0]).abs());
        }
        steepest = upper_max(steepest, slope.map_or(0.0, |(_, slope)| slope));
    }
    steepest
}

/// The local parameter of an argument in a span, and its complement.
fn local(argument: f64, [start, end]: [f64; 2]) -> [f64; 2] {
    let width = end - start;
    [(end - argument) / width, (argument - start) / width]
}

/// An upper bound, up to rounding, on the sum of the sizes of the weights.
fn sums(arguments: &[Knot], parameter: impl Fn(&Knot) -> f64, ends: [f64; 2]) -> f64 {
    arguments.iter().map(|knot| local(parameter(knot), ends).map(f64::abs).iter().sum::<f64>()).product()
}

/// Takes a span if it is the first or its size is smaller.
fn take_smaller<S>(best: &mut Option<(S, f64)>, span: S, size: f64) {
    if best.as_ref().is_none_or(|(_, least)| size < *least) {
        *best = Some((span, size));
    }
}

/// The weights of the controls of a span, of a degree that is not above the number of arguments, in the
/// blossom at these.
fn weights(
    arguments: &[Knot],
    parameter: impl Fn(&Knot) -> f64,
    ends: [f64; 2],
    degree: usize,
) -> [f64; MAX_ORDER] {
    let mut weights = [0.0; MAX_ORDER];
    weights[0] = 1.0;
    for (level, knot) in arguments.iter().enumerate() {
        let [complement, parameter] = local(parameter(knot), ends);
        for k in (1..=level + 1).rev() {
            weights[k] = complement * weights[k] + parameter * weights[k - 1];
        }
        weights[0] *= complement;
    }
    let to = arguments.len();
    if degree == to {
        return weights;
    }
    // Each control of the elevated polynomial is a mean of those of the polynomial.
    let mut lowered = [0.0; MAX_ORDER];
    for (l, k, share) in elevation_shares(degree, to) {
        lowered[l] += share * weights[k];
    }
    lowered
}
