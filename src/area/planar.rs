//! Areas of parts that lie in a plane, by the flux of their normals along its own: lemma A4 of docs/area.md.
//!
//! The flux has no root in it, so that poles and corners without an angle, where a normal is 0, are as smooth as
//! the rest. Most faces of parts are plane.

use super::MAX_RELATIVE_WIDTH;
use super::cell::{AXIS_SHARE, MIN_NODES, axis_error, moved_node};
use super::density::Series;
use super::ellipse::{RADII, weighted};
use super::gauss::MAX_NODES;
use crate::approximation::chebyshev::{MAX_BERNSTEIN, bernstein_condition, to_bernstein};
use crate::axis::Axis;
use crate::rounding::{gamma, lower_min, upper_max, upper_min};
use glam::DVec3;

/// The part of the area, relative to its permitted width, that normals may be off the plane's own.
const MAX_ASTRAY: f64 = 0.0625 * MAX_RELATIVE_WIDTH;

/// The roundings of a coefficient in the Bernstein basis for each number of them.
const CONVERSION_ROUNDINGS: f64 = 8.0;

/// The rule for one parameter, and the error of the mean by it.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisRule {
    pub(super) count: usize,
    pub(super) error: f64,
    /// What the error of the nodes and weights adds.
    pub(super) moved: f64,
}

/// A part whose normals N are about those of a plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Planar {
    /// The plane's unit normal n.
    pub(super) direction: DVec3,
    /// An upper bound on |N| - N·n.
    pub(super) astray: f64,
    pub(super) rules: [AxisRule; 2],
}

impl Planar {
    /// Returns the plane that a part lies in; `None` if the part is not plane, or if it folds over itself.
    pub(super) fn of(series: &Series) -> Option<Self> {
        let direction = series.numerator[0].try_normalize()?;
        let along: Vec<f64> = series.numerator.iter().map(|one| one.dot(direction)).collect();
        let count = along.len() as f64;
        let own: f64 = along.iter().map(|one| one.abs()).sum();
        let across: f64 =
            series.numerator.iter().zip(&along).map(|(one, along)| (one - along * direction).length()).sum();
        let rounding = count * series.rounding + gamma(CONVERSION_ROUNDINGS * count) * own;
        let across = across + rounding;
        let permitted = MAX_ASTRAY * along[0];
        if !(across <= permitted) {
            return None;
        }
        let least = least_bernstein(&along, series.counts)? - rounding;
        let against = if least < 0.0 { -2.0 * least } else { 0.0 };
        let astray = (across + against) * (1.0 + gamma(CONVERSION_ROUNDINGS));
        if !(astray <= permitted) {
            return None;
        }
        let sizes: Vec<f64> = along.iter().map(|one| one.abs() + series.rounding).collect();
        let rule = |axis| axis_rule(series, &sizes, axis);
        Some(Self { direction, astray, rules: [rule(Axis::U)?, rule(Axis::V)?] })
    }
}

/// Returns a lower bound on the polynomial with these Chebyshev coefficients, by its Bernstein coefficients; `None`
/// where its degree is too high.
fn least_bernstein(along: &[f64], counts: [usize; 2]) -> Option<f64> {
    let degrees = counts.map(|count| count - 1);
    if degrees.into_iter().any(|degree| degree > MAX_BERNSTEIN) {
        return None;
    }
    let rows: Vec<Vec<f64>> =
        along.chunks_exact(counts[1]).map(|row| to_bernstein(row, degrees[1])).collect();
    let columns = (0..counts[1]).map(|column| rows.iter().map(|row| row[column]).collect::<Vec<f64>>());
    let least = columns.flat_map(|column| to_bernstein(&column, degrees[0])).fold(f64::INFINITY, lower_min);
    let largest = along.iter().map(|one| one.abs()).fold(0.0, upper_max);
    let condition: f64 = degrees.into_iter().map(bernstein_condition).product();
    let roundings = CONVERSION_ROUNDINGS * (counts[0] + counts[1]) as f64;
    Some(least - gamma(roundings) * condition * largest)
}

/// Returns the rule of the fewest nodes that is narrow enough along one parameter, by lemma A1 for the flux, which is
/// analytic where the weight is not 0; `None` where no rule is.
fn axis_rule(series: &Series, sizes: &[f64], axis: Axis) -> Option<AxisRule> {
    let weights: Vec<f64> = series.weight.iter().map(|one| one.abs() + series.weight_rounding).collect();
    let constant = series.weight[0] - series.weight_rounding;
    // The radii whose ellipses the weight keeps away from 0, with a bound on the flux there.
    let bounded = |&radius: &f64| {
        let mut radii = [1.0; 2];
        radii[axis] = radius;
        let change = weighted(&weights, series.weight_counts, radii) - weights[0];
        let weight = constant - change * (1.0 + gamma(CONVERSION_ROUNDINGS * weights.len() as f64));
        let bound = weighted(sizes, series.counts, radii) / (weight * weight * weight);
        (weight > 0.5 * constant)
            .then_some((radius, bound * (1.0 + gamma(CONVERSION_ROUNDINGS * sizes.len() as f64))))
    };
    let regions: Vec<(f64, f64)> = RADII.iter().map_while(bounded).collect();
    let least = |of: &dyn Fn(f64) -> f64| {
        regions.iter().map(|&(radius, bound)| bound * of(radius)).fold(f64::INFINITY, upper_min)
    };
    let mean = series.numerator[0].length() / (constant * constant * constant);
    let rule = |count| AxisRule {
        count,
        error: least(&|radius| axis_error(radius, count)),
        moved: least(&moved_node),
    };
    (MIN_NODES..=MAX_NODES).map(rule).find(|rule| rule.error <= AXIS_SHARE * MAX_RELATIVE_WIDTH * mean)
}
