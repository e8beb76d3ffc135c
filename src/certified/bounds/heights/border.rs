//! Where the points of a face that are compared with a cell's end.

use super::cell_comparison::CellComparison;
use super::frame::Placement;
use super::quadric::Quadric;
use super::rim::{self, Overhang};
use crate::axis::Axis;
use crate::certified::faces::FaceRim;
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;
use glam::DVec3;

/// The largest overhang of linear functions, relative to the threshold, that is not looked at more closely.
const MAX_LOOSE: f64 = 0.125;

/// The largest overhang, relative to the threshold, beyond a side that is not open.
const MAX_CLOSED: f64 = 0.5;

/// The largest overhang, relative to the threshold, beyond an open side of the points that are compared with its
/// face.
pub(super) const MAX_OPEN: f64 = 0.125;

/// Roundings of a combination of two overhangs, relative to the sizes of their terms.
const COMBINATION_ROUNDINGS: f64 = 32.0;

/// Roundings of a step of a length.
const STEP_ROUNDINGS: f64 = 8.0;

/// The number of lines that are looked at for the least of their maximum: most often one or two are found.
const MAX_LINES: usize = 8;

/// The sides of a face over a cell: the ends of its surface and, where it is trimmed, the sides of a rim. *Open* are
/// those beyond which points of the cell are too far; these are compared with other faces.
pub(super) struct Border {
    /// The placement for the points of the cell that are beyond each open end by at most the largest overhang.
    placement: Placement,
    is_open: [[bool; 2]; 2],
    rim: Option<FaceRim>,
    /// The overhang beyond each side of the rim, if it is not an open one.
    closed: Vec<Option<f64>>,
    /// The open ends and sides.
    pub(super) open: Vec<Side>,
}

/// An open side.
pub(super) struct Side {
    overhang: Overhang,
    /// The length of a step of parameters across it.
    length: f64,
}

impl Border {
    /// All that are known, for feet within the threshold; none where it is not known where the face ends.
    pub(super) fn all(cell: &CellComparison<'_>, threshold: f64) -> Vec<Self> {
        let linear = cell.linear;
        if cell.overhang(&linear) <= MAX_LOOSE * threshold && cell.is_held(&linear) {
            let is_open = [[false; 2]; 2];
            return vec![Self {
                placement: linear,
                is_open,
                rim: None,
                closed: Vec::new(),
                open: Vec::new(),
            }];
        }
        let closer = cell.frame.closer_placement(&cell.a, &cell.image);
        let lengths = cell.frame.tangents.map(DVec3::length);
        let is_open = [0, 1].map(|axis| {
            let is_far = |overhang: f64| is_far(overhang * lengths[axis], threshold);
            closer.overhang_at_ends[axis].map(is_far)
        });
        let placement = limited(&closer, is_open, lengths.map(|length| MAX_OPEN * threshold / length));
        let rims = match &cell.face {
            Some(face) if !cell.is_held(&placement) => {
                face.rims(placement.feet).into_iter().map(Some).collect()
            }
            _ => vec![None],
        };
        let of_rim = |rim: Option<FaceRim>| {
            let mut border = Self { placement, is_open, rim, closed: Vec::new(), open: Vec::new() };
            border.add_ends(cell, &closer);
            border.add_sides(cell, threshold);
            border
        };
        rims.into_iter().map(of_rim).collect()
    }

    /// Adds the open ends of the surface, by the functions of a placement.
    fn add_ends(&mut self, cell: &CellComparison<'_>, placement: &Placement) {
        for axis in Axis::BOTH {
            let index = axis.index();
            let length = cell.frame.tangents[index].length();
            for end in (0..2).filter(|end| self.is_open[index][*end]) {
                // How far F is beyond the end at a fixed point.
                let Quadric { linear, form } = placement.functions[index];
                let sign = if end == 0 { -1.0 } else { 1.0 };
                let function = Quadric { linear: sign * linear, form: form * sign };
                let overhang = Overhang::new(function, &cell.a, placement.offsets[index][end]);
                self.open.push(Side { overhang, length });
            }
        }
    }

    /// Adds the sides of the rim.
    fn add_sides(&mut self, cell: &CellComparison<'_>, threshold: f64) {
        for side in self.rim.iter().flat_map(|rim| &rim.sides) {
            let overhang = rim::overhang(cell, &self.placement, side, threshold);
            let (length, highest) = (cell.frame.tangents[side.axis.index()].length(), overhang.highest());
            let is_closed = !is_far(highest * length, threshold);
            self.closed.push(is_closed.then_some(highest));
            if !is_closed {
                self.open.push(Side { overhang, length });
            }
        }
    }

