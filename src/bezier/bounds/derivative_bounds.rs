//! Upper bounds on a patch's derivatives from its control net.

use crate::bezier::Patch;
use crate::rounding::{gamma, lower_min, upper_max};
use glam::{DVec4, Vec4Swizzles};

/// Upper bounds on the lengths of a patch's derivatives by (s, t) over [0, 1]²,
/// or over the part of it that a function states.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DerivativeBounds {
    /// The largest distance from the patch's centre.
    pub radius: f64,
    /// First derivatives by s and t.
    pub first: [f64; 2],
    /// Second derivatives ss, st, tt.
    pub second: [f64; 3],
    /// Third derivatives sss, sst, stt, ttt.
    pub third: [f64; 4],
}

impl DerivativeBounds {
    /// Makes these bounds hold also where `other` holds; the radius stays.
    pub(crate) fn enclose(&mut self, other: &Self) {
        let pairs = [
            (&mut self.first[..], &other.first[..]),
            (&mut self.second[..], &other.second[..]),
            (&mut self.third[..], &other.third[..]),
        ];
        for (own, other) in pairs {
            for (own, &other) in own.iter_mut().zip(other) {
                *own = upper_max(*own, other);
            }
        }
    }

    /// Returns the bounds by other parameters; an interval of theirs of length 1
    /// of these parameters spans h and k.
    pub(crate) fn rescaled(mut self, [h, k]: [f64; 2]) -> Self {
        for bounds in [&mut self.first[..], &mut self.second, &mut self.third] {
            let order = bounds.len() - 1;
            for (index, bound) in bounds.iter_mut().enumerate() {
                *bound /= h.powi((order - index) as i32) * k.powi(index as i32);
            }
        }
        self
    }
}

/// The highest order of the derivatives bounded, plus one.
const ORDERS: usize = 4;

/// The binomial coefficients C(row, column).
const BINOMIAL: [[f64; ORDERS]; ORDERS] =
    [[1.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0], [1.0, 2.0, 1.0, 0.0], [1.0, 3.0, 3.0, 1.0]];

/// A factor for the rounding of the recursion, whose terms are positive: more than
/// 10^4 rounding errors of 2^-53, where each bound has fewer than 60. It does not
/// cover the differences, which are of the size of rounding on a straight net.
const ROUNDING_FACTOR: f64 = 1.0 + 1e-12;

