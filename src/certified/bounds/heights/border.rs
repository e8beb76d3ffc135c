//! Where the points of a face that are compared with a cell's end.

use super::frame::Placement;
use super::over::Over;
use super::quadric::Quadric;
use super::rim::{self, Excess};
use crate::axis::Axis;
use crate::certified::faces::FaceRim;
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;
use glam::DVec3;

/// The largest distance, relative to the threshold, by which points of the cell may be beyond a side that is not
/// open.
const MAX_CLOSED: f64 = 0.5;

/// Roundings of a combination of two excesses, relative to the sizes of their terms.
const COMBINATION_ROUNDINGS: f64 = 32.0;

/// Roundings of a step of a length.
const STEP_ROUNDINGS: f64 = 8.0;

/// The number of lines that are looked at for the least of their maximum: most often one or two are found.
const MAX_LINES: usize = 8;

/// The ends of the surface and, of a trimmed face, the sides of a rim. *Open* are those beyond which points of the
/// cell are too far.
pub(super) struct Border {
    /// The placement for the points of the cell that exceed each open end by at most the largest excess.
    placement: Placement,
    is_open: [[bool; 2]; 2],
    rim: Option<FaceRim>,
    /// The excess over each side of the rim, if it is not an open one.
    closed: Vec<Option<f64>>,
    /// The open ends and sides.
    pub(super) open: Vec<Side>,
}

/// An open side.
pub(super) struct Side {
    excess: Excess,
    /// The length of a step of parameters across it.
    length: f64,
}

impl Border {
    /// All that are known, for feet within the threshold and points that are beyond open sides by no more than the
    /// largest excess.
    pub(super) fn all(over: &Over<'_>, largest: f64, threshold: f64) -> Vec<Self> {
        let closer = over.closer_placement(threshold);
        let lengths = over.frame.tangents.map(DVec3::length);
        let is_open = over.open_ends(&closer, threshold);
        let placement = limited(&closer, is_open, lengths.map(|length| largest / length));
        let of = |rim: Option<FaceRim>| {
            let mut border = Self { placement, is_open, rim, closed: Vec::new(), open: Vec::new() };
            for axis in Axis::BOTH {
                let length = lengths[axis.index()];
                let ends = (0..2).filter(|end| is_open[axis.index()][*end]);
                border
                    .open
                    .extend(ends.map(|end| Side { excess: over.end_excess(&closer, axis, end), length }));
            }
            for side in border.rim.iter().flat_map(|rim| &rim.sides) {
                let excess = rim::excess(over, &placement, side, threshold);
                let (length, highest) = (lengths[side.axis.index()], excess.highest());
                let is_closed = !is_far(highest * length, threshold);
                border.closed.push(is_closed.then_some(highest));
                if !is_closed {
                    border.open.push(Side { excess, length });
                }
            }
            border
        };
        let rims = match &over.face {
            Some(face) if !face.holds(placement.feet) => {
                face.rims(placement.feet).into_iter().map(Some).collect()
            }
            _ => vec![None],
        };
        rims.into_iter().map(of).collect()
    }

    /// The bound for the points of the cell that are beyond no open side by more than this length, for feet within
    /// the threshold.
    pub(super) fn upper_bound(&self, over: &Over<'_>, excess: f64, threshold: f64) -> Option<f64> {
        let steps =
            over.frame.tangents.map(|tangent| (1.0 + gamma(STEP_ROUNDINGS)) * excess / tangent.length());
        let placement = limited(&self.placement, self.is_open, steps);
        let overrun = match &self.rim {
            None => None,
            Some(rim) => {
                let sides = rim.sides.iter().zip(&self.closed);
                let excesses: Vec<f64> =
                    sides.map(|(side, closed)| closed.unwrap_or(steps[side.axis.index()])).collect();
                Some(rim::overrun_of(over, &placement, rim, &excesses, threshold)?)
            }
        };
        over.with_overrun(&placement, overrun, threshold)
    }
}

