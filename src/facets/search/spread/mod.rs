//! Bounds on the distances of all points of a part of A, and on their means, for statistics.

mod parts;
mod refutation;
mod triangle;

use crate::area::Area;
use crate::rounding::{lower_min, upper_max, upper_min};

pub(crate) use parts::{PartOf, Parts, WeightedPart};

/// Bounds on the distances of all points of a part from B, and on their mean and the mean of their
/// squares over its area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spread {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    pub(crate) mean: [f64; 2],
    pub(crate) square: [f64; 2],
}

/// A set of points of A with bounds.
pub(crate) trait Weighted {
    /// Returns its area, or its number of points.
    fn weight(&self) -> Area;
    /// Returns the bounds of its distances.
    fn spread(&self) -> Spread;
    /// Returns bounds on the share of its weight whose distances are above a limit.
    fn beyond(&self, limit: f64) -> [f64; 2] {
        self.spread().beyond(limit)
    }
    /// Returns the largest width of the bounds on the distance of a point of it, given the place of the point.
    fn thickness(&self) -> f64 {
        self.spread().upper - self.spread().lower
    }
}

impl Spread {
    pub(crate) fn exact([lower, upper]: [f64; 2]) -> Self {
        let lower = if lower > 0.0 { lower } else { 0.0 };
        Self { lower, upper, mean: [lower, upper], square: [lower * lower, upper * upper] }
    }

    /// Returns the share above a limit: all, none, or anything between.
    pub(crate) fn beyond(&self, limit: f64) -> [f64; 2] {
        let share = |is_beyond: bool| if is_beyond { 1.0 } else { 0.0 };
        // Not "at most the limit", so that NaN counts as beyond.
        [share(self.lower > limit), share(!(self.upper <= limit))]
    }

    /// Returns bounds that hold for all points of both.
    fn union(self, other: Self) -> Self {
        Self::exact([lower_min(self.lower, other.lower), upper_max(self.upper, other.upper)])
    }

    /// Returns the bounds of a set all of whose distances are in a range.
    pub(crate) fn within(self, [lower, upper]: [f64; 2]) -> Self {
        let clipped = |[low, high]: [f64; 2], [least, most]: [f64; 2]| {
            [if low < least { least } else { low }, upper_min(high, most)]
        };
        let [lower, upper] = clipped([self.lower, self.upper], [lower, upper]);
        let (mean, square) = ([lower, upper], [lower * lower, upper * upper]);
        Self { lower, upper, mean: clipped(self.mean, mean), square: clipped(self.square, square) }
    }

    /// Returns bounds that hold where distances are off by this.
    pub(crate) fn widened(self, by: f64) -> Self {
        let [mean, square] = [self.mean, self.square];
        let below = |value: f64| if value > by { value - by } else { 0.0 };
        let low = below(mean[0]);
        Self {
            lower: below(self.lower),
            upper: self.upper + by,
            mean: [low, mean[1] + by],
            // (d + e)² is d² + 2 d e + e², and the mean of d at most the root of that of d².
            square: [low * low, square[1] + 2.0 * square[1].sqrt() * by + by * by],
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Every end moves by the error, and the mean square by both of its terms.
    #[test]
    fn bounds_are_widened_by_every_term() {
        let spread = Spread { lower: 2.0, upper: 5.0, mean: [3.0, 4.0], square: [9.5, 16.0] };
        let expected = Spread { lower: 1.0, upper: 6.0, mean: [2.0, 5.0], square: [4.0, 25.0] };
        assert_eq!(spread.widened(1.0), expected);
        let [one, other] = [Spread::exact([1.0, 4.0]), Spread::exact([2.0, 5.0])];
        assert_eq!([one.union(other), other.union(one)], [Spread::exact([1.0, 5.0]); 2]);
    }
}
