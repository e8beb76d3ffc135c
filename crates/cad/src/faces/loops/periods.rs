//! Places around a period that loops leave free.

/// Returns whether a place lies in an interval, up to periods.
pub(super) fn is_inside(place: f64, [low, high]: [f64; 2], period: f64) -> bool {
    (place - low).rem_euclid(period) <= high - low
}

/// Returns the middle of the widest gap that intervals, at least one, leave on a circle of this length;
/// where they leave none, any place. O(n log n).
///
/// Of the ends in their order, that before the i-th start lies before it only if i intervals end there:
/// those that begin before it, which all intervals do that end before it.
pub(super) fn widest_gap(intervals: &[[f64; 2]], period: f64) -> f64 {
    let turns = |[low, _]: &[f64; 2]| period * (low / period).floor();
    let sorted = |end: usize| {
        let mut ends: Vec<f64> = intervals.iter().map(|one| one[end] - turns(one)).collect();
        ends.sort_by(f64::total_cmp);
        ends
    };
    let (starts, ends) = (sorted(0), sorted(1));
    // The first gap begins where the last interval ended, a period before.
    let before = ends[ends.len() - 1] - period;
    let gaps = std::iter::once(before).chain(ends).zip(starts);
    let widest = gaps.max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
    widest.map_or(0.0, |(from, to)| 0.5 * (from + to))
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn the_widest_gap_is_found_across_the_end_of_the_period() {
        // In units of the period: gaps [0.3, 0.5] and [0.8, 1.1]; an interval in another one; a long one
        // that contains a short one.
        for (intervals, expected) in [
            (vec![[0.1, 0.3], [0.5, 0.8]], 0.95),
            (vec![[3.1, 3.3], [-1.5, -1.2]], 0.95),
            (vec![[0.1, 0.5], [0.2, 0.3], [0.52, 1.05]], 0.075),
            (vec![[0.6, 1.4]], 0.5),
        ] {
            let found = widest_gap(&intervals, 1.0).rem_euclid(1.0);
            assert!((found - expected).abs() < 1e-12, "{intervals:?}: {found}");
        }
    }
}
