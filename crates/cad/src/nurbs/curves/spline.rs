//! Rational B-spline curves in homogeneous coordinates.

use glam::{DVec3, DVec4, Vec4Swizzles};
use nurbs_hausdorff::workspace::{MAX_FILE_DEGREE, binomial, blossom};

/// The distance of the ends of a closed curve or surface relative to its coordinates: the
/// tolerance of 1e-7 that OpenCASCADE allows, for parts of a few hundred units.
pub(in crate::nurbs) const CLOSED: f64 = 1e-9;

/// A rational B-spline curve `(w x, w y, w z, w)`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spline {
    pub(crate) degree: usize,
    pub(crate) knots: Vec<f64>,
    pub(crate) controls: Vec<DVec4>,
}

impl Spline {
    /// The segment from `start` to `end` over `range`.
    pub(crate) fn segment(range: [f64; 2], start: DVec3, end: DVec3) -> Self {
        let knots = vec![range[0], range[0], range[1], range[1]];
        Self { degree: 1, knots, controls: vec![start.extend(1.0), end.extend(1.0)] }
    }

    /// Returns the domain.
    pub(crate) fn domain(&self) -> [f64; 2] {
        [self.knots[self.degree], self.knots[self.controls.len()]]
    }

    /// Returns the index of the knot that begins the non-empty span of `parameter`.
    fn span(&self, parameter: f64) -> usize {
        span(&self.knots, self.degree, self.controls.len(), parameter)
    }

    /// Returns the point at a parameter. Beyond the domain the outer spans continue.
    pub(crate) fn point(&self, parameter: f64) -> DVec3 {
        project(self.homogeneous(parameter))
    }

    /// Returns the homogeneous point at a parameter, as [`Self::point`] does.
    pub(crate) fn homogeneous(&self, parameter: f64) -> DVec4 {
        self.blossom(self.span(parameter), |_| parameter)
    }

    /// Returns the derivative at a parameter.
    pub(crate) fn tangent(&self, parameter: f64) -> DVec3 {
        let span = self.span(parameter);
        let point = self.blossom(span, |_| parameter);
        // Any polar form with one argument moved by the span's length differs by 1 / degree
        // of the derivative times that length.
        let length = self.knots[span + 1] - self.knots[span];
        let moved = self.blossom(span, |argument| parameter + if argument == 0 { length } else { 0.0 });
        let slope = self.degree as f64 / length * (moved - point);
        (slope.xyz() - slope.w * project(point)) / point.w
    }

    /// Returns the homogeneous polar form of the polynomial of the span that begins with
    /// knot `span`, at degree arguments (L. Ramshaw, *Blossoming: a connect-the-dots
    /// approach to splines*). O(degree²).
    fn blossom(&self, span: usize, argument: impl Fn(usize) -> f64) -> DVec4 {
        let controls = &self.controls[span - self.degree..=span];
        blossom(&self.knots, self.degree, span, controls, argument)
    }

    /// Returns the same curve over clamped knots, which must contain every knot of
    /// this curve inside their domain with at least its multiplicity.
    ///
    /// A control point is the polar form, at the degree knots inside of its support, of
    /// the polynomial on any span of its support. O(controls degree²).
    pub(crate) fn with_knots(&self, knots: &[f64]) -> Self {
        let spans = support_spans(&self.knots, self.degree, self.controls.len(), knots);
        let control =
            |(index, &span): (usize, &usize)| self.blossom(span, |argument| knots[index + 1 + argument]);
        let controls = spans.iter().enumerate().map(control).collect();
        Self { degree: self.degree, knots: knots.to_vec(), controls }
    }

    /// Returns the curve traversed from its end to its start, over the same domain.
    pub(crate) fn reversed(mut self) -> Self {
        let [start, end] = self.domain();
        self.controls.reverse();
        self.knots.reverse();
        for knot in &mut self.knots {
            *knot = start + (end - *knot);
        }
        self
    }

