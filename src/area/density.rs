//! The area density of a patch over a part of its parameters, as polynomials.

use crate::approximation::bernstein::Linear;
use crate::approximation::chebyshev::{coefficients, nodes};
use crate::bezier::{HomogeneousTangents, Patch};
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// Numerator and weight of the area density of a patch.
///
/// With the homogeneous point `(X, w)`, `S_s × S_t = N / w³` for
/// `N = w X_s × X_t - w_t X_s × X - w_s X × X_t`, a polynomial of degree 3p - 2 in s and
/// 3q - 2 in t; where all weights are one, of degree 2p - 1 and 2q - 1, as `N = w X_s × X_t`
/// with a constant w. The area is the integral of `|N| / w³`.
pub(crate) struct Density<'a> {
    patch: &'a Patch<'a>,
    /// A bound on the rounding of a computed N and, relative to the largest weight, of w.
    pub(crate) rounding: f64,
    pub(crate) weight_rounding: f64,
    /// The smallest weight of a control point, which is a lower bound on w.
    pub(crate) least_weight: f64,
    /// An upper bound on |N|.
    pub(crate) largest: f64,
}

/// The Chebyshev coefficients of N and w over a part of [0, 1]², t fastest.
pub(super) struct Series {
    /// The numbers of coefficients of N in s and t.
    pub(super) counts: [usize; 2],
    pub(super) numerator: Vec<DVec3>,
    pub(super) weight_counts: [usize; 2],
    pub(super) weight: Vec<f64>,
    /// Bounds on the rounding of every coefficient of N and of w.
    pub(super) rounding: f64,
    pub(super) weight_rounding: f64,
}

impl Series {
    /// Returns the numbers of coefficients of |M|² in s and t, and the coefficients, by
    /// `2 T_i T_j = T_(i+j) + T_|i-j|`, for the first coefficients M of N along both axes.
    /// O(coefficients of M²).
    pub(super) fn square(&self, [rows, columns]: [usize; 2]) -> ([usize; 2], Vec<f64>) {
        let counts = [2 * rows - 1, 2 * columns - 1];
        let mut square = vec![0.0; counts[0] * counts[1]];
        let coefficient = |index: usize| {
            let place = (index / columns, index % columns);
            (place, self.numerator[place.0 * self.counts[1] + place.1])
        };
        for first in 0..rows * columns {
            let ((i, j), a) = coefficient(first);
            for second in first..rows * columns {
                let ((k, l), b) = coefficient(second);
                // Both orders of two factors.
                let product = if second == first { 0.25 } else { 0.5 } * a.dot(b);
                for row in [i + k, i.abs_diff(k)] {
                    square[row * counts[1] + j + l] += product;
                    square[row * counts[1] + j.abs_diff(l)] += product;
                }
            }
        }
        (counts, square)
    }
}

/// The roundings of a factor of N for each degree, and besides them: lemma R5 of
/// docs/rounding.md counts 4 and 2 for a point, and a derivative has one more difference. The
/// rounding of a node moves each of them by its slope, at most twice its degree: 4 nodes' units.
const FACTOR_ROUNDINGS: [f64; 2] = [12.0, 4.0];
/// The roundings of the products and sums of N.
const PRODUCT_ROUNDINGS: f64 = 8.0;

impl<'a> Density<'a> {
    /// Makes the density of a patch. O(p q).
    pub(crate) fn new(patch: &'a Patch<'a>) -> Self {
        let [p, q] = patch.degree.map(|degree| degree as f64);
        let [each, more] = FACTOR_ROUNDINGS;
        let factor = gamma(each * (p + q) + more);
        let Sizes { point, first: [s, t] } = Sizes::new(patch);
        // The errors of a point, of its derivatives and of theirs: basis functions sum to 1, their
        // derivatives to at most twice the degree.
        let errors = [1.0, 2.0 * p, 2.0 * q].map(|size| point.map(|largest| factor * size * largest));
        let [[e, e_w], [e_s, e_ws], [e_t, e_wt]] = errors;
        let [x, w] = point;
        let [[x_s, w_s], [x_t, w_t]] = [s, t];
        let plain = w * (e_s * x_t + x_s * e_t + e_s * e_t);
        let rational = e_w * x_s * x_t
            + e_wt * x_s * x
            + w_t * (e_s * x + x_s * e)
            + e_ws * x_t * x
            + w_s * (e_t * x + x_t * e);
        let products = w * x_s * x_t + if patch.rational { w_t * x_s * x + w_s * x_t * x } else { 0.0 };
        let rounding =
            plain + if patch.rational { rational } else { 0.0 } + gamma(PRODUCT_ROUNDINGS) * products;
        let least_weight = patch.controls.iter().map(|control| control.w).fold(f64::INFINITY, f64::min);
        Self {
            patch,
            // Twice, for the products of two errors.
            rounding: 2.0 * rounding,
            weight_rounding: if patch.rational { e_w } else { 0.0 },
            least_weight,
            largest: products * (1.0 + gamma(PRODUCT_ROUNDINGS)),
        }
    }

