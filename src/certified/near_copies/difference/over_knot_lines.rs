//! The polynomial difference over several patches of B.
//!
//! A map may be another one on every piece of a cell, as it need not be
//! continuous: the pieces only have to cover the cell. So where the image of a
//! cell runs over knot lines of B, the cell is cut along them, and each piece is
//! compared with the patch that it is mapped to.

use super::super::orientation::Orientation;
use super::aligned_map::AlignedMap;
use super::piece::SpanPart;
use super::strip::{Comparison, RestrictedPart};
use crate::axis::Axis;
use crate::bezier::Jet;
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use crate::certified::nearest::Foot;
use crate::certified::reparametrization::Reparametrization;
use crate::certified::sheets::Chart;
use crate::rounding::upper_max;
use crate::sorting::sort_by_number;

/// The largest number of pieces of a rectangle along one surface of B.
const MAX_PIECES: usize = 256;

/// The largest component of a map across B's parameter lines, relative to the one
/// along them, that is left out.
const MAX_SKEW: f64 = 0.05;

/// Distance of the centre's foot, in radii of the cell, up to which the bound is
/// tried: it is for near copies and offsets by little.
const MAX_DISTANCE_IN_RADII: f64 = 0.5;

/// The part of a range below which a range beyond an end of a surface is left to
/// the surface: the map's rounding.
const SLIVER: f64 = 1e-9;

/// How often a part of a cell that is mapped beyond an end of one surface of B may be
/// mapped to another one: twice along either axis.
const MAX_SURFACES_CROSSED: usize = 4;

/// The bound by maps along the parameter lines of B's surfaces.
pub(in crate::certified) struct DifferenceOverKnotLines;

impl UpperBound for DifferenceOverKnotLines {
    fn lemma(&self) -> Lemma {
        Lemma::DifferenceOverKnotLines
    }

    /// `None` where there are no such maps, where one patch of B suffices, or where a point of a piece is
    /// farther from its image than the threshold.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let foot = context.foot();
        let is_near = foot.distance_squared <= threshold * threshold
            && foot.distance() <= MAX_DISTANCE_IN_RADII * context.radius;
        if !is_near || AlignedMap::new(context).is_some() {
            return None;
        }
        let rectangle = Rectangle { context, ranges: context.cell.ranges(), jet: context.jet, foot };
        rectangle.upper_bound(threshold, MAX_SURFACES_CROSSED)
    }
}

/// A rectangle of the cell with a foot of its centre.
struct Rectangle<'a> {
    context: &'a CellContext<'a>,
    ranges: [[f64; 2]; 2],
    /// A's moved jet at the centre.
    jet: Jet,
    foot: Foot,
}

