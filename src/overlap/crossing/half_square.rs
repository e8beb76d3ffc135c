//! Parts of the unit square on one side of a line.

use crate::axis::Axis;
use crate::interval::Interval;
use crate::rounding::gamma;

/// More than the roundings of a part of the square, and of the place of the line in it.
const PART_ROUNDINGS: f64 = 32.0;

/// An affine function of two parameters in [0, 1].
#[derive(Debug, Clone, Copy)]
pub(in crate::overlap) struct Affine {
    /// The value at (½, ½).
    pub(in crate::overlap) middle: f64,
    pub(in crate::overlap) slopes: [f64; 2],
}

impl Affine {
    /// Returns the value at a place.
    pub(in crate::overlap) fn at(&self, place: [f64; 2]) -> f64 {
        self.middle + self.slopes[0] * (place[0] - 0.5) + self.slopes[1] * (place[1] - 0.5)
    }

    /// Returns the sum of the sizes of the value at the middle and of both slopes.
    pub(in crate::overlap) fn size(&self) -> f64 {
        self.middle.abs() + self.slopes[0].abs() + self.slopes[1].abs()
    }

    /// Returns the function of the parameters of a half of the square, off by one rounding of its size.
    pub(super) fn half(&self, axis: Axis, is_high: bool) -> Self {
        let mut slopes = self.slopes;
        let step = 0.25 * slopes[axis.index()];
        slopes[axis.index()] *= 0.5;
        Self { middle: self.middle + if is_high { step } else { -step }, slopes }
    }

    /// Returns the area of the part of the square in which the function is above `level`.
    ///
    /// With slopes a ≥ b ≥ 0 and the height t of the level above the least value, the part below is t²/(2ab) up to
    /// t = b, (t − b/2)/a up to t = a, and 1 less that of the opposite corner's triangle up to t = a + b. Its slope in t
    /// is at most 1/a.
    pub(super) fn part_above(&self, level: f64) -> Interval {
        let [one, other] = self.slopes.map(f64::abs);
        let [a, b] = if one > other { [one, other] } else { [other, one] };
        if a == 0.0 {
            return Interval::exactly(if self.middle > level { 1.0 } else { 0.0 });
        }
        let below = (level - self.middle) + 0.5 * (a + b);
        let above = (self.middle - level) + 0.5 * (a + b);
        let triangle = |height: f64| 0.5 * (height / a) * (height / b);
        let part = if below <= 0.0 {
            1.0
        } else if above <= 0.0 {
            0.0
        } else if below <= b {
            1.0 - triangle(below)
        } else if above <= b {
            triangle(above)
        } else {
            (above - 0.5 * b) / a
        };
        let error = gamma(PART_ROUNDINGS) * (1.0 + (self.size() + level.abs()) / a);
        Interval::about(part, error).clamped(0.0, 1.0)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// The part by counting the middles of the cells of a grid, off by at most a row and a column of cells on the line.
    fn counted(function: &Affine, level: f64) -> f64 {
        let count = 400;
        let at = |index: usize| (index as f64 + 0.5) / f64::from(count);
        let above = |place: [f64; 2]| function.at(place) > level;
        let all = 0..count as usize;
        let found =
            all.clone().flat_map(|i| all.clone().map(move |j| [at(i), at(j)])).filter(|&place| above(place));
        found.count() as f64 / f64::from(count * count)
    }

    #[test]
    fn parts_are_those_that_are_counted() {
        for slopes in [[1.0, 0.25], [-0.3, 2.0], [0.5, -0.5], [0.0, 1.5], [-1e-9, -1.0]] {
            for step in 0..9 {
                let function = Affine { middle: 0.2, slopes };
                let level = 0.2 + 0.3 * (f64::from(step) - 4.0);
                let part = function.part_above(level);
                assert!(part.width() < 1e-13);
                let difference = (part.middle() - counted(&function, level)).abs();
                assert!(difference < 0.006, "{slopes:?} {level}: {part:?}");
            }
        }
    }

    #[test]
    fn parts_of_constants_and_at_ends_are_exact() {
        let flat = Affine { middle: 1.0, slopes: [0.0; 2] };
        assert_eq!([flat.part_above(1.0), flat.part_above(0.5)], [0.0, 1.0].map(Interval::exactly));
        let diagonal = Affine { middle: 0.0, slopes: [1.0, 1.0] };
        for (level, part) in [(-1.0, 1.0), (-0.5, 0.875), (0.0, 0.5), (0.5, 0.125), (1.0, 0.0)] {
            assert!(diagonal.part_above(level).contains(part), "{level}");
        }
    }

    #[test]
    fn a_line_whose_place_is_lost_in_rounding_has_any_part() {
        let function = Affine { middle: 1.0, slopes: [1e-18, 0.0] };
        assert_eq!(function.part_above(1.0), Interval { lower: 0.0, upper: 1.0 });
        assert_eq!(
            Affine { middle: f64::NAN, slopes: [1.0; 2] }.part_above(0.0),
            Interval { lower: 0.0, upper: 1.0 }
        );
    }
}
