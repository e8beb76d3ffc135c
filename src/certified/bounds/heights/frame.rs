//! The tangent plane of B at a foot, and the part of B that lies over it.

use super::super::polynomial_difference::pseudo_inverse;
use super::quadric::{Piece, Quadric, symmetric_product};
use crate::bezier::Jet;
use crate::certified::rounding::gamma;
use crate::certified::sheets::{Chart, Over, Reach};
use crate::rounding::{unit, upper_max};
use glam::{DMat3, DVec3};

/// Roundings of a product of T, P and n with a vector, relative to the sizes of its terms.
const FRAME_ROUNDINGS: f64 = 64.0;

/// The number of boxes tried; each but the first is larger by what the last one lacked, and by half
/// as much again.
const MAX_BOXES: usize = 3;
const ENLARGEMENT: f64 = 1.5;

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

/// A box of B's parameters.
pub(super) struct Image {
    pub(super) reach: Reach,
    /// Half the widths of a box about the foot that contains it.
    pub(super) extent: [f64; 2],
    /// Its ends along each axis.
    pub(super) ends: [[f64; 2]; 2],
    /// How far P (A - B) can be from zero.
    pub(super) overshoot: [f64; 2],
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

    /// A box of parameters over which B lies above or below all points of a piece of A, up to the
    /// overshoot at the ends of B's surface; `None` if B turns too far for the lemma.
    ///
    /// `error` bounds the rounding of computed points of B.
    pub(super) fn image(&self, piece: &Piece, error: f64) -> Option<Image> {
        let places = self.inverse.map(|row| piece.range(row));
        let farthest = places.map(|[low, high]| upper_max(-low, high));
        let rows = self.inverse.map(DVec3::length);
        let mut extent = farthest.map(|place| ENLARGEMENT * place);
        for _ in 0..MAX_BOXES {
            let reach = self.chart.reach_over_creases(extent);
            let deviation = error + self.chart.step_error(&reach, [0.0; 2], extent, Over::Parts);
            let moved = [0, 1].map(|axis| rows[axis] * deviation + self.inverse_error(axis, extent));
            let sum = [0, 1].map(|axis| farthest[axis] + moved[axis]);
            if (0..2).all(|axis| sum[axis] <= extent[axis]) {
                return Some(self.image_within(reach, extent, places, moved));
            }
            extent = sum.map(|sum| ENLARGEMENT * sum);
        }
        None
    }

    /// A bound on the change of a parameter step by `I - P T`, for steps of at most `extent`.
    fn inverse_error(&self, axis: usize, extent: [f64; 2]) -> f64 {
        let row = self.inverse[axis];
        let of = |other: usize| {
            let tangent = self.tangents[other];
            let expected = if other == axis { 1.0 } else { 0.0 };
            let rounding = gamma(FRAME_ROUNDINGS) * (1.0 + row.length() * tangent.length());
            ((row.dot(tangent) - expected).abs() + rounding) * extent[other]
        };
        of(0) + of(1)
    }

    fn image_within(
        &self,
        reach: Reach,
        extent: [f64; 2],
        places: [[f64; 2]; 2],
        moved: [f64; 2],
    ) -> Image {
        let gap = self.chart.gap(&reach, extent);
        let mut overshoot = [0.0; 2];
        let ends = [0, 1].map(|axis| {
            let at = self.chart.parameters[axis];
            let [low, high] = reach.domain[axis];
            let [first, last] = [places[axis][0] - moved[axis], places[axis][1] + moved[axis]];
            let beyond = upper_max(upper_max(low - (at + first), at + last - high), 0.0);
            let rounding = gamma(FRAME_ROUNDINGS) * (1.0 + extent[axis]);
            overshoot[axis] = beyond + self.inverse[axis].length() * gap + rounding;
            [(at + first).clamp(low, high), (at + last).clamp(low, high)]
        });
        Image { reach, extent, ends, overshoot }
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