impl Rectangle<'_> {
    fn upper_bound(&self, threshold: f64, crossings: usize) -> Option<f64> {
        let context = self.context;
        let chart = Chart::new(context.pair.b.sheets?, self.foot.patch, self.foot.parameters);
        let jet = chart.jet();
        let [h, k] = self.ranges.map(|[start, end]| 0.5 * (end - start));
        let tangents = [h * self.jet.s, k * self.jet.t];
        let map = Reparametrization::linearized(&jet, jet.point - self.jet.point, tangents, [false; 2])?;
        let orientation = Orientation::new(&map);
        let across = orientation.across(&map).abs().max_element();
        let along = orientation.along(&map);
        // False for NaN, as all conditions here.
        let is_aligned = across <= MAX_SKEW * along[0].abs().min(along[1].abs());
        if !is_aligned {
            return None;
        }
        let [(parts_s, rest_s), (parts_t, rest_t)] =
            Axis::BOTH.map(|axis| self.parts(&chart, &orientation, along[axis.index()], axis));
        let is_whole = rest_s.is_empty() && rest_t.is_empty();
        let count = parts_s.len() * parts_t.len();
        if count == 0 || count > MAX_PIECES || (!is_whole && crossings == 0) {
            return None;
        }
        // As many cells of the size that Lipschitz continuity decides are cheaper.
        let margin = threshold - self.foot.distance();
        if count as f64 * margin * margin > context.radius * context.radius {
            return None;
        }
        let comparison = Comparison::new(context.pair, context.patch, &chart, orientation);
        let inner = [parts_s[0].range[0], parts_s[parts_s.len() - 1].range[1]];
        let parts = [(Axis::U, parts_s), (Axis::V, parts_t)].map(|(axis, parts)| {
            let restricted = |part| comparison.restricted(axis, part);
            parts.into_iter().map(restricted).collect::<Vec<RestrictedPart>>()
        });
        let first = comparison.first_axis(parts.each_ref().map(Vec::len));
        let others = &parts[first.other()];
        let mut strips = Vec::with_capacity(parts[first].len());
        for part in &parts[first] {
            let mut farthest = 0.0_f64;
            for other in others {
                let mut pair = [part.part(); 2];
                pair[first.other()] = other.part();
                let distance = comparison.piece(context.patch, pair).distance_of_middle(threshold);
                let is_near = distance <= threshold;
                if !is_near {
                    return None;
                }
                farthest = upper_max(farthest, distance);
            }
            strips.push((farthest, part));
        }
        // The farthest first: it is the likeliest to exceed the threshold.
        sort_by_number(&mut strips, |&(farthest, _)| -farthest);
        let net = comparison.net_of_a(context.patch);
        let mut largest = 0.0_f64;
        for (_, part) in strips {
            let bound = comparison.strip(part).upper_bound(context.patch, &net, others, threshold, false)?;
            largest = upper_max(largest, bound);
        }
        // Along s over the whole range of t; along t over what is left of s.
        let beyond_s = rest_s.into_iter().map(|range| [range, self.ranges[1]]);
        let beyond_t = rest_t.into_iter().map(|range| [inner, range]);
        for ranges in beyond_s.chain(beyond_t) {
            largest = upper_max(largest, self.at(ranges).upper_bound(threshold, crossings - 1)?);
        }
        Some(largest)
    }

    /// Another rectangle of the cell, with the nearest foot.
    fn at(&self, ranges: [[f64; 2]; 2]) -> Self {
        let Self { context, foot, .. } = self;
        let center = ranges.map(|[start, end]| 0.5 * (start + end));
        let jet = context.pair.jet_of_a(context.cell.patch, center);
        let start = Foot::start(foot.patch, foot.parameters);
        Self { context, ranges, jet, foot: context.nearest.nearest(jet.point, start, 0.0) }
    }

    /// The parts of the range along an axis of A that are mapped to patches of the
    /// surface, and the ranges that are mapped beyond its ends.
    fn parts(
        &self,
        chart: &Chart<'_>,
        orientation: &Orientation,
        along: f64,
        axis: Axis,
    ) -> (Vec<SpanPart>, Vec<[f64; 2]>) {
        let on_b = orientation.axis_of_b(axis);
        let foot = chart.parameters[on_b];
        let [start, end] = self.ranges[axis.index()];
        let (center, half) = (0.5 * (start + end), 0.5 * (end - start));
        let reached = chart.lines_between(on_b, [foot - along.abs(), foot + along.abs()]);
        let (first, last) = (*reached.start(), *reached.end());
        let at = |line: isize| {
            let parameter = center + half * (chart.line(on_b, line) - foot) / along;
            let is_end = (parameter - start).abs().min((parameter - end).abs()) <= SLIVER * half;
            if is_end { if parameter < center { start } else { end } } else { parameter.clamp(start, end) }
        };
        let count = last - first;
        let mut parts = Vec::with_capacity(count as usize);
        // In the order of A's parameter.
        let forwards = along > 0.0;
        let (lower, upper) = if forwards { (at(first), at(last)) } else { (at(last), at(first)) };
        let mut low = lower;
        for step in 0..count {
            let offset = if forwards { first + step } else { last - step - 1 };
            let next = if forwards { offset + 1 } else { offset };
            let high = if step + 1 == count { upper } else { at(next).clamp(low, upper) };
            if high > low {
                let image = [low, high].map(|parameter| {
                    let on_chart = foot + along * ((parameter - center) / half);
                    ((on_chart - chart.line(on_b, offset)) / chart.width(on_b, offset)).clamp(0.0, 1.0)
                });
                parts.push(SpanPart { range: [low, high], offset, image });
            }
            low = high;
        }
        let rest = [[start, lower], [upper, end]].into_iter().filter(|[low, high]| low < high);
        (parts, rest.collect())
    }
}
