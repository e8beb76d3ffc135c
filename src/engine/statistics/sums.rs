//! The intervals of statistics, of parts with bounds (lemma F9 of docs/meshes.md).

use super::{Beyond, Bounded, Measure, Percentile, StatisticsOptions};
use crate::area::Area;
use crate::facets::{Spread, Weighted};
use crate::rounding::{UNIT_ROUNDOFF, upper_max, upper_min};
use crate::sorting::sort_pairs;

/// The roundings of a product or a quotient of two numbers, and of a root.
const QUOTIENT_ROUNDINGS: f64 = 4.0;

/// All intervals at one time.
pub(super) struct Sums {
    pub(super) total: Area,
    pub(super) mean: Bounded,
    pub(super) rms: Bounded,
    pub(super) percentiles: Vec<Percentile>,
    pub(super) beyond: Option<Beyond>,
}

/// A sum of numbers that are not negative, with bounds on its rounding.
struct Sum {
    value: f64,
    rounding: f64,
}

impl Sum {
    /// Returns the sum of `count` products: each takes a rounding, and so does each addition.
    fn of(terms: impl Iterator<Item = f64>, count: usize) -> Self {
        Self { value: terms.sum(), rounding: 2.0 * (count as f64 + 2.0) * UNIT_ROUNDOFF }
    }

    fn lower(&self) -> f64 {
        self.value * (1.0 - self.rounding)
    }

    fn upper(&self) -> f64 {
        self.value * (1.0 + self.rounding)
    }
}

impl Sums {
    /// `known` bounds the total weight: sums of fewer parts round less. O(n log n) in the number of
    /// parts.
    pub(super) fn of<T: Weighted>(
        parts: &[T],
        options: &StatisticsOptions,
        over: Measure,
        known: Area,
    ) -> Self {
        let count = parts.len();
        let sum = |term: &dyn Fn(&T) -> f64| Sum::of(parts.iter().map(term), count);
        let total = match over {
            Measure::Count => Area { lower: count as f64, upper: count as f64 },
            Measure::Area => Area {
                lower: sum(&|part| part.weight().lower).lower().max(known.lower),
                upper: upper_min(known.upper, sum(&|part| part.weight().upper).upper()),
            },
        };
        let mean = |low: &dyn Fn(&T) -> f64, high: &dyn Fn(&T) -> f64| {
            let lower = sum(&|part| part.weight().lower * low(part)).lower();
            let upper = sum(&|part| part.weight().upper * high(part)).upper();
            quotients(lower, upper, total)
        };
        let square = mean(&|part| part.spread().square[0], &|part| part.spread().square[1]);
        let mean = mean(&|part| part.spread().mean[0], &|part| part.spread().mean[1]);
        let root = |value: f64, up: f64| value.sqrt() * (1.0 + up * QUOTIENT_ROUNDINGS * UNIT_ROUNDOFF);
        // By Jensen's inequality the mean is at most the root mean square.
        let rms = Bounded {
            lower: upper_max(root(square.lower, -1.0), mean.lower),
            upper: root(square.upper, 1.0),
        };
        let beyond = options.limit.map(|limit| {
            let weight = |is_beyond: bool, weight: f64| if is_beyond { weight } else { 0.0 };
            let lower = sum(&|part| weight(part.spread().lower > limit, part.weight().lower)).lower();
            // Not "at most the limit", so that NaN counts as beyond.
            let upper = sum(&|part| weight(!(part.spread().upper <= limit), part.weight().upper)).upper();
            let Bounded { lower, upper } = quotients(lower, upper, total);
            Beyond { limit, part: Bounded { lower, upper: upper_min(1.0, upper) } }
        });
        let percentiles = percentiles(parts, &options.percentiles, total, over);
        Self { total, mean, rms, percentiles, beyond }
    }
}

/// Returns bounds on the quotient by the total.
fn quotients(lower: f64, upper: f64, total: Area) -> Bounded {
    Bounded {
        lower: if total.upper > 0.0 {
            lower / total.upper * (1.0 - QUOTIENT_ROUNDINGS * UNIT_ROUNDOFF)
        } else {
            0.0
        },
        upper: upper / total.lower * (1.0 + QUOTIENT_ROUNDINGS * UNIT_ROUNDOFF),
    }
}

/// Returns each percentile p between the least t for which the parts that may be within t have the
/// part of the weight, and the least t for which those that may be beyond t have at most the rest
/// (lemma F9 of docs/meshes.md). A fused product has the sign of the exact difference; sums of counts
/// are exact, and so are those percentiles.
fn percentiles<T: Weighted>(parts: &[T], of: &[f64], total: Area, over: Measure) -> Vec<Percentile> {
    let rounding = match over {
        Measure::Count => 0.0,
        Measure::Area => 2.0 * (parts.len() as f64 + 2.0) * UNIT_ROUNDOFF,
    };
    let has_part = |part: f64, weight: f64| part.mul_add(total.lower, -weight) <= 0.0;
    let lowers = sorted(parts, |spread| spread.lower);
    let lower = |&part: &f64| {
        let mut within = 0.0;
        let reached = lowers.iter().find(|(_, weight)| {
            within += weight;
            has_part(part, within * (1.0 + rounding))
        });
        reached.map_or(0.0, |(distance, _)| *distance)
    };
    let lower_bounds: Vec<f64> = of.iter().map(lower).collect();
    drop(lowers);
    let uppers = sorted(parts, |spread| spread.upper);
    let upper = |part: f64| {
        let mut beyond = 0.0;
        let mut upper = uppers.last().map_or(0.0, |(distance, _)| *distance);
        for (distance, weight) in uppers.iter().rev() {
            // All parts from here on are within `distance`.
            if !has_part(part, (total.lower - beyond * (1.0 + rounding)) * (1.0 - rounding)) {
                break;
            }
            upper = upper_min(upper, *distance);
            beyond += weight;
        }
        upper
    };
    let percentile = |(&part, lower)| Percentile { part, distance: Bounded { lower, upper: upper(part) } };
    of.iter().zip(lower_bounds).map(percentile).collect()
}

/// Returns a bound on the distances of each part with the part's largest weight, in their order.
fn sorted<T: Weighted>(parts: &[T], bound: fn(Spread) -> f64) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> =
        parts.iter().map(|part| (bound(part.spread()), part.weight().upper)).collect();
    sort_pairs(&mut sorted);
    sorted
}
