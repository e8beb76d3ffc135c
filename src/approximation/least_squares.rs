//! Least squares by terms that are added one by one (modified Gram and Schmidt).
//!
//! No bound rests on what is found here: it names functions, whose values are bounded anew.

/// The part of a term's values that must not depend on those of the terms before it.
const MIN_INDEPENDENCE: f64 = 1e-5;

/// Values at some points, and what is left of them beside the terms that are nearest to them in sum.
pub(crate) struct LeastSquares<C> {
    residual: C,
    /// The terms' values made orthonormal, with how they depend on those before.
    columns: Vec<C>,
    dependences: Vec<Vec<f64>>,
    shares: Vec<f64>,
}

impl<C: AsRef<[f64]> + AsMut<[f64]>> LeastSquares<C> {
    /// Begins without terms.
    pub(crate) fn new(values: C) -> Self {
        Self { residual: values, columns: Vec::new(), dependences: Vec::new(), shares: Vec::new() }
    }

    /// What is left of the values.
    pub(crate) fn residual(&self) -> &[f64] {
        self.residual.as_ref()
    }

    /// Adds a term with these values and returns true, unless it depends on those before. O(terms points).
    pub(crate) fn add(&mut self, mut column: C) -> bool {
        let size = length(column.as_ref());
        let mut dependences = Vec::with_capacity(self.columns.len() + 1);
        for earlier in &self.columns {
            dependences.push(remove(column.as_mut(), earlier.as_ref()));
        }
        let rest = length(column.as_ref());
        let is_independent = rest > MIN_INDEPENDENCE * size;
        if is_independent {
            column.as_mut().iter_mut().for_each(|value| *value /= rest);
            dependences.push(rest);
            self.shares.push(remove(self.residual.as_mut(), column.as_ref()));
            self.columns.push(column);
            self.dependences.push(dependences);
        }
        is_independent
    }

    /// The factors of the terms that were added, in order.
    pub(crate) fn factors(&self) -> Vec<f64> {
        let mut factors = self.shares.clone();
        for later in (0..factors.len()).rev() {
            let dependences = &self.dependences[later];
            factors[later] /= dependences[later];
            let factor = factors[later];
            for (earlier, dependence) in factors[..later].iter_mut().zip(dependences) {
                *earlier -= factor * dependence;
            }
        }
        factors
    }
}

fn length(column: &[f64]) -> f64 {
    dot(column, column).sqrt()
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(left, right)| left * right).sum()
}

/// Takes from a column its part along a unit one, and returns that part's length.
fn remove(column: &mut [f64], unit: &[f64]) -> f64 {
    let share = dot(column, unit);
    for (value, unit) in column.iter_mut().zip(unit) {
        *value -= share * unit;
    }
    share
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    const PLACES: [f64; 5] = [-1.0, -0.25, 0.5, 1.0, 2.0];

    /// The factors of a sum of terms are found, a term that depends on the others is refused, and what is left is normal
    /// to all terms.
    #[test]
    fn the_factors_of_a_sum_are_found() {
        let terms = [PLACES.map(|_| 1.0), PLACES, PLACES.map(|x| 3.0 * x - 2.0), PLACES.map(|x| x * x)];
        let odd = [1.0, -2.0, 0.5, 0.25, -0.125];
        let values = |share: f64| {
            std::array::from_fn::<f64, 5, _>(|k| {
                0.5 - 2.0 * PLACES[k] + 4.0 * PLACES[k].powi(2) + share * odd[k]
            })
        };
        let mut exact = LeastSquares::new(values(0.0));
        assert_eq!(terms.map(|term| exact.add(term)), [true, true, false, true]);
        for (factor, expected) in exact.factors().into_iter().zip([0.5, -2.0, 4.0]) {
            assert!((factor - expected).abs() < 1e-14, "{factor} {expected}");
        }
        assert!(length(exact.residual()) < 1e-14);
        let mut inexact = LeastSquares::new(values(1.0));
        terms.iter().for_each(|term| {
            inexact.add(*term);
        });
        assert!(length(inexact.residual()) > 0.1);
        assert!(terms.iter().all(|term| dot(inexact.residual(), term).abs() < 1e-13));
        // The residual is the values less the terms with their factors.
        let factors = inexact.factors();
        for (k, left) in inexact.residual().iter().enumerate() {
            let sum = factors[0] + factors[1] * PLACES[k] + factors[2] * PLACES[k].powi(2);
            assert!((values(1.0)[k] - sum - left).abs() < 1e-14);
        }
    }

    /// A term counts as one of its own by a hundred-thousandth of it.
    #[test]
    fn terms_that_nearly_depend_on_others_are_refused() {
        for (share, is_added) in [(2e-5, true), (5e-6, false), (0.0, false)] {
            let mut squares = LeastSquares::new(vec![0.0; 2]);
            assert!(squares.add(vec![1.0, 0.0]));
            assert_eq!(squares.add(vec![1.0, share]), is_added, "{share}");
        }
    }
}