    /// Returns about the number of products that [`Series::square`] takes.
    pub(super) fn work(&self) -> usize {
        let coefficients: usize = counts(self.patch).iter().product();
        coefficients * coefficients / 2
    }

    /// Returns an upper bound on the density where |N| is at most `numerator`.
    pub(crate) fn upper_bound(&self, numerator: f64) -> f64 {
        let weight = self.least_weight;
        numerator / (weight * weight * weight) * (1.0 + gamma(PRODUCT_ROUNDINGS))
    }

    /// Returns N and w at all pairs of these parameters, the second fastest.
    pub(super) fn values(&self, parameters: [&[f64]; 2]) -> Vec<(DVec3, f64)> {
        let numerator = |at: &HomogeneousTangents| (self.numerator(at), at.point.w);
        self.patch.homogeneous_tangents(parameters).iter().map(numerator).collect()
    }

    /// Returns N for a homogeneous point with its derivatives.
    pub(crate) fn numerator(&self, at: &HomogeneousTangents) -> DVec3 {
        let ([x, s, t], w) = ([at.point, at.s, at.t].map(|value| value.xyz()), at.point.w);
        let product = w * s.cross(t);
        if self.patch.rational { product - at.t.w * s.cross(x) - at.s.w * x.cross(t) } else { product }
    }

    /// Returns the Chebyshev series over a part of [0, 1]², which is constant along an axis where the part has no width.
    /// O(degree³).
    pub(super) fn series(&self, part: ParamBox) -> Series {
        let is_line = part.lengths().map(|length| length == 0.0);
        let of_line = |counts: [usize; 2]| [0, 1].map(|axis| if is_line[axis] { 1 } else { counts[axis] });
        let counts = of_line(counts(self.patch));
        let [in_s, in_t] = [0, 1].map(|axis| {
            let [start, end] = part[axis];
            nodes(counts[axis]).map(|x| start + x * (end - start)).collect::<Vec<f64>>()
        });
        let (numerators, weights): (Vec<DVec3>, Vec<f64>) = self.values([&in_s, &in_t]).into_iter().unzip();
        let weight_counts =
            if self.patch.rational { of_line(self.patch.degree.map(|degree| degree + 1)) } else { [1, 1] };
        let largest = numerators.iter().map(|value| value.length()).fold(0.0, f64::max);
        let heaviest = weights.iter().copied().fold(0.0, f64::max);
        // A coefficient is a mean of values times at most 2 for each axis.
        let transform = gamma(counts.iter().map(|&count| count as f64 + 4.0).sum());
        Series {
            counts,
            numerator: tensor_coefficients(&numerators, counts, counts),
            weight_counts,
            weight: tensor_coefficients(&weights, counts, weight_counts),
            rounding: 4.0 * (self.rounding + transform * largest),
            weight_rounding: 4.0 * (self.weight_rounding + transform * heaviest),
        }
    }
}

/// Upper bounds on the lengths and weights of a patch's homogeneous points and derivatives.
struct Sizes {
    point: [f64; 2],
    first: [[f64; 2]; 2],
}

impl Sizes {
    fn new(patch: &Patch<'_>) -> Self {
        let columns = patch.degree[1] + 1;
        let size = |vector: DVec4| [vector.xyz().length(), vector.w.abs()];
        let larger = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].max(b[1])];
        let (mut point, mut first) = ([0.0; 2], [[0.0; 2]; 2]);
        for (index, &control) in patch.controls.iter().enumerate() {
            point = larger(point, size(control));
            let neighbours = [patch.controls.get(index + columns), patch.controls.get(index + 1)];
            let has_next = [true, (index + 1) % columns != 0];
            for axis in 0..2 {
                if let (Some(&next), true) = (neighbours[axis], has_next[axis]) {
                    let derivative = patch.degree[axis] as f64 * (next - control);
                    first[axis] = larger(first[axis], size(derivative));
                }
            }
        }
        Self { point, first }
    }
}

/// Returns the numbers of coefficients of N in s and t.
fn counts(patch: &Patch<'_>) -> [usize; 2] {
    patch.degree.map(|degree| if patch.rational { 3 * degree - 1 } else { 2 * degree })
}

/// Returns the first `kept` coefficients along both axes of the polynomial with these values
/// at the nodes.
pub(crate) fn tensor_coefficients<T: Linear>(values: &[T], counts: [usize; 2], kept: [usize; 2]) -> Vec<T> {
    let rows: Vec<Vec<T>> = values.chunks_exact(counts[1]).map(coefficients).collect();
    let columns: Vec<Vec<T>> = (0..kept[1])
        .map(|column| coefficients(&rows.iter().map(|row| row[column]).collect::<Vec<T>>()))
        .collect();
    (0..kept[0]).flat_map(|row| columns.iter().map(move |column| column[row])).collect()
}
