//! The polynomial difference over the patches of a block of A.
//!
//! One affine map of the block to a surface of B bounds most patches by the coefficients of a spline. One map
//! of all of A's knot lines to parameter lines of B serves those that are left, which are then decided one
//! by one: their pieces are compared with the patches of B that they are mapped to.

use super::aligned_map::Orientation;
use super::knot_line_map::{Place, Walk, parts};
use super::piece::Part;
use super::spline::BlockMap;
use super::strip::{Comparison, RestrictedPart};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::certified::nearest::{Foot, NearestPoint, Query, Sample};
use crate::certified::reparametrization::Reparametrization;
use crate::certified::sheets::{Chart, Sheets};
use crate::certified::{Block, Pair};
use crate::rounding::upper_max;
use glam::DVec2;

/// The largest number of pieces of one patch of A.
const MAX_PIECES: usize = 256;

/// Distance of the sample's foot, in radii of the block, up to which a map is tried: farther
/// away smaller blocks or their cells are decided by bounds of the distance alone.
const MAX_DISTANCE_IN_RADII: f64 = 0.5;

/// The decided bound and the undecided patches of a block.
pub(in crate::certified) struct BlockBound {
    /// An upper bound on the distance of the patches that are decided.
    pub(in crate::certified) decided: f64,
    /// The undecided patches of the block, v fastest: no bound of theirs is at most the threshold.
    pub(in crate::certified) undecided: Vec<bool>,
    /// A point in the middle of the block with its foot.
    pub(in crate::certified) sample: Sample,
    /// Of the undecided patches' middles about the farthest, with its foot.
    pub(in crate::certified) farthest: Sample,
}

/// What maps of a block decide.
struct Decided {
    /// The largest bound of the patches that are decided.
    largest: f64,
    undecided: Vec<bool>,
    /// Of the middles of pieces of undecided patches about the farthest.
    farthest: Option<Sample>,
}

/// Bounds the patches of a block of A's sheets by one map. O(patches p q) where a spline decides them, else
/// O(patches p² q²), for patches of B as large as A's.
pub(in crate::certified) fn block(
    pair: &Pair<'_>,
    sheets: Sheets<'_>,
    nearest: &NearestPoint<'_>,
    block: &Block,
    known: &Foot,
    threshold: f64,
) -> BlockBound {
    let [rows, columns] = block.size();
    let middle = [block.rows[0] + rows / 2, block.columns[0] + columns / 2];
    let flat = sheets.flat_patches(sheets.index(block.surface, middle)).start;
    let parameters = [0.5; 2];
    let target = pair.point_of_a(flat, parameters);
    let known = nearest.at(target, known.patch, known.parameters);
    let foot = nearest.near(&Query { target, known, sufficient: 0.0 }).nearest();
    let sample = Sample { patch: flat, parameters, foot };
    let is_near = foot.distance() <= threshold;
    let decided = if is_near { decided(pair, sheets, block, middle, &sample, threshold) } else { None };
    let Some(Decided { largest, undecided, farthest }) = decided else {
        let undecided = vec![true; (rows * columns) as usize];
        return BlockBound { decided: 0.0, undecided, sample, farthest: sample };
    };
    let farthest = farthest.map_or(sample, |Sample { patch, parameters, foot }| {
        let target = pair.point_of_a(patch, parameters);
        Sample { patch, parameters, foot: nearest.on_patch(target, foot.patch, foot.parameters) }
    });
    BlockBound { decided: largest, undecided, sample, farthest }
}

