//! Ellipses in which the area density is analytic, and its bound there.

use super::density::Series;
use crate::axis::Axis;
use crate::rounding::gamma;

/// The radii tried: sums of the half-axes of the ellipse with the foci -1 and 1, in ascending order.
pub(super) const RADII: [f64; 18] = [
    1.25, 1.375, 1.5, 1.625, 1.75, 2.0, 2.25, 2.5, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 32.0, 64.0, 256.0, 2048.0,
];

/// An ellipse of one parameter in which |N| / w³ is analytic for all values of the other in
/// the part.
#[derive(Debug, Clone, Copy)]
pub(super) struct Region {
    /// The sum of the half-axes.
    pub(super) radius: f64,
    /// An upper bound on the density's size there.
    pub(super) bound: f64,
}

/// Sizes of the Chebyshev coefficients of N, |N|² and w over a part.
pub(super) struct Sizes {
    counts: [usize; 2],
    numerator: Vec<f64>,
    /// A bound on the rounding of every coefficient of N.
    rounding: f64,
    square_counts: [usize; 2],
    /// Without the constant coefficient.
    square: Vec<f64>,
    square_constant: f64,
    weight_counts: [usize; 2],
    /// Without the constant coefficient, with rounding.
    weight: Vec<f64>,
    /// A lower bound on the constant coefficient of w.
    weight_constant: f64,
}

/// The roundings of a coefficient of |N|², relative to the sum of its terms' sizes, for each of
/// the coefficients of N.
const SQUARE_ROUNDINGS: f64 = 4.0;

impl Sizes {
    pub(super) fn new(series: &Series) -> Self {
        let (square_counts, square) = series.square();
        let mut sizes: Vec<f64> = square.iter().map(|value| value.abs()).collect();
        sizes[0] = 0.0;
        let mut weight: Vec<f64> =
            series.weight.iter().map(|value| value.abs() + series.weight_rounding).collect();
        weight[0] = 0.0;
        Self {
            counts: series.counts,
            numerator: series.numerator.iter().map(|value| value.length()).collect(),
            rounding: series.rounding,
            square_counts,
            square: sizes,
            square_constant: square[0],
            weight_counts: series.weight_counts,
            weight,
            weight_constant: series.weight[0] - series.weight_rounding,
        }
    }

    /// Returns an upper bound on |N|² in the ellipses of these radii, and one on the rounding of
    /// |N|²: that of N moves the square by twice their product, and by its own square.
    fn largest(&self, radii: [f64; 2]) -> [f64; 2] {
        let length = weighted(&self.numerator, self.counts, radii);
        let count = self.numerator.len();
        let moved = self.rounding * weighted(&vec![1.0; count], self.counts, radii);
        let summed = gamma(SQUARE_ROUNDINGS * count as f64) * length * length;
        let rounding = moved * (2.0 * length + moved) + summed;
        [length * length + rounding, rounding]
    }

    /// Returns an upper bound on |N|² over the part, and one on its rounding.
    pub(super) fn square_bound(&self) -> [f64; 2] {
        let rounding = self.largest([1.0; 2])[1];
        [self.square_constant + self.square.iter().sum::<f64>() + rounding, rounding]
    }

    /// Returns the parameter along which |N|² changes more.
    pub(super) fn wider_axis(&self) -> Axis {
        let [mut in_s, mut in_t] = [0.0; 2];
        for (row, sizes) in self.square.chunks_exact(self.square_counts[1]).enumerate() {
            for (column, size) in sizes.iter().enumerate() {
                in_s += if row > 0 { *size } else { 0.0 };
                in_t += if column > 0 { *size } else { 0.0 };
            }
        }
        if in_t > in_s { Axis::V } else { Axis::U }
    }

    /// Returns the largest ellipses that the series prove, for s and for t; `None` where they
    /// prove none for one of them. Any choice is valid: it decides only how many nodes the
    /// quadrature takes.
    pub(super) fn regions(&self) -> Option<[Region; 2]> {
        let largest = |axis| RADII.iter().map_while(|&radius| self.within(axis, radius)).last();
        Some([largest(Axis::U)?, largest(Axis::V)?])
    }

    /// Returns the region of this radius if the density is analytic there: lemma A2 of docs/area.md.
    fn within(&self, axis: Axis, radius: f64) -> Option<Region> {
        let mut radii = [1.0; 2];
        radii[axis] = radius;
        let [_, rounding] = self.largest(radii);
        let change = weighted(&self.square, self.square_counts, radii) + rounding;
        let weight = self.weight_constant - weighted(&self.weight, self.weight_counts, radii);
        let analytic = change < self.square_constant && weight > 0.5 * self.weight_constant;
        let bound = (self.square_constant + change).sqrt() / (weight * weight * weight);
        analytic.then_some(Region { radius, bound })
    }
}

/// Returns `Σ c_ij ρ^i σ^j`, a bound on the series in the ellipses as `|T_j| <= ρ^j` there.
pub(super) fn weighted(sizes: &[f64], counts: [usize; 2], [in_s, in_t]: [f64; 2]) -> f64 {
    let row = |row: &[f64]| row.iter().rev().fold(0.0, |sum, size| sum * in_t + size);
    sizes.chunks_exact(counts[1]).rev().fold(0.0, |sum, sizes| sum * in_s + row(sizes))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use glam::DVec3;
    use std::f64::consts::TAU;

    /// The series of `N = (1 + b x) e_z` in s, over [-1, 1], with weight 1.
    fn linear(b: f64) -> Series {
        Series {
            counts: [2, 1],
            numerator: vec![DVec3::Z, b * DVec3::Z],
            weight_counts: [1, 1],
            weight: vec![1.0],
            rounding: 0.0,
            weight_rounding: 0.0,
        }
    }

    /// N vanishes at -1 / b: no ellipse reaches it, and the bound holds on each.
    #[test]
    fn the_density_is_analytic_and_bounded_in_the_region() {
        for b in [0.02, 0.1, 0.2, 0.3] {
            let Region { radius, bound } = Sizes::new(&linear(b)).regions().unwrap()[0];
            let zero: f64 = 1.0 / b;
            assert!(radius < zero + (zero * zero - 1.0).sqrt(), "{b}: {radius} contains the zero");
            let size = |angle: f64| {
                let (x, y) = (angle.cos() * (radius + 1.0 / radius), angle.sin() * (radius - 1.0 / radius));
                (1.0 + 0.5 * b * x).hypot(0.5 * b * y)
            };
            let largest = (0..64).map(|k| size(TAU * f64::from(k) / 64.0)).fold(0.0, f64::max);
            assert!(largest <= bound && bound <= 1.4 * largest, "{b}: {largest}, {bound}");
        }
    }

    /// Without a part on which N keeps away from 0 there is no region.
    #[test]
    fn a_zero_in_the_part_leaves_no_region() {
        for b in [1.0, 1.5, -2.0] {
            assert!(Sizes::new(&linear(b)).regions().is_none(), "{b}");
        }
    }
}
