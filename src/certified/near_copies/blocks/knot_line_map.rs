//! A map of A's knot lines to parameter lines of B.

use super::super::difference::SpanPart;
use super::super::orientation::Orientation;
use crate::axis::Axis;
use crate::certified::sheets::Chart;
use crate::closest::newton_below;
use glam::DVec3;

/// Bound on the Newton steps on one patch of B.
const MAX_ITERATIONS: u32 = 8;

/// The largest number of patches of B over which one foot is followed.
const MAX_MOVES: usize = 4;

/// The part of a span of A's knots below which its image beyond a knot line of B is left to
/// the neighbouring patch: the rounding of feet.
const SLIVER: f64 = 1e-7;

/// A point of a surface of B, by the parameters of a chart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) parameters: [f64; 2],
}

/// Finds feet on one surface of B, each from the place of one before.
pub(super) struct Walk<'a> {
    pub(super) chart: &'a Chart<'a>,
}

impl Walk<'_> {
    /// The foot near a place, over a few edges of patches. It need be neither the nearest
    /// nor stationary.
    pub(super) fn foot(&self, target: DVec3, start: Place) -> Place {
        let locate = |axis: Axis| self.chart.locate(axis, start.parameters[axis.index()]);
        let [mut s, mut t] = Axis::BOTH.map(locate);
        let mut nearest = f64::INFINITY;
        let mut place = start;
        for _ in 0..=MAX_MOVES {
            let patch = self.chart.neighbour([s.0, t.0]);
            let (foot, _) = newton_below(&patch, target, [s.1, t.1], MAX_ITERATIONS, f64::INFINITY);
            let is_nearer = foot.distance_squared < nearest;
            if !is_nearer {
                break;
            }
            nearest = foot.distance_squared;
            let [u, v] = foot.parameters;
            place = Place {
                parameters: [self.chart.parameter(Axis::U, s.0, u), self.chart.parameter(Axis::V, t.0, v)],
            };
            let [beyond_s, beyond_t] = [self.beyond(Axis::U, s.0, u), self.beyond(Axis::V, t.0, v)];
            if beyond_s.is_none() && beyond_t.is_none() {
                break;
            }
            s = beyond_s.unwrap_or((s.0, u));
            t = beyond_t.unwrap_or((t.0, v));
        }
        place
    }

    /// The patch beyond the edge on which a foot is, with the parameter there.
    fn beyond(&self, axis: Axis, offset: isize, local: f64) -> Option<(isize, f64)> {
        if local <= 0.0 && self.chart.is_joined(axis, offset) {
            Some((offset - 1, 1.0))
        } else if local >= 1.0 && self.chart.is_joined(axis, offset + 1) {
            Some((offset + 1, 0.0))
        } else {
            None
        }
    }
}

/// The parts of consecutive spans of A along an axis, cut at B's knot lines.
///
/// Knot line k of A is mapped to the parameter `images[k]` of the chart, and each span
/// affinely. A span has no parts where its image is empty or runs against `orientation`.
pub(super) fn parts(
    chart: &Chart<'_>,
    orientation: &Orientation,
    axis: Axis,
    images: &[f64],
) -> Vec<Vec<SpanPart>> {
    let on_b = orientation.axis_of_b(axis);
    let sign = if orientation.is_backwards(axis) { -1.0 } else { 1.0 };
    images.windows(2).map(|ends| parts_of_span(chart, on_b, sign, [ends[0], ends[1]])).collect()
}

fn parts_of_span(chart: &Chart<'_>, axis: Axis, sign: f64, [start, end]: [f64; 2]) -> Vec<SpanPart> {
    let length = sign * (end - start);
    let is_proper = length > 0.0;
    if !is_proper {
        return Vec::new();
    }
    let [low, high] = [start.min(end), start.max(end)];
    let sliver = SLIVER * length;
    let lines = chart.lines_between(axis, [low + sliver, high - sliver]);
    // From the patch that contains the low end.
    let first = (*lines.start()..*lines.end() - 1)
        .rev()
        .find(|&offset| chart.line(axis, offset) <= low + sliver)
        .unwrap_or(*lines.start());
    let mut parts = Vec::new();
    let mut covered = low;
    let mut offset = first;
    while covered < high && offset < *lines.end() {
        let line = chart.line(axis, offset + 1);
        let is_last = offset + 1 == *lines.end() || line >= high - sliver;
        let until = if is_last { high } else { line };
        if until > covered {
            let fraction = |parameter: f64| (parameter - low) / (high - low);
            let local = |parameter: f64| {
                ((parameter - chart.line(axis, offset)) / chart.width(axis, offset)).clamp(0.0, 1.0)
            };
            let (range, image) = ([covered, until].map(fraction), [covered, until].map(local));
            parts.push(SpanPart { range, offset, image });
            covered = until;
        }
        offset += 1;
    }
    if covered < high {
        return Vec::new();
    }
    if let Some(first) = parts.first_mut() {
        first.range[0] = 0.0;
    }
    if let Some(last) = parts.last_mut() {
        last.range[1] = 1.0;
    }
    if sign < 0.0 {
        for part in &mut parts {
            part.range = [1.0 - part.range[1], 1.0 - part.range[0]];
            part.image = [part.image[1], part.image[0]];
        }
        parts.reverse();
    }
    parts
}
