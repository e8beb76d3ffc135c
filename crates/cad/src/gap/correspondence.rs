//! Parameters of an edge as a function of those of a part of a curve.

use super::local::{Ends, Local};
use super::nearest::nearest;
use std::array::from_fn;
use std::f64::consts::PI;

/// A polynomial on [-1, 1] that increases or decreases throughout, so that it maps the part
/// onto that of the edge.
pub(super) struct Correspondence {
    /// The Chebyshev coefficients.
    coefficients: Vec<f64>,
    /// The middle of the edge's part.
    pub(super) middle: f64,
}

/// The degree of the correspondence by nearest points: arcs of a quarter turn whose
/// parameters are angles and tangents agree to about 1e-10.
const DEGREE: usize = 12;

impl Correspondence {
    pub(super) fn affine([start, end]: [f64; 2]) -> Self {
        let middle = 0.5 * (start + end);
        Self { coefficients: vec![middle, 0.5 * (end - start)], middle }
    }

    /// Returns the interpolant of the parameters of nearest points at the extrema of a
    /// Chebyshev polynomial, with the ends as they are; `None` if it may not be monotone.
    pub(super) fn nearest(local: &Local<'_>, [(t0, s0), (t1, s1)]: Ends) -> Option<Self> {
        let cosines: [f64; 2 * DEGREE] = from_fn(|k| (PI / DEGREE as f64 * k as f64).cos());
        let mut values = [s1; DEGREE + 1];
        values[DEGREE] = s0;
        let mut near = s1;
        for (k, value) in values.iter_mut().enumerate().take(DEGREE).skip(1) {
            let x = cosines[k];
            let t = 0.5 * (t0 + t1) + 0.5 * (t1 - t0) * x;
            let starts = [near, local.lifted.corresponding(t)];
            near = nearest(local.on_surface(t), starts, [s0, s1], |s| local.edge_jet(s));
            *value = near;
        }
        let halved = |index: usize| if index == 0 || index == DEGREE { 0.5 } else { 1.0 };
        let coefficient = |j: usize| {
            let term = |(k, value): (usize, &f64)| halved(k) * cosines[j * k % (2 * DEGREE)] * value;
            2.0 / DEGREE as f64 * halved(j) * values.iter().enumerate().map(term).sum::<f64>()
        };
        let coefficients: Vec<f64> = (0..=DEGREE).map(coefficient).collect();
        // |T_j'| is at most j².
        let slopes = coefficients.iter().enumerate().skip(2).map(|(j, value)| (j * j) as f64 * value.abs());
        (slopes.sum::<f64>() < coefficients[1].abs())
            .then_some(Self { coefficients, middle: 0.5 * (s0 + s1) })
    }

    /// Returns the parameter of the edge, by Clenshaw's recurrence.
    pub(super) fn parameter(&self, x: f64) -> f64 {
        let (mut next, mut after) = (0.0, 0.0);
        for &coefficient in self.coefficients[1..].iter().rev() {
            (next, after) = (coefficient + 2.0 * x * next - after, next);
        }
        self.coefficients[0] + x * next - after
    }

    /// Returns an upper bound on the distance of the parameters from that at 0, within the
    /// ellipse of ρ, where `|T_j| ≤ (ρ^j + ρ^-j) / 2 ≤ ρ^j`, or on [-1, 1] for ρ = 1.
    pub(super) fn reach(&self, rho: f64) -> f64 {
        let from_zero = self.coefficients[0] - self.parameter(0.0);
        self.coefficients[1..].iter().rev().fold(0.0, |sum, value| rho * (sum + value.abs()))
            + from_zero.abs()
    }
}
