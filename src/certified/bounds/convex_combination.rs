//! The bound for cells whose nearest patch changes inside, by any number of
//! competing patches.
//!
//! Lemma (3.7 of docs/method.md). For weights `λ_k >= 0` of sum 1 and maps φ_k of the cell into patches
//! of B, `d(a, B)² <= Σ λ_k |A - B∘φ_k|²` at every point a of the cell.
//!
//! Where the distance has a maximum at which several patches are equally near,
//! their squared distances have gradients with 0 in their convex hull. With
//! those weights the combination has no slope, and its bound is of second order
//! where that of every single patch is of first. Two parameters need three
//! patches at most (Carathéodory's theorem).

use super::super::maximin::{AffineFunction, linearized_distance_squared, maximin};
use super::taylor::{Bounds, CellPair, Difference, coefficient_error, max_coefficient};
use crate::certified::audit::Lemma;
use crate::certified::cell_context::{CellContext, UpperBound};
use glam::DVec3;

/// The bound by the known feet of the centre on different patches.
pub(super) struct ConvexCombination;

/// One patch's part: the Bernstein coefficients of `|Q|²`, its weight, and its
/// difference from A.
type Term<'a> = ([[f64; 5]; 5], f64, Difference<'a>);

impl UpperBound for ConvexCombination {
    fn lemma(&self) -> Lemma {
        Lemma::ConvexCombination
    }

    /// `None` also where one patch alone is best.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64> {
        let feet = context.feet.all();
        if feet.len() == 1 {
            return None;
        }
        let b = &context.pair.b;
        let to_first_order =
            feet.iter().map(|foot| linearized(context, b.patch(foot.patch).point(foot.parameters)));
        let multipliers = maximin(&to_first_order.collect::<Vec<_>>()).multipliers;
        if multipliers.iter().any(|(_, weight)| *weight == 1.0) {
            return None;
        }
        let context = &*context;
        let pairs: Vec<(CellPair<'_>, f64)> = multipliers
            .into_iter()
            .filter(|(_, weight)| *weight > 0.0)
            .map(|(index, weight)| (CellPair::new(context, &feet[index]), weight))
            .collect();
        let terms: Vec<Term<'_>> = pairs
            .iter()
            .map(|(pair, weight)| {
                let difference = pair.difference();
                (difference.quadratic.length_squared(), *weight, difference)
            })
            .collect();
        let by_patches = upper_bound(&terms, |difference| difference.remainder(Bounds::Patch));
        let may_suffice = || upper_bound(&terms, |_| 0.0) <= threshold;
        if by_patches > threshold && may_suffice() {
            return Some(upper_bound(&terms, |difference| difference.remainder(Bounds::Local)));
        }
        Some(by_patches)
    }
}

/// The squared distance to a point over the cell, to first order.
fn linearized(context: &CellContext<'_>, point: DVec3) -> AffineFunction {
    let half = context.cell.half;
    linearized_distance_squared(&context.jet, point, half.map(|half| -half), half)
}

/// An upper bound on `(|Q| + R)² - |Q|²`, where the coefficients of `|Q|²` are at most
/// `largest` and each is off by `error` (lemma R8).
fn increase(largest: f64, error: f64, remainder: f64) -> f64 {
    error + remainder * (2.0 * (largest + error).sqrt() + remainder)
}

/// The root of the largest coefficient of the combination of `(|Q| + R)²`.
fn upper_bound(terms: &[Term<'_>], remainder: impl Fn(&Difference<'_>) -> f64) -> f64 {
    let mut combination = [[0.0_f64; 5]; 5];
    for (squares, weight, difference) in terms {
        let remainder = remainder(difference);
        let increase =
            increase(max_coefficient(squares), coefficient_error(&difference.quadratic), remainder);
        for (sum, square) in combination.iter_mut().flatten().zip(squares.iter().flatten()) {
            *sum += weight * (square + increase);
        }
    }
    max_coefficient(&combination).sqrt()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::increase;

    #[test]
    fn the_increase_is_that_of_the_square() {
        // (1.1 + 0.5)² - 1 with 1.1² = 1 + 0.21.
        assert!((increase(1.0, 0.21, 0.5) - 1.56).abs() <= 1e-15);
        assert_eq!(increase(4.0, 0.0, 1.0), 5.0);
    }
}