    /// Returns the curve moved by `offset`.
    pub(crate) fn translated(mut self, offset: DVec3) -> Self {
        for control in &mut self.controls {
            *control += (control.w * offset).extend(0.0);
        }
        self
    }

    /// Returns the control points, not multiplied by their weights.
    pub(crate) fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.controls.iter().map(|&control| project(control))
    }

    /// Returns the first control point, where a clamped curve starts.
    pub(crate) fn start(&self) -> DVec3 {
        project(self.controls[0])
    }

    /// Returns the last control point, where a clamped curve ends.
    pub(crate) fn end(&self) -> DVec3 {
        project(self.controls[self.controls.len() - 1])
    }

    /// Returns the curve as Bézier pieces with their ranges, over the non-empty spans.
    pub(crate) fn pieces(&self) -> Vec<Self> {
        let spans = (self.degree..self.controls.len()).filter(|&i| self.knots[i] < self.knots[i + 1]);
        spans
            .map(|span| {
                let ends = [self.knots[span], self.knots[span + 1]];
                self.piece(span, ends)
            })
            .collect()
    }

    /// Returns the polynomial of a span over an interval as a Bézier piece.
    fn piece(&self, span: usize, [start, end]: [f64; 2]) -> Self {
        let degree = self.degree;
        let knots = [vec![start; degree + 1], vec![end; degree + 1]].concat();
        let control = |index| self.blossom(span, |argument| if argument < index { end } else { start });
        Self { degree, knots, controls: (0..=degree).map(control).collect() }
    }

    /// Returns the part of a Bézier piece over an interval.
    pub(crate) fn sub_piece(&self, interval: [f64; 2]) -> Self {
        self.piece(self.degree, interval)
    }
}

/// Turns the degree + 1 active control points of the span that begins with knot `span` into the
/// Taylor coefficients of its polynomial at a parameter.
///
/// De Boor's algorithm leaves the polar forms `e_j = b(at, …, at, k_1, …, k_j)` with the knots k
/// beside the span on one of its sides. Coefficient m is `binomial(degree, m)` times the polar
/// form with m arguments replaced by the unit vector; the differences
/// `(g_(j+1) - g_j) / (k_(j+1) - at)` replace one each, as polar forms are affine in every
/// argument (L. Ramshaw, *Blossoming: a connect-the-dots approach to splines*). The knots are
/// those of the farther side, so that no difference is divided by less than half of the span.
/// O(degree²).
pub(crate) fn taylor(knots: &[f64], degree: usize, span: usize, controls: &mut [DVec4], at: f64) {
    let is_right = knots[span + 1] - at >= at - knots[span];
    for level in 1..=degree {
        let moved = |low: DVec4, high: DVec4, index: usize| {
            let [start, end] = [knots[span - degree + level + index], knots[span + 1 + index]];
            let fraction = (at - start) / (end - start);
            (1.0 - fraction) * low + fraction * high
        };
        if is_right {
            for index in 0..=degree - level {
                controls[index] = moved(controls[index], controls[index + 1], index);
            }
        } else {
            for index in (level..=degree).rev() {
                controls[index] = moved(controls[index - 1], controls[index], index - level);
            }
        }
    }
    if !is_right {
        controls.reverse();
    }
    let beside = |j: usize| knots[if is_right { span + j } else { span + 1 - j }];
    for order in 0..degree {
        for j in (1..=degree - order).rev() {
            controls[order + j] = (controls[order + j] - controls[order + j - 1]) / (beside(j) - at);
        }
    }
    for (order, control) in controls.iter_mut().enumerate() {
        *control *= binomial(degree, order);
    }
}

/// Returns the point of homogeneous coordinates.
pub(crate) fn project(point: DVec4) -> DVec3 {
    point.xyz() / point.w
}

/// Returns the index of the knot that begins the non-empty span of `parameter`, or the
/// outer span that is nearest to it.
pub(crate) fn span(knots: &[f64], degree: usize, count: usize, parameter: f64) -> usize {
    let mut span = knots[..count].partition_point(|&knot| knot <= parameter).max(degree + 1) - 1;
    while span > degree && knots[span] == knots[span + 1] {
        span -= 1;
    }
    while span + 1 < count && knots[span] == knots[span + 1] {
        span += 1;
    }
    span
}

