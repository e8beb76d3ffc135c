//! The tangent plane of B at a foot, and the part of B that lies over it.

use super::quadric::{Piece, Quadric, symmetric_product};
use crate::axis::Axis;
use crate::bezier::Jet;
use crate::certified::reparametrization::pseudo_inverse;
use crate::certified::rounding::gamma;
use crate::certified::sheets::{Chart, Reach};
use crate::rounding::{lower_min, unit, upper_max};
use glam::{DMat3, DVec3};

/// Roundings of a product of T, P and n with a vector, relative to the sizes of its terms.
const FRAME_ROUNDINGS: f64 = 64.0;

/// The number of boxes tried; each but the first is larger by what the last one lacked.
const MAX_BOXES: usize = 3;

/// The size of a box relative to what it has to contain.
const ENLARGEMENT: f64 = 1.25;

/// The largest number of patches of B over which a cell is compared.
const MAX_PATCHES: usize = 16;

/// Roundings of a parameter of the chart for a patch's, relative to its size and that of the patch.
const PLACE_ROUNDINGS: f64 = 32.0;

/// A foot's tangents T with a map P to steps of parameters and a normal.
pub(super) struct Frame<'a> {
    pub(super) chart: Chart<'a>,
    pub(super) jet: Jet,
    pub(super) tangents: [DVec3; 2],
    /// The rows of P.
    pub(super) inverse: [DVec3; 2],
    pub(super) normal: DVec3,
    /// An upper bound on the norm of `I - T P - n nᵀ` and on `|n·T_i| / |T_i|`.
    pub(super) skew: f64,
}

/// The part of B over a box of parameters.
pub(super) struct Image {
    pub(super) pieces: Vec<Piece>,
    /// How far `P (a - B(y))` can be from zero along each axis where y is the fixed point.
    pub(super) overshoot: [f64; 2],
    /// The ranges of the fixed points' parameters.
    pub(super) feet: [[f64; 2]; 2],
}

/// The nearest number of a range; NaN, which is in no range, stays.
fn clamped(number: f64, [start, end]: [f64; 2]) -> f64 {
    if number < start {
        start
    } else if number > end {
        end
    } else {
        number
    }
}

impl<'a> Frame<'a> {
    /// `None` where the tangents are about parallel.
    pub(super) fn new(chart: Chart<'a>) -> Option<Self> {
        let jet = chart.jet();
        let tangents = [jet.s, jet.t];
        let inverse = pseudo_inverse(tangents);
        let normal = unit(jet.s.cross(jet.t));
        let rows = inverse.map(DVec3::length);
        let columns = tangents.map(DVec3::length);
        let mut rest = DMat3::IDENTITY - symmetric_product(normal, normal);
        for (tangent, row) in tangents.iter().zip(&inverse) {
            rest -= DMat3::from_cols(row.x * tangent, row.y * tangent, row.z * tangent);
        }
        let measured = Quadric { normal, form: rest }.size();
        let sizes = 1.0 + columns[0] * rows[0] + columns[1] * rows[1];
        let along = [0, 1].map(|axis| normal.dot(tangents[axis]).abs() / columns[axis]);
        let skew = measured + along[0] + along[1] + gamma(FRAME_ROUNDINGS * sizes);
        let is_regular = skew < MAX_SKEW && inverse.iter().all(|row| *row != DVec3::ZERO);
        is_regular.then_some(Self { chart, jet, tangents, inverse, normal, skew })
    }

