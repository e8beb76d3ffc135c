//! A surface in the parameters of one of its Bézier patches.
//!
//! Lemma (Taylor bound over seams, 3.12 of docs/method.md). Let a surface be the polynomial or rational
//! functions of its patches, and let the segment from β to β + λ, with
//! |λ_i| <= ℓ_i, cross seams. Then the surface at β + λ differs from the Taylor
//! polynomial of second order of the patch of β by at most
//!
//! `(ℓ_s³ M_sss + 3 ℓ_s² ℓ_t M_sst + 3 ℓ_s ℓ_t² M_stt + ℓ_t³ M_ttt) / 6 +
//! Σ (J_00 + ω (ℓ_a J_10 + ℓ_b J_01) + ½ ω² (ℓ_a² J_20 + 2 ℓ_a ℓ_b J_11 + ℓ_b² J_02))`
//!
//! with M over all patches that β ± ℓ touches, and the sum over the seams across s and
//! across t that lie on one side of β, of the larger of its two sums; J bounds
//! the jumps across the seam (axis a) and along it (axis b) on all patches
//! touched, and `ω = 1 - d / ℓ_a` with d the distance of the seam from β.

use super::super::rounding::{JetScale, UNIT_ROUNDOFF};
use super::Sheets;
use crate::axis::Axis;
use crate::bezier::{DerivativeBounds, Jet, Patch, PatchGrid, SeamJumps};
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use std::ops::RangeInclusive;

/// A relative margin that covers the rounding of the seams that may be crossed, in the parameters of the
/// other patches.
pub(super) const MARGIN: f64 = 1e-8;

/// The largest number of seams that a map may cross on one side. A cell is halved if its
/// image touches more patches.
const MAX_CROSSED: isize = 4;

/// The largest ratio of the widths of two spans that one map may touch:
/// bounds on derivatives by the narrower span's parameters grow with its cube.
const MAX_WIDTH_RATIO: f64 = 64.0;

/// The largest jump of points, relative to the patch's first derivative, and of
/// first derivatives, at a seam that a map may cross. Beyond a larger one, which is an edge of
/// the surface or a crease, the Taylor bound is of first order.
const MAX_GAP: f64 = 1e-9;
const MAX_CREASE: f64 = 1e-6;

/// The largest rounding of a seam's parameter at which the seam may be crossed.
const MAX_LINE_ERROR: f64 = 1e-11;

/// A surface about a point of one of its patches, in that patch's parameters.
#[derive(Debug, Clone, Copy)]
pub(in crate::certified) struct Chart<'a> {
    pub(super) sheets: Sheets<'a>,
    pub(super) grid: &'a PatchGrid,
    /// The patch, by its place in the grid.
    pub(super) index: [usize; 2],
    patch: Patch<'a>,
    /// The point's parameters.
    pub(in crate::certified) parameters: [f64; 2],
}

/// The part of a surface over which derivatives are bounded: a smaller one costs more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::certified) enum Over {
    /// Whole patches, once for each of them.
    Patches,
    /// The parts of patches that are touched, once for each part.
    Parts,
    /// Just the box that is touched, or [`MIN_BOX`] where that is narrower.
    Boxes,
}

/// The least width of a box over which derivatives are bounded, by a patch's parameters:
/// in narrower ones rounding dominates.
const MIN_BOX: f64 = 1.0 / 64.0;

/// The part of [0, 1] about a range that is at least [`MIN_BOX`] wide.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    let lack = 0.5 * (MIN_BOX - (high - low)).max(0.0);
    let start = (low - lack).clamp(0.0, 1.0 - MIN_BOX);
    [start.min(low), (high + lack).max(start + MIN_BOX).min(1.0)]
}

/// How far a surface is followed from a point.
#[derive(Debug, Clone)]
pub(in crate::certified) struct Reach {
    /// The parameters, inside by their rounding.
    pub(in crate::certified) domain: ParamBox,
    /// The patches, by their offsets along each axis.
    patches: [RangeInclusive<isize>; 2],
}

