//! Ranges of the distances of a patch from a point, a line or a circle, and of its heights above a cone.

use crate::bezier::binomials;
use crate::rounding::{gamma, lower_min, upper_max};
use glam::DVec3;

/// The roundings of a squared distance besides those of its sums: lemma C4 of docs/clearance.md.
const SQUARE_ROUNDINGS: f64 = 48.0;

/// The roundings of the polynomial of a torus, for each control point and besides: lemma C5.
const TORUS_ROUNDINGS: [f64; 2] = [32.0, 512.0];

/// The roundings of the polynomial of a cone, for each control point and besides: lemma C6.
const CONE_ROUNDINGS: [f64; 2] = [2.0, 64.0];

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

impl Distances {
    /// Returns bounds on the heights cos ρ - sin z above a cone, for the distances ρ from its axis and those along it,
    /// `heights`, which are at least `lowest`; `part` has the cosine and the sine of the cone's half angle.
    ///
    /// Guarantee (lemma C6): their product with cos ρ + sin z is cos² ρ² - sin² z².
    pub(super) fn range_from_cone(&self, heights: &Self, lowest: f64, [cos, sin]: [f64; 2]) -> [f64; 2] {
        let [least, largest] = extremes(
            self.sums
                .iter()
                .zip(&heights.sums)
                .map(|(from_axis, along)| (cos * cos * from_axis[0] - sin * sin * along[0]) / from_axis[1]),
        );
        let error =
            gamma(CONE_ROUNDINGS[0] * self.controls as f64 + CONE_ROUNDINGS[1]) * self.reach * self.reach;
        let [below, above] = [error - least, largest + error].map(|bound| upper_max(0.0, bound));
        let rounding = gamma(CONE_ROUNDINGS[1]) * self.reach;
        let lowest = sin * lowest - rounding;
        let divisor = cos * self.range()[0] + lowest - rounding;
        // Near the apex, where the divisor vanishes, heights are at most the root of the product.
        let behind = if lowest < 0.0 { -2.0 * lowest } else { 0.0 };
        let bound = |product: f64| {
            let by_root = product.sqrt() + behind;
            let by_divisor = product / divisor;
            if divisor > 0.0 && by_divisor < by_root { by_divisor } else { by_root }
        };
        [-bound(below) - rounding, bound(above) + rounding]
    }
}

/// Returns the parts of the vectors along a direction, as x.
pub(super) fn along(offsets: &[DVec3], direction: DVec3) -> Vec<DVec3> {
    offsets.iter().map(|offset| DVec3::new(direction.dot(*offset), 0.0, 0.0)).collect()
}

/// Returns the least x; NaN bounds nothing.
pub(super) fn lowest(offsets: &[DVec3]) -> f64 {
    offsets.iter().map(|offset| offset.x).fold(f64::INFINITY, lower_min)
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

    /// A patch that is one point 3 across and 4 along the axis, 0.6 · 3 - 0.8 · 4 above a cone, of whose product with
    /// 0.6 · 3 + 0.8 · 4 the bounds differ by the roundings of lemma C6.
    #[test]
    fn the_height_above_a_cone_is_between_its_bounds() {
        let of = |x: f64| Distances::new([1, 1], &[x * DVec3::X; 4], &[1.0; 4], 5.0);
        let [low, high] = of(3.0).range_from_cone(&of(4.0), 4.0, [0.6, 0.8]);
        assert!(low <= -1.4 && high >= 0.0 && low > -1.4 - 1e-12, "{low} {high}");
        let [low, high] = of(3.0).range_from_cone(&of(4.0), 4.0, [0.8, 0.6]);
        let error = gamma(2.0 * 4.0 + 64.0) * 25.0 / 4.8 + gamma(64.0) * 5.0;
        let is_attained = |found: f64| (0.99 * error..1.5 * error).contains(&found);
        assert!(is_attained(-low) && is_attained(high), "{low:e} {high:e} for {error:e}");
    }

    /// Before the apex, by 0.5, heights are bounded by the way to it.
    #[test]
    fn heights_behind_the_apex_of_a_cone_are_bounded() {
        let of = |x: f64| Distances::new([1, 1], &[x * DVec3::X; 4], &[1.0; 4], 5.0);
        // On the other nappe: 0.8 · 3 + 0.6 · 4 above this one.
        let [low, high] = of(3.0).range_from_cone(&of(-4.0), -4.0, [0.8, 0.6]);
        assert!(low <= 4.8 && (4.8..4.8 + 1e-6).contains(&high), "{low} {high}");
        let none = of(3.0).range_from_cone(&of(f64::NAN), f64::NAN, [0.8, 0.6]);
        assert!(none[0] == f64::NEG_INFINITY && none[1] == f64::INFINITY, "{none:?}");
    }
}
