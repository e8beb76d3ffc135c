//! Ranges of the distances of a patch from a point, a line or a circle.

use crate::bezier::binomials;
use crate::rounding::{gamma, lower_min, upper_max};
use glam::DVec3;

/// The roundings of a squared distance besides those of its sums: lemma C4 of docs/clearance.md.
const SQUARE_ROUNDINGS: f64 = 48.0;

/// The roundings of the polynomial of a torus, for each control point and besides: lemma C5.
const TORUS_ROUNDINGS: [f64; 2] = [32.0, 512.0];

/// The squared lengths of the points of a patch as a quotient of two polynomials.
pub(super) struct Distances {
    /// The numbers of coefficients along both parameters.
    counts: [usize; 2],
    /// Coefficients of both, times the binomials of the double degrees.
    sums: Vec<[f64; 2]>,
    controls: usize,
    reach: f64,
}

impl Distances {
    /// Takes control points at most `reach` long, with positive weights. O(p² q²).
    pub(super) fn new([p, q]: [usize; 2], points: &[DVec3], weights: &[f64], reach: f64) -> Self {
        let counts = [2 * p + 1, 2 * q + 1];
        let [rows_of, columns_of] = [binomials(p), binomials(q)];
        let share = |index: usize| {
            let [i, j] = [index / (q + 1), index % (q + 1)];
            (i * counts[1] + j, rows_of[i] * columns_of[j] * weights[index])
        };
        let mut sums = vec![[0.0; 2]; counts[0] * counts[1]];
        for (one, a) in points.iter().enumerate() {
            let (at, of_a) = share(one);
            for (two, b) in points.iter().enumerate() {
                let (next, of_b) = share(two);
                let sum = &mut sums[at + next];
                sum[0] += of_a * of_b * a.dot(*b);
                sum[1] += of_a * of_b;
            }
        }
        Self { counts, sums, controls: points.len(), reach }
    }

    /// Returns bounds on the lengths.
    ///
    /// Guarantee (lemma C4): |x|² is a quotient of two sums of Bernstein polynomials with coefficients
    /// N and D > 0, and lies between the least and the largest N / D.
    pub(super) fn range(&self) -> [f64; 2] {
        let [least, largest] = self.squares();
        [if least > 0.0 { least.sqrt() } else { 0.0 }, largest.sqrt()]
    }

    /// Returns bounds on the squared lengths.
    fn squares(&self) -> [f64; 2] {
        let error = gamma(2.0 * self.controls as f64 + SQUARE_ROUNDINGS) * self.reach * self.reach;
        let [least, largest] =
            extremes(self.sums.iter().map(|&[numerator, denominator]| numerator / denominator));
        [least - error, largest + error]
    }

    /// Returns bounds on the distances from a circle of this radius, for the distances from its centre
    /// and from its axis; `None` where none are known. `near` is about the distance.
    ///
    /// Guarantee (lemma C5): with g = |x|² + R² - t², f² - t² is (g² - 4 R² ρ²) / (g + 2 R ρ).
    pub(super) fn range_from_circle(&self, from_axis: &Self, radius: f64, near: f64) -> Option<[f64; 2]> {
        let shift = radius * radius - near * near;
        let shifted: Vec<[f64; 2]> = self.sums.iter().map(|&[n, d]| [n + shift * d, d]).collect();
        let [rows, columns] = self.counts.map(|count| 2 * count - 1);
        let mut sums = vec![[0.0; 2]; rows * columns];
        let place = |index: usize| index / self.counts[1] * columns + index % self.counts[1];
        for (one, [g, d]) in shifted.iter().enumerate() {
            for (two, [h, e]) in shifted.iter().enumerate() {
                let sum = &mut sums[place(one) + place(two)];
                sum[0] += g * h - 4.0 * radius * radius * from_axis.sums[one][0] * e;
                sum[1] += d * e;
            }
        }
        let size = self.reach * self.reach + radius * radius + near * near;
        let roundings = TORUS_ROUNDINGS[0] * self.controls as f64 + TORUS_ROUNDINGS[1];
        let error = gamma(roundings) * size * size;
        let [least, largest] = extremes(sums.iter().map(|&[numerator, denominator]| numerator / denominator));
        let divisor =
            self.squares()[0] + shift + 2.0 * radius * from_axis.range()[0] - gamma(roundings) * size;
        if !(divisor > 0.0) {
            return None;
        }
        let rounding = gamma(roundings) * size;
        // A positive lower bound, or a negative upper one, would need the largest divisor.
        let below = near * near + (least - error).min(0.0) / divisor - rounding;
        let above = near * near + upper_max(0.0, largest + error) / divisor + rounding;
        (below > 0.0).then(|| [below.sqrt(), above.sqrt()])
    }
}

/// Returns the least and the largest of some bounds; NaN bounds nothing.
fn extremes(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    [values.clone().fold(f64::INFINITY, lower_min), values.fold(f64::NEG_INFINITY, upper_max)]
}

/// Returns the parts of the vectors across a direction.
pub(super) fn across(offsets: &[DVec3], direction: DVec3) -> Vec<DVec3> {
    let (x, y) = direction.any_orthonormal_pair();
    offsets.iter().map(|offset| DVec3::new(x.dot(*offset), y.dot(*offset), 0.0)).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The error of lemma C4: that of as many sums, relative to the square of the reach.
    #[test]
    fn squared_distances_have_the_error_of_the_lemma() {
        let [low, high] = Distances::new([1, 1], &[DVec3::X; 4], &[1.0; 4], 3.0).squares();
        let error = gamma(8.0 + SQUARE_ROUNDINGS) * 9.0;
        assert!(low <= 1.0 - 0.99 * error && high >= 1.0 + 0.99 * error, "{low} {high}");
    }

    #[test]
    fn a_point_that_is_not_finite_leaves_no_bound() {
        let mut points = [DVec3::X; 4];
        points[2].y = f64::NAN;
        let all = Distances::new([1, 1], &points, &[1.0; 4], f64::INFINITY);
        assert_eq!(all.range(), [0.0, f64::INFINITY]);
        assert_eq!(all.range_from_circle(&all, 2.0, 1.0), None);
    }

    /// A patch that is one point, at 2 from the axis and 1 above the circle of radius 2.
    #[test]
    fn the_distance_of_a_point_from_a_circle_is_between_its_bounds() {
        let offsets = [DVec3::new(0.0, 2.0, 1.0); 4];
        let of = |points: &[DVec3]| Distances::new([1, 1], points, &[1.0; 4], 5.0_f64.sqrt());
        for near in [1.0, 0.9, 1.1] {
            let found = of(&offsets).range_from_circle(&of(&across(&offsets, DVec3::Z)), 2.0, near);
            let Some([low, high]) = found else { unreachable!("the divisor is about 16") };
            assert!(low <= 1.0 && 1.0 <= high && high - low < 0.2, "{low} {high}");
            // At the distance itself the polynomial is 0, and the lemma's roundings remain: with a
            // size of 10 and a divisor of 16, half of their square's, as the distance is 1.
            let rounding = gamma(32.0 * 4.0 + 512.0) * (10.0 * 10.0 / 16.0 + 10.0) / 2.0;
            let is_attained = |error: f64| (0.99 * rounding..1.01 * rounding).contains(&error);
            assert!(near != 1.0 || (is_attained(1.0 - low) && is_attained(high - 1.0)), "{low} {high}");
        }
    }
}