impl Patch<'_> {
    /// Returns bounds on the first to third derivatives over [0, 1]².
    ///
    /// The derivative of order (a, b) of the homogeneous surface (X, w) has
    /// the control points `p!/(p-a)! q!/(q-b)!` times the differences of the
    /// net, whose largest length is its upper bound: `X_ab`, `w_ab`. Differentiating
    /// `X = w x` by Leibniz' rule and solving for the last term,
    ///
    /// `x_ab <= (X_ab + sum C(a,i) C(b,j) w_ij x_(a-i)(b-j)) / w_min`
    ///
    /// over (i, j) != (0, 0), with `x_00` the radius. The rounding of the
    /// differences is added (lemma R9 of docs/rounding.md). O(p q).
    #[must_use]
    pub fn derivative_bounds(&self) -> DerivativeBounds {
        self.derivative_bounds_within([0.0; 2])
    }

    /// Returns bounds as [`Patch::derivative_bounds`] that hold for every patch
    /// whose homogeneous controls differ from these by at most `error`, in space
    /// and in weight: a difference of order n then differs from this net's by at
    /// most `2^n error`. The bounds are infinite where a weight may be 0.
    pub(in crate::bezier) fn derivative_bounds_within(&self, error: [f64; 2]) -> DerivativeBounds {
        let least = |weight: f64| (weight - error[1]).max(0.0);
        let weight = self.controls.iter().map(|control| least(control.w)).fold(f64::INFINITY, lower_min);
        let mut bounds = [[0.0_f64; ORDERS]; ORDERS];
        let differences = self.difference_bounds(error);
        let radius = |control: &DVec4| (control.xyz().length() + error[0]) / least(control.w);
        bounds[0][0] = self.controls.iter().map(radius).fold(0.0, upper_max);
        for order in 1..ORDERS {
            for a in (0..=order).rev() {
                let b = order - a;
                let mut sum = differences[a][b][0];
                for i in 0..=a {
                    for j in 0..=b {
                        if i + j > 0 {
                            sum +=
                                BINOMIAL[a][i] * BINOMIAL[b][j] * differences[i][j][1] * bounds[a - i][b - j];
                        }
                    }
                }
                bounds[a][b] = sum / weight * ROUNDING_FACTOR;
            }
        }
        DerivativeBounds {
            radius: bounds[0][0],
            first: [bounds[1][0], bounds[0][1]],
            second: [bounds[2][0], bounds[1][1], bounds[0][2]],
            third: [bounds[3][0], bounds[2][1], bounds[1][2], bounds[0][3]],
        }
    }

    /// Returns the largest length and the largest weight of the homogeneous controls.
    pub(in crate::bezier) fn largest_controls(&self) -> [f64; 2] {
        let mut largest = [0.0_f64; 2];
        for control in self.controls {
            let sizes = [control.xyz().length(), control.w];
            largest = [0, 1].map(|kind| upper_max(largest[kind], sizes[kind]));
        }
        largest
    }

    /// Returns, for each order (a, b), the largest length and the largest
    /// weight of the controls of that derivative.
    ///
    /// A subtraction is off by one rounding of its result and by the errors of its two
    /// terms, so the error of a difference is at most one rounding of the largest of its
    /// order and twice the error of the order before (lemma R9 of docs/rounding.md). On a
    /// net that is constant along an axis all of them are 0.
    fn difference_bounds(&self, error: [f64; 2]) -> [[[f64; 2]; ORDERS]; ORDERS] {
        let [p, q] = self.degree;
        let columns = q + 1;
        let mut bounds = [[[0.0; 2]; ORDERS]; ORDERS];
        let mut roundings = [[[0.0; 2]; ORDERS]; ORDERS];
        let mut by_s = self.controls.to_vec();
        for a in 0..ORDERS.min(p + 1) {
            let mut net = by_s[..(p + 1 - a) * columns].to_vec();
            for (b, bound) in bounds[a].iter_mut().enumerate().take((ORDERS - a).min(columns)) {
                let (mut space, mut weight) = (0.0_f64, 0.0_f64);
                for row in net.chunks_exact_mut(columns) {
                    for j in 0..columns - b {
                        let difference = row[j];
                        space = upper_max(space, difference.xyz().length_squared());
                        weight = upper_max(weight, difference.w.abs());
                        if j + b < q {
                            row[j] = row[j + 1] - difference;
                        }
                    }
                }
                let scale = falling_factorial(p, a) * falling_factorial(q, b);
                let terms = 2.0_f64.powi((a + b) as i32);
                let sizes = [space.sqrt(), weight];
                let before = match (a, b) {
                    (0, 0) => None,
                    (_, 0) => Some(roundings[a - 1][0]),
                    _ => Some(roundings[a][b - 1]),
                };
                if let Some(before) = before {
                    roundings[a][b] = [0, 1].map(|kind| gamma(1.0) * sizes[kind] + 2.0 * before[kind]);
                }
                *bound =
                    [0, 1].map(|kind| scale * (sizes[kind] + terms * error[kind] + roundings[a][b][kind]));
            }
            for index in 0..(p - a) * columns {
                by_s[index] = by_s[index + columns] - by_s[index];
            }
        }
        bounds
    }
}

