//! How far the tangents of a surface turn over a box of its parameters.
//!
//! Lemma (steps over seams, 3.15 of docs/method.md). Let x lie in the box β ± h of a surface's
//! parameters, and all steps of at most δ from it in the surface. Then for a step λ, |λ_i| <= δ_i, the
//! surface at x + λ differs from `B(x) + T λ`, T the first derivatives of the patch of β at β, by at most
//!
//! `C_s δ_s + C_t δ_t + G` with `C_s = k_s M_ss + k_t M_st + Σ J_s`, `C_t = k_s M_st + k_t M_tt + Σ J_t`,
//!
//! `k = h + ½ δ`; M over all patches that the box β ± (h + δ) touches, J_s and J_t the jumps of the
//! derivatives by s and by t and G the sum of the jumps of points at the seams that it touches; for each
//! axis the larger of the sums of J over the seams on either side of β.

use super::chart::{Chart, Over, Reach};
use crate::axis::Axis;
use crate::bezier::DerivativeBounds;
use crate::certified::rounding::{JET_ROUNDINGS, UNIT_ROUNDOFF};
use crate::rounding::upper_max;
use std::ops::RangeInclusive;

/// Roundings of the sums of terms of one sign, relative to them: four for each of up to eight seams
/// that are crossed, and some for the products.
const SUM_ROUNDINGS: f64 = 64.0;

/// How a surface differs over a box from its linear function about the middle.
#[derive(Debug, Clone, Copy, Default)]
struct Slope {
    /// Bounds on the changes of both first derivatives.
    changes: [f64; 2],
    /// A bound on the sum of the jumps of points between any two points of the box.
    gaps: f64,
}

impl Chart<'_> {
    /// The lemma's bound for steps of at most `steps` from points that are at most `half` from the
    /// chart's, with the rounding of the chart's jet; `reach` must contain both ends of them.
    pub(in crate::certified) fn step_error(
        &self,
        reach: &Reach,
        half: [f64; 2],
        steps: [f64; 2],
        over: Over,
    ) -> f64 {
        let [widened, mean] = [1.0, 0.5].map(|part| [0, 1].map(|axis| half[axis] + part * steps[axis]));
        let touched = self.all_touched(widened, reach);
        let mut bounds = DerivativeBounds::default();
        for m in touched[0].clone() {
            for n in touched[1].clone() {
                bounds.enclose(&self.derivatives(widened, [m, n], over));
            }
        }
        let [h, k] = mean;
        let [ss, st, tt] = bounds.second;
        let mut slope = Slope { changes: [h * ss + k * st, h * st + k * tt], gaps: 0.0 };
        for axis in Axis::BOTH {
            let [before, after] = self.sums(axis, &touched);
            for order in 0..2 {
                slope.changes[order] += upper_max(before.changes[order], after.changes[order]);
            }
            slope.gaps += before.gaps + after.gaps;
        }
        let error = slope.gaps + slope.changes[0] * steps[0] + slope.changes[1] * steps[1];
        (1.0 + SUM_ROUNDINGS * UNIT_ROUNDOFF) * error + self.jet_scale().quadratic_error(steps, JET_ROUNDINGS)
    }

    /// An upper bound on the length of the derivative along an axis within `extent` of the chart's point.
    pub(in crate::certified) fn speed(&self, axis: Axis, reach: &Reach, extent: [f64; 2]) -> f64 {
        let [rows, columns] = self.all_touched(extent, reach);
        let mut speed = 0.0;
        for m in rows {
            for n in columns.clone() {
                let bounds = self.derivatives(extent, [m, n], Over::Parts);
                speed = upper_max(speed, bounds.first[axis.index()]);
            }
        }
        speed
    }

    /// A bound on the jumps of points between any two points within `extent` of the chart's.
    pub(in crate::certified) fn gap(&self, reach: &Reach, extent: [f64; 2]) -> f64 {
        let touched = self.all_touched(extent, reach);
        Axis::BOTH.iter().flat_map(|&axis| self.sums(axis, &touched)).map(|sum| sum.gaps).sum()
    }

    /// The sums of the jumps at the seams across an axis before and after the point.
    fn sums(&self, axis: Axis, touched: &[RangeInclusive<isize>; 2]) -> [Slope; 2] {
        let (range, along) = (&touched[axis.index()], &touched[axis.other().index()]);
        [range.start() + 1..=0, 1..=*range.end()].map(|lines| {
            let mut sum = Slope::default();
            for line in lines {
                let mut largest = Slope::default();
                for other in along.clone() {
                    let j = self.seam(axis, line, other);
                    let jumps = if axis == Axis::U { [j[1][0], j[0][1]] } else { [j[0][1], j[1][0]] };
                    for (largest, jump) in largest.changes.iter_mut().zip(jumps) {
                        *largest = upper_max(*largest, jump);
                    }
                    largest.gaps = upper_max(largest.gaps, j[0][0]);
                }
                for (sum, jump) in sum.changes.iter_mut().zip(largest.changes) {
                    *sum += jump;
                }
                sum.gaps += largest.gaps;
            }
            sum
        })
    }
}
