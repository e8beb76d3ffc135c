//! The polynomial difference over several patches of B.
//!
//! A map may be another one on every piece of a cell, as it need not be
//! continuous: the pieces only have to cover the cell. So where the image of a
//! cell runs over knot lines of B, the cell is cut along them, and each piece is
//! compared with the patch that it is mapped to.

use super::super::CellContext;
use super::aligned_map::Orientation;
use super::net::Net;
use crate::axis::Axis;
use crate::certified::reparametrization::Reparametrization;
use crate::certified::sheets::Chart;
use glam::Vec4Swizzles;

/// The largest number of pieces of a cell.
const MAX_PIECES: usize = 256;

/// The largest component of a map across B's parameter lines, relative to the one
/// along them, that is left out.
const MAX_SKEW: f64 = 0.05;

/// A part of a range of A's parameter, and the patch of B, by its offset, and the
/// range of its parameter that the part is mapped to.
struct Part {
    range: [f64; 2],
    offset: isize,
    image: [f64; 2],
}

/// The bound by a map along the parameter lines of B's surface; `None` where there is no
/// such map or a point of a piece is farther from its image than the threshold.
pub(super) fn upper_bound(context: &CellContext<'_>, threshold: f64) -> Option<f64> {
    let foot = context.foot();
    let chart = Chart::new(context.pair.b.sheets?, foot.patch, foot.parameters);
    let jet = chart.jet();
    let (a, [h, k]) = (&context.jet, context.cell.half);
    let map = Reparametrization::linearized(&jet, jet.point - a.point, [h * a.s, k * a.t], [false; 2])?;
    let orientation = Orientation::new(&map);
    let across = orientation.across(&map).abs().max_element();
    let along = orientation.along(&map);
    if !(across <= MAX_SKEW * along[0].abs().min(along[1].abs())) {
        return None;
    }
    let parts = Axis::BOTH.map(|axis| parts(context, &chart, &orientation, along[axis.index()], axis));
    let [parts_s, parts_t] = parts;
    let (parts_s, parts_t) = (parts_s?, parts_t?);
    if parts_s.len() * parts_t.len() > MAX_PIECES {
        return None;
    }
    let chart = &chart;
    let mut pieces = Vec::with_capacity(parts_s.len() * parts_t.len());
    for s in &parts_s {
        for t in &parts_t {
            pieces.push(Piece { context, chart, orientation, parts: [s, t] });
        }
    }
    if pieces.iter().any(|piece| !(piece.distance_of_middle() <= threshold)) {
        return None;
    }
    let mut largest = 0.0_f64;
    for piece in &pieces {
        let bound = piece.upper_bound()?;
        if !(bound <= threshold) {
            return None;
        }
        largest = largest.max(bound);
    }
    Some(largest)
}

/// The parts of the cell's range along an axis of A; `None` where the image leaves B's surface.
fn parts(
    context: &CellContext<'_>,
    chart: &Chart<'_>,
    orientation: &Orientation,
    along: f64,
    axis: Axis,
) -> Option<Vec<Part>> {
    let on_b = if orientation.swapped { axis.other() } else { axis };
    let foot = chart.parameters[on_b];
    let index = axis.index();
    let (center, half) = (context.cell.center[index], context.cell.half[index]);
    let [start, end] = context.cell.ranges()[index];
    let lines = chart.lines_between(on_b, [foot - along.abs(), foot + along.abs()])?;
    let (first, last) = (*lines.start(), *lines.end());
    let at = |line: isize| center + half * (chart.line(on_b, line) - foot) / along;
    let mut parts = Vec::with_capacity((last - first) as usize);
    let mut low = start;
    // In the order of A's parameter.
    let count = last - first;
    for step in 0..count {
        let (offset, next) =
            if along > 0.0 { (first + step, first + step + 1) } else { (last - step - 1, last - step - 1) };
        let high = if step + 1 == count { end } else { at(next).clamp(low, end) };
        if high > low {
            let image = [low, high].map(|parameter| {
                let on_chart = foot + along * ((parameter - center) / half);
                ((on_chart - chart.line(on_b, offset)) / chart.width(on_b, offset)).clamp(0.0, 1.0)
            });
            parts.push(Part { range: [low, high], offset, image });
        }
        low = high;
    }
    Some(parts)
}

/// A piece of the cell.
struct Piece<'a> {
    context: &'a CellContext<'a>,
    chart: &'a Chart<'a>,
    orientation: Orientation,
    parts: [&'a Part; 2],
}

impl Piece<'_> {
    /// The pair for B's axes, from that for A's.
    fn by_axes_of_b<T: Copy>(&self, [s, t]: [T; 2]) -> [T; 2] {
        if self.orientation.swapped { [t, s] } else { [s, t] }
    }

    /// The distance of the piece's middle from its image.
    fn distance_of_middle(&self) -> f64 {
        let middle = |[low, high]: [f64; 2]| 0.5 * (low + high);
        let from = self.parts.map(|part| middle(part.range));
        let to = self.by_axes_of_b(self.parts.map(|part| middle(part.image)));
        let patch = self.chart.neighbour(self.by_axes_of_b(self.parts.map(|part| part.offset)));
        self.context.pair.point_of_a(self.context.cell.patch, from).distance(patch.point(to))
    }

    /// An upper bound on the distance of the piece's points from their images.
    fn upper_bound(&self) -> Option<f64> {
        let (context, pair) = (self.context, self.context.pair);
        let patch = self.chart.neighbour(self.by_axes_of_b(self.parts.map(|part| part.offset)));
        let images = self.by_axes_of_b(self.parts.map(|part| part.image));
        // An axis along which B's patch is followed backwards.
        let ascending = images.map(|[start, end]| [start.min(end), start.max(end)]);
        if ascending.iter().any(|[start, end]| !(start < end)) {
            return None;
        }
        let controls = self.orientation.oriented(&patch.restricted(ascending[0], ascending[1]), patch.degree);
        let degree = self.by_axes_of_b(patch.degree);
        let origin = context.jet.point;
        let y = Net::new(degree, &controls, origin - patch.center, 1.0);
        let [s, t] = self.parts.map(|part| part.range);
        let mut controls = context.patch.restricted(s, t);
        for control in &mut controls {
            *control = pair.transform.rotate(control.xyz()).extend(control.w);
        }
        let center = pair.transform.apply(context.patch.center);
        Net::new(context.patch.degree, &controls, origin - center, 1.0).max_difference(&y)
    }
}
