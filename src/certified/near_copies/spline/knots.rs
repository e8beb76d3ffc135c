//! The knots of the difference of two surfaces along an axis.

use crate::axis::Axis;
use crate::certified::rounding::UNIT_ROUNDOFF;
use crate::certified::sheets::Chart;
use crate::rounding::upper_max;

/// The part of the image of a block up to which a line of A and one of B count as one.
const MAX_GAP: f64 = 1e-12;

/// The largest number of lines of B that are crossed along an axis.
const MAX_LINES: usize = 1024;

/// Roundings of the image of a parameter, and of the map's slope, relative to the sizes of the images of both ends.
const MAP_ROUNDINGS: f64 = 8.0;

/// An axis of a block with its affine map to an axis of a surface of B.
pub(super) struct AxisMap<'a> {
    pub(super) chart: &'a Chart<'a>,
    /// The axis of B.
    pub(super) on_b: Axis,
    /// The degrees of A and of B along it.
    pub(super) degrees: [usize; 2],
    /// The block's knots of A with their multiplicities.
    pub(super) breaks: &'a [f64],
    pub(super) multiplicities: &'a [u8],
    /// The parameters of the chart to which the block's first and last knot are mapped.
    pub(super) images: [f64; 2],
}

/// A knot of the difference by the parameter of A, which is exact, and by the chart's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Knot {
    pub(super) parameter: f64,
    pub(super) image: f64,
}

/// The spans of A, counted from the block's first, and of B, by its offset, after a knot.
pub(super) type Spans = (usize, isize);

/// The knots of a block's difference along an axis, each as often as it is repeated.
pub(super) struct KnotSequence {
    /// The degree of the difference.
    pub(super) degree: usize,
    pub(super) knots: Vec<Knot>,
    /// The spans that follow each knot.
    pub(super) spans: Vec<Spans>,
    /// An upper bound on the distance, in the chart's parameters, of the images from those by the map.
    pub(super) error: f64,
}

impl KnotSequence {
    /// The union of A's knots in the block with B's in its image; `None` where the image is empty or
    /// leaves B's surface. O(knots).
    pub(super) fn new(map: &AxisMap<'_>) -> Option<Self> {
        let &AxisMap { chart, on_b, degrees, breaks, images: [from, to], .. } = map;
        let [start, end] = [breaks[0], breaks[breaks.len() - 1]];
        let slope = (to - from) / (end - start);
        if !(slope.is_finite() && slope != 0.0) {
            return None;
        }
        let image = |parameter: f64| from + slope * (parameter - start);
        let gap = MAX_GAP * (to - from).abs();
        let lines = inner_lines(chart, on_b, [from.min(to), from.max(to)], gap)?;
        // Errors grow with the distance from the chart's own span.
        let ends = [lines.start - 1, lines.start, lines.end - 1, lines.end];
        let line_error = ends.map(|line| chart.line_error(on_b, line)).into_iter().fold(0.0, upper_max);
        let rounding = MAP_ROUNDINGS * UNIT_ROUNDOFF * (from.abs() + to.abs());
        let degree = degrees[0].max(degrees[1]);
        let mut sequence = Self { degree, knots: Vec::new(), spans: Vec::new(), error: 0.0 };
        let forwards = slope > 0.0;
        let mut spans: Spans = (0, if forwards { lines.start - 1 } else { lines.end - 1 });
        sequence.append(Knot { parameter: start, image: from }, degree + 1, spans);
        let mut largest_gap = lines.overhang;
        let (mut inner, mut ahead) = (1, lines.end - lines.start);
        loop {
            // The next lines, if there are any.
            let of_b = (ahead > 0).then(|| {
                let line = if forwards { spans.1 + 1 } else { spans.1 };
                (chart.line(on_b, line), chart.multiplicity(on_b, line) + degree - degrees[1])
            });
            let of_a = (inner + 1 < breaks.len())
                .then(|| (breaks[inner], usize::from(map.multiplicities[inner]) + degree - degrees[0]));
            let is_one = |x: f64, y: f64| (image(x) - y).abs() <= gap;
            let is_a_first = |x: f64, y: f64| if forwards { image(x) < y } else { image(x) > y };
            let (knot, multiplicity, passed) = match (of_a, of_b) {
                (None, None) => break,
                (Some((x, m)), Some((y, n))) if is_one(x, y) => {
                    (Knot { parameter: x, image: y }, m.max(n), [true; 2])
                }
                (Some((x, m)), Some((y, _))) if is_a_first(x, y) => {
                    (Knot { parameter: x, image: image(x) }, m, [true, false])
                }
                (Some((x, m)), None) => (Knot { parameter: x, image: image(x) }, m, [true, false]),
                (_, Some((y, n))) => {
                    let parameter = start + (y - from) / slope;
                    // Between the neighbouring knots however it is rounded.
                    let last = sequence.knots[sequence.knots.len() - 1].parameter;
                    let next = of_a.map_or(end, |(x, _)| x);
                    (Knot { parameter: parameter.max(last).min(next), image: y }, n, [false, true])
                }
            };
            if passed[0] {
                inner += 1;
                spans.0 += 1;
            }
            if passed[1] {
                ahead -= 1;
                spans.1 += if forwards { 1 } else { -1 };
            }
            largest_gap = upper_max(largest_gap, (image(knot.parameter) - knot.image).abs());
            sequence.append(knot, multiplicity, spans);
        }
        sequence.append(Knot { parameter: end, image: to }, degree + 1, spans);
        sequence.error = largest_gap + line_error + rounding;
        Some(sequence)
    }

    fn append(&mut self, knot: Knot, multiplicity: usize, spans: Spans) {
        self.knots.extend(std::iter::repeat_n(knot, multiplicity));
        self.spans.extend(std::iter::repeat_n(spans, multiplicity));
    }

    /// The number of B-spline coefficients.
    pub(super) fn coefficient_count(&self) -> usize {
        self.knots.len() - self.degree - 1
    }

    /// Whether the interval after a knot is not empty.
    pub(super) fn is_proper(&self, index: usize) -> bool {
        self.knots[index].parameter < self.knots[index + 1].parameter
    }
}

/// The lines of B inside an image.
struct InnerLines {
    start: isize,
    end: isize,
    /// How far the image leaves the spans about these lines.
    overhang: f64,
}

/// Finds the lines more than `gap` inside an image; `None` where the image leaves the surface by
/// more than that.
fn inner_lines(chart: &Chart<'_>, axis: Axis, [low, high]: [f64; 2], gap: f64) -> Option<InnerLines> {
    // The first line that is inside, and the end of the lines that are.
    let mut start = 1;
    for _ in 0..MAX_LINES {
        if chart.line(axis, start) <= low + gap {
            start += 1;
        } else if chart.line(axis, start - 1) > low + gap && chart.is_joined(axis, start - 1) {
            start -= 1;
        } else {
            break;
        }
    }
    let mut end = start;
    for _ in 0..MAX_LINES {
        if chart.line(axis, end) < high - gap && chart.is_joined(axis, end) {
            end += 1;
        } else {
            break;
        }
    }
    // Lines that have been passed must join.
    let is_joined = (1..start).all(|line| chart.is_joined(axis, line));
    let overhang = upper_max(chart.line(axis, start - 1) - low, high - chart.line(axis, end));
    // The limit on lines may have ended either loop before the image does.
    let is_covered = chart.line(axis, start) > low + gap && chart.line(axis, end) >= high - gap;
    (is_joined && is_covered && overhang <= gap).then(|| InnerLines {
        start,
        end,
        overhang: upper_max(0.0, overhang),
    })
}
