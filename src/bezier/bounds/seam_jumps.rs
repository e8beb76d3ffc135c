//! Upper bounds on the jumps of derivatives across the common edge of two patches.

use crate::axis::Axis;
use crate::bezier::{DerivativeBounds, Patch};
use crate::rounding::{gamma, upper_max};
use glam::{DVec3, DVec4, Vec4Swizzles};

/// The highest order of the derivatives whose jumps are bounded, plus one.
const ORDERS: usize = 3;

/// The roundings in a control of a jump, relative to the sum of the absolute values
/// of its terms: four of the change of centre, four of differences, three of the
/// factors, twelve of the scaling by a quotient of spans, off by five each time.
const ROUNDINGS: f64 = 24.0;

/// The binomial coefficients C(row, column).
const BINOMIAL: [[f64; ORDERS]; ORDERS] = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 1.0]];

/// A factor for the rounding of the recursion, whose terms are positive.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-12;

/// Upper bounds on the lengths of the jumps of derivatives at the points of an
/// edge, by the parameters of the patch before it: `bounds[a][b]` of the derivative
/// of order a across the edge and b along it, a + b at most 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SeamJumps {
    pub(crate) bounds: [[f64; ORDERS]; ORDERS],
}

impl SeamJumps {
    /// Returns the bounds for the end of `low` and the start of `high` along
    /// `across`, which are of the same degrees; `of_high` bounds the derivatives of
    /// `high`, and a step of 1 across `low` is one of `ratio` across `high`.
    ///
    /// Lemma (jumps, 3.12 of docs/method.md). Let E and e bound the lengths of the jumps of the homogeneous
    /// derivatives X_ab and w_ab, W the lengths of `low`'s w_ab, x those of `high`'s points,
    /// relative to `low`'s centre, and derivatives, and ω > 0 the weights of `low`,
    /// all on the edge. Then the jumps of the derivatives of X/w are at most
    ///
    /// `j_ab = (E_ab + Σ C(a,i) C(b,k) (W_ik j_(a-i)(b-k) + e_ik x_(a-i)(b-k)) + e_00 x_ab) / ω`
    ///
    /// with the sum over (i, k) ≠ (0, 0).
    ///
    /// The jumps of X_ab and w_ab are Bernstein polynomials along the edge, at most
    /// as long as their coefficients. O(p + q).
    pub(crate) fn between(
        low: &Patch<'_>,
        high: &Patch<'_>,
        of_high: &DerivativeBounds,
        across: Axis,
        ratio: f64,
    ) -> Self {
        let shift = high.center - low.center;
        let [degree, along] = [low.degree[across], low.degree[across.other()]];
        let columns = low.degree[1] + 1;
        let control = |patch: &Patch<'_>, row: usize, index: usize, shift: DVec3| {
            let control = match across {
                Axis::U => patch.controls[row * columns + index],
                Axis::V => patch.controls[index * columns + row],
            };
            (control.xyz() + control.w * shift).extend(control.w)
        };
        // Weights that are all equal have no jumps, and no rounding.
        let weight = low.controls[0].w;
        let is_polynomial = low.controls.iter().chain(high.controls).all(|control| control.w == weight);
        let mut jumps = [[[0.0_f64; 2]; ORDERS]; ORDERS];
        let mut weights = [[0.0_f64; ORDERS]; ORDERS];
        let mut lightest = f64::INFINITY;
        for a in 0..ORDERS.min(degree + 1) {
            let scale = ratio.powi(a as i32);
            let factor = falling_factorial(degree, a);
            // The differences across the edge of both patches, and the sum of the terms' sizes.
            let mut net: Vec<[DVec4; 2]> = Vec::with_capacity(along + 1);
            let mut size = [0.0_f64; 2];
            for index in 0..=along {
                let (mut before, mut after) = (DVec4::ZERO, DVec4::ZERO);
                for (step, binomial) in BINOMIAL[a].iter().enumerate().take(a + 1) {
                    let (of_low, of_high) =
                        (control(low, degree - step, index, DVec3::ZERO), control(high, step, index, shift));
                    let sign = if step % 2 == 0 { 1.0 } else { -1.0 };
                    before += sign * binomial * of_low;
                    // Differences of the second patch go the other way.
                    after += sign * if a % 2 == 0 { 1.0 } else { -1.0 } * binomial * of_high;
                    let length = |control: &DVec4| control.xyz().length();
                    let moved = scale * (length(&of_high) + of_high.w * shift.length());
                    size[0] = upper_max(size[0], length(&of_low) + moved);
                    size[1] = upper_max(size[1], of_low.w + scale * of_high.w);
                    if a == 0 {
                        lightest = if of_low.w < lightest { of_low.w } else { lightest };
                    }
                }
                net.push([factor * (before - scale * after), factor * before]);
            }
            for b in 0..ORDERS - a {
                if b > along {
                    break;
                }
                if b > 0 {
                    for index in 0..=along - b {
                        net[index] = [0, 1].map(|kind| net[index + 1][kind] - net[index][kind]);
                    }
                }
                let factor_along = falling_factorial(along, b);
                let terms = gamma(ROUNDINGS) * factor * factor_along * 2.0_f64.powi((a + b) as i32);
                let mut largest = [0.0_f64; 3];
                for [jump, of_low] in &net[..=along - b] {
                    for (largest, length) in
                        largest.iter_mut().zip([jump.xyz().length(), jump.w.abs(), of_low.w.abs()])
                    {
                        *largest = upper_max(*largest, factor_along * length);
                    }
                }
                let rounded = if is_polynomial { 0.0 } else { size[1] };
                jumps[a][b] = [largest[0] + terms * size[0], largest[1] + terms * rounded];
                weights[a][b] = largest[2] + terms * rounded;
            }
        }
        let lengths = edge_lengths(of_high, across, ratio, shift.length());
        Self { bounds: quotient_jumps(&jumps, &weights, &lengths, lightest) }
    }
}