impl<'a> Chart<'a> {
    /// The chart of the patch that a flat patch was cut from, about a point of the latter.
    pub(in crate::certified) fn new(sheets: Sheets<'a>, flat: u32, parameters: [f64; 2]) -> Self {
        let place = sheets.places.get(flat);
        let patch = sheets.bezier.patches.patch(place.patch as usize);
        let grid = &sheets.bezier.grids[patch.surface];
        let columns = grid.counts()[1];
        let local = place.patch as usize - grid.first;
        // The rounded parameters are those of another point, which serves as well.
        let inside = |axis: usize| (place.low[axis] + place.width[axis] * parameters[axis]).clamp(0.0, 1.0);
        Self {
            sheets,
            grid,
            index: [local / columns, local % columns],
            patch,
            parameters: [inside(0), inside(1)],
        }
    }

    /// The chart about a point of a surface, by its parameters.
    pub(in crate::certified) fn at(sheets: Sheets<'a>, surface: usize, parameters: [f64; 2]) -> Self {
        let grid = &sheets.bezier.grids[surface];
        let [(row, s), (column, t)] = Axis::BOTH.map(|axis| grid.locate(axis, parameters[axis.index()]));
        let patch = sheets.patch(surface as u32, [row as u32, column as u32]);
        Self { sheets, grid, index: [row, column], patch, parameters: [s, t] }
    }

    /// The parameters of the patch's surface at the point.
    pub(in crate::certified) fn surface_parameters(&self) -> [f64; 2] {
        let [s, t] = [0, 1].map(|axis| {
            let line = self.index[axis];
            [self.grid.breaks[axis][line], self.grid.breaks[axis][line + 1]]
        });
        ParamBox::new(s, t).at(self.parameters)
    }

    /// The chart's patch.
    pub(in crate::certified) fn surface(&self) -> usize {
        self.patch.surface
    }

    /// The chart of the patch at `offsets`, cyclically, about a point of it.
    pub(in crate::certified) fn moved(&self, offsets: [isize; 2], parameters: [f64; 2]) -> Self {
        let index = self.patch_at(offsets);
        let (columns, local) = (self.grid.counts()[1], index - self.grid.first);
        let patch = self.sheets.bezier.patches.patch(index);
        Self { index: [local / columns, local % columns], patch, parameters, ..*self }
    }

    /// The patch's jet at the point.
    pub(in crate::certified) fn jet(&self) -> Jet {
        self.patch.jet(self.parameters)
    }

    /// What the rounding of the jet depends on.
    pub(in crate::certified) fn jet_scale(&self) -> JetScale {
        self.sheets.jet_scale(self.patch_at([0; 2]))
    }

    /// Whether the surface continues smoothly beyond the start (`end` 0) or the end (1)
    /// of the patch along an axis.
    pub(in crate::certified) fn continues(&self, axis: Axis, end: usize) -> bool {
        self.is_passable(axis, end as isize)
    }

    /// How far the surface may be followed from the point for steps of about
    /// `extent`: up to seams that are no smooth joins.
    pub(in crate::certified) fn reach(&self, extent: [f64; 2]) -> Reach {
        self.reach_over(extent, MAX_CREASE)
    }

    /// The same up to the ends of the surface, over creases.
    pub(in crate::certified) fn reach_over_creases(&self, extent: [f64; 2]) -> Reach {
        self.reach_over(extent, f64::INFINITY)
    }

    fn reach_over(&self, extent: [f64; 2], max_crease: f64) -> Reach {
        let reached = Axis::BOTH.map(|axis| {
            let (at, extent) = (self.parameters[axis], extent[axis.index()]);
            let mut lines = [0_isize, 1];
            while lines[0] > -MAX_CROSSED
                && at - extent < self.line(axis, lines[0])
                && self.is_passable_over(axis, lines[0], max_crease)
            {
                lines[0] -= 1;
            }
            while lines[1] <= MAX_CROSSED
                && at + extent > self.line(axis, lines[1])
                && self.is_passable_over(axis, lines[1], max_crease)
            {
                lines[1] += 1;
            }
            // Inside by the rounding of the lines.
            let [low, high] = lines.map(|line| self.line(axis, line));
            let [low_error, high_error] = lines.map(|line| self.line_error(axis, line));
            ([low + low_error, high - high_error], lines[0]..=lines[1] - 1)
        });
        let [(s, rows), (t, columns)] = reached;
        Reach { domain: ParamBox::new(s, t), patches: [rows, columns] }
    }

