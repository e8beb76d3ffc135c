//! Lengths in space of lengths in the parameters.

use crate::brep::nurbs::{SurfaceNet, project};
use glam::DVec3;

/// Bounds of a surface in the parameters of its NURBS.
#[derive(Debug, Clone, Copy)]
pub(super) struct Metric {
    /// Upper bounds on |S_u| and |S_v| over the domain.
    pub(super) speeds: [f64; 2],
    /// The diagonal of the box of the control points.
    pub(super) size: f64,
}

impl Metric {
    /// With `X = w (S - c)` for the centre c of the control points, `S_u = (X_u - w_u (S -
    /// c)) / w`; the controls of X_u are `p (X_{i+1} - X_i) / (t_{i+p+1} - t_{i+1})`, and
    /// |S - c| is at most the largest distance of a control point from c.
    pub(super) fn of(net: &SurfaceNet) -> Self {
        let points = || net.controls.iter().map(|&control| project(control));
        let low = points().fold(DVec3::INFINITY, DVec3::min);
        let high = points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let center = 0.5 * low + 0.5 * high;
        let radius = points().map(|point| point.distance(center)).fold(0.0, f64::max);
        let least = net.controls.iter().map(|control| control.w).fold(f64::INFINITY, f64::min);
        let columns = net.knots[1].len() - net.degrees[1] - 1;
        let speeds = [0, 1].map(|axis| {
            let (degree, knots) = (net.degrees[axis], &net.knots[axis]);
            let stride = if axis == 0 { columns } else { 1 };
            let count = knots.len() - degree - 1;
            let mut largest = 0.0_f64;
            for (index, from) in net.controls.iter().enumerate() {
                let along = if axis == 0 { index / columns } else { index % columns };
                if along + 1 == count {
                    continue;
                }
                let to = net.controls[index + stride];
                let relative = |control: glam::DVec4| control.w * (project(control) - center);
                let change = relative(to).distance(relative(*from)) + radius * (to.w - from.w).abs();
                if change > 0.0 {
                    largest =
                        largest.max(degree as f64 * change / (knots[along + degree + 1] - knots[along + 1]));
                }
            }
            largest / least
        });
        Self { speeds, size: low.distance(high) }
    }

    /// Returns an upper bound on the length in space of a difference of parameters.
    pub(super) fn length(&self, difference: DVec3) -> f64 {
        let [u, v] = self.speeds;
        let part =
            |speed: f64, difference: f64| if difference == 0.0 { 0.0 } else { speed * difference.abs() };
        part(u, difference.x) + part(v, difference.y)
    }
}
