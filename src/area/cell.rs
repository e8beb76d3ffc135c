//! The area of one patch over a part of its parameters, as an interval.

use super::collapsed::Divided;
use super::density::Density;
use super::ellipse::{Region, Sizes};
use super::gauss::{GAUSS_FACTOR, MAX_NODES, rule};
use super::planar::Planar;
use super::{Area, MAX_RELATIVE_WIDTH, QUADRATURE_SHARE};
use crate::axis::Axis;
use crate::param_box::ParamBox;
use crate::rounding::gamma;
use glam::DVec3;

/// The part of the allowed relative width that the error along one parameter may take: both
/// count on both sides, and the bound of a density exceeds its mean.
pub(super) const AXIS_SHARE: f64 = 0.0625;

/// The smallest number of nodes for which that lemma holds.
pub(super) const MIN_NODES: usize = 2;

/// The error of a node of a rule in [-1, 1], and that of all weights together, relative to their sum.
const RULE_ERROR: f64 = 8.0 * f64::EPSILON;

/// The number of times that a bound on |N|² exceeds the rounding of its terms at least if
/// halving makes it smaller.
const MIN_RESOLVED: f64 = 4.0;

/// The roundings of a density `|N| / w³` and of its sum over nodes.
const DENSITY_ROUNDINGS: f64 = 16.0 + (MAX_NODES * MAX_NODES) as f64;

/// A part of a patch's parameters with its area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) part: ParamBox,
    pub(super) area: Area,
    /// The parameter to halve for a narrower area, `None` if it is narrow enough or if
    /// rounding takes most of its width.
    pub(super) halve: Option<Axis>,
}

impl Cell {
    /// Computes the area over `part`: narrow by quadrature where it is plane (A4), or where the density, divided by the
    /// factors of collapsed edges (A5), is proven to be analytic in ellipses wide enough (A2); else between 0 and an
    /// upper bound.
    pub(super) fn new(density: &Density<'_>, part: ParamBox) -> Self {
        let series = density.series(part);
        if let Some(plane) = Planar::of(&series) {
            return Self::planar(density, part, &plane);
        }
        if let Some(divided) = Divided::of(&series)
            && let Some(mut regions) = Sizes::new(&divided.quotient).regions()
        {
            for (region, axis) in regions.iter_mut().zip(Axis::BOTH) {
                region.bound *= divided.largest_factor(axis, region.radius);
            }
            // Once for the integral, and once at the nodes.
            return Self::regular(density, part, regions, 2.0 * density.upper_bound(divided.remainder));
        }
        let sizes = Sizes::new(&series);
        match sizes.regions() {
            Some(regions) => Self::regular(density, part, regions, 0.0),
            None => {
                let [bound, rounding] = sizes.square_bound();
                let upper = part_size(part) * density.upper_bound(bound.sqrt());
                let resolved = bound > MIN_RESOLVED * rounding;
                let halve = resolved.then(|| sizes.wider_axis());
                Self { part, area: Area { lower: 0.0, upper }, halve }
            }
        }
    }

    /// Computes the area over a part by quadrature: lemmas A1 and A3 of docs/area.md. The density may differ by `astray`
    /// from the function that is analytic in the regions.
    fn regular(density: &Density<'_>, part: ParamBox, regions: [Region; 2], astray: f64) -> Self {
        let counts = regions.map(|region| node_count(region.radius));
        let errors = [0, 1].map(|axis| regions[axis].bound * axis_error(regions[axis].radius, counts[axis]));
        let moved: f64 = regions.iter().map(|region| region.bound * moved_node(region.radius)).sum();
        let Mean { value, rounding } = mean(density, part, counts, |numerator| numerator.length());
        let error = errors[0] + errors[1];
        let off = (error + moved + rounding + astray) * (1.0 + gamma(DENSITY_ROUNDINGS));
        let scale = part_size(part);
        let area = Area { lower: (scale * (value - off)).max(0.0), upper: scale * (value + off) };
        let narrow =
            2.0 * error <= QUADRATURE_SHARE * MAX_RELATIVE_WIDTH * value || error <= moved + rounding;
        let worse = if errors[1] > errors[0] { Axis::V } else { Axis::U };
        Self { part, area, halve: (!narrow).then_some(worse) }
    }

