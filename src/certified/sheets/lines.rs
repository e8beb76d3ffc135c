//! The knot lines of a surface, and its patches between them, in the parameters of a chart.

use super::super::rounding::UNIT_ROUNDOFF;
use super::chart::{Chart, MARGIN};
use crate::axis::Axis;
use std::ops::RangeInclusive;

/// The rounding of a seam's parameter, in units of the sizes of its terms.
const LINE_ROUNDINGS: f64 = 16.0;

/// A part of a surface's domain along an axis that a chart's parameters name.
pub(in crate::certified) struct DomainPart {
    /// In the surface's parameters.
    pub(in crate::certified) range: [f64; 2],
    /// The part less what the chart's parameters are by themselves: 0, or a period of a closed surface.
    pub(in crate::certified) shift: f64,
}

impl Chart<'_> {
    /// The lines at the ends of the patches that cover a range of parameters along
    /// an axis, or the part of it in which the surface lies.
    pub(in crate::certified) fn lines_between(
        &self,
        axis: Axis,
        [low, high]: [f64; 2],
    ) -> RangeInclusive<isize> {
        let (mut first, mut last) = (0_isize, 1_isize);
        while low < self.line(axis, first) - MARGIN && self.is_joined(axis, first) {
            first -= 1;
        }
        while high > self.line(axis, last) + MARGIN && self.is_joined(axis, last) {
            last += 1;
        }
        first..=last
    }

    /// The patch along an axis, by its offset, that contains a parameter, and the parameter
    /// of that patch; the nearest of the surface beyond its ends. O(patches between).
    pub(in crate::certified) fn locate(&self, axis: Axis, parameter: f64) -> (isize, f64) {
        let lines = self.lines_between(axis, [parameter, parameter]);
        let offset = if parameter < 0.0 { *lines.start() } else { *lines.end() - 1 };
        (offset, ((parameter - self.line(axis, offset)) / self.width(axis, offset)).clamp(0.0, 1.0))
    }

    /// The parameter of the chart for one of a patch, given by its offset.
    pub(in crate::certified) fn parameter(&self, axis: Axis, offset: isize, local: f64) -> f64 {
        self.line(axis, offset) + self.width(axis, offset) * local
    }

    /// Whether a line lies inside the surface, or where its two ends join.
    pub(in crate::certified) fn is_joined(&self, axis: Axis, line: isize) -> bool {
        let count = self.grid.breaks[axis].len() as isize - 1;
        (self.index[axis] as isize + line).rem_euclid(count) != 0 || self.is_passable(axis, line)
    }

    /// The multiplicity of a line in the surface's knots: degree + 1 at the surface's ends.
    pub(in crate::certified) fn multiplicity(&self, axis: Axis, line: isize) -> usize {
        let multiplicities = &self.grid.multiplicities[axis];
        let count = multiplicities.len() as isize - 1;
        let knot = (self.index[axis] as isize + line).rem_euclid(count) as usize;
        usize::from(multiplicities[knot])
    }

    /// The index of the patch at `offset`, cyclically.
    pub(super) fn patch_at(&self, offsets: [isize; 2]) -> usize {
        let counts = self.grid.counts();
        let [row, column] = Axis::BOTH.map(|axis| {
            let moved = self.index[axis] as isize + offsets[axis.index()];
            moved.rem_euclid(counts[axis] as isize) as usize
        });
        self.grid.first + row * counts[1] + column
    }

    /// Width of the span at `offset`, relative to the chart's span.
    pub(in crate::certified) fn width(&self, axis: Axis, offset: isize) -> f64 {
        let breaks = &self.grid.breaks[axis];
        let count = breaks.len() as isize - 1;
        let span = (self.index[axis] as isize + offset).rem_euclid(count) as usize;
        (breaks[span + 1] - breaks[span]) / self.own_width(axis)
    }

    /// The width of the chart's span.
    pub(in crate::certified) fn own_width(&self, axis: Axis) -> f64 {
        let (breaks, index) = (&self.grid.breaks[axis], self.index[axis]);
        breaks[index + 1] - breaks[index]
    }

    /// The parameter at the start of the span at `offset`. Beyond an end of
    /// the surface its other end follows.
    pub(in crate::certified) fn line(&self, axis: Axis, offset: isize) -> f64 {
        match offset {
            0 => 0.0,
            1 => 1.0,
            _ => {
                let (breaks, own) = (&self.grid.breaks[axis], self.index[axis]);
                let count = breaks.len() as isize - 1;
                let moved = own as isize + offset;
                let periods = if moved == count { 0 } else { moved.div_euclid(count) };
                let knot = breaks[(moved - periods * count) as usize];
                let beyond = periods as f64 * (breaks[count as usize] - breaks[0]);
                ((knot - breaks[own]) + beyond) / self.own_width(axis)
            }
        }
    }

    /// The parts of the surface's domain along an axis that a range of the chart's parameters names, with
    /// its rounding: two where the range goes on at the other end. `None` for more than the domain.
    ///
    /// Each has the multiple of the period by which it is moved into the domain: who takes the part has to move the
    /// chart's point with it.
    pub(in crate::certified) fn surface_ranges(
        &self,
        axis: Axis,
        range: [f64; 2],
    ) -> Option<impl Iterator<Item = DomainPart>> {
        let (breaks, own) = (&self.grid.breaks[axis], self.index[axis]);
        let (start, end) = (breaks[0], breaks[breaks.len() - 1]);
        let period = end - start;
        let rounding = LINE_ROUNDINGS * UNIT_ROUNDOFF * (4.0 * period + start.abs().max(end.abs()));
        let [low, high] = range.map(|parameter| breaks[own] + parameter * self.own_width(axis));
        let [low, high] = [low - rounding, high + rounding];
        // A surface that is not closed has nothing beyond its ends, where rounding may lead.
        let count = (breaks.len() - 1) as isize;
        let is_beyond = low < start || high > end;
        let is_closed =
            is_beyond && [0, count].iter().any(|line| self.continues_over_creases(axis, line - own as isize));
        let shifts = [-period, 0.0, period].into_iter().filter(move |shift| *shift == 0.0 || is_closed);
        let part = move |shift: f64| {
            let [low, high] = [(low + shift).max(start), (high + shift).min(end)];
            (low < high).then_some(DomainPart { range: [low, high], shift })
        };
        (high - low < period).then(|| shifts.filter_map(part))
    }

    /// A bound on the rounding error of [`Chart::line`].
    pub(in crate::certified) fn line_error(&self, axis: Axis, offset: isize) -> f64 {
        if offset == 0 || offset == 1 {
            return 0.0;
        }
        let breaks = &self.grid.breaks[axis];
        let count = breaks.len() as isize - 1;
        let moved = self.index[axis] as isize + offset;
        let periods = if moved == count { 0 } else { moved.div_euclid(count) };
        let beyond = periods.abs() as f64 * (breaks[count as usize] - breaks[0]) / self.own_width(axis);
        LINE_ROUNDINGS * UNIT_ROUNDOFF * (self.line(axis, offset).abs() + 2.0 * beyond)
    }
}