/// What maps of a block decide; `None` where B has no map.
fn decided(
    pair: &Pair<'_>,
    sheets: Sheets<'_>,
    block: &Block,
    middle: [u32; 2],
    sample: &Sample,
    threshold: f64,
) -> Option<Decided> {
    let chart = Chart::new(pair.b.sheets?, sample.foot.patch, sample.foot.parameters);
    let lines = KnotLines { pair, sheets, block, middle, sample, chart: &chart };
    let linearization = lines.linearized()?;
    let orientation = linearization.orientation;
    let ends = Axis::BOTH.map(|axis| lines.ends(axis, &linearization));
    let map = BlockMap { pair, sheets, block, chart: &chart, orientation, images: ends };
    let by_spline = map.upper_bounds().unwrap_or_default();
    // Of the patches that the spline decides.
    let decided_bound = |index: usize| by_spline.get(index).copied().filter(|bound| *bound <= threshold);
    let [rows, columns] = block.size().map(|count| count as usize);
    if (0..rows * columns).all(|index| decided_bound(index).is_some()) {
        let largest = by_spline.into_iter().fold(0.0, upper_max);
        return Some(Decided { largest, undecided: vec![false; rows * columns], farthest: None });
    }
    let comparison = Comparison::new(pair, lines.patch(middle), &chart, orientation);
    let parts: [Vec<Vec<RestrictedPart>>; 2] = Axis::BOTH.map(|axis| {
        let spans = parts(&chart, &orientation, axis, &lines.images(axis, &linearization));
        let restricted = |part| comparison.restricted(axis, part);
        spans.into_iter().map(|span| span.into_iter().map(restricted).collect()).collect()
    });
    let first = comparison.first_axis(parts.each_ref().map(|spans| spans.iter().map(Vec::len).sum()));
    let mut bounds = Vec::with_capacity(rows * columns);
    for s in &parts[0] {
        for t in &parts[1] {
            let count = s.len() * t.len();
            let by_pieces = (1..=MAX_PIECES).contains(&count).then_some(0.0_f64);
            bounds.push(decided_bound(bounds.len()).or(by_pieces));
        }
    }
    let mut was_decided = true;
    for (index, span) in parts[first].iter().enumerate() {
        for part in span {
            let mut strip = comparison.strip(part);
            for (other_index, others) in parts[first.other()].iter().enumerate() {
                let mut place = [index; 2];
                place[first.other()] = other_index;
                let index = place[0] * columns + place[1];
                if decided_bound(index).is_some() {
                    continue;
                }
                let bound = &mut bounds[index];
                if let Some(largest) = *bound {
                    let patch = lines.patch(lines.indices(place));
                    let of_strip = strip.upper_bound(
                        patch,
                        &comparison.net_of_a(patch),
                        others,
                        threshold,
                        !was_decided,
                    );
                    *bound = of_strip.map(|of_strip| upper_max(largest, of_strip));
                    was_decided = bound.is_some();
                }
            }
        }
    }
    let undecided: Vec<bool> = bounds.iter().map(Option::is_none).collect();
    let mut farthest = (0.0, None);
    for (place, _) in undecided.iter().enumerate().filter(|(_, is_undecided)| **is_undecided) {
        let places = [place / columns, place % columns];
        let [row, column] = lines.indices(places);
        let patch = lines.patch([row, column]);
        if let [Some(s), Some(t)] = Axis::BOTH.map(|axis| middle_part(&parts[axis][places[axis]]))
            && let piece = comparison.piece(patch, [s, t])
            && let distance = piece.distance_of_middle(0.0)
            && distance > farthest.0
            && let (from, Some(image)) = piece.middle_with_image()
            && let Some((flat, parameters)) =
                sheets.flat_place(sheets.index(block.surface, [row, column]), from)
        {
            let foot = Foot::start(image.0, image.1);
            farthest = (distance, Some(Sample { patch: flat, parameters, foot }));
        }
    }
    let largest = bounds.iter().flatten().copied().fold(0.0, upper_max);
    Some(Decided { largest, undecided, farthest: farthest.1 })
}

/// The part in the middle of those of a span.
fn middle_part(parts: &[RestrictedPart]) -> Option<&Part> {
    parts.get(parts.len() / 2).map(RestrictedPart::part)
}

/// The knot lines of A through a block.
struct KnotLines<'a> {
    pair: &'a Pair<'a>,
    sheets: Sheets<'a>,
    block: &'a Block,
    /// The row and the column of the patch of the sample.
    middle: [u32; 2],
    sample: &'a Sample,
    chart: &'a Chart<'a>,
}

