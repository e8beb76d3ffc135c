//! The numbers of nodes with which Gauss's rules integrate moments.

use crate::area::gauss::{GAUSS_FACTOR, MAX_RULE};
use crate::rounding::gamma;

/// The radii of ellipses tried, sums of the half-axes.
const RADII: [f64; 22] = [
    1.25, 1.375, 1.5, 1.625, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 12.0, 16.0, 32.0,
    64.0, 256.0, 2048.0, 16384.0,
];

/// The error aimed at, relative to the bound on the density: two digits below the width of a volume.
const MAX_ERROR: f64 = 1e-13;

/// The largest number of nodes before a part is halved, for each degree, and besides: 3 for each degree are those
/// of a polynomial of the numerator's degree, which halving does not lower.
const MAX_NODES: [usize; 2] = [3, 20];

/// More than the roundings of an error, powers by repeated multiplication among them, relative to it.
const ERROR_ROUNDINGS: f64 = 1024.0;

/// The largest order of a moment.
const MAX_ORDER: usize = 2;

/// How a moment's density depends on one parameter: a polynomial over a power of the weight.
#[derive(Debug, Clone)]
pub(super) enum Dependence {
    /// The weight does not depend on the parameter, and the density of order j is a polynomial of
    /// degree (3 + j) p − 1.
    Polynomial { degree: usize },
    /// The density of order j is a polynomial of degree (4 + j) p − 2 over w to the power 4 + j.
    Rational {
        degree: usize,
        /// Upper bounds on the sizes of the Chebyshev coefficients of w by their index in this parameter, summed
        /// over the other's; the first one is without the constant coefficient.
        sizes: Vec<f64>,
        /// A lower bound on the constant coefficient.
        constant: f64,
    },
}

/// A number of nodes along one parameter, with the error of the mean for each order of moments, relative to a
/// bound on their densities.
#[derive(Debug, Clone, Copy)]
pub(super) struct Nodes {
    pub(super) count: usize,
    pub(super) errors: [f64; MAX_ORDER + 1],
    /// The same for what the rounding of a node moves a mean by, relative to that of the node times the mean
    /// of 1 / √(1 − x²).
    pub(super) slopes: [f64; MAX_ORDER + 1],
}

impl Dependence {
    /// Returns the nodes, or `None` where a part is to be halved first.
    pub(super) fn nodes(&self) -> Option<Nodes> {
        match self {
            Self::Polynomial { degree } => {
                let degrees = [3, 4, 5].map(|factor| factor * degree - 1);
                let count = degrees[MAX_ORDER] / 2 + 1;
                (count <= MAX_RULE).then_some(Nodes {
                    count,
                    errors: [0.0; MAX_ORDER + 1],
                    slopes: degrees.map(|degree| degree as f64),
                })
            }
            Self::Rational { degree, .. } => {
                let choices = RADII.iter().filter_map(|&radius| self.within(radius));
                let most = MAX_NODES[0] * degree + MAX_NODES[1];
                choices.min_by_key(|nodes| nodes.count).filter(|nodes| nodes.count <= most)
            }
        }
    }

    /// Returns the widest bounds there are, for a part that is halved no further.
    pub(super) fn any_nodes(&self) -> Nodes {
        let unknown = [f64::INFINITY; MAX_ORDER + 1];
        self.nodes().unwrap_or(Nodes { count: 2, errors: unknown, slopes: unknown })
    }

    /// Returns the number of nodes that suffices by the ellipse of this radius (lemma V2 of docs/facts.md);
    /// `None` where the weight may vanish in it.
    fn within(&self, radius: f64) -> Option<Nodes> {
        let Self::Rational { degree, sizes, constant } = self else { return None };
        let change = |radius: f64| sizes.iter().rev().fold(0.0, |sum, size| sum * radius + size);
        let (least, most) = (constant - change(radius), constant + change(1.0));
        if !(least > 0.0) {
            return None;
        }
        let powers = [4_i32, 5, 6];
        let degrees = powers.map(|power| power * *degree as i32 - 2);
        let ratio = most / least;
        let bound = |order: usize| radius.powi(degrees[order]) * ratio.powi(powers[order]) * GAUSS_FACTOR;
        let square = radius * radius;
        let closed = 1.0 - 1.0 / square;
        let needed = (bound(MAX_ORDER) / (closed * MAX_ERROR)).ln() / square.ln();
        // NaN and infinite needs are more than any rule has.
        if !(needed < MAX_RULE as f64) {
            return None;
        }
        let count = if needed > 2.0 { needed.ceil() as usize } else { 2 };
        let rounding = 1.0 + gamma(ERROR_ROUNDINGS);
        let errors = [0, 1, 2].map(|order| bound(order) * square.powi(-(count as i32)) / closed * rounding);
        // f = P / w^k has the slope P' / w^k − k f w' / w, by Bernstein's inequality for both polynomials.
        let variation = change(1.0) / (constant - change(1.0));
        let slopes = [0, 1, 2].map(|order| {
            let power = f64::from(powers[order]);
            (f64::from(degrees[order]) + power * *degree as f64 * variation)
                * (most / (constant - change(1.0))).powi(powers[order])
        });
        Some(Nodes { count, errors, slopes })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    /// Lemmas V2 and A1, written out: for one of the radii the errors are those of the ellipse's bound, with 32/15
    /// for A1's factor, and that of the second moments is within the error aimed at.
    #[test]
    fn errors_are_those_of_the_lemma() {
        let (constant, [first, second]) = (1.0, [0.05, 0.01]);
        let dependence = Dependence::Rational { degree: 2, sizes: vec![0.0, first, second], constant };
        let found = dependence.nodes().unwrap();
        let of_lemma = |radius: f64, order: i32| {
            let change = first * radius + second * radius * radius;
            let ratio = (constant + first + second) / (constant - change);
            let bound = radius.powi((4 + order) * 2 - 2) * ratio.powi(4 + order);
            let nodes = found.count as i32;
            32.0 / 15.0 * bound * radius.powi(-2 * nodes) / (1.0 - radius.powi(-2))
        };
        let matches = |radius: f64| {
            (0..3).all(|order| {
                let exact = of_lemma(radius, order);
                let error = found.errors[order as usize];
                (1.0..1.0 + 1e-9).contains(&(error / exact))
            })
        };
        assert!(RADII.into_iter().any(matches), "{found:?}");
        assert!(found.errors[2] <= MAX_ERROR * 1.001 && found.errors[2] > 0.0, "{found:?}");
    }
}
