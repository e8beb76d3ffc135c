//! How far the tangents of a surface turn over a box of its parameters.
//!
//! Lemma (change of tangents over seams). Let the segment from β to a point of the box β ± ℓ
//! cross seams of a surface. Then the first derivatives at that point differ from those of the
//! patch of β at β by at most
//!
//! `C_s = ℓ_s M_ss + ℓ_t M_st + Σ J_s` and `C_t = ℓ_s M_st + ℓ_t M_tt + Σ J_t`
//!
//! with M over all patches that the box touches, J_s and J_t the jumps of the derivatives by s
//! and by t, and for each axis the larger of the sums over the seams on either side of β.
//!
//! Proof. Between the crossings, `d/dθ B_s(β + θλ) = λ_s B_ss + λ_t B_st`, and at each of them
//! B_s jumps by at most J_s. A segment crosses the seams across an axis on one side only. ∎

use super::chart::{Chart, Reach};
use crate::axis::Axis;
use crate::bezier::DerivativeBounds;
use crate::certified::rounding::JET_ROUNDINGS;
use crate::rounding::upper_max;
use std::ops::RangeInclusive;

/// How a surface differs over a box from its linear function about the middle.
#[derive(Debug, Clone, Copy)]
pub(in crate::certified) struct Slope {
    /// Bounds on the changes of both first derivatives.
    changes: [f64; 2],
    /// A bound on the sum of the jumps of points between any two points of the box.
    gaps: f64,
}

impl Slope {
    /// An upper bound on `|B(x + δ) - B(x) - T δ|` for steps δ of at most `steps` between
    /// points of the box, with T the derivatives at the middle.
    ///
    /// Proof. `B(x + δ) - B(x)` is the integral of `B'(x + θδ) δ` and the jumps that the step
    /// crosses, and `|B_i - T_i|` is at most the change of derivative i. ∎
    pub(in crate::certified) fn error(&self, steps: [f64; 2]) -> f64 {
        self.gaps + self.changes[0] * steps[0] + self.changes[1] * steps[1]
    }
}

impl Chart<'_> {
    /// The slope over the box of these half-widths about the chart's point, which must lie in
    /// the domain of `reach`, by derivatives over the parts touched or over whole patches.
    pub(in crate::certified) fn slope(&self, reach: &Reach, half: [f64; 2], is_local: bool) -> Slope {
        let touched = self.all_touched(half, reach);
        let mut bounds = DerivativeBounds::default();
        for m in touched[0].clone() {
            for n in touched[1].clone() {
                bounds.enclose(&self.derivatives(half, [m, n], is_local));
            }
        }
        let [h, k] = half;
        let [ss, st, tt] = bounds.second;
        let mut slope = Slope { changes: [h * ss + k * st, h * st + k * tt], gaps: 0.0 };
        for axis in Axis::BOTH {
            let [before, after] = self.sums(axis, &touched);
            for order in 0..2 {
                slope.changes[order] += upper_max(before.changes[order], after.changes[order]);
            }
            slope.gaps += before.gaps + after.gaps;
        }
        slope
    }

    /// An upper bound on the rounding of the chart's jet over steps of this size: of its first
    /// derivatives times the steps (lemma R7).
    pub(in crate::certified) fn slope_rounding(&self, steps: [f64; 2]) -> f64 {
        self.jet_scale().quadratic_error(steps, JET_ROUNDINGS)
    }

    /// The sums of the jumps at the seams across an axis before and after the point.
    fn sums(&self, axis: Axis, touched: &[RangeInclusive<isize>; 2]) -> [Slope; 2] {
        let (range, along) = (&touched[axis.index()], &touched[axis.other().index()]);
        [range.start() + 1..=0, 1..=*range.end()].map(|lines| {
            let mut sum = Slope { changes: [0.0; 2], gaps: 0.0 };
            for line in lines {
                let mut largest = Slope { changes: [0.0; 2], gaps: 0.0 };
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