/// Whether points that are beyond a side by this length are too far.
fn is_far(beyond: f64, threshold: f64) -> bool {
    !(beyond <= MAX_CLOSED * threshold)
}

/// A placement for the points that are beyond no open end by more than these steps.
fn limited(placement: &Placement, is_open: [[bool; 2]; 2], steps: [f64; 2]) -> Placement {
    let limit = |axis: usize| is_open[axis].map(|is_open| if is_open { steps[axis] } else { f64::INFINITY });
    placement.limited([limit(0), limit(1)])
}

impl Over<'_> {
    /// The ends of the surface beyond which points of the cell are too far.
    pub(super) fn open_ends(&self, placement: &Placement, threshold: f64) -> [[bool; 2]; 2] {
        [0, 1].map(|axis| {
            let length = self.frame.tangents[axis].length();
            placement.beyond[axis].map(|beyond| is_far(beyond * length, threshold))
        })
    }

    /// How far F is beyond an end of the surface at a fixed point.
    fn end_excess(&self, placement: &Placement, axis: Axis, end: usize) -> Excess {
        let Quadric { linear, form } = placement.functions[axis.index()];
        let sign = if end == 0 { -1.0 } else { 1.0 };
        let function = Quadric { linear: sign * linear, form: form * sign };
        Excess::new(function, &self.a, placement.offsets[axis.index()][end])
    }
}

impl Side {
    /// A coefficient of the excess as a length.
    pub(super) fn coefficient(&self, index: usize) -> f64 {
        let (value, weight) = self.excess.values.coefficients[index];
        self.length * (value / weight + self.excess.constant)
    }

    /// The excess as a length at a point of the cell.
    pub(super) fn at(&self, point: DVec3) -> f64 {
        self.length * (self.excess.function.at(point) + self.excess.constant)
    }

    /// An upper bound on the lesser of two excesses as lengths over the cell, by a combination of both.
    pub(super) fn lesser_excess(&self, other: &Self) -> f64 {
        let lengths: Vec<[f64; 2]> = (0..self.excess.values.coefficients.len())
            .map(|index| [self.coefficient(index), other.coefficient(index)])
            .collect();
        let share = share_of(&lengths);
        let mut highest = f64::NEG_INFINITY;
        for [one, two] in lengths {
            highest = upper_max(highest, share * one + (1.0 - share) * two);
        }
        highest + share * self.error() + (1.0 - share) * other.error()
    }

    /// The rounding error of a coefficient in a combination.
    fn error(&self) -> f64 {
        let Excess { values, constant, .. } = &self.excess;
        self.length * (values.error + gamma(COMBINATION_ROUNDINGS) * (values.size + constant.abs()))
    }
}

