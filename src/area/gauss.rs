//! Gauss-Legendre rules on [0, 1].

use std::sync::OnceLock;

/// The largest number of nodes of areas.
pub(super) const MAX_NODES: usize = 24;

/// The largest number of nodes of a rule.
pub(crate) const MAX_RULE: usize = 65;

/// The factor of the error of a rule for a mean value: lemma A1 of docs/area.md.
pub(crate) const GAUSS_FACTOR: f64 = 32.0 / 15.0;

/// The numbers of Newton steps from the asymptotic position of a node: the error is below
/// 0.01 at the start and is squared by every step.
const NEWTON_STEPS: usize = 6;

/// A rule that is exact for polynomials of degree below twice its number of nodes, up to
/// the rounding of its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rule {
    /// The nodes in (0, 1).
    pub(crate) nodes: Vec<f64>,
    /// The weights, positive, with the sum 1.
    pub(crate) weights: Vec<f64>,
}

/// Returns the rule of `count` nodes, 1 to [`MAX_RULE`], computed once.
pub(crate) fn rule(count: usize) -> &'static Rule {
    static RULES: [OnceLock<Rule>; MAX_RULE + 1] = [const { OnceLock::new() }; MAX_RULE + 1];
    RULES[count].get_or_init(|| {
        let nodes: Vec<f64> = (0..count).map(|index| node(count, index)).collect();
        let weight = |&x: &f64| {
            let [_, slope] = legendre(count, x);
            // Half of 2 / ((1 - x²) P'(x)²), which is for an interval of length 2.
            1.0 / ((1.0 - x * x) * slope * slope)
        };
        let weights = nodes.iter().map(weight).collect();
        Rule { nodes: nodes.iter().map(|x| 0.5 + 0.5 * x).collect(), weights }
    })
}

/// Returns zero `index` of the Legendre polynomial of this degree in (-1, 1).
fn node(degree: usize, index: usize) -> f64 {
    let angle = std::f64::consts::PI * (index as f64 + 0.75) / (degree as f64 + 0.5);
    (0..NEWTON_STEPS).fold(angle.cos(), |x, _| {
        let [value, slope] = legendre(degree, x);
        x - value / slope
    })
}

/// Returns the Legendre polynomial of a degree of at least 1 and its derivative at x in (-1, 1).
fn legendre(degree: usize, x: f64) -> [f64; 2] {
    let (mut before, mut value) = (1.0, x);
    for n in 1..degree {
        let n = n as f64;
        (before, value) = (value, ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0));
    }
    [value, degree as f64 * (before - x * value) / (1.0 - x * x)]
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// ∫ (2x - 1)^k over [0, 1] is 1 / (k + 1) for even k and 0 for odd k.
    #[test]
    fn a_rule_is_exact_for_polynomials_below_twice_its_nodes() {
        for count in 1..=MAX_RULE {
            let Rule { nodes, weights } = rule(count);
            let moment = |k: i32| -> f64 {
                nodes.iter().zip(weights).map(|(x, weight)| weight * (2.0 * x - 1.0).powi(k)).sum()
            };
            for k in 0..2 * count as i32 {
                let expected = if k % 2 == 0 { 1.0 / f64::from(k + 1) } else { 0.0 };
                assert!((moment(k) - expected).abs() < 2e-15, "{count} nodes, degree {k}: {}", moment(k));
            }
            // The next one is off by the mean square of the monic Legendre polynomial.
            let next = 1.0 / (2 * count + 1) as f64;
            let square = (1..=count).map(|k| (k * k) as f64 / (4 * k * k - 1) as f64).product::<f64>();
            let off = next - moment(2 * count as i32);
            assert!((off - square).abs() < 2e-15, "{count} nodes: {off} {square}");
        }
    }
}
