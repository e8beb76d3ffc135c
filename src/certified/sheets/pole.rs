//! Poles: ends of a surface that are one point, around which it is closed.

use super::chart::Chart;
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::certified::rounding::gamma;
use crate::rounding::{unit, upper_max};
use glam::{DVec3, Vec4Swizzles};

/// The largest distance of the end's control points from the pole, and the largest sum of the jumps around it,
/// relative to the patches' size.
const MAX_GAP: f64 = 1e-9;

/// Roundings of a control point's distance from the pole.
const ROUNDINGS: f64 = 32.0;

/// The largest number of patches around a pole.
const MAX_AROUND: usize = 128;

/// What is known of an end that is a pole.
#[derive(Debug, Clone, Copy)]
pub(super) struct PoleShape {
    point: DVec3,
    normal: DVec3,
    gap: f64,
}

/// A pole of a chart's surface.
#[derive(Debug, Clone, Copy)]
pub(in crate::certified) struct Pole<'a> {
    /// The chart about the pole, of the first of the patches around it.
    pub(in crate::certified) chart: Chart<'a>,
    /// The axis that leads to it.
    pub(in crate::certified) axis: Axis,
    /// Whether it is at the start (0) or the end (1) of that axis.
    pub(in crate::certified) end: usize,
    pub(in crate::certified) point: DVec3,
    /// The unit vector along the sum of the normals around it; 0 if they cancel.
    pub(in crate::certified) normal: DVec3,
    /// An upper bound on the distance of the end's points from the pole and on the sum of all jumps around it.
    pub(in crate::certified) gap: f64,
    /// The number of patches around it.
    count: usize,
}

impl<'a> Pole<'a> {
    /// The patches around it, each with a bound on the distance of its control points from its centre.
    pub(in crate::certified) fn patches(&self) -> impl Iterator<Item = (Patch<'a>, f64)> {
        let Self { chart, axis, .. } = *self;
        (0..self.count as isize).map(move |place| {
            let mut offsets = [0; 2];
            offsets[axis.other().index()] = place;
            (chart.neighbour(offsets), chart.radius(offsets))
        })
    }
}

impl<'a> Chart<'a> {
    /// The poles of the surface. O(patches around), once for each.
    pub(in crate::certified) fn poles(&self) -> impl Iterator<Item = Pole<'a>> {
        let chart = *self;
        let ends = Axis::BOTH.into_iter().flat_map(|axis| [(axis, 0), (axis, 1)]);
        ends.filter_map(move |(axis, end)| chart.pole(axis, end))
    }

    fn pole(&self, axis: Axis, end: usize) -> Option<Pole<'a>> {
        let counts = self.grid.counts();
        let count = counts[axis.other().index()];
        let index = (self.surface() * Axis::BOTH.len() + axis.index()) * 2 + end;
        let table = self.sheets.bezier.grids.len() * Axis::BOTH.len() * 2;
        let (mut offsets, mut parameters) = ([0_isize; 2], [0.0; 2]);
        offsets[axis.index()] = (end * (counts[axis.index()] - 1)) as isize;
        let own = self.index.map(|index| index as isize);
        parameters[axis.index()] = end as f64;
        let chart = self.moved([offsets[0] - own[0], offsets[1] - own[1]], parameters);
        let shape = self.sheets.cache.poles.get(table, index, || chart.pole_shape(axis, end, count));
        shape.map(|PoleShape { point, normal, gap }| Pole { chart, axis, end, point, normal, gap, count })
    }

    /// The shape of the end at which the chart is, if it is a pole.
    fn pole_shape(&self, axis: Axis, end: usize, count: usize) -> Option<PoleShape> {
        if count > MAX_AROUND {
            return None;
        }
        let point = self.jet().point;
        let (mut spread, mut radius, mut normals) = (0.0, 0.0, DVec3::ZERO);
        let mut last = None;
        // The first derivative is that after the last as well.
        for column in 0..=count {
            let mut offsets = [0; 2];
            offsets[axis.other().index()] = column as isize;
            let patch = self.neighbour(offsets);
            let [rows, columns] = patch.degree.map(|degree| degree + 1);
            for (control, place) in patch.controls.iter().zip(0..) {
                let line = if axis == Axis::U { place / columns } else { place % columns };
                let last_line = if axis == Axis::U { rows } else { columns } - 1;
                let distance = (control.xyz() / control.w + patch.center).distance(point);
                radius = upper_max(radius, distance);
                if line == end * last_line {
                    spread = upper_max(spread, distance);
                }
            }
            let jet = patch.jet(self.parameters);
            let outwards = if axis == Axis::U { jet.s } else { jet.t };
            if let Some(last) = last.replace(outwards) {
                normals += outwards.cross(last);
            }
        }
        let lines = 1..=count as isize;
        let jumps: f64 = lines.map(|line| self.seam(axis.other(), line, 0)[0][0]).sum();
        let gap = spread + jumps;
        let rounding = gamma(ROUNDINGS) * (radius + point.length());
        (gap <= MAX_GAP * radius).then(|| PoleShape { point, normal: unit(normals), gap: gap + rounding })
    }
}
