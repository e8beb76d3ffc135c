//! Cells over a loop of a face.
//!
//! Lemma (3.19 of `docs/method.md`). Let a face have no boundary where one or two parabolas of its parameters say
//! so: in a box of them each point within all sides, `±η_v < a + b η_u + c η_u²` with η relative to the foot,
//! belongs to it. Let all fixed points of a cell be in the box. With the functions g and the lags λ of their
//! placement and the lags κ of linear functions at its fixed points, no fixed point is beyond a side by more than
//!
//! `max over the cell of (±g_v - b g_u - c (P_u·Y)²) - a + λ_v + |b| λ_u + |c| κ_u (2 |η_u| + κ_u)`.
//!
//! A step along v of the largest excess, or along both axes of `(x_1 + s_1 x_2) / (1 - s_1 s_2)` and
//! `(x_2 + s_2 x_1) / (1 - s_1 s_2)` for excesses x and slopes s of sides of both, leads to a point of the face.

use super::frame::Placement;
use super::over::Over;
use super::piece::Values;
use super::quadric::{Quadric, symmetric_product};
use crate::axis::Axis;
use crate::certified::faces::{FaceChart, FaceRim};
use crate::certified::rounding::gamma;
use crate::model::trim::RimSide;
use crate::rounding::upper_max;

/// Roundings of the sums, relative to the sizes of their terms.
const SUM_ROUNDINGS: f64 = 32.0;

/// Roundings of the steps, relative to both excesses and slopes.
const STEP_ROUNDINGS: f64 = 128.0;

/// How far the fixed points' images may be from the face along the surface, for feet within the threshold; `None`
/// where that is not known, or more than the threshold.
pub(super) fn overrun(
    over: &Over<'_>,
    face: &FaceChart<'_>,
    placement: &Placement,
    threshold: f64,
) -> Option<f64> {
    face.rims(placement.feet).into_iter().find_map(|rim| {
        let excesses: Vec<f64> =
            rim.sides.iter().map(|side| excess(over, placement, side, threshold).highest()).collect();
        overrun_of(over, placement, &rim, &excesses, threshold)
    })
}

/// The same of fixed points that are beyond the sides of a rim by no more than these excesses.
pub(super) fn overrun_of(
    over: &Over<'_>,
    placement: &Placement,
    rim: &FaceRim,
    excesses: &[f64],
    threshold: f64,
) -> Option<f64> {
    let excesses: Vec<f64> = excesses.iter().map(|excess| upper_max(*excess, 0.0)).collect();
    let steps = steps(&rim.sides, &excesses);
    if !stays_in_box(rim, placement.feet, steps) {
        return None;
    }
    let overrun = over.frame.drift(&over.image, rim.parameters, steps)?;
    (overrun <= threshold).then_some(overrun)
}

/// Whether steps towards the inside lead from all of these parameters to places in the rim's box.
pub(super) fn stays_in_box(rim: &FaceRim, feet: [[f64; 2]; 2], steps: [f64; 2]) -> bool {
    rim.sides.iter().all(|side| {
        let index = side.axis.index();
        let ([low, high], [first, last]) = (rim.parameters[index], feet[index]);
        steps[index] <= if side.is_upwards { first - low } else { high - last }
    })
}

/// A bound, for each point of a cell, on how far its fixed point is beyond a line.
pub(super) struct Excess {
    /// On the cell, of twice its degrees.
    pub(super) values: Values,
    /// What is added to the values.
    pub(super) constant: f64,
}

impl Excess {
    /// The largest over the cell.
    pub(super) fn highest(&self) -> f64 {
        self.values.range()[1] + self.constant
    }
}

/// How far fixed points may be beyond a side, along its axis, for feet within the threshold.
pub(super) fn excess(over: &Over<'_>, placement: &Placement, side: &RimSide, threshold: f64) -> Excess {
    let frame = &over.frame;
    let (across, along) = (side.axis.index(), side.axis.other().index());
    let ([a, b, c], sign) = (side.coefficients, if side.is_upwards { 1.0 } else { -1.0 });
    let [g, h] = [placement.functions[across], placement.functions[along]];
    let row = frame.inverse[along];
    let function = Quadric {
        linear: sign * g.linear - b * h.linear,
        form: g.form * sign - h.form * b - symmetric_product(row, row) * c,
    };
    let values = over.a.quadratic_values(&function);
    let ([low, high], at) = (placement.feet[along], frame.chart.parameters[along]);
    let reach = upper_max(at - low, high - at);
    let linear_lag =
        over.linear.bracket[along] + placement.overshoot[along] + h.size() * over.reach() * threshold;
    let lags = placement.lag[across]
        + b.abs() * placement.lag[along]
        + c.abs() * linear_lag * (2.0 * reach + linear_lag);
    let sizes = a.abs() + reach * (b.abs() + reach * c.abs()) + values.size + lags;
    Excess { constant: lags - a + gamma(SUM_ROUNDINGS) * sizes, values }
}

/// Steps along both axes that lead from where all excesses are at most these to within all sides.
pub(super) fn steps(sides: &[RimSide], excesses: &[f64]) -> [f64; 2] {
    let mut steps = [0.0; 2];
    if let ([first, second], [x, y]) = (sides, excesses)
        && first.axis != second.axis
    {
        let [s, t] = [first.slope, second.slope];
        let rounding = gamma(STEP_ROUNDINGS) * (1.0 + s) * (1.0 + t) * (x + y);
        let ([x, y], divisor) = ([x + rounding, y + rounding], 1.0 - s * t);
        steps[first.axis.index()] = (x + s * y) / divisor;
        steps[second.axis.index()] = (y + t * x) / divisor;
    } else {
        for (side, excess) in sides.iter().zip(excesses) {
            let step: &mut f64 = &mut steps[side.axis.index()];
            *step = upper_max(*step, *excess);
        }
    }
    Axis::BOTH.map(|axis| steps[axis.index()])
}