    /// The bound for the points of the cell that are beyond no open side by more than this length, for feet within
    /// the threshold.
    pub(super) fn upper_bound(
        &self,
        cell: &CellComparison<'_>,
        overhang: f64,
        threshold: f64,
    ) -> Option<f64> {
        let steps =
            cell.frame.tangents.map(|tangent| (1.0 + gamma(STEP_ROUNDINGS)) * overhang / tangent.length());
        let placement = limited(&self.placement, self.is_open, steps);
        let drift = match &self.rim {
            None => None,
            Some(rim) => {
                let sides = rim.sides.iter().zip(&self.closed);
                let overhangs: Vec<f64> =
                    sides.map(|(side, closed)| closed.unwrap_or(steps[side.axis.index()])).collect();
                Some(rim::drift(cell, &placement, rim, &overhangs, threshold)?)
            }
        };
        cell.upper_bound(&placement, drift, threshold)
    }
}

/// Whether points that are beyond a side by this length are too far.
fn is_far(overhang: f64, threshold: f64) -> bool {
    !(overhang <= MAX_CLOSED * threshold)
}

/// A placement for the points that are beyond no open end by more than these steps.
fn limited(placement: &Placement, is_open: [[bool; 2]; 2], steps: [f64; 2]) -> Placement {
    let limit = |axis: usize| is_open[axis].map(|is_open| if is_open { steps[axis] } else { f64::INFINITY });
    placement.limited([limit(0), limit(1)])
}

impl Side {
    /// A coefficient of the overhang as a length.
    pub(super) fn coefficient(&self, index: usize) -> f64 {
        let (value, weight) = self.overhang.values.coefficients[index];
        self.length * (value / weight + self.overhang.constant)
    }

    /// The overhang as a length at a point of the cell.
    pub(super) fn at(&self, point: DVec3) -> f64 {
        self.length * (self.overhang.function.at(point) + self.overhang.constant)
    }

    /// An upper bound on the lesser of two overhangs as lengths over the cell, by a combination of both.
    pub(super) fn lesser_overhang(&self, other: &Self) -> f64 {
        let lengths: Vec<[f64; 2]> = (0..self.overhang.values.coefficients.len())
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
        let Overhang { values, constant, .. } = &self.overhang;
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
        Side { overhang: Overhang { function, values, constant }, length }
    }

    /// Two functions with opposite slopes have what their constants leave in common, with the errors of both.
    #[test]
    fn the_lesser_overhang_has_the_errors_of_both() {
        let (one, other) = (side([-1.0, 1.0], 0.25, 2.0, 1e-3), side([4.0, -4.0], 0.5, 0.5, 1e-2));
        // 2 (x + 0.25) and 0.5 (0.5 - 4 x): half of both is 0.375.
        let rounding = |constant: f64| gamma(32.0) * (3.0 + constant);
        let error = 0.5 * (2.0 * (1e-3 + rounding(0.25)) + 0.5 * (1e-2 + rounding(0.5)));
        let found = one.lesser_overhang(&other);
        assert!((found - (0.375 + error)).abs() < 1e-15, "{found}");
        // Without errors of their own, that of the combination is what is left.
        let [one, other] = [side([-1.0, 1.0], 0.25, 2.0, 0.0), side([4.0, -4.0], 0.5, 0.5, 0.0)];
        assert!(
            one.lesser_overhang(&other) >= 0.375 + 0.5 * (2.0 * rounding(0.25) + 0.5 * rounding(0.5)) - 1e-16
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

    /// No place of a cell is beyond both by more than the lesser overhang, and it is that of one place where both
    /// are parallel.
    #[test]
    fn no_place_is_beyond_both_by_more() {
        let random = &mut fastrand::Rng::with_seed(3211);
        for _ in 0..200 {
            let mut number = || random.f64() - 0.5;
            let [one, other] =
                [0; 2].map(|_| side([number(), number()], number(), 1.0 + number().abs(), 0.0));
            let lesser = one.lesser_overhang(&other);
            for step in 0..=20 {
                let basis = bernstein(1, f64::from(step) / 20.0);
                let value = |side: &Side| basis[0] * side.coefficient(0) + basis[1] * side.coefficient(2);
                assert!(value(&one).min(value(&other)) <= lesser + 1e-15);
            }
        }
    }
}
