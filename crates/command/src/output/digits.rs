//! Numbers for people: as many digits as an interval supports, and no number outside of it.

use nurbs_hausdorff::Interval;

/// Digits by which any two numbers of float64 differ.
const MAX_DIGITS: i32 = 17;

/// The ends of an interval are rounded outwards by less than this part of its width.
const END_PART: f64 = 0.1;

/// Coordinates are rounded to this part of the diagonal, the tolerance of a search by default.
const COORDINATE_PART: f64 = 1e-6;

/// Sizes between which numbers are written without an exponent.
const PLAIN: std::ops::Range<f64> = 1e-5..1e15;

/// Returns the number with the fewest digits that lies in the interval and rounds `value`, and the
/// interval with its ends rounded outwards: `0.2 (0.19999 … 0.20001)`.
pub(crate) fn bounded(value: f64, ends: [f64; 2]) -> String {
    format!("{} ({})", within(value, ends), interval(ends))
}

/// Returns the same, of ends that are rounded to no other side of a limit.
pub(crate) fn bounded_beside(limit: Option<f64>, value: f64, ends: [f64; 2]) -> String {
    format!("{} ({})", within(value, ends), interval_beside(limit, ends))
}

/// Returns the interval with its ends rounded outwards, to no other side of a limit.
pub(crate) fn interval_beside(limit: Option<f64>, [lower, upper]: [f64; 2]) -> String {
    let room = |beside: f64| if beside >= 0.0 { beside } else { f64::INFINITY };
    let rooms = limit.map_or([f64::INFINITY; 2], |limit| [room(lower - limit), room(limit - upper)]);
    rounded_ends([lower, upper], rooms)
}

/// Returns the number with the fewest digits that lies in the interval and rounds `value`: `0.2`.
fn within(value: f64, [lower, upper]: [f64; 2]) -> String {
    let value = if value >= lower { value } else { lower };
    let value = if value <= upper { value } else { upper };
    let short = (1..=MAX_DIGITS).map(|digits| rounded(value, digits));
    number(short.into_iter().find(|short| (lower..=upper).contains(short)).unwrap_or(value))
}

/// Returns the number with the fewest digits that lies in the interval and rounds its middle.
pub(crate) fn held(interval: &Interval) -> String {
    within(interval.middle(), [interval.lower, interval.upper])
}

/// Returns the interval with its ends rounded outwards: `0.19999 … 0.20001`.
pub(crate) fn interval(ends: [f64; 2]) -> String {
    rounded_ends(ends, [f64::INFINITY; 2])
}

/// Returns the interval with its ends rounded outwards, each by less than a part of the width and than its room.
fn rounded_ends([lower, upper]: [f64; 2], rooms: [f64; 2]) -> String {
    let step = END_PART * (upper - lower);
    let [below, above] = rooms.map(|room| if room < step { room } else { step });
    format!("{} … {}", number(outwards(lower, below, -1.0)), number(outwards(upper, above, 1.0)))
}

/// Returns the coordinates of a point of models with this diagonal, with blanks between them.
pub(crate) fn coordinates(point: [f64; 3], diagonal: f64) -> String {
    let step = COORDINATE_PART * diagonal;
    let places = if step.is_normal() { -step.log10().floor() } else { f64::from(MAX_DIGITS) };
    // Beyond 17 places of a number near 1, as of models of 1e-12, digits do not end before the number does.
    let places = places.clamp(0.0, 300.0) as usize;
    let text = |value: f64| {
        let near: f64 = format!("{value:.places$}").parse().unwrap_or(value);
        // Without the sign of 0.
        number(if near == 0.0 { 0.0 } else { near })
    };
    point.map(text).join(" ")
}

/// Returns the number with all its digits, and an exponent where it is very small or large.
pub(crate) fn number(value: f64) -> String {
    match value == 0.0 || !value.is_finite() || PLAIN.contains(&value.abs()) {
        true => format!("{value}"),
        false => format!("{value:e}"),
    }
}