/// The share s of [0, 1] with which the largest `s one + (1 - s) other` of pairs is about the least.
///
/// The largest is a convex function of s, the maximum of a line for each pair: between a line that falls and one that
/// rises its least value is where a higher line replaces one of both, or where they meet.
fn share_of(pairs: &[[f64; 2]]) -> f64 {
    let value = |share: f64, [one, other]: [f64; 2]| share * one + (1.0 - share) * other;
    let highest = |share: f64| {
        let higher = |best: [f64; 2], pair: [f64; 2]| {
            if value(share, pair) > value(share, best) { pair } else { best }
        };
        pairs.iter().copied().reduce(higher).unwrap_or_default()
    };
    let rise = |[one, other]: [f64; 2]| one - other;
    let [mut falling, mut rising] = [highest(0.0), highest(1.0)];
    if rise(falling) >= 0.0 {
        return 0.0;
    }
    if rise(rising) <= 0.0 {
        return 1.0;
    }
    let meeting = |falling: [f64; 2], rising: [f64; 2]| {
        ((falling[1] - rising[1]) / (rise(rising) - rise(falling))).clamp(0.0, 1.0)
    };
    for _ in 0..MAX_LINES {
        let highest = highest(meeting(falling, rising));
        if highest == falling || highest == rising {
            break;
        }
        *(if rise(highest) > 0.0 { &mut rising } else { &mut falling }) = highest;
    }
    meeting(falling, rising)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::bezier::bernstein;
    use crate::certified::bounds::heights::piece::Values;

    /// A linear function of the first parameter.
    fn side(ends: [f64; 2], constant: f64, length: f64, error: f64) -> Side {
        let coefficients = [ends[0], ends[0], ends[1], ends[1]].map(|value| (2.0 * value, 2.0)).to_vec();
        let values = Values { degree: [1, 1], coefficients, size: 3.0, error };
        let function = Quadric::of_plane(DVec3::ZERO);
        Side { excess: Excess { function, values, constant }, length }
    }

    /// Two functions with opposite slopes have what their constants leave in common, with the errors of both.
    #[test]
    fn the_lesser_excess_has_the_errors_of_both() {
        let (one, other) = (side([-1.0, 1.0], 0.25, 2.0, 1e-3), side([4.0, -4.0], 0.5, 0.5, 1e-2));
        // 2 (x + 0.25) and 0.5 (0.5 - 4 x): half of both is 0.375.
        let rounding = |constant: f64| gamma(32.0) * (3.0 + constant);
        let error = 0.5 * (2.0 * (1e-3 + rounding(0.25)) + 0.5 * (1e-2 + rounding(0.5)));
        let found = one.lesser_excess(&other);
        assert!((found - (0.375 + error)).abs() < 1e-15, "{found}");
        // Without errors of their own, that of the combination is what is left.
        let [one, other] = [side([-1.0, 1.0], 0.25, 2.0, 0.0), side([4.0, -4.0], 0.5, 0.5, 0.0)];
        assert!(
            one.lesser_excess(&other) >= 0.375 + 0.5 * (2.0 * rounding(0.25) + 0.5 * rounding(0.5)) - 1e-16
        );
    }

    /// No other share makes the largest combination of two functions less, whether the lines fall and rise or do one of
    /// both.
    #[test]
    fn the_share_lowers_the_largest_most() {
        let random = &mut fastrand::Rng::with_seed(3212);
        for case in 0..300 {
            let bias = [0.0, 1.0, -1.0][case % 3];
            let pairs: Vec<[f64; 2]> =
                (0..9).map(|_| [random.f64() - 0.5 + bias, random.f64() - 0.5 - bias]).collect();
            let largest = |share: f64| {
                let values = pairs.iter().map(|[one, other]| share * one + (1.0 - share) * other);
                values.fold(f64::NEG_INFINITY, upper_max)
            };
            let share = share_of(&pairs);
            assert!((0.0..=1.0).contains(&share));
            let least = (0..=1000).map(|k| largest(f64::from(k) / 1000.0)).fold(f64::INFINITY, f64::min);
            assert!(largest(share) <= least + 1e-12, "{} {least} of case {case}", largest(share));
        }
    }

    /// No place of a cell is beyond both by more than the lesser excess, and it is that of one place where both
    /// are parallel.
    #[test]
    fn no_place_is_beyond_both_by_more() {
        let random = &mut fastrand::Rng::with_seed(3211);
        for _ in 0..200 {
            let mut number = || random.f64() - 0.5;
            let [one, other] =
                [0; 2].map(|_| side([number(), number()], number(), 1.0 + number().abs(), 0.0));
            let lesser = one.lesser_excess(&other);
            for step in 0..=20 {
                let basis = bernstein(1, f64::from(step) / 20.0);
                let value = |side: &Side| basis[0] * side.coefficient(0) + basis[1] * side.coefficient(2);
                assert!(value(&one).min(value(&other)) <= lesser + 1e-15);
            }
        }
    }
}
