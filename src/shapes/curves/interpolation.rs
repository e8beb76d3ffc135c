//! Interpolating cubic splines.

use crate::approximation::elimination::eliminated;
use crate::shapes::PlaneCurve;
use crate::shapes::curves::clamped_knots;
use glam::DVec3;

/// The degree of the splines.
pub(in crate::shapes) const DEGREE: usize = 3;

/// Returns the cubic B-spline curve that interpolates `point(i / (count - 1))` at
/// the parameters i / (count - 1), i = 0 .. count - 1; `count` is at least 4.
///
/// This is global interpolation (Piegl and Tiller, *The NURBS Book*, algorithm
/// A9.1). For evenly spaced parameters, the knots by averaging (eq. 9.8) are the
/// parameters themselves without the two next to the ends. O(count²).
pub(in crate::shapes) fn interpolate(count: usize, point: impl Fn(f64) -> [f64; 2]) -> PlaneCurve {
    let spline = UniformSpline::new(count);
    let sites = (0..count).map(|index| {
        let [x, y] = point(index as f64 / (count - 1) as f64);
        DVec3::new(x, y, 0.0)
    });
    let solution = spline.through(sites.collect());
    let control_points = solution.into_iter().map(|DVec3 { x, y, .. }| [x, y, 1.0]).collect();
    PlaneCurve { degree: DEGREE, knots: spline.knots, control_points }
}

/// The space of cubic splines over [0, 1] that are determined by their values at
/// the sites i / (count - 1), i = 0 .. count - 1.
pub(in crate::shapes) struct UniformSpline {
    /// The clamped knots.
    pub(in crate::shapes) knots: Vec<f64>,
    /// The value of every basis function (columns) at every site (rows).
    rows: Vec<Vec<f64>>,
}

impl UniformSpline {
    /// Builds the interpolation matrix; `count` is at least 4. O(count²).
    pub(in crate::shapes) fn new(count: usize) -> Self {
        let parameter = |index: usize| index as f64 / (count - 1) as f64;
        let mut knots = clamped_knots(DEGREE, count);
        for (inner, knot) in knots[DEGREE + 1..count].iter_mut().enumerate() {
            *knot = parameter(inner + 2);
        }
        let rows = (0..count).map(|index| basis(&knots, DEGREE, count, parameter(index))).collect();
        Self { knots, rows }
    }

    /// Returns the control points of the spline with these values at the sites. O(count²).
    pub(in crate::shapes) fn through(&self, values: Vec<DVec3>) -> Vec<DVec3> {
        eliminated(self.rows.clone(), values)
    }
}

/// The values of all `count` basis functions of one degree (algorithm A2.2).
pub(in crate::shapes) fn basis(knots: &[f64], degree: usize, count: usize, parameter: f64) -> Vec<f64> {
    let span = knots.partition_point(|&knot| knot <= parameter).clamp(degree + 1, count) - 1;
    let mut values = vec![0.0; count];
    values[span] = 1.0;
    for current in 1..=degree {
        for index in span - current..=span {
            let rising = if index > span - current {
                let (start, end) = (knots[index], knots[index + current]);
                (parameter - start) / (end - start) * values[index]
            } else {
                0.0
            };
            let falling = if index < span {
                let (start, end) = (knots[index + 1], knots[index + current + 1]);
                (end - parameter) / (end - start) * values[index + 1]
            } else {
                0.0
            };
            values[index] = rising + falling;
        }
    }
    values
}