    /// The lemma's bound for steps of at most `extent` that stay in the domain, with
    /// the derivatives over the box touched or over all patches touched.
    pub(in crate::certified) fn remainder(&self, reach: &Reach, extent: [f64; 2], over: Over) -> f64 {
        let touched = self.all_touched(extent, reach);
        let mut third = [0.0_f64; 4];
        for m in touched[0].clone() {
            for n in touched[1].clone() {
                let bounds = self.derivatives(extent, [m, n], over);
                for (third, bound) in third.iter_mut().zip(bounds.third) {
                    *third = upper_max(*third, bound);
                }
            }
        }
        let [h, k] = extent;
        let [sss, sst, stt, ttt] = third;
        let taylor =
            (h * h * h * sss + 3.0 * h * h * k * sst + 3.0 * h * k * k * stt + k * k * k * ttt) / 6.0;
        let [across_s, across_t] = Axis::BOTH.map(|axis| self.jumps(axis, extent, &touched));
        taylor + across_s + across_t
    }

    /// The larger of the sums over the seams on either side of the point.
    fn jumps(&self, axis: Axis, extent: [f64; 2], touched: &[RangeInclusive<isize>; 2]) -> f64 {
        let range = &touched[axis.index()];
        let sum = |lines: RangeInclusive<isize>| -> f64 {
            lines.map(|line| self.jump(axis, line, extent, &touched[axis.other().index()])).sum()
        };
        upper_max(sum(range.start() + 1..=0), sum(1..=*range.end()))
    }

    /// The term of one seam.
    fn jump(&self, axis: Axis, line: isize, extent: [f64; 2], along: &RangeInclusive<isize>) -> f64 {
        let [a, b] = [extent[axis.index()], extent[axis.other().index()]];
        let error = self.line_error(axis, line) + UNIT_ROUNDOFF;
        let distance = (self.line(axis, line) - self.parameters[axis]).abs() - 4.0 * error;
        let omega = if distance > 0.0 { (1.0 - distance / a).max(0.0) } else { 1.0 };
        let mut largest = 0.0_f64;
        for other in along.clone() {
            let j = self.seam(axis, line, other);
            let first = a * j[1][0] + b * j[0][1];
            let second = a * a * j[2][0] + 2.0 * a * b * j[1][1] + b * b * j[0][2];
            largest = upper_max(largest, j[0][0] + omega * first + 0.5 * omega * omega * second);
        }
        largest
    }

    /// The jumps at a seam across an axis by the chart's parameters, `line` of this
    /// axis and patch `other` of the other one.
    pub(super) fn seam(&self, axis: Axis, line: isize, other: isize) -> [[f64; 3]; 3] {
        let place = |along: isize| if axis == Axis::U { [along, other] } else { [other, along] };
        let [low, high] = [line - 1, line].map(|along| self.patch_at(place(along)));
        let [before, after] = [line - 1, line].map(|along| self.width(axis, along));
        let jumps: &SeamJumps = self.sheets.jumps([low, high], axis, before / after);
        let (across, along) = (before.recip(), self.width(axis.other(), other).recip());
        let mut scaled = jumps.bounds;
        for (a, row) in scaled.iter_mut().enumerate() {
            for (b, bound) in row.iter_mut().enumerate() {
                *bound *= (1.0 + MARGIN) * across.powi(a as i32) * along.powi(b as i32);
            }
        }
        scaled
    }

    /// Whether the surface is smooth enough at a seam for a map to cross it.
    pub(super) fn is_passable(&self, axis: Axis, line: isize) -> bool {
        self.is_passable_over(axis, line, MAX_CREASE)
    }

    /// Whether the surface is continuous at a seam, so that it is followed over it.
    pub(super) fn continues_over_creases(&self, axis: Axis, line: isize) -> bool {
        self.is_passable_over(axis, line, f64::INFINITY)
    }

    /// Whether it is continuous there, with a crease of at most this size.
    fn is_passable_over(&self, axis: Axis, line: isize, max_crease: f64) -> bool {
        let widths = [line - 1, line].map(|along| self.width(axis, along));
        let is_similar = |width: &f64| (MAX_WIDTH_RATIO.recip()..=MAX_WIDTH_RATIO).contains(width);
        let own = self.patch_at([0; 2]);
        if !widths.iter().all(is_similar) || self.line_error(axis, line) > MAX_LINE_ERROR {
            return false;
        }
        let j = self.seam(axis, line, 0);
        let speed = self.sheets.bounds(own).whole(&self.patch).first[axis.index()];
        j[0][0] <= MAX_GAP * speed && j[1][0] <= max_crease * speed
    }