/// Bounds on points, relative to the other patch's centre, and derivatives of the
/// patch after an edge, by the parameters of the patch before it.
fn edge_lengths(bounds: &DerivativeBounds, across: Axis, ratio: f64, shift: f64) -> [[f64; ORDERS]; ORDERS] {
    let DerivativeBounds { radius, first, second, .. } = bounds;
    let [across_1, along_1, across_2, along_2] = match across {
        Axis::U => [first[0], first[1], second[0], second[2]],
        Axis::V => [first[1], first[0], second[2], second[0]],
    };
    [
        [radius + shift, along_1, along_2],
        [ratio * across_1, ratio * second[1], 0.0],
        [ratio * ratio * across_2, 0.0, 0.0],
    ]
}

/// The recursion of the lemma.
fn quotient_jumps(
    jumps: &[[[f64; 2]; ORDERS]; ORDERS],
    weights: &[[f64; ORDERS]; ORDERS],
    lengths: &[[f64; ORDERS]; ORDERS],
    lightest: f64,
) -> [[f64; ORDERS]; ORDERS] {
    let mut bounds = [[0.0_f64; ORDERS]; ORDERS];
    for order in 0..ORDERS {
        for a in 0..=order {
            let b = order - a;
            let mut sum = jumps[a][b][0] + jumps[0][0][1] * lengths[a][b];
            for i in 0..=a {
                for k in 0..=b {
                    if i + k > 0 {
                        let (left_a, left_b) = (a - i, b - k);
                        let terms =
                            weights[i][k] * bounds[left_a][left_b] + jumps[i][k][1] * lengths[left_a][left_b];
                        sum += BINOMIAL[a][i] * BINOMIAL[b][k] * terms;
                    }
                }
            }
            bounds[a][b] = sum / lightest * ROUNDING_FACTOR;
        }
    }
    bounds
}

fn falling_factorial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64)
}
