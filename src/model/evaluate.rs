//! Points of a surface by de Boor's algorithm.

use super::NurbsSurface;
use crate::axis::Axis;
use glam::{DVec3, DVec4, Vec4Swizzles};

impl NurbsSurface {
    /// Returns the point at (u, v); parameters outside the domain are moved to its
    /// edge. O(p q (p + q)).
    #[must_use]
    pub fn point(&self, parameters: [f64; 2]) -> [f64; 3] {
        let [p, q] = self.degree();
        let domain = self.domain();
        let [u, v] = [0, 1].map(|axis| parameters[axis].clamp(domain[axis][0], domain[axis][1]));
        let [row, column] = [(Axis::U, u), (Axis::V, v)].map(|(axis, at)| self.span(axis, at));
        let columns = self.counts()[1];
        let along_v = (0..=p).map(|i| {
            let first = (row - p + i) * columns + column - q;
            let controls = self.control_points()[first..=first + q].iter().map(|&[x, y, z, w]| {
                let point = DVec3::new(x, y, z);
                (w * point).extend(w)
            });
            de_boor(self.knots(Axis::V), column, v, controls.collect())
        });
        let sum = de_boor(self.knots(Axis::U), row, u, along_v.collect());
        (sum.xyz() / sum.w).to_array()
    }

    /// Returns the index of the knot that begins the non-empty span of a parameter.
    fn span(&self, axis: Axis, parameter: f64) -> usize {
        let (knots, degree, count) = (self.knots(axis), self.degree()[axis], self.counts()[axis]);
        let inner = &knots[degree..=count];
        // The end of the domain belongs to the last non-empty span.
        let end = inner.partition_point(|&knot| knot < knots[count]);
        degree + inner.partition_point(|&knot| knot <= parameter).min(end) - 1
    }
}

/// Returns the value at `parameter` of the polynomial of a span with these controls.
fn de_boor(knots: &[f64], span: usize, parameter: f64, mut controls: Vec<DVec4>) -> DVec4 {
    let degree = controls.len() - 1;
    for level in 1..=degree {
        for index in 0..=degree - level {
            let (low, high) = (knots[span - degree + level + index], knots[span + 1 + index]);
            let fraction = (parameter - low) / (high - low);
            controls[index] = (1.0 - fraction) * controls[index] + fraction * controls[index + 1];
        }
    }
    controls[0]
}