/// Returns a number in this direction from `end`, or `end`, less than `step` away where fewer digits state it.
fn outwards(end: f64, step: f64, direction: f64) -> f64 {
    let digits = end.abs().log10().floor() - step.log10().floor() + 1.0;
    if !(step.is_normal() && digits.is_finite() && digits <= f64::from(MAX_DIGITS)) {
        return end;
    }
    let unit = 10.0_f64.powf(step.log10().floor());
    let is_outside = |value: f64| direction * (value - end) >= 0.0;
    if digits < 1.0 {
        return if is_outside(0.0) { 0.0 } else { end };
    }
    let digits = digits as i32;
    let near = rounded(end, digits);
    let candidates = [near, rounded(near + direction * unit, digits)];
    candidates.into_iter().find(|&value| is_outside(value)).unwrap_or(end)
}

/// Returns the number rounded to this many significant digits, at least 1.
fn rounded(value: f64, digits: i32) -> f64 {
    let places = digits.max(1) as usize - 1;
    format!("{value:.places$e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_the_interval_supports() {
        for (value, ends, expected) in [
            (0.2, [0.199_990_2, 0.200_009_8], "0.2 (0.19999 … 0.20001)"),
            (3.0, [3.0, 3.0], "3 (3 … 3)"),
            (1.234_56, [1.234_51, 1.234_59], "1.23456 (1.23451 … 1.23459)"),
            (0.0, [0.0, 3.1e-8], "0 (0 … 3.1e-8)"),
            (7.0, [1e-9, 12.34], "7 (0 … 13)"),
            (1e20, [1e20, 2e20], "1e20 (1e20 … 2e20)"),
            (5.0, [1.0, f64::INFINITY], "5 (1 … inf)"),
        ] {
            assert_eq!(bounded(value, ends), expected);
        }
    }

    /// 0.0194 rounds to 0 in an interval as wide as 2.7. An end that is the limit is stated as it is.
    #[test]
    fn ends_stay_on_their_side_of_a_limit() {
        assert_eq!(bounded([0.0194, 2.68][0], [0.0194, 2.68]), "0.02 (0 … 2.7)");
        assert_eq!(bounded_beside(Some(0.001), 0.0194, [0.0194, 2.68]), "0.02 (0.01 … 2.7)");
        assert_eq!(bounded_beside(Some(0.0194), 0.0194, [0.0194, 2.68]), "0.02 (0.0194 … 2.7)");
        assert_eq!(bounded_beside(Some(2.68), 1.0, [0.0194, 2.68]), "1 (0 … 2.68)");
        assert_eq!(bounded_beside(Some(2.69), 1.0, [0.0194, 2.68]), "1 (0 … 2.68)");
        assert_eq!(bounded_beside(None, 1.0, [0.0194, 2.68]), "1 (0 … 2.7)");
    }

    /// Of ends of many sizes and widths, in an order that repeats.
    #[test]
    fn printed_numbers_are_in_the_interval_and_printed_ends_hold_it() {
        let mut state = 1_u64;
        let mut next = || {
            // The constants of Knuth's MMIX generator.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..5_000 {
            let lower = 10.0_f64.powf(20.0 * next() - 10.0);
            let upper = lower + 10.0_f64.powf(24.0 * next() - 16.0) * lower;
            let value = lower + next() * (upper - lower);
            let text = bounded(value, [lower, upper]);
            let numbers: Vec<f64> =
                text.split([' ', '(', ')', '…']).filter_map(|word| word.parse().ok()).collect();
            assert!(lower <= numbers[0] && numbers[0] <= upper, "{lower:?} {upper:?}: {text}");
            assert!(numbers[1] <= lower && upper <= numbers[2], "{lower:?} {upper:?}: {text}");
            let slack = END_PART * (upper - lower) * 1.000_001;
            assert!(
                lower - numbers[1] <= slack && numbers[2] - upper <= slack,
                "{lower:?} {upper:?}: {text}"
            );
        }
    }

    #[test]
    fn coordinates_are_rounded_to_a_part_of_the_diagonal() {
        assert_eq!(coordinates([8.200_000_000_3, -1e-12, 1.0 / 3.0], 10.0), "8.2 0 0.33333");
        assert_eq!(coordinates([1e-9, 2.5e-9, 0.0], 1e-8), "1e-9 2.5e-9 0");
        assert_eq!(coordinates([1_234_567.25, 0.0, 0.0], 1e9), "1234567 0 0");
    }
}