fn falling_factorial(n: usize, k: usize) -> f64 {
    (0..k).fold(1.0, |product, i| product * (n - i) as f64)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::rounding::UNIT_ROUNDOFF;
    use glam::DVec3;

    /// Lemma R9 on a net that is linear along both axes: its differences of orders 2 and 3 are 0,
    /// and their bounds are E_n and the errors of the controls alone.
    #[test]
    fn differences_have_the_errors_of_the_lemma() {
        let controls: Vec<DVec4> =
            (0..16).map(|index| DVec4::new(f64::from(index / 4 + index % 4), 0.0, 0.0, 1.0)).collect();
        let (degree, center) = ([3, 3], DVec3::ZERO);
        let patch = Patch::whole(degree, center, &controls);
        assert_eq!(patch.largest_controls(), [6.0, 1.0]);
        // p! / (p - a)!
        let factor = [1.0, 3.0, 6.0, 6.0];
        for error in [0.0, 1e-3] {
            let bounds = patch.difference_bounds([error, 2.0 * error]);
            for a in 0..ORDERS {
                for b in 0..ORDERS - a {
                    let order = a + b;
                    // E_1 is a rounding of the difference 1, and each further order doubles it.
                    let rounding = [0.0, 1.0, 2.0, 4.0][order] * UNIT_ROUNDOFF;
                    let largest = [6.0, 1.0, 0.0, 0.0][order];
                    let of_controls = error * 2.0_f64.powi(order as i32);
                    let [space, weight] = bounds[a][b].map(|bound| bound / (factor[a] * factor[b]));
                    let lemma = largest + of_controls + rounding;
                    assert!(
                        (lemma - 1e-3 * rounding..=lemma * (1.0 + 1e-15) + 0.02 * rounding).contains(&space),
                        "{space} and {lemma}, order ({a}, {b})"
                    );
                    let lemma = 2.0 * of_controls + if order == 0 { 1.0 } else { 0.0 };
                    assert!((weight - lemma).abs() <= 1e-15, "{weight} and {lemma}, order ({a}, {b})");
                }
            }
        }
    }

    /// Leibniz' rule solved for each derivative in turn, of a rational patch whose controls are off
    /// by known errors, for weights of several sizes along either axis.
    #[test]
    fn bounds_are_those_of_leibniz_rule() {
        let weights = [1.0, 3.0, 2.0, 5.0];
        for (scale, along_t) in [(1.0, false), (1.0, true), (0.125, false), (0.125, true)] {
            let control = |index: usize| {
                let [i, j] = [index / 4, index % 4];
                let w = scale * weights[if along_t { j } else { i }];
                let [i, j] = [i as f64, j as f64];
                let point = DVec3::new(i * i - j, j * j * j - 2.0 * i, i * j);
                (w * point).extend(w)
            };
            let controls: Vec<DVec4> = (0..16).map(control).collect();
            let (degree, center) = ([3, 3], DVec3::ZERO);
            let patch = Patch::whole(degree, center, &controls);
            let error = [0.25 * scale, 0.125 * scale];
            // The largest difference of order (a, b), p! / (p - a)! times.
            let largest = |a: usize, b: usize| {
                let factor = [1.0, 3.0, 6.0, 6.0];
                let mut largest = [0.0_f64; 2];
                for i in 0..4 - a {
                    for j in 0..4 - b {
                        let mut difference = DVec4::ZERO;
                        for k in 0..=a {
                            for l in 0..=b {
                                let sign = if (a + b - k - l).is_multiple_of(2) { 1.0 } else { -1.0 };
                                difference +=
                                    sign * BINOMIAL[a][k] * BINOMIAL[b][l] * controls[(i + k) * 4 + j + l];
                            }
                        }
                        let sizes = [difference.xyz().length(), difference.w.abs()];
                        largest = [0, 1].map(|kind| largest[kind].max(sizes[kind]));
                    }
                }
                let doubled = 2.0_f64.powi((a + b) as i32);
                [0, 1].map(|kind| factor[a] * factor[b] * (largest[kind] + doubled * error[kind]))
            };
            let [x, w] = [0, 1].map(|kind| move |a: usize, b: usize| largest(a, b)[kind]);
            let least = scale - error[1];
            let radius =
                controls.iter().map(|control| (control.xyz().length() + error[0]) / (control.w - error[1]));
            let x00 = radius.fold(0.0, f64::max);
            let x10 = (x(1, 0) + w(1, 0) * x00) / least;
            let x01 = (x(0, 1) + w(0, 1) * x00) / least;
            let x20 = (x(2, 0) + 2.0 * w(1, 0) * x10 + w(2, 0) * x00) / least;
            let x11 = (x(1, 1) + w(1, 0) * x01 + w(0, 1) * x10 + w(1, 1) * x00) / least;
            let x02 = (x(0, 2) + 2.0 * w(0, 1) * x01 + w(0, 2) * x00) / least;
            let x30 = (x(3, 0) + 3.0 * w(1, 0) * x20 + 3.0 * w(2, 0) * x10 + w(3, 0) * x00) / least;
            let x03 = (x(0, 3) + 3.0 * w(0, 1) * x02 + 3.0 * w(0, 2) * x01 + w(0, 3) * x00) / least;
            let along_s = 2.0 * (w(1, 0) * x11 + w(1, 1) * x10) + w(2, 0) * x01 + w(0, 1) * x20;
            let x21 = (x(2, 1) + along_s + w(2, 1) * x00) / least;
            let across_s = 2.0 * (w(0, 1) * x11 + w(1, 1) * x01) + w(0, 2) * x10 + w(1, 0) * x02;
            let x12 = (x(1, 2) + across_s + w(1, 2) * x00) / least;
            let expected = [x00, x10, x01, x20, x11, x02, x30, x21, x12, x03];
            let DerivativeBounds { radius, first, second, third } = patch.derivative_bounds_within(error);
            let found = [&[radius][..], &first, &second, &third].concat();
            for (order, (found, expected)) in found.iter().zip(expected).enumerate() {
                let part = found / expected;
                assert!(
                    (1.0 - 1e-12..=1.0 + 1e-10).contains(&part),
                    "{part} of bound {order}, {scale} {along_t}"
                );
            }
        }
    }
}
