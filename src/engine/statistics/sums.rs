//! The intervals of statistics, of parts with bounds (lemma F9 of docs/meshes.md).

use super::{Beyond, Measure, Percentile};
use crate::area::Area;
use crate::facets::{Spread, Weighted};
use crate::interval::Interval;
use crate::rounding::{UNIT_ROUNDOFF, upper_max, upper_min};
use crate::sorting::sort_pairs;

/// The roundings of a product or a quotient of two numbers, and of a root.
const QUOTIENT_ROUNDINGS: f64 = 4.0;

/// The number of halvings by which an end of a percentile's interval is found in what the ends of parts leave: a part in
/// 4,096 of it.
const PERCENTILE_HALVINGS: u32 = 12;

/// All intervals at one time.
pub(in crate::engine) struct Sums {
    pub(super) total: Area,
    pub(in crate::engine) mean: Interval,
    pub(in crate::engine) rms: Interval,
    pub(super) percentiles: Vec<Percentile>,
    /// The parts beyond the limits, in their order.
    pub(in crate::engine) beyond: Vec<Beyond>,
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
        (limits, percentiles_of): (&[f64], &[f64]),
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
        let rms = Interval {
            lower: upper_max(root(square.lower, -1.0), mean.lower),
            upper: root(square.upper, 1.0),
        };
        let beyond = limits.iter().map(|&limit| {
            let lower = sum(&|part| part.weight().lower * part.beyond(limit)[0]).lower();
            let upper = sum(&|part| part.weight().upper * part.beyond(limit)[1]).upper();
            let Interval { lower, upper } = quotients(lower, upper, total);
            Beyond { limit, part: Interval { lower, upper: upper_min(1.0, upper) } }
        });
        let beyond = beyond.collect();
        let percentiles = percentiles(parts, percentiles_of, total, over);
        Self { total, mean, rms, percentiles, beyond }
    }
}

