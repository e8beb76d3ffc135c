//! The audit of the bounds that statistics rest on: lemmas S1 to S4 of `docs/meshes.md`.

use super::super::spread::{LinearBounds, Spreads};
use super::super::{Cell, Pair};
use super::points::{REGULAR, inner};
use crate::closest::closest_above;
use crate::rounding::{upper_max, upper_min};

/// The width of a certified distance, relative to the range that it is compared with.
const CERTIFICATE_PART: f64 = 1e-3;

/// The points along each side of a cell for its mean by a rule, and of the rule whose difference is its error.
const FINE: usize = 6;
const COARSE: usize = 3;

/// The error of the finer rule, in differences of both: of midpoints it is a third of one where distances are smooth.
const RULE_DIFFERENCES: f64 = 4.0;

/// What a bound on a cell's distances states, which certified distances contradict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpreadRefutation {
    pub(crate) patch: u32,
    /// The point; of a mean the middle of the cell.
    pub(crate) parameters: [f64; 2],
    pub(crate) is_mean: bool,
    pub(crate) stated: [f64; 2],
    /// The distance of the point, or the mean by a rule.
    pub(crate) found: [f64; 2],
}

/// Whether two intervals have no number in common. NaN refutes nothing.
fn are_apart(one: [f64; 2], other: [f64; 2]) -> bool {
    one[1] < other[0] || other[1] < one[0]
}

impl Spreads<'_> {
    /// Looks at the corners of a cell, its middle and `further` points: the certified distance of each is in the
    /// range stated for all, and between the linear bounds there. O(points) closest points.
    pub(crate) fn refutation(
        &self,
        cell: &Cell,
        (all, linear): ([f64; 2], Option<&LinearBounds>),
        further: usize,
    ) -> Option<SpreadRefutation> {
        let mut known = None;
        REGULAR.into_iter().chain(inner(further)).find_map(|place| {
            let parameters = cell.at(place);
            let stated = linear.map_or(all, |linear| {
                let [low, high] = linear.at(place);
                [upper_max(all[0], low), upper_min(all[1], high)]
            });
            let found = self.certified(cell.patch, parameters, CERTIFICATE_PART * all[1], &mut known)?;
            let refutation =
                SpreadRefutation { patch: cell.patch, parameters, is_mean: false, stated, found };
            are_apart(stated, found).then_some(refutation)
        })
    }

    /// Compares the mean that is stated with that by a rule over the cell's middle points, as areas are by a second
    /// rule: its error is estimated by that of a coarser rule and is no bound, so that no answer rests on it.
    pub(crate) fn refutation_of_mean(
        &self,
        cell: &Cell,
        all: [f64; 2],
        stated: [f64; 2],
    ) -> Option<SpreadRefutation> {
        let [fine, coarse] = [self.mean_by_rule(cell, FINE)?, self.mean_by_rule(cell, COARSE)?];
        // Where nearest points change, the rule has the error of a step: a share of the range for a row of points.
        let range = all[1] - all[0];
        let error = RULE_DIFFERENCES * (fine - coarse).abs() + range / (FINE * FINE) as f64 + self.rounding();
        let found = [fine - error, fine + error];
        let refutation =
            SpreadRefutation { patch: cell.patch, parameters: cell.center, is_mean: true, stated, found };
        are_apart(stated, found).then_some(refutation)
    }

    fn mean_by_rule(&self, cell: &Cell, count: usize) -> Option<f64> {
        let (mut weight, mut sum, mut known) = (0.0, 0.0, None);
        for index in 0..count * count {
            let place = [index / count, index % count].map(|k| (2 * k + 1) as f64 / count as f64 - 1.0);
            let parameters = cell.at(place);
            let [lower, upper] = self.certified(cell.patch, parameters, 0.0, &mut known)?;
            let jet = self.pair().jet_of_a(cell.patch, parameters);
            let density = jet.s.cross(jet.t).length();
            weight += density;
            sum += density * 0.5 * (lower + upper);
        }
        (weight > 0.0).then(|| sum / weight)
    }

    /// Bounds on the distance of a point of A, by the closest point over B's patches alone.
    fn certified(
        &self,
        patch: u32,
        parameters: [f64; 2],
        gap: f64,
        known: &mut Option<(u32, [f64; 2])>,
    ) -> Option<[f64; 2]> {
        let pair: &Pair<'_> = self.pair();
        let point = pair.point_of_a(patch, parameters);
        let closest = closest_above(pair.b.target, point, gap, *known, 0.0, None)?;
        *known = Some((closest.patch as u32, closest.parameters));
        let foot = pair.b.patch(closest.patch as u32).point(closest.parameters);
        let rounding = self.rounding();
        Some([
            upper_max(0.0, closest.lower - rounding),
            upper_max(closest.lower, foot.distance(point)) + rounding,
        ])
    }
}
