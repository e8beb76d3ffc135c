//! Cells over a loop of a face.
//!
//! Lemma (3.19 of `docs/method.md`). Let a face have no boundary where a parabola of its parameters says so:
//! in a box of them each point with `±η_v < a + b η_u + c η_u²`, η relative to the foot, belongs to it, and
//! the whole side of the box towards which that falls. Let all fixed points of a cell be in the box. With
//! the functions g and the lags λ of their placement, a point of the face is at most
//!
//! `max over the cell of (±g_v - b g_u - c (P_u·Y)²) - a + λ_v + |b| λ_u + |c| κ_u (2 |η_u| + κ_u)`
//!
//! from a fixed point along v, κ the lags of linear functions.

use super::Over;
use super::quadric::{Quadric, symmetric_product};
use crate::certified::faces::FaceChart;
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;

/// Roundings of the sum, relative to the sizes of its terms.
const SUM_ROUNDINGS: f64 = 32.0;

/// How far the fixed points' images may be from the face along the surface; `None` where that is not known,
/// or more than the threshold. `linear_lag` is that of the placement by linear functions.
pub(super) fn overrun(
    over: &Over<'_>,
    face: &FaceChart<'_>,
    linear_lag: [f64; 2],
    threshold: f64,
) -> Option<f64> {
    let Over { frame, placement, .. } = over;
    let rim = face.rim(placement.feet)?;
    let (across, along) = (rim.axis.index(), rim.axis.other().index());
    let ([a, b, c], sign) = (rim.coefficients, if rim.is_upwards { 1.0 } else { -1.0 });
    let [g, h] = [placement.functions[across], placement.functions[along]];
    let row = frame.inverse[along];
    let function = Quadric {
        linear: sign * g.linear - b * h.linear,
        form: g.form * sign - h.form * b - symmetric_product(row, row) * c,
    };
    let [_, highest] = over.a.values(&function).range();
    let ([low, high], at) = (placement.feet[along], frame.chart.parameters[along]);
    let reach = upper_max(at - low, high - at);
    let lags = placement.lag[across]
        + b.abs() * placement.lag[along]
        + c.abs() * linear_lag[along] * (2.0 * reach + linear_lag[along]);
    let sizes = a.abs() + reach * (b.abs() + reach * c.abs()) + highest.abs() + lags;
    let beyond = highest - a + lags + gamma(SUM_ROUNDINGS) * sizes;
    if beyond <= 0.0 {
        return Some(0.0);
    }
    let overrun = frame.drift(over.image, rim.axis, rim.parameters, beyond)?;
    (overrun <= threshold).then_some(overrun)
}
