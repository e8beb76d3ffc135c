//! A block of A with the surface of B near it.

use super::super::orientation::Orientation;
use super::block::Block;
use super::knot_line_map::{Place, Walk};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::certified::Pair;
use crate::certified::nearest::Sample;
use crate::certified::reparametrization::Reparametrization;
use crate::certified::sheets::{Chart, Sheets};
use glam::DVec2;

/// Distance of the sample's foot, in radii of the block, up to which a map is tried: farther
/// away smaller blocks or their cells are decided by bounds of the distance alone.
const MAX_DISTANCE_IN_RADII: f64 = 0.5;

/// The largest ratio of the steps between the feet of consecutive knot lines that is expected.
const MAX_STEP_RATIO: f64 = 64.0;

/// A block of A, a sample in its middle, and B's surface about the sample's foot.
pub(in crate::certified) struct BlockContext<'a> {
    pub(super) pair: &'a Pair<'a>,
    pub(super) sheets: Sheets<'a>,
    pub(super) block: &'a Block,
    /// The row and the column of the patch of the sample.
    pub(super) middle: [u32; 2],
    pub(super) chart: Chart<'a>,
    pub(super) linearization: Linearization,
}

/// The map of a block near its sample.
pub(super) struct Linearization {
    /// The sample's parameters on its patch as extracted.
    at: [f64; 2],
    pub(super) orientation: Orientation,
    /// The derivatives of the sample's foot.
    map: Reparametrization,
}

impl<'a> BlockContext<'a> {
    /// `None` where the foot is far or B has no map near it.
    pub(in crate::certified) fn new(
        pair: &'a Pair<'a>,
        sheets: Sheets<'a>,
        block: &'a Block,
        sample: &Sample,
    ) -> Option<Self> {
        let chart = Chart::new(pair.b.sheets?, sample.foot.patch, sample.foot.parameters);
        let middle = block.middle();
        let linearization = Linearization::new(pair, sheets, block, sample, &chart)?;
        Some(Self { pair, sheets, block, middle, chart, linearization })
    }

    pub(super) fn patch(&self, place: [u32; 2]) -> Patch<'a> {
        self.sheets.patch(self.block.surface, place)
    }

    /// The indices in the surface of the patch at this place in the block.
    pub(super) fn indices(&self, [row, column]: [usize; 2]) -> [u32; 2] {
        [self.block.rows[0] + row as u32, self.block.columns[0] + column as u32]
    }

    /// The flat patch that holds a point of a patch as extracted, with its parameters there.
    pub(super) fn flat_place(&self, place: [u32; 2], parameters: [f64; 2]) -> Option<(u32, [f64; 2])> {
        self.sheets.flat_place(self.sheets.index(self.block.surface, place), parameters)
    }

    /// The parameters of the chart to which the block's first and last lines across an axis are
    /// mapped, by the feet of points on them.
    pub(super) fn ends(&self, axis: Axis) -> [f64; 2] {
        let linearization = &self.linearization;
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
        let foot = Walk { chart: &self.chart }.foot(target, Place { parameters: start.to_array() });
        DVec2::from_array(foot.parameters)
    }

    /// The parameters of the chart to which all lines across an axis are mapped.
    pub(super) fn images(&self, axis: Axis) -> Vec<f64> {
        let linearization = &self.linearization;
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

impl Linearization {
    fn new(
        pair: &Pair<'_>,
        sheets: Sheets<'_>,
        block: &Block,
        sample: &Sample,
        chart: &Chart<'_>,
    ) -> Option<Self> {
        let place = sheets.places.get(sample.patch);
        let at = [0, 1].map(|axis| place.low[axis] + place.width[axis] * sample.parameters[axis]);
        let a = sheets.patch(block.surface, block.middle()).jet(at);
        let rotate = |vector| pair.transform.rotate(vector);
        // The block's half sides if its patches are like the sample's.
        let [rows, columns] = block.size().map(|count| 0.5 * f64::from(count));
        let radius = rows * a.s.length() + columns * a.t.length();
        if sample.foot.distance() > MAX_DISTANCE_IN_RADII * radius {
            return None;
        }
        let jet = chart.jet();
        let residual = jet.point - pair.transform.apply(a.point);
        let map = Reparametrization::linearized(&jet, residual, [rotate(a.s), rotate(a.t)], [false; 2])?;
        Some(Self { at, orientation: Orientation::new(&map), map })
    }

    /// The derivative of the foot along an axis of A.
    fn speed(&self, axis: Axis) -> DVec2 {
        if axis == Axis::U { self.map.p } else { self.map.q }
    }

    /// The parameter of B that corresponds to an axis of A.
    fn along(&self, axis: Axis, foot: DVec2) -> f64 {
        foot[self.orientation.axis_of_b(axis).index()]
    }
}