/// Returns the point of a tensor product surface with these control points.
pub(crate) fn tensor_point(
    [p, q]: [usize; 2],
    [knots_u, knots_v]: [&[f64]; 2],
    [u, v]: [f64; 2],
    control: impl Fn(usize, usize) -> DVec4,
) -> DVec3 {
    let row = span(knots_u, p, knots_u.len() - p - 1, u);
    let column = span(knots_v, q, knots_v.len() - q - 1, v);
    match p.max(q) {
        0..=3 => tensor_within::<4>([p, q], [knots_u, knots_v], [row, column], [u, v], control),
        4..=7 => tensor_within::<8>([p, q], [knots_u, knots_v], [row, column], [u, v], control),
        _ => tensor_within::<MAX_ORDER>([p, q], [knots_u, knots_v], [row, column], [u, v], control),
    }
}

/// [`tensor_point`] in these spans, for degrees below N.
fn tensor_within<const N: usize>(
    [p, q]: [usize; 2],
    [knots_u, knots_v]: [&[f64]; 2],
    [row, column]: [usize; 2],
    [u, v]: [f64; 2],
    control: impl Fn(usize, usize) -> DVec4,
) -> DVec3 {
    let mut across = [DVec4::ZERO; N];
    let mut along = [DVec4::ZERO; N];
    for (i, point) in across[..=p].iter_mut().enumerate() {
        for (j, value) in along[..=q].iter_mut().enumerate() {
            *value = control(row - p + i, column - q + j);
        }
        *point = blossom(knots_v, q, column, &along[..=q], |_| v);
    }
    project(blossom(knots_u, p, row, &across[..=p], |_| u))
}

/// The largest number of control points of a span.
const MAX_ORDER: usize = MAX_FILE_DEGREE + 1;

/// Returns, for every control point over the new clamped knots, the span of the old
/// knots whose polynomial gives it.
pub(crate) fn support_spans(old: &[f64], degree: usize, count: usize, new: &[f64]) -> Vec<usize> {
    let new_count = new.len() - degree - 1;
    (0..new_count)
        .map(|index| {
            let support = index.max(degree)..=(index + degree).min(new_count - 1);
            // Of the spans of the support the widest, whose middle rounding cannot move out.
            let widest = support.max_by(|&a, &b| (new[a + 1] - new[a]).total_cmp(&(new[b + 1] - new[b])));
            let widest = widest.unwrap_or(degree);
            span(old, degree, count, 0.5 * (new[widest] + new[widest + 1]))
        })
        .collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn taylor_coefficients_are_those_of_the_span_on_both_of_its_halves_and_beyond() {
        let knots = [0.0, 0.0, 0.5, 1.0, 2.0, 2.0, 3.0, 4.5, 5.0, 6.0];
        let controls = [[1.0, 2.0], [-1.0, 3.0], [0.5, 1.0], [2.0, 4.0], [3.0, 2.0], [0.0, 1.0]]
            .map(|[x, w]| DVec4::new(x, x * x, 1.0 - x, w));
        for (degree, span) in [(3, 3), (3, 5), (2, 5), (1, 3), (4, 5)] {
            let [start, end] = [knots[span], knots[span + 1]];
            let active = &controls[span - degree..=span];
            for at in [0.0, 0.1, 0.5, 0.9, 1.0, 1.5, -0.5].map(|x| start + x * (end - start)) {
                let mut orders = active.to_vec();
                taylor(&knots, degree, span, &mut orders, at);
                for moved in [0.0, 0.3, -0.7] {
                    let found = orders.iter().rev().fold(DVec4::ZERO, |sum, &order| moved * sum + order);
                    let expected = blossom(&knots, degree, span, active, |_| at + moved);
                    assert!((found - expected).length() < 1e-12, "{degree} {span} {at} {found} {expected}");
                }
            }
        }
    }
}