/// Returns bounds on the quotient by the total.
fn quotients(lower: f64, upper: f64, total: Area) -> Interval {
    Interval {
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
    let percentile = |(&part, lower)| {
        let by_ends = Interval { lower, upper: upper(part) };
        // Of NaN nothing follows.
        let is_above = |within: f64| part.mul_add(total.lower, -within * (1.0 + rounding)) > 0.0;
        let is_at_most =
            |beyond: f64| has_part(part, (total.lower - beyond * (1.0 + rounding)) * (1.0 - rounding));
        Percentile { part, distance: narrowed_by_shares(parts, by_ends, is_above, is_at_most) }
    };
    of.iter().zip(lower_bounds).map(percentile).collect()
}

/// Returns the interval of a percentile that is known by the ends of parts, narrowed by the shares of parts.
///
/// `is_above` returns whether the percentile is above a distance, from the largest weight that may be within it, and
/// `is_at_most` whether it is at most a distance, from the largest weight that may be beyond it. Both weights are monotone in
/// the distance, so that each end is found by halving.
fn narrowed_by_shares<T: Weighted>(
    parts: &[T],
    known: Interval,
    is_above: impl Fn(f64) -> bool,
    is_at_most: impl Fn(f64) -> bool,
) -> Interval {
    let (mut within, mut beyond, mut near) = (0.0, 0.0, Vec::new());
    for part in parts {
        let (Spread { lower, upper, .. }, weight) = (part.spread(), part.weight().upper);
        if upper < known.lower {
            within += weight;
        } else if lower > known.upper {
            beyond += weight;
        } else {
            near.push(part);
        }
    }
    let has_shares = |part: &&T| part.thickness() < part.spread().upper - part.spread().lower;
    if !near.iter().any(has_shares) {
        return known;
    }
    let sum =
        |share: &dyn Fn(&T) -> f64| near.iter().map(|part| part.weight().upper * share(part)).sum::<f64>();
    let Interval { mut lower, mut upper } = known;
    let mut high = upper;
    for _ in 0..PERCENTILE_HALVINGS {
        let middle = 0.5 * (lower + high);
        let is_lower = is_above(within + sum(&|part| 1.0 - part.beyond(middle)[0]));
        *(if is_lower { &mut lower } else { &mut high }) = middle;
    }
    let mut low = lower;
    for _ in 0..PERCENTILE_HALVINGS {
        let middle = 0.5 * (low + upper);
        let is_upper = is_at_most(beyond + sum(&|part| part.beyond(middle)[1]));
        *(if is_upper { &mut upper } else { &mut low }) = middle;
    }
    Interval { lower, upper }
}

/// Returns a bound on the distances of each part with the part's largest weight, in their order.
fn sorted<T: Weighted>(parts: &[T], bound: fn(Spread) -> f64) -> Vec<(f64, f64)> {
    let mut sorted: Vec<(f64, f64)> =
        parts.iter().map(|part| (bound(part.spread()), part.weight().upper)).collect();
    sort_pairs(&mut sorted);
    sorted
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use num_rational::BigRational;
    use num_traits::Zero;

    /// The number of parts whose weights a sum in float64 loses.
    const LOST: u32 = 64;

    struct Part {
        weight: [f64; 2],
        spread: Spread,
    }

    impl Weighted for Part {
        fn weight(&self) -> Area {
            Area { lower: self.weight[0], upper: self.weight[1] }
        }

        fn spread(&self) -> Spread {
            self.spread
        }
    }

    /// A part whose distances rise evenly from its lower end to its upper one, known up to a thickness.
    struct Slope {
        part: Part,
        thickness: f64,
    }

    impl Weighted for Slope {
        fn weight(&self) -> Area {
            self.part.weight()
        }

        fn spread(&self) -> Spread {
            self.part.spread
        }

        fn beyond(&self, limit: f64) -> [f64; 2] {
            let Spread { lower, upper, .. } = self.part.spread;
            [-0.5, 0.5]
                .map(|by: f64| ((upper + by * self.thickness - limit) / (upper - lower)).clamp(0.0, 1.0))
        }

        fn thickness(&self) -> f64 {
            self.thickness
        }
    }

    /// Two slopes of the weight 1, from 0 to 4 and from 2 to 4, that are known up to 1/8: of the whole 1/4 is within 2, and
    /// half within 8/3. A bound differs from these by half of the thickness, but for the halvings.
    #[test]
    fn percentiles_and_limits_take_shares_of_parts() {
        const THICKNESS: f64 = 0.125;
        let slope = |lower: f64, upper: f64| Slope {
            part: part([1.0; 2], [lower, upper], [lower, upper], [lower * lower, upper * upper]),
            thickness: THICKNESS,
        };
        let parts = [slope(0.0, 4.0), slope(2.0, 4.0)];
        let found = Sums::of(&parts, (&[3.0], &[0.25, 0.5]), Measure::Area, UNKNOWN);
        for (of, expected) in found.percentiles.iter().zip([2.0, 8.0 / 3.0]) {
            let Interval { lower, upper } = of.distance;
            assert!(lower <= expected && expected <= upper, "{lower} {expected} {upper}");
            assert!(upper - lower >= 0.9 * THICKNESS && upper - lower <= 1.1 * THICKNESS, "{lower} {upper}");
        }
        // Beyond 3 there are 1/4 and 1/2 of the parts, by 1/64 and 1/32 more or less.
        is_about(found.beyond[0].part, [0.375 - 0.75 / 32.0, 0.375 + 0.75 / 32.0]);
    }

    fn part(weight: [f64; 2], [lower, upper]: [f64; 2], mean: [f64; 2], square: [f64; 2]) -> Part {
        Part { weight, spread: Spread { lower, upper, mean, square } }
    }

    /// A part of this weight, all of whose points are at one distance.
    fn at(weight: f64, distance: f64) -> Part {
        let square = [distance * distance; 2];
        part([weight; 2], [distance; 2], [distance; 2], square)
    }

    fn sums(parts: &[Part], over: Measure, known: Area, limit: f64, percentiles: &[f64]) -> Sums {
        Sums::of(parts, (&[limit], percentiles), over, known)
    }

    const UNKNOWN: Area = Area { lower: 0.0, upper: f64::INFINITY };

    fn exact(number: f64) -> BigRational {
        BigRational::from_float(number).unwrap()
    }

    fn holds(lower: f64, value: &BigRational, upper: f64) {
        assert!(exact(lower) <= *value && *value <= exact(upper), "[{lower:e}, {upper:e}] {value}");
    }

    /// Checks that an interval is a given one but for a rounding that widens it.
    fn is_about(Interval { lower, upper }: Interval, [low, high]: [f64; 2]) {
        let rounding = 1e-14 * high;
        assert!(low - rounding <= lower && lower <= low, "{lower} {low}");
        assert!(high <= upper && upper <= high + rounding, "{upper} {high}");
    }

    /// Lemma F9 for two parts of the weights [1, 2] and [2, 4]: w = 3 and W = 6.
    #[test]
    fn intervals_are_those_of_the_lemma() {
        let parts = [
            part([1.0, 2.0], [1.0, 4.0], [2.0, 3.0], [4.0, 16.0]),
            part([2.0, 4.0], [3.0, 8.0], [5.0, 6.0], [36.0, 49.0]),
        ];
        let found = |limit: f64| sums(&parts, Measure::Area, UNKNOWN, limit, &[0.125, 0.5, 0.875]);
        let Sums { total, mean, rms, percentiles, .. } = found(0.0);
        is_about(Interval { lower: total.lower, upper: total.upper }, [3.0, 6.0]);
        // (1 · 2 + 2 · 5) / 6 and (2 · 3 + 4 · 6) / 3; of squares 76 / 6 and 228 / 3.
        is_about(mean, [2.0, 10.0]);
        is_about(rms, [(76.0_f64 / 6.0).sqrt(), 76.0_f64.sqrt()]);
        // Parts are at most 1, though 6 / 3 may be beyond 0.5, and 4 / 3 beyond 5.
        for (limit, expected) in [(0.5, [0.5, 1.0]), (2.0, [1.0 / 3.0, 1.0]), (5.0, [0.0, 1.0])] {
            is_about(found(limit).beyond[0].part, expected);
        }
        let narrow = [part([1.0, 1.5], [1.0, 4.0], [2.0; 2], [4.0; 2]), at(2.0, 8.0)];
        let narrow = |limit: f64| sums(&narrow, Measure::Area, UNKNOWN, limit, &[0.25, 0.75]);
        is_about(narrow(2.0).beyond[0].part, [2.0 / 3.5, 1.0]);
        is_about(narrow(4.0).beyond[0].part, [2.0 / 3.5, 2.0 / 3.0]);
        // Within 1 there may be 2, which is 0.5 · 3 and more; then all.
        for (of, lower) in percentiles.iter().zip([1.0, 1.0, 3.0]) {
            // The second part may weigh 4, and 3 (1 − 0.125) is less than that.
            assert_eq!((of.distance.lower, of.distance.upper), (lower, 8.0));
        }
        // 2 of 3 are beyond 4, which 0.75 of 3 is more than and 0.25 is not.
        let narrow = narrow(0.0).percentiles;
        assert_eq!(narrow.iter().map(|of| of.distance.lower).collect::<Vec<_>>(), [1.0, 8.0]);
        assert_eq!(narrow.iter().map(|of| of.distance.upper).collect::<Vec<_>>(), [4.0, 8.0]);
    }

    /// A part whose least distance is the limit may have no point beyond it.
    #[test]
    fn a_part_at_the_limit_is_not_beyond_it() {
        let beyond = sums(&[at(1.0, 2.0)], Measure::Area, UNKNOWN, 2.0, &[]).beyond[0].part;
        assert_eq!((beyond.lower, beyond.upper), (0.0, 0.0));
        let nan = part([1.0; 2], [0.0, f64::NAN], [0.0; 2], [0.0; 2]);
        assert_eq!(sums(&[nan], Measure::Area, UNKNOWN, 2.0, &[]).beyond[0].part.upper, 1.0);
    }

    /// To 1, terms below half of the spacing of numbers add nothing, and those above it a whole one.
    #[test]
    fn sums_hold_the_exact_ones() {
        for term in [UNIT_ROUNDOFF, 1.25 * UNIT_ROUNDOFF] {
            let parts: Vec<Part> =
                std::iter::once(at(1.0, 1.0)).chain((0..LOST).map(|_| at(term, 1.0))).collect();
            let total = sums(&parts, Measure::Area, UNKNOWN, 0.0, &[]).total;
            let sum: BigRational = parts.iter().map(|part| exact(part.weight[0])).sum();
            assert_ne!(exact(parts.iter().map(|part| part.weight[0]).sum()), sum);
            holds(total.lower, &sum, total.upper);
            // A sum that is known to be more narrow stays so.
            let known = Area { lower: 1.0, upper: 1.0 + 2.0 * f64::from(LOST) * term };
            let total = sums(&parts, Measure::Area, known, 0.0, &[]).total;
            assert_eq!((total.lower, total.upper), (known.lower, known.upper));
        }
    }

    #[test]
    fn quotients_hold_the_exact_ones() {
        for [a, b] in (1..40).flat_map(|a| (1..40).map(move |b| [a, b].map(f64::from))) {
            let Interval { lower, upper } = quotients(a, a, Area { lower: b, upper: b });
            holds(lower, &(exact(a) / exact(b)), upper);
        }
        is_about(quotients(1.0, 1.0, Area { lower: 2.0, upper: 4.0 }), [0.25, 0.5]);
    }

    /// Half of the weight is reached at the 32nd of 64 parts that sums in float64 lose, from below and
    /// from above, where the total is known exactly.
    #[test]
    fn percentiles_hold_where_sums_are_rounded() {
        let lost = |k: u32| at(UNIT_ROUNDOFF, f64::from(k));
        let check = |bottom: f64, part: f64| {
            let mut parts = vec![at(bottom, 0.0), at(1.0, 1000.0)];
            parts.extend((1..=LOST).map(lost));
            let total = bottom + 1.0 + f64::from(LOST) * UNIT_ROUNDOFF;
            let sum: BigRational = parts.iter().map(|part| exact(part.weight[0])).sum();
            assert_eq!(exact(total), sum);
            let known = Area { lower: total, upper: total };
            let percentile = sums(&parts, Measure::Area, known, 0.0, &[part]).percentiles[0];
            // The exact percentile: the least distance within which there is that part of the sum.
            parts.sort_by(|one, other| one.spread.lower.total_cmp(&other.spread.lower));
            let mut within = BigRational::zero();
            let reached = parts.iter().find(|one| {
                within += exact(one.weight[0]);
                within >= exact(part) * &sum
            });
            let distance = reached.unwrap().spread.lower;
            assert!((1.0..=f64::from(LOST)).contains(&distance), "{distance}");
            let Interval { lower, upper } = percentile.distance;
            assert!(lower <= distance && distance <= upper, "{distance} [{lower}, {upper}]");
        };
        check(1.0, 0.5);
        // What is left of the sum from above is far smaller than it, and so are its roundings.
        let small = 0.5_f64.powi(20);
        let beyond = 1.0 + f64::from(LOST) * UNIT_ROUNDOFF;
        check(small, (small + 31.5 * UNIT_ROUNDOFF) / (small + beyond));
        // The part within 1 is 1 − 1.4 u, which is rounded to 1 − u.
        let parts =
            [at(1.0 - 2.0 * UNIT_ROUNDOFF, 1.0), at(0.6 * UNIT_ROUNDOFF, 1.0), at(1.4 * UNIT_ROUNDOFF, 2.0)];
        let known = Area { lower: 1.0, upper: 1.0 };
        let found = sums(&parts, Measure::Area, known, 0.0, &[1.0 - UNIT_ROUNDOFF]).percentiles[0];
        assert!(found.distance.lower <= 2.0 && found.distance.upper >= 2.0, "{found:?}");
    }

    /// 0.1 in float64 is more than a tenth, so that one of ten points is not that part.
    #[test]
    fn percentiles_of_counts_are_exact() {
        let points: Vec<Part> = (1..=10).map(|k| at(1.0, f64::from(k))).collect();
        let found = sums(&points, Measure::Count, UNKNOWN, 0.0, &[0.1, 0.5, 0.95]).percentiles;
        assert!(exact(0.1) * exact(10.0) > exact(1.0));
        for (of, distance) in found.iter().zip([2.0, 5.0, 10.0]) {
            assert_eq!((of.distance.lower, of.distance.upper), (distance, distance));
        }
    }
}
