//! Bounds on the first derivatives of a surface.

use super::NurbsSurface;
use crate::axis::Axis;
use glam::DVec3;

/// The roundings of the bound: differences, products, quotients and sums.
const ROUNDING: f64 = 1.0 + 1e-12;

impl NurbsSurface {
    /// Returns upper bounds on `|S_u|` and `|S_v|` over the domain: a move of the
    /// parameters by (Δu, Δv) moves the point by `|S_u| |Δu| + |S_v| |Δv|` or less.
    /// +∞ where the surface jumps.
    ///
    /// With `X = w (S - c)` for the centre c of the control points, `S_u = (X_u - w_u (S - c)) / w`.
    /// The controls of X_u are `p (X_{i+1} - X_i) / (t_{i+p+1} - t_{i+1})`, and of w_u likewise;
    /// `|S - c|` is at most the largest distance of a control point from c. O(size).
    #[must_use]
    pub fn lipschitz_bounds(&self) -> [f64; 2] {
        let points = || self.control_points().iter().map(|&[x, y, z, _]| DVec3::new(x, y, z));
        let (low, high) = points().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
            (low.min(point), high.max(point))
        });
        let center = 0.5 * low + 0.5 * high;
        let radius = points().map(|point| point.distance(center)).fold(0.0, f64::max);
        let least = self.control_points().iter().map(|point| point[3]).fold(f64::INFINITY, f64::min);
        Axis::BOTH.map(|axis| {
            let degree = self.degree()[axis];
            let columns = self.counts()[1];
            let stride = if axis == Axis::U { columns } else { 1 };
            let knots = self.knots(axis);
            let mut largest = 0.0_f64;
            for (index, &[x, y, z, w]) in self.control_points().iter().enumerate() {
                let along = if axis == Axis::U { index / columns } else { index % columns };
                let Some(&[x1, y1, z1, w1]) =
                    (along + 1 < self.counts()[axis]).then(|| &self.control_points()[index + stride])
                else {
                    continue;
                };
                let (span_end, span_start) = (knots[along + degree + 1], knots[along + 1]);
                let from = w * (DVec3::new(x, y, z) - center);
                let to = w1 * (DVec3::new(x1, y1, z1) - center);
                let change = (to - from).length() + radius * (w1 - w).abs();
                if change > 0.0 {
                    largest = largest.max(degree as f64 * change / (span_end - span_start));
                }
            }
            ROUNDING * largest / least
        })
    }
}