    /// The patches within reach that steps of at most `extent` may touch.
    pub(in crate::certified) fn all_touched(
        &self,
        extent: [f64; 2],
        reach: &Reach,
    ) -> [RangeInclusive<isize>; 2] {
        Axis::BOTH.map(|axis| self.touched(axis, extent[axis.index()], &reach.patches[axis.index()]))
    }

    /// The patches along an axis, of those within reach, that a step of at most
    /// `extent` may touch.
    fn touched(&self, axis: Axis, extent: f64, reach: &RangeInclusive<isize>) -> RangeInclusive<isize> {
        let at = self.parameters[axis];
        let (mut first, mut last) = (0_isize, 0_isize);
        let is_beyond = |line: isize, reach: f64| {
            let error = 4.0 * (self.line_error(axis, line) + UNIT_ROUNDOFF * (1.0 + extent));
            if line <= 0 {
                reach - error < self.line(axis, line)
            } else {
                reach + error > self.line(axis, line)
            }
        };
        while first > *reach.start() && is_beyond(first, at - extent) {
            first -= 1;
        }
        while last < *reach.end() && is_beyond(last + 1, at + extent) {
            last += 1;
        }
        first..=last
    }

    /// Bounds on the derivatives, by the chart's parameters, over the part of a patch
    /// that steps of at most `extent` may touch, or over more of it.
    pub(super) fn derivatives(&self, extent: [f64; 2], offsets: [isize; 2], over: Over) -> DerivativeBounds {
        let index = self.patch_at(offsets);
        let patch = self.sheets.bezier.patches.patch(index);
        let widths = Axis::BOTH.map(|axis| self.width(axis, offsets[axis.index()]));
        let bounds = self.sheets.bounds(index);
        let range = |axis: Axis| {
            let start = self.line(axis, offsets[axis.index()]);
            let (at, extent) = (self.parameters[axis], extent[axis.index()]);
            let local = |parameter: f64| (parameter - start) / widths[axis];
            [(local(at - extent) - MARGIN).clamp(0.0, 1.0), (local(at + extent) + MARGIN).clamp(0.0, 1.0)]
        };
        let bounds = match over {
            Over::Patches => *bounds.whole(&patch),
            Over::Parts => {
                let range = Axis::BOTH.map(range);
                bounds.over(&patch, range.map(|[low, _]| low), range.map(|[_, high]| high))
            }
            Over::Boxes => {
                let [s, t] = Axis::BOTH.map(range).map(widened);
                patch.bounds_over(s, t)
            }
        };
        // Widths that are smaller by the margin make bounds larger by it.
        bounds.rescaled(widths.map(|width| (1.0 - MARGIN) * width))
    }

    /// The part of a box of the chart's parameters in the patch at `offsets`, or a little more, in
    /// that patch's parameters.
    pub(in crate::certified) fn part(&self, offsets: [isize; 2], ends: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
        Axis::BOTH.map(|axis| {
            let (offset, [low, high]) = (offsets[axis.index()], ends[axis.index()]);
            let (start, width) = (self.line(axis, offset), self.width(axis, offset));
            let [low, high] = [(low - start) / width - MARGIN, (high - start) / width + MARGIN];
            [low.clamp(0.0, 1.0 - MARGIN), high.clamp(MARGIN, 1.0)]
        })
    }

    /// An upper bound on the distance of the control points of that patch from its centre.
    pub(in crate::certified) fn radius(&self, offsets: [isize; 2]) -> f64 {
        let index = self.patch_at(offsets);
        self.sheets.bounds(index).whole(&self.sheets.bezier.patches.patch(index)).radius
    }

    /// The patch at `offsets`, cyclically.
    pub(in crate::certified) fn neighbour(&self, offsets: [isize; 2]) -> Patch<'a> {
        self.sheets.bezier.patches.patch(self.patch_at(offsets))
    }

    /// The flat patch that holds a point of that patch, with the point's parameters in it.
    pub(in crate::certified) fn flat_place(
        &self,
        offsets: [isize; 2],
        parameters: [f64; 2],
    ) -> Option<(u32, [f64; 2])> {
        self.sheets.flat_place(self.patch_at(offsets), parameters)
    }
}
