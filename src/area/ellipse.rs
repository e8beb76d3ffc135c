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

/// Sizes of the Chebyshev coefficients of N = M + E, of |M|² and of w over a part. M has the first coefficients
/// along both axes, E all others.
pub(super) struct Sizes<'a> {
    series: &'a Series,
    /// The sizes of N's coefficients, 0 in place of E's.
    kept: Vec<f64>,
    /// The sizes of N's coefficients, 0 in place of M's.
    left: Vec<f64>,
    square_counts: [usize; 2],
    /// The sizes of the coefficients of |M|², without the constant one.
    square: Vec<f64>,
    square_constant: f64,
    /// Without the constant coefficient, with rounding.
    weight: Vec<f64>,
    /// A lower bound on the constant coefficient of w.
    weight_constant: f64,
}

/// The roundings of a coefficient of |M|², relative to the sum of its terms' sizes, for each of
/// the coefficients of M.
const SQUARE_ROUNDINGS: f64 = 4.0;

/// The number of coefficients of N up to which none is left to E: the square of so few takes less than the nodes
/// that a smaller ellipse costs. Statistics of plates and cylinders took 1.2 times as long without it.
const MAX_WHOLE: usize = 64;

/// The radius for which coefficients are left to E: Gauss's rules of seven nodes suffice with it.
const LEFT_RADIUS: f64 = 4.0;

/// The size of E in an ellipse of that radius, relative to N's constant coefficient, for each axis along which
/// coefficients are left to it.
const LEFT_PART: f64 = 0.03;

impl<'a> Sizes<'a> {
    pub(super) fn new(series: &'a Series) -> Self {
        let sizes: Vec<f64> = series.numerator.iter().map(|value| value.length()).collect();
        let block = kept_counts(&sizes, series.counts);
        let columns = series.counts[1];
        let is_kept = |index: usize| index / columns < block[0] && index % columns < block[1];
        let of = |part: bool| {
            let size = |(index, &size): (usize, &f64)| if is_kept(index) == part { size } else { 0.0 };
            sizes.iter().enumerate().map(size).collect::<Vec<f64>>()
        };
        let (square_counts, mut square) = series.square(block);
        let square_constant = std::mem::take(&mut square[0]);
        square.iter_mut().for_each(|value| *value = value.abs());
        let mut weight: Vec<f64> =
            series.weight.iter().map(|value| value.abs() + series.weight_rounding).collect();
        weight[0] = 0.0;
        let weight_constant = series.weight[0] - series.weight_rounding;
        let (kept, left) = (of(true), of(false));
        Self { series, kept, left, square_counts, square, square_constant, weight, weight_constant }
    }

    /// Returns an upper bound on what |N|² differs by from the computed series of |M|² in the ellipses of these
    /// radii, and the part of it that is rounding: what N differs by moves the square by twice their product, and by
    /// its own square.
    fn difference(&self, radii: [f64; 2]) -> [f64; 2] {
        let counts = self.series.counts;
        let length = weighted(&self.kept, counts, radii);
        let left = weighted(&self.left, counts, radii);
        let powers = counts.iter().zip(radii).map(|(&count, radius)| powers(count, radius)).product::<f64>();
        let rounded = self.series.rounding * powers;
        let summed = gamma(SQUARE_ROUNDINGS * self.kept.len() as f64) * (length + left) * (length + left);
        let moved = |by: f64| by * (2.0 * length + by) + summed;
        [moved(left + rounded), moved(rounded)]
    }

    /// Returns an upper bound on |N|² over the part, and one on its rounding.
    pub(super) fn square_bound(&self) -> [f64; 2] {
        let [difference, rounding] = self.difference([1.0; 2]);
        [self.square_constant + self.square.iter().sum::<f64>() + difference, rounding]
    }

    /// Returns the parameter along which |M|² changes more.
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
        let [difference, _] = self.difference(radii);
        let change = weighted(&self.square, self.square_counts, radii) + difference;
        let weight = self.weight_constant - weighted(&self.weight, self.series.weight_counts, radii);
        let analytic = change < self.square_constant && weight > 0.5 * self.weight_constant;
        let bound = (self.square_constant + change).sqrt() / (weight * weight * weight);
        analytic.then_some(Region { radius, bound })
    }
}