    /// Computes the area over a part in a plane, by quadrature of the flux along its normal: lemmas A1, A3 and A4.
    fn planar(density: &Density<'_>, part: ParamBox, plane: &Planar) -> Self {
        let counts = plane.rules.map(|rule| rule.count);
        let Mean { value, rounding } =
            mean(density, part, counts, |numerator| numerator.dot(plane.direction));
        let off = plane.rules.iter().map(|rule| rule.error + rule.moved).sum::<f64>() + rounding;
        let off = off * (1.0 + gamma(DENSITY_ROUNDINGS));
        let scale = part_size(part);
        let above = off + density.upper_bound(plane.astray);
        let least = value - off;
        let lower = if least > 0.0 { scale * least } else { 0.0 };
        Self { part, area: Area { lower, upper: scale * (value + above) }, halve: None }
    }

    /// Returns the width of the area.
    pub(super) fn width(&self) -> f64 {
        self.area.upper - self.area.lower
    }
}

/// Returns the size of the part, exact for parts made by halving.
pub(super) fn part_size(part: ParamBox) -> f64 {
    let [width, height] = part.lengths();
    width * height
}

/// Returns the number of nodes, at most [`MAX_NODES`], for an error that is allowed.
fn node_count(radius: f64) -> usize {
    let is_enough = |&count: &usize| axis_error(radius, count) <= AXIS_SHARE * MAX_RELATIVE_WIDTH;
    (MIN_NODES..MAX_NODES).find(is_enough).unwrap_or(MAX_NODES)
}

/// Returns the error of the mean along one parameter, relative to the bound in the region.
pub(super) fn axis_error(radius: f64, count: usize) -> f64 {
    let square = radius * radius;
    GAUSS_FACTOR * square.powi(-(count as i32)) / (1.0 - 1.0 / square)
}

/// Returns what the error of a rule's nodes and weights moves a mean by, relative to the bound
/// in the region: a node that is off moves the value by the slope, which Cauchy's formula
/// bounds by the distance of the ellipse from the interval.
pub(super) fn moved_node(radius: f64) -> f64 {
    let distance = (radius - 1.0) * (radius - 1.0) / (2.0 * radius);
    RULE_ERROR * (1.0 + 1.0 / distance)
}

/// The mean of a density at the nodes of two rules, with a bound on the rounding.
struct Mean {
    value: f64,
    rounding: f64,
}

/// Returns the mean over `part` of a size of N over w³, by Gauss's rules with these numbers of nodes (lemma A3). The
/// size changes by at most what N changes by.
fn mean(density: &Density<'_>, part: ParamBox, counts: [usize; 2], size: impl Fn(DVec3) -> f64) -> Mean {
    let rules = counts.map(rule);
    let [in_s, in_t] = [0, 1].map(|axis| {
        let [start, end] = part[axis];
        rules[axis].nodes.iter().map(|x| start + x * (end - start)).collect::<Vec<f64>>()
    });
    let values = density.values([&in_s, &in_t]);
    let mut mean = Mean { value: 0.0, rounding: 0.0 };
    for (row, in_s) in values.chunks_exact(counts[1]).zip(&rules[0].weights) {
        for (&(numerator, weight), in_t) in row.iter().zip(&rules[1].weights) {
            let cube = weight * weight * weight;
            let value = size(numerator) / cube;
            mean.value += in_s * in_t * value;
            let relative = 4.0 * density.weight_rounding / weight + gamma(DENSITY_ROUNDINGS);
            mean.rounding += in_s * in_t * (2.0 * density.rounding / cube + relative * value.abs());
        }
    }
    mean
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The smallest bound of lemma A1 for `1 / (pole - x)` over all radii below that of the pole.
    fn least_bound(pole: f64, count: usize) -> f64 {
        let largest = pole + (pole * pole - 1.0).sqrt();
        let bound = |part: f64| {
            let radius = 1.0 + part * (largest - 1.0);
            axis_error(radius, count) / (pole - 0.5 * (radius + 1.0 / radius))
        };
        (1..1000).map(|k| bound(f64::from(k) / 1000.0)).fold(f64::INFINITY, f64::min)
    }

    /// The bound decreases with the number of nodes as the error does.
    #[test]
    fn the_error_of_a_rule_is_bounded_and_attained_to_a_factor() {
        for (pole, counts) in [(2.0_f64, 2..8), (4.0, 2..6)] {
            let mean = 0.5 * ((pole + 1.0) / (pole - 1.0)).ln();
            for count in counts {
                let rule = rule(count);
                let terms =
                    rule.nodes.iter().zip(&rule.weights).map(|(x, weight)| weight / (pole + 1.0 - 2.0 * x));
                let error = (terms.sum::<f64>() - mean).abs();
                let bound = least_bound(pole, count);
                assert!(error <= bound, "{count} nodes, pole at {pole}: {error} above {bound}");
                assert!(
                    bound <= 12.0 * count as f64 * error,
                    "{count} nodes, pole at {pole}: {error}, {bound}"
                );
            }
        }
    }
}
