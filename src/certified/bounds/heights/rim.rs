//! Cells over a loop of a face.
//!
//! Lemma (3.18 of `docs/method.md`). Let a face have no boundary where one or two conics of its parameters say so: in
//! a box of them each point within all sides, `e = ±η_v - a - b η_u - c η_u² - d η_u η_v - f η_v² < 0` with η relative
//! to the foot and a derivative by ±η_v of at least σ, belongs to it. Let all fixed points of a cell be in the box. With
//! the functions g and the lags λ of their placement, the lags κ of linear functions at its fixed points and the largest
//! parameters q, e is at no fixed point more than
//!
//! `max over the cell of (±g_v - b g_u - c (P_u·Y)² - d (P_u·Y) (P_v·Y) - f (P_v·Y)²) - a + λ_v + |b| λ_u`
//! `+ |c| κ_u (2 q_u + κ_u) + |d| (κ_u q_v + (q_u + κ_u) κ_v) + |f| κ_v (2 q_v + κ_v)`.
//!
//! With these overhangs over σ, x, and slopes s of both sides, a step along v of the largest x, or along both axes of
//! `(x_1 + s_1 x_2) / (1 - s_1 s_2)` and `(x_2 + s_2 x_1) / (1 - s_1 s_2)`, leads to a point of the face.

use super::cell_comparison::CellComparison;
use super::frame::Placement;
use super::piece::{Piece, Values};
use super::quadric::{Quadric, symmetric_product};
use crate::axis::Axis;
use crate::certified::faces::FaceRim;
use crate::certified::rounding::gamma;
use crate::model::trim::RimSide;
use crate::rounding::upper_max;

/// Roundings of the sums, relative to the sizes of their terms.
const SUM_ROUNDINGS: f64 = 32.0;

/// Roundings of the steps, relative to both overhangs and slopes.
const STEP_ROUNDINGS: f64 = 128.0;

/// How far the images of fixed points may be from the face along the surface, where they are beyond the sides of a rim
/// by no more than these overhangs, for feet within the threshold; `None` where that is not known, or more than the
/// threshold.
pub(super) fn drift(
    cell: &CellComparison<'_>,
    placement: &Placement,
    rim: &FaceRim,
    overhangs: &[f64],
    threshold: f64,
) -> Option<f64> {
    let overhangs: Vec<f64> = overhangs.iter().map(|overhang| upper_max(*overhang, 0.0)).collect();
    let steps = steps(&rim.sides, &overhangs);
    if !stays_in_box(rim, placement.feet, steps) {
        return None;
    }
    let drift = cell.frame.drift(&cell.image, rim.parameters, steps)?;
    (drift <= threshold).then_some(drift)
}

/// Whether steps along both axes lead from all of these parameters to places in the rim's box. Steps along one do: the
/// side of the box that they lead to is within the rim.
pub(super) fn stays_in_box(rim: &FaceRim, feet: [[f64; 2]; 2], steps: [f64; 2]) -> bool {
    let is_inside = |side: &RimSide| {
        let index = side.axis.index();
        let ([low, high], [first, last]) = (rim.parameters[index], feet[index]);
        steps[index] <= if side.is_upwards { first - low } else { high - last }
    };
    steps.contains(&0.0) || rim.sides.iter().all(is_inside)
}

/// A bound, for each point of a cell, on how far its fixed point is beyond a line.
pub(super) struct Overhang {
    pub(super) function: Quadric,
    /// Its values on the cell, of twice the cell's degrees.
    pub(super) values: Values,
    /// What is added to the values.
    pub(super) constant: f64,
}

impl Overhang {
    pub(super) fn new(function: Quadric, a: &Piece, constant: f64) -> Self {
        Self { values: a.quadratic_values(&function), function, constant }
    }

    /// The largest over the cell.
    pub(super) fn highest(&self) -> f64 {
        self.values.range()[1] + self.constant
    }
}

/// How far fixed points may be beyond a side, along its axis at most, for feet within the threshold.
pub(super) fn overhang(
    cell: &CellComparison<'_>,
    placement: &Placement,
    side: &RimSide,
    threshold: f64,
) -> Overhang {
    let frame = &cell.frame;
    let axes = [side.axis.index(), side.axis.other().index()];
    // Relative to the least derivative across the side.
    let v = if side.is_upwards { 1.0 } else { -1.0 } / side.rate;
    let [a, b, c, d, f] = side.coefficients.map(|coefficient| coefficient / side.rate);
    let [g, h] = axes.map(|axis| placement.functions[axis]);
    let [across, along] = axes.map(|axis| frame.inverse[axis]);
    let products = symmetric_product(along, along) * c
        + symmetric_product(along, across) * d
        + symmetric_product(across, across) * f;
    let function = Quadric { linear: v * g.linear - b * h.linear, form: g.form * v - h.form * b - products };
    // The largest parameters, and those of linear functions in place of them.
    let [y, x] = axes.map(|axis| {
        let ([low, high], at) = (placement.feet[axis], frame.chart.parameters[axis]);
        upper_max(at - low, high - at)
    });
    let [y_lag, x_lag] = axes.map(|axis| {
        let turn = placement.functions[axis].size() * cell.reach();
        cell.linear.lag_of_b[axis] + placement.overhang[axis] + turn * threshold
    });
    let [b, c, d, f] = [b, c, d, f].map(f64::abs);
    let lags = v.abs() * placement.lag[axes[0]]
        + b * placement.lag[axes[1]]
        + c * x_lag * (2.0 * x + x_lag)
        + d * (x_lag * y + (x + x_lag) * y_lag)
        + f * y_lag * (2.0 * y + y_lag);
    let mut overhang = Overhang::new(function, &cell.a, lags - a);
    let sizes = a.abs() + x * (b + x * c + y * d) + y * y * f + overhang.values.size + lags;
    overhang.constant += gamma(SUM_ROUNDINGS) * sizes;
    overhang
}

/// Steps along both axes that lead from where all overhangs are at most these to within all sides.
pub(super) fn steps(sides: &[RimSide], overhangs: &[f64]) -> [f64; 2] {
    let mut steps = [0.0; 2];
    if let ([first, second], [x, y]) = (sides, overhangs)
        && first.axis != second.axis
    {
        let [s, t] = [first.slope, second.slope];
        let rounding = gamma(STEP_ROUNDINGS) * (1.0 + s) * (1.0 + t) * (x + y);
        let ([x, y], divisor) = ([x + rounding, y + rounding], 1.0 - s * t);
        steps[first.axis.index()] = (x + s * y) / divisor;
        steps[second.axis.index()] = (y + t * x) / divisor;
    } else {
        for (side, overhang) in sides.iter().zip(overhangs) {
            let step: &mut f64 = &mut steps[side.axis.index()];
            *step = upper_max(*step, *overhang);
        }
    }
    Axis::BOTH.map(|axis| steps[axis.index()])
}
