//! Normals of patches with collapsed edges, divided by what vanishes there: lemma A5 of docs/area.md.
//!
//! Where an edge is a point, as at poles and at tips, N is 0 along it, and |N| is no analytic function there. Its
//! quotient by the distance from the edge in parameters is.

use super::MAX_RELATIVE_WIDTH;
use super::density::Series;
use crate::axis::Axis;
use crate::rounding::gamma;
use glam::DVec3;

/// The part of the area, relative to its permitted width, that the remainder of a division may take.
const MAX_REMAINDER: f64 = 0.0625 * MAX_RELATIVE_WIDTH;

/// The roundings of a coefficient of the remainder.
const REMAINDER_ROUNDINGS: f64 = 8.0;

/// N as the product of a quotient M and of factors 1 + x or 1 - x, up to a remainder, x being a parameter of the part
/// in [-1, 1].
pub(super) struct Divided {
    /// M, exactly as its coefficients are.
    pub(super) quotient: Series,
    /// The number of factors in s and in t.
    pub(super) factors: [i32; 2],
    /// An upper bound on the remainder.
    pub(super) remainder: f64,
}

impl Divided {
    /// Divides N by the factors of all edges along which it vanishes; `None` if it vanishes along no edge.
    pub(super) fn of(series: &Series) -> Option<Self> {
        let mut divided: Option<Self> = None;
        for axis in Axis::BOTH {
            for sign in [1.0, -1.0] {
                let (of, factors, before) = match &divided {
                    Some(found) => (&found.quotient, found.factors, found.remainder),
                    None => (series, [0; 2], 0.0),
                };
                let Some((quotient, remainder)) = quotient(of, axis, sign) else { continue };
                // Each factor that it is multiplied by is at most 2.
                let remainder = before + 2.0_f64.powi(factors[0] + factors[1]) * remainder;
                let mut factors = factors;
                factors[axis as usize] += 1;
                divided = Some(Self { quotient, factors, remainder });
            }
        }
        divided
    }

    /// Returns an upper bound on the product of the factors, for a parameter along one axis in the ellipse of a radius.
    pub(super) fn largest_factor(&self, axis: Axis, radius: f64) -> f64 {
        let within = 1.0 + 0.5 * (radius + 1.0 / radius);
        let size = |of: Axis| if of == axis { within } else { 2.0 }.powi(self.factors[of as usize]);
        size(Axis::U) * size(Axis::V) * (1.0 + gamma(REMAINDER_ROUNDINGS))
    }
}

/// Returns the quotient by 1 + sign x along an axis, and a bound on the remainder; `None` where N does not vanish.
///
/// For `(1 + σ x) Σ m_k T_k = Σ c_k T_k` the products `x T_k = (T_(k+1) + T_(k-1)) / 2` give the m_k from the last one
/// on. Whatever they are, what is left of the c_k is the remainder.
fn quotient(series: &Series, axis: Axis, sign: f64) -> Option<(Series, f64)> {
    let [rows, columns] = series.counts;
    let (count, across) = if axis == Axis::U { (rows, columns) } else { (columns, rows) };
    let place = |k: usize, line: usize| if axis == Axis::U { k * columns + line } else { line * columns + k };
    if count < 2 {
        return None;
    }
    let permitted = MAX_REMAINDER * series.numerator[0].length();
    let at_edge = |line: usize| {
        let term =
            |k: usize| series.numerator[place(k, line)] * if k.is_multiple_of(2) { 1.0 } else { -sign };
        (0..count).map(term).sum::<DVec3>().length()
    };
    if !((0..across).map(at_edge).sum::<f64>() <= permitted) {
        return None;
    }
    let mut counts = series.counts;
    counts[axis as usize] -= 1;
    let mut numerator = vec![DVec3::ZERO; counts[0] * counts[1]];
    let (mut left, mut sizes) = (0.0, 0.0);
    for line in 0..across {
        let given: Vec<DVec3> = (0..count).map(|k| series.numerator[place(k, line)]).collect();
        let found = quotient_of_line(&given, sign);
        let m = |k: usize| found.get(k).copied().unwrap_or(DVec3::ZERO);
        for (k, &c) in given.iter().enumerate() {
            let below = if k == 1 {
                2.0 * m(0)
            } else if k == 0 {
                DVec3::ZERO
            } else {
                m(k - 1)
            };
            left += (c - (m(k) + 0.5 * sign * (below + m(k + 1)))).length();
            sizes += c.length() + 2.0 * m(k).length();
        }
        for (k, &m) in found.iter().enumerate() {
            let column = if axis == Axis::U { k * counts[1] + line } else { line * counts[1] + k };
            numerator[column] = m;
        }
    }
    let count = series.numerator.len() as f64;
    let remainder =
        (left + count * series.rounding) * (1.0 + gamma(count)) + gamma(REMAINDER_ROUNDINGS + count) * sizes;
    let quotient = Series { counts, numerator, rounding: 0.0, weight: series.weight.clone(), ..*series };
    (remainder <= permitted).then_some((quotient, remainder))
}