    /// The part of B over a box of parameters that contains the fixed points for all points of a piece
    /// of A, up to the overshoot at the ends of B's surface. `None` where B turns too far or has too
    /// many patches for it.
    pub(super) fn image(&self, a: &Piece) -> Option<Image> {
        let places = self.inverse.map(|row| a.range(row));
        let mut extent = places.map(|[low, high]| ENLARGEMENT * upper_max(-low, high));
        for _ in 0..MAX_BOXES {
            let reach = self.chart.reach_over_creases(extent);
            let ends = [0, 1].map(|axis| {
                let (at, [low, high]) = (self.chart.parameters[axis], reach.domain[axis]);
                [(at - extent[axis]).clamp(low, high), (at + extent[axis]).clamp(low, high)]
            });
            let (pieces, lags) = self.pieces(&reach, extent, ends)?;
            let gap = self.chart.gap(&reach, extent);
            let (mut overshoot, mut lack, mut feet) = ([0.0; 2], [0.0; 2], ends);
            for axis in 0..2 {
                let (at, [start, end]) = (self.chart.parameters[axis], ends[axis]);
                let [first, last] = [0, 1].map(|end| at + places[axis][end] + lags[axis][end]);
                let beyond = [start - first, last - end];
                let jump = self.inverse[axis].length() * gap;
                let rounding = gamma(PLACE_ROUNDINGS) * (1.0 + extent[axis]);
                overshoot[axis] = upper_max(upper_max(beyond[0], beyond[1]), 0.0) + jump + rounding;
                let free = [first - jump - rounding, last + jump + rounding];
                feet[axis] = free.map(|parameter| clamped(parameter, [start, end]));
                // Beyond an end of the surface there is nothing more.
                for (side, beyond) in beyond.into_iter().enumerate() {
                    if ends[axis][side] != reach.domain[axis][side] {
                        lack[axis] = upper_max(lack[axis], beyond);
                    }
                }
            }
            if lack == [0.0; 2] {
                return Some(Image { pieces, overshoot, feet });
            }
            extent = [0, 1].map(|axis| ENLARGEMENT * (extent[axis] + lack[axis]));
        }
        None
    }

    /// The pieces of B over a box, and the range of `(y - β) - P (B(y) - b)` over it for each axis;
    /// `None` where they are many.
    fn pieces(
        &self,
        reach: &Reach,
        extent: [f64; 2],
        ends: [[f64; 2]; 2],
    ) -> Option<(Vec<Piece>, [[f64; 2]; 2])> {
        let chart = &self.chart;
        let [rows, columns] = chart.all_touched(extent, reach);
        if rows.clone().count() * columns.clone().count() > MAX_PATCHES {
            return None;
        }
        let (mut pieces, mut lags) = (Vec::new(), [[0.0_f64; 2]; 2]);
        for row in rows {
            for column in columns.clone() {
                let offsets = [row, column];
                let patch = chart.neighbour(offsets);
                let part = chart.part(offsets, ends);
                let controls = patch.restricted(part[0], part[1]);
                let shift = self.jet.point - patch.center;
                let piece = Piece::new(patch.degree, controls, shift, chart.radius(offsets));
                for axis in Axis::BOTH {
                    let index = axis.index();
                    let places = part[index]
                        .map(|end| chart.parameter(axis, offsets[index], end) - chart.parameters[index]);
                    let [low, high] = piece.lag(axis, places, self.inverse[index]);
                    let [start, end] = [0, 1].map(|line| chart.line_error(axis, offsets[index] + line));
                    lags[index][0] = lower_min(lags[index][0], low - start - end);
                    lags[index][1] = upper_max(lags[index][1], high + start + end);
                }
                pieces.push(piece);
            }
        }
        Some((pieces, lags))
    }

    /// The paraboloid that osculates B at the foot, as a function that vanishes on it.
    pub(super) fn paraboloid(&self) -> Quadric {
        let [s, t] = self.inverse;
        let [ss, st, tt] = [self.jet.ss, self.jet.st, self.jet.tt].map(|vector| self.normal.dot(vector));
        let form = symmetric_product(s, s) * ss
            + symmetric_product(s, t) * (2.0 * st)
            + symmetric_product(t, t) * tt;
        Quadric { normal: self.normal, form: form * -0.5 }
    }

    /// The function that vanishes on the tangent plane.
    pub(super) fn plane(&self) -> Quadric {
        Quadric { normal: self.normal, form: DMat3::ZERO }
    }
}

/// The largest skewness of the frame: with more, rounding or nearly parallel tangents spoil the bound.
const MAX_SKEW: f64 = 1e-6;
