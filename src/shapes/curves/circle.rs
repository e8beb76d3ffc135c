//! Rational circles.

use crate::error::Result;
use crate::shapes::{PlaneCurve, positive};
use std::f64::consts::FRAC_1_SQRT_2;

/// The control points `[x, y, w]` of the unit circle as four quadratic quarters,
/// from (1, 0) through (0, 1) (Piegl and Tiller, *The NURBS Book*, section 7.5).
pub(in crate::shapes) const UNIT_CIRCLE: [[f64; 3]; 9] = [
    [1.0, 0.0, 1.0],
    [1.0, 1.0, FRAC_1_SQRT_2],
    [0.0, 1.0, 1.0],
    [-1.0, 1.0, FRAC_1_SQRT_2],
    [-1.0, 0.0, 1.0],
    [-1.0, -1.0, FRAC_1_SQRT_2],
    [0.0, -1.0, 1.0],
    [1.0, -1.0, FRAC_1_SQRT_2],
    [1.0, 0.0, 1.0],
];

/// The knots of [`UNIT_CIRCLE`], degree 2.
pub(in crate::shapes) const UNIT_CIRCLE_KNOTS: [f64; 12] =
    [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];

/// The control points of the right half of [`UNIT_CIRCLE`], from (0, -1) up to (0, 1).
const HALF_CIRCLE: [[f64; 3]; 5] =
    [UNIT_CIRCLE[6], UNIT_CIRCLE[7], UNIT_CIRCLE[0], UNIT_CIRCLE[1], UNIT_CIRCLE[2]];

/// The knots of [`HALF_CIRCLE`], degree 2.
const HALF_CIRCLE_KNOTS: [f64; 8] = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];

/// Returns the circle about `center`, exact, starting at its point of largest x
/// and passing the point of largest y next.
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `radius` is finite and above 0.
pub fn circle(center: [f64; 2], radius: f64) -> Result<PlaneCurve> {
    let radius = positive("radius", radius)?;
    let scaled = |&[x, y, w]: &[f64; 3]| [center[0] + radius * x, center[1] + radius * y, w];
    Ok(PlaneCurve {
        degree: 2,
        knots: UNIT_CIRCLE_KNOTS.to_vec(),
        control_points: UNIT_CIRCLE.iter().map(scaled).collect(),
    })
}

/// Returns the half circle x >= 0 about the origin, exact, from (0, -radius) to
/// (0, radius).
///
/// # Errors
/// `OPTION_OUT_OF_RANGE` unless `radius` is finite and above 0.
pub fn half_circle(radius: f64) -> Result<PlaneCurve> {
    let radius = positive("radius", radius)?;
    Ok(PlaneCurve {
        degree: 2,
        knots: HALF_CIRCLE_KNOTS.to_vec(),
        control_points: HALF_CIRCLE.iter().map(|&[x, y, w]| [radius * x, radius * y, w]).collect(),
    })
}