/// Returns the coefficients of the quotient of one series, of two coefficients at least.
fn quotient_of_line(given: &[DVec3], sign: f64) -> Vec<DVec3> {
    let mut found = vec![DVec3::ZERO; given.len() + 1];
    for k in (2..given.len()).rev() {
        found[k - 1] = 2.0 * sign * (given[k] - found[k]) - found[k + 1];
    }
    found[0] = sign * (given[1] - found[1]) - 0.5 * found[2];
    found.truncate(given.len() - 1);
    found
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// `N = (1 + σ x) (4 + x + y) e_z` in s for x and t for y, with weight 1 and something added to the constant.
    fn vanishing(sign: f64, more: f64) -> Series {
        // (1 + σ x) (4 + x + y) = (4 + σ/2) T_0 + (1 + 4 σ) T_1 + (σ/2) T_2 + (1 + σ x) y.
        let rows = [[4.0 + 0.5 * sign + more, 1.0], [1.0 + 4.0 * sign, sign], [0.5 * sign, 0.0]];
        Series {
            counts: [3, 2],
            numerator: rows.concat().into_iter().map(|one| one * DVec3::Z).collect(),
            weight_counts: [1, 1],
            weight: vec![1.0],
            rounding: 0.0,
            weight_rounding: 0.0,
        }
    }

    #[test]
    fn the_factor_of_a_collapsed_edge_is_divided_out() {
        for sign in [1.0, -1.0] {
            let Divided { quotient, factors, remainder } = Divided::of(&vanishing(sign, 0.0)).unwrap();
            assert_eq!((quotient.counts, factors), ([2, 2], [1, 0]));
            let expected = [4.0, 1.0, 1.0, 0.0];
            let off = quotient.numerator.iter().zip(expected).map(|(one, z)| one.distance(z * DVec3::Z));
            assert!(off.sum::<f64>() < 1e-14 && remainder < 1e-13, "{remainder}");
        }
    }

    /// What does not vanish is no factor, and what nearly does is in the remainder.
    #[test]
    fn the_remainder_holds_what_is_not_zero_at_the_edge() {
        assert!(Divided::of(&vanishing(1.0, 1e-3)).is_none());
        let more = 1e-8;
        let Divided { remainder, .. } = Divided::of(&vanishing(1.0, more)).unwrap();
        assert!(more <= remainder && remainder < 1.001 * more, "{remainder}");
    }

    /// The bound on the factors is attained where the ellipse meets the axis.
    #[test]
    fn factors_are_bounded_in_the_ellipse() {
        let divided = Divided::of(&vanishing(1.0, 0.0)).unwrap();
        for radius in [1.25, 2.0, 8.0] {
            let size = |angle: f64| {
                let (x, y) = (angle.cos() * (radius + 1.0 / radius), angle.sin() * (radius - 1.0 / radius));
                (1.0 + 0.5 * x).hypot(0.5 * y)
            };
            let largest = (0..64).map(|k| size(TAU * f64::from(k) / 64.0)).fold(0.0, f64::max);
            let bound = divided.largest_factor(Axis::U, radius);
            assert!(largest <= bound && bound <= largest * (1.0 + 1e-12), "{radius}: {largest}, {bound}");
        }
        assert!((divided.largest_factor(Axis::V, 8.0) - 2.0).abs() < 1e-12);
    }
}
