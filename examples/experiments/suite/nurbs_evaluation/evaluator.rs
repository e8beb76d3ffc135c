//! Evaluation of a NURBS surface from its own knots and control points.

use glam::{DVec3, DVec4, Vec4Swizzles};
use nurbs_hausdorff::internals::bezier::MAX_ORDER;
use nurbs_hausdorff::{Axis, NurbsSurface};

/// A surface with its homogeneous control points and their Greville abscissae.
pub(super) struct NurbsEvaluator<'a> {
    surface: &'a NurbsSurface,
    controls: Vec<DVec4>,
    greville: [Vec<f64>; 2],
}

type Values = [f64; MAX_ORDER];

impl<'a> NurbsEvaluator<'a> {
    pub(super) fn new(surface: &'a NurbsSurface) -> Self {
        let homogeneous = |&[x, y, z, w]: &[f64; 4]| DVec4::new(w * x, w * y, w * z, w);
        let greville = Axis::BOTH.map(|axis| {
            let degree = surface.degree()[axis];
            let [start, end] = surface.domain()[axis];
            let mean = |knots: &[f64]| knots.iter().sum::<f64>() / degree as f64;
            (0..surface.counts()[axis])
                .map(|index| mean(&surface.knots(axis)[index + 1..=index + degree]).clamp(start, end))
                .collect()
        });
        Self { surface, controls: surface.control_points().iter().map(homogeneous).collect(), greville }
    }

    /// Returns the point at (u, v) and its first derivatives (Piegl and Tiller, *The
    /// NURBS Book*, algorithms A2.1 and A2.3, eq. 4.20).
    fn jet(&self, at: [f64; 2]) -> [DVec3; 3] {
        let [(row, in_u), (column, in_v)] = Axis::BOTH.map(|axis| self.basis(axis, at[axis]));
        let degree = self.surface.degree();
        let columns = self.surface.counts()[1];
        let [mut h, mut u, mut v] = [DVec4::ZERO; 3];
        for (i, (value_u, slope_u)) in in_u[0].iter().zip(&in_u[1]).enumerate().take(degree[0] + 1) {
            let first = (row + i) * columns + column;
            let line = &self.controls[first..=first + degree[1]];
            let sum =
                |values: &Values| line.iter().zip(values).fold(DVec4::ZERO, |sum, (&c, &b)| sum + b * c);
            let value = sum(&in_v[0]);
            h += value_u * value;
            u += slope_u * value;
            v += value_u * sum(&in_v[1]);
        }
        let point = h.xyz() / h.w;
        [point, (u.xyz() - u.w * point) / h.w, (v.xyz() - v.w * point) / h.w]
    }

    /// Returns the index of the first basis function of the span of `t`, and the
    /// values and derivatives of the functions that do not vanish there.
    fn basis(&self, axis: Axis, t: f64) -> (usize, [Values; 2]) {
        let knots = self.surface.knots(axis);
        let (degree, count) = (self.surface.degree()[axis], self.surface.counts()[axis]);
        let span = knots[degree..count].partition_point(|&knot| knot <= t).max(1) - 1 + degree;
        let mut values = [0.0; MAX_ORDER];
        values[0] = 1.0;
        let mut below = values;
        for order in 1..=degree {
            below = values;
            let mut saved = 0.0;
            for index in 0..order {
                let (low, high) = (knots[span + 1 + index - order], knots[span + 1 + index]);
                let part = below[index] / (high - low);
                values[index] = saved + (high - t) * part;
                saved = (t - low) * part;
            }
            values[order] = saved;
        }
        let mut derivatives = [0.0; MAX_ORDER];
        for index in 0..degree {
            let (low, high) = (knots[span + 1 + index - degree], knots[span + 1 + index]);
            let part = degree as f64 * below[index] / (high - low);
            derivatives[index] -= part;
            derivatives[index + 1] += part;
        }
        (span - degree, [values, derivatives])
    }

    /// Returns the distance from `target` at the end of the 2012 paper's iteration over
    /// the whole domain, which starts at the control point nearest to the target.
    pub(super) fn tangent_plane(&self, target: DVec3, steps: u32, tolerance: f64) -> f64 {
        let distance_squared = |control: &DVec4| (control.xyz() / control.w).distance_squared(target);
        let nearest = (0..self.controls.len())
            .map(|index| (distance_squared(&self.controls[index]), index))
            .fold((f64::INFINITY, 0), |best, candidate| if candidate.0 < best.0 { candidate } else { best })
            .1;
        let columns = self.surface.counts()[1];
        let mut at = [self.greville[0][nearest / columns], self.greville[1][nearest % columns]];
        let mut jet = self.jet(at);
        for _ in 0..steps {
            let previous = jet[0].distance(target);
            let [point, u, v] = jet;
            let residual = target - point;
            let [uu, uv, vv] = [u.dot(u), u.dot(v), v.dot(v)];
            let [gu, gv] = [residual.dot(u), residual.dot(v)];
            let determinant = uu * vv - uv * uv;
            if determinant <= 0.0 {
                break;
            }
            let step = [(vv * gu - uv * gv) / determinant, (uu * gv - uv * gu) / determinant];
            let domain = self.surface.domain();
            at = [0, 1].map(|axis| (at[axis] + step[axis]).clamp(domain[axis][0], domain[axis][1]));
            jet = self.jet(at);
            if (jet[0].distance(target) - previous).abs() < tolerance {
                break;
            }
        }
        jet[0].distance(target)
    }
}