/// Returns the numbers of coefficients that M has along both axes: the least for which the others are small beside
/// the constant one in ellipses of [`LEFT_RADIUS`]. Any choice is valid: it decides only how large the ellipses are.
fn kept_counts(sizes: &[f64], counts: [usize; 2]) -> [usize; 2] {
    if sizes.len() <= MAX_WHOLE {
        return counts;
    }
    let mut lines = counts.map(|count| vec![0.0; count]);
    for (index, size) in sizes.iter().enumerate() {
        let place = [index / counts[1], index % counts[1]];
        let grown = size * LEFT_RADIUS.powi(place[0].max(place[1]) as i32);
        for axis in 0..2 {
            lines[axis][place[axis]] += grown;
        }
    }
    let permitted = LEFT_PART * sizes[0];
    lines.map(|line| {
        let mut left = 0.0;
        let is_left = |grown: &&f64| {
            left += **grown;
            left <= permitted
        };
        // The constant coefficient is kept.
        line.len() - line[1..].iter().rev().take_while(is_left).count()
    })
}

/// Returns 1 + ρ + … + ρ^(count − 1) for the radius ρ.
fn powers(count: usize, radius: f64) -> f64 {
    (0..count).fold(0.0, |sum, _| sum * radius + 1.0)
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

    /// The series of N in s with these coefficients along z, so long that some are left to E.
    fn long(coefficients: &[(usize, f64)]) -> Series {
        let mut numerator = vec![DVec3::ZERO; MAX_WHOLE + 1];
        for &(index, size) in coefficients {
            numerator[index] = size * DVec3::Z;
        }
        Series { counts: [numerator.len(), 1], numerator, ..linear(0.0) }
    }

    /// Lemma A6, attained: N = (1 + c T_4) e_z is 1 + c at the ends of the interval, where T_4 is 1.
    #[test]
    fn what_is_left_out_is_attained_at_the_ends() {
        let c = 2e-5;
        let series = long(&[(0, 1.0), (4, c)]);
        let sizes = Sizes::new(&series);
        assert_eq!(sizes.square_counts, [1, 1]);
        let [bound, largest] = [sizes.square_bound()[0], (1.0 + c) * (1.0 + c)];
        assert!(largest <= bound && bound <= largest * (1.0 + 1e-12), "{bound} {largest}");
    }

    /// Coefficients that are left to E count in the bound: N = (1 + b x + c T_4) e_z vanishes in larger ellipses, and
    /// is at most as large as the bound in those that are found.
    #[test]
    fn what_is_left_out_of_the_square_is_part_of_the_bound() {
        let (b, c) = (0.02, 2e-5);
        let series = long(&[(0, 1.0), (1, b), (4, c)]);
        let sizes = Sizes::new(&series);
        assert_eq!(sizes.square_counts, [3, 1]);
        for radius in RADII {
            let size = 1.0 + 0.5 * b * (radius + 1.0 / radius) + 0.5 * c * (radius.powi(4) + radius.powi(-4));
            let Some(Region { bound, .. }) = sizes.within(Axis::U, radius) else { continue };
            assert!(size <= bound, "{radius}: {size} above {bound}");
        }
        let [all, without] =
            [&series, &linear(b)].map(|series| Sizes::new(series).regions().unwrap()[0].radius);
        // At 16 the change of P is 2 b ρ + (b ρ)² / 2 = 0.69, and with c far above 1, as c ρ⁴ = 1.3; at 8 it is 0.33
        // and with c 0.52; at 32 it is above 1.
        assert_eq!([all, without], [8.0, 16.0]);
    }

    /// Without a part on which N keeps away from 0 there is no region.
    #[test]
    fn a_zero_in_the_part_leaves_no_region() {
        for b in [1.0, 1.5, -2.0] {
            assert!(Sizes::new(&linear(b)).regions().is_none(), "{b}");
        }
    }
}
