//! Validation of one trimming curve, and its Bézier pieces.

use super::TrimCurveArrays;
use super::piece::{TrimPiece, homogeneous, point_of};
use crate::error::TrimFault;
use crate::limits::{MAX_ORDER, MAX_WEIGHT_RATIO, MIN_WEIGHT, is_in_range};
use crate::model::{knots, spans};
use crate::rounding::gamma;
use glam::{DVec2, DVec3};

/// The roundings of a control of a piece, relative to the largest coordinate: the
/// products with the weights, the blossoms' three for each of at most 15 levels, the sum
/// of 16 terms, two quotients and the powers of [`TrimPiece::normalize_weights`].
const EXTRACTION_ROUNDINGS: f64 = 96.0;

/// The place of a curve among the loops of its surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) loop_index: usize,
    pub(super) curve: usize,
}

impl TrimCurveArrays {
    /// Checks the arrays by the rules of surfaces: degree, knots, finite coordinates,
    /// positive weights; and a gap of at least 0. O(size).
    pub(super) fn validate(&self, Place { loop_index, curve }: Place) -> Result<(), TrimFault> {
        let invalid = |found: String| TrimFault::CurveInvalid { loop_index, curve, found };
        knots::check(self.degree, self.control_points.len(), &self.knots)
            .map_err(|fault| invalid(fault.to_string()))?;
        for (index, &[u, v, w]) in self.control_points.iter().enumerate() {
            if let Some(found) = [u, v, w].into_iter().find(|&number| !is_in_range(number)) {
                let expected = "a finite number of at most 1e100 in size";
                return Err(invalid(format!("control point {index} has {found:?}, expected {expected}")));
            }
        }
        if !(self.gap >= 0.0 && is_in_range(self.gap)) {
            return Err(invalid(format!("gap is {:?}, expected a finite number of at least 0", self.gap)));
        }
        let largest = self.control_points.iter().fold(0.0, |largest: f64, point| largest.max(point[2]));
        let expected = MIN_WEIGHT.max(largest / MAX_WEIGHT_RATIO);
        match self.control_points.iter().position(|&[_, _, w]| w.is_nan() || w < expected) {
            Some(index) => {
                let found = self.control_points[index][2];
                Err(TrimFault::WeightNotPositive { loop_index, curve, index, found, expected })
            }
            None => Ok(()),
        }
    }

    /// Returns the Bézier pieces of valid arrays, in order: control k of the span [a, b]
    /// is the blossom at a, degree - k times, and b, k times. A coordinate that is
    /// constant on the curve is exactly constant on the pieces. O(pieces degree²).
    pub(super) fn pieces(&self, curve: u32) -> Vec<TrimPiece> {
        let points: Vec<DVec2> = self.control_points.iter().map(|&[u, v, _]| DVec2::new(u, v)).collect();
        let constant = [0, 1].map(|axis| points.iter().all(|point| point[axis] == points[0][axis]));
        let rational = self.control_points.iter().any(|point| point[2] != self.control_points[0][2]);
        let weight = |index: usize| if rational { self.control_points[index][2] } else { 1.0 };
        let spans = spans(&self.knots, self.degree, points.len());
        let pieces = spans.iter().map(|span| {
            let control = |coefficients: &[f64; MAX_ORDER]| {
                let mut sum = DVec3::ZERO;
                for (index, coefficient) in coefficients.iter().enumerate().take(self.degree + 1) {
                    let index = span.first_control + index;
                    sum += *coefficient * homogeneous(points[index], weight(index));
                }
                let mut point = point_of(sum);
                for axis in 0..2 {
                    if constant[axis] {
                        point[axis] = points[0][axis];
                    }
                }
                homogeneous(point, if rational { sum.z } else { 1.0 })
            };
            let mut piece = TrimPiece { controls: span.operator.iter().map(control).collect(), curve };
            piece.normalize_weights();
            piece
        });
        pieces.collect()
    }

    /// Returns an upper bound on the distance in u and in v between the curve and its pieces.
    pub(super) fn extraction_error(&self) -> f64 {
        let sizes = self.control_points.iter().map(|&[u, v, _]| u.abs().max(v.abs()));
        gamma(EXTRACTION_ROUNDINGS) * sizes.fold(0.0, f64::max)
    }
}