impl<'a> KnotLines<'a> {
    fn patch(&self, place: [u32; 2]) -> Patch<'a> {
        self.sheets.patch(self.block.surface, place)
    }

    /// The indices in the surface of the patch at this place in the block.
    fn indices(&self, [row, column]: [usize; 2]) -> [u32; 2] {
        [self.block.rows[0] + row as u32, self.block.columns[0] + column as u32]
    }

    /// How A's axes correspond to B's at the sample, if they do.
    fn linearized(&self) -> Option<Linearization> {
        let Sample { patch, parameters, .. } = *self.sample;
        let place = self.sheets.places.get(patch);
        let at = [0, 1].map(|axis| place.low[axis] + place.width[axis] * parameters[axis]);
        let a = self.patch(self.middle).jet(at);
        let rotate = |vector| self.pair.transform.rotate(vector);
        // The block's half sides if its patches are like the sample's.
        let [rows, columns] = self.block.size().map(|count| 0.5 * f64::from(count));
        let radius = rows * a.s.length() + columns * a.t.length();
        if self.sample.foot.distance() > MAX_DISTANCE_IN_RADII * radius {
            return None;
        }
        let jet = self.chart.jet();
        let residual = jet.point - self.pair.transform.apply(a.point);
        let map = Reparametrization::linearized(&jet, residual, [rotate(a.s), rotate(a.t)], [false; 2])?;
        Some(Linearization { at, orientation: Orientation::new(&map), map })
    }

    /// The parameters of the chart to which the block's first and last lines across an axis are
    /// mapped, by the feet of points on them.
    fn ends(&self, axis: Axis, linearization: &Linearization) -> [f64; 2] {
        let at = linearization.at[axis];
        let middle = self.middle[axis.index()];
        let center = DVec2::from_array(self.chart.parameters);
        let breaks = &self.sheets.bezier.grids[self.block.surface as usize].breaks[axis];
        let width = self.width(axis, middle);
        let [start, end] = self.block.range(axis);
        [(start, start, 0.0), (end, end - 1, 1.0)].map(|(line, span, local)| {
            let distance = breaks[line as usize] - breaks[middle as usize] - at * width;
            let step = distance / width * linearization.speed(axis);
            linearization.along(axis, self.foot(axis, span, local, linearization.at, center + step))
        })
    }

    /// The parameters of the foot of the point with the sample's parameters but in this span of an
    /// axis, from this place.
    fn foot(&self, axis: Axis, span: u32, local: f64, at: [f64; 2], start: DVec2) -> DVec2 {
        let (mut place, mut parameters) = (self.middle, at);
        (place[axis.index()], parameters[axis.index()]) = (span, local);
        let target = self.pair.transform.apply(self.patch(place).point(parameters));
        let foot = Walk { chart: self.chart }.foot(target, Place { parameters: start.to_array() });
        DVec2::from_array(foot.parameters)
    }

    /// The parameters of the chart to which all lines across an axis are mapped.
    fn images(&self, axis: Axis, linearization: &Linearization) -> Vec<f64> {
        let feet = self.feet(axis, linearization.at, linearization.speed(axis));
        feet.into_iter().map(|foot| linearization.along(axis, foot)).collect()
    }

    /// The parameters of the feet of the lines across an axis, given the sample's parameters
    /// and the derivative of its foot along the axis.
    fn feet(&self, axis: Axis, at: [f64; 2], speed: DVec2) -> Vec<DVec2> {
        let [start, end] = self.block.range(axis);
        let middle = self.middle[axis.index()];
        let center = DVec2::from_array(self.chart.parameters);
        let mut images = vec![DVec2::ZERO; (end - start + 1) as usize];
        // From the sample to the end, and to the start.
        for forwards in [true, false] {
            let (mut last, mut step) = (center, if forwards { 1.0 - at[axis] } else { -at[axis] } * speed);
            let spans: &mut dyn Iterator<Item = u32> =
                if forwards { &mut (middle..end) } else { &mut (start..=middle).rev() };
            for span in spans {
                let foot = self.foot(axis, span, if forwards { 1.0 } else { 0.0 }, at, last + step);
                images[(span - start) as usize + usize::from(forwards)] = foot;
                // The next span may be shorter or longer.
                let next = if forwards { span + 1 } else { span.wrapping_sub(1) };
                let [width, next_width] = [span, next].map(|span| self.width(axis, span));
                let of_step =
                    if span == middle { if forwards { 1.0 - at[axis] } else { at[axis] } } else { 1.0 };
                step = (foot - last) * (next_width / (width * of_step)).min(MAX_STEP_RATIO);
                last = foot;
            }
        }
        images
    }

    /// The width of a span of A's knots, 0 beyond the ends.
    fn width(&self, axis: Axis, span: u32) -> f64 {
        let breaks = &self.sheets.bezier.grids[self.block.surface as usize].breaks[axis];
        breaks.get(span as usize..span as usize + 2).map_or(0.0, |ends| ends[1] - ends[0])
    }
}

/// How a block is mapped near its sample.
struct Linearization {
    /// The sample's parameters on its patch as extracted.
    at: [f64; 2],
    orientation: Orientation,
    /// The derivatives of the sample's foot.
    map: Reparametrization,
}

impl Linearization {
    /// The derivative of the foot along an axis of A.
    fn speed(&self, axis: Axis) -> DVec2 {
        if axis == Axis::U { self.map.p } else { self.map.q }
    }

    /// The parameter of B that corresponds to an axis of A.
    fn along(&self, axis: Axis, foot: DVec2) -> f64 {
        foot[self.orientation.axis_of_b(axis).index()]
    }
}

/// The largest ratio of the steps between the feet of consecutive knot lines that is expected.
const MAX_STEP_RATIO: f64 = 64.0;
