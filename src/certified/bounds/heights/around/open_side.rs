//! Ends of the surface beyond which a cell goes.

use super::super::fit::{Fit, POINTS};
use super::super::frame::Frame;
use super::super::piece::{Piece, samples_along};
use super::super::quadric::{Cubic, Quadric};
use crate::certified::rounding::gamma;
use crate::rounding::{lower_min, upper_max};
use glam::{DVec2, DVec3};

/// The part of the threshold within which a function vanishes on the end.
const SUFFICIENT_SPREAD: f64 = 1.0 / 64.0;

/// Terms of rising order of the function that vanishes on the end, by the coordinates along it, across the plane and
/// outwards: none across the plane, along which its gradient has to be small.
const TERMS: [[usize; 3]; 7] = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [1, 0, 1], [0, 0, 2], [3, 0, 0], [2, 0, 1]];

/// The largest turn of the function's gradient, relative to it.
const MAX_TURN: f64 = 0.5;

/// How much of the distance from B's nearest point l may contain. A bound of 3.17 grows by at most 6.1 times what l
/// does, so that it holds for all points if it is at most what was taken for their distance.
const MAX_DEPENDENCE: f64 = 0.125;

/// What is left at least of a step across one end at a corner.
const MIN_REST: f64 = 0.25;

/// Roundings of the combination of its terms.
const SUM_ROUNDINGS: f64 = 64.0;

/// An end of the surface that was moved outwards.
#[derive(Debug, Clone, Copy)]
pub(super) struct OpenSide {
    /// The direction outwards in the plane, of length 1.
    pub(super) outwards: DVec2,
    /// How far the cell is beyond the end at most times `1 - turn`, where it is beyond no other.
    excess: f64,
    /// The part of the excess that is this often the distance from B.
    dependence: f64,
    /// The turn of the function's gradient, relative to it.
    turn: f64,
}

/// What the lemma allows for.
pub(super) struct Allowances {
    /// The sum of the largest distances of the cell's points and of those of the part from the foot.
    pub(super) reach: f64,
    pub(super) gap: f64,
    /// What the distance from B is taken for.
    pub(super) threshold: f64,
}

impl OpenSide {
    /// `None` where the end turns too far.
    pub(super) fn new(
        frame: &Frame<'_>,
        [curves, opposite]: [&[Piece]; 2],
        a: &Piece,
        allowances: &Allowances,
    ) -> Option<Self> {
        let &Allowances { reach, gap, threshold } = allowances;
        let (first, last) = (curves.first()?, curves.last()?);
        let [start, end] = [first.corners()[0], last.corners()[3]];
        let along = end - start;
        let outwards = frame.normal.cross(along).normalize_or_zero();
        let is_inwards = outwards.dot(start - opposite.first()?.corners()[0]) < 0.0;
        let outwards = if is_inwards { -outwards } else { outwards };
        if outwards == DVec3::ZERO {
            return None;
        }
        let samples = samples_along(curves, POINTS);
        // No function that follows a parabola of twice this turn turns less than it may.
        let sagitta = outwards.dot(samples[samples.len() / 2] - start).abs();
        if !(4.0 * sagitta * reach <= 2.0 * MAX_TURN * along.length_squared()) {
            return None;
        }
        let mut function = Cubic::of(Quadric::of_plane(outwards));
        // A straight end through the foot has no height over its line.
        if let Some(mut fit) = Fit::new(outwards, along, &samples) {
            fit.add(&TERMS, SUFFICIENT_SPREAD * threshold);
            function = fit.function();
        }
        let [x, y] = frame.tangents.map(|tangent| tangent.dot(function.quadric.linear));
        let gradient = DVec2::new(x, y);
        let speed = gradient.length();
        let turn = (function.quadric.size() + function.size() * reach) * reach / speed;
        let of_normal = frame.normal.dot(function.quadric.linear).abs()
            + ((function.quadric.form * frame.normal).length() + function.size_along(frame.normal) * reach)
                * reach;
        if !(turn <= MAX_TURN) {
            return None;
        }
        // What the excess is at least.
        let ahead =
            a.corners().map(|point| function.at(point)).into_iter().fold(f64::NEG_INFINITY, upper_max);
        let behind = samples.iter().map(|point| function.at(*point)).fold(f64::INFINITY, lower_min);
        if !(ahead - behind <= threshold * speed) {
            return None;
        }
        let [_, highest] = a.range(&function);
        let least = curves.iter().map(|curve| curve.range(&function)[0]).fold(f64::INFINITY, lower_min);
        let aside = function.quadric.linear.length() / speed + turn;
        let dependence = of_normal / speed + gamma(SUM_ROUNDINGS) * (1.0 + turn) + aside * frame.skew;
        let excess = (highest - least) / speed + aside * gap + dependence * threshold;
        Some(Self { outwards: gradient / speed, excess: upper_max(excess, 0.0), dependence, turn })
    }

    /// How far a point of the cell is beyond the open ones of the ends of the first axis and of the second at most;
    /// `None` where that depends too much on the distance from B.
    pub(super) fn beyond(ends: [[Option<Self>; 2]; 2]) -> Option<f64> {
        let dependence = sum_of(&ends, |end| end.dependence)?;
        let excess = sum_of(&ends, |end| end.excess)?;
        (dependence <= MAX_DEPENDENCE).then_some((1.0 + gamma(SUM_ROUNDINGS)) * excess)
    }
}

/// The largest sum of steps across ends that have these excesses: across one of them, or across two at their corner.
fn sum_of([first, second]: &[[Option<OpenSide>; 2]; 2], excess: impl Fn(&OpenSide) -> f64) -> Option<f64> {
    let step = |end: &OpenSide| excess(end) / (1.0 - end.turn);
    let mut largest = 0.0;
    for end in first.iter().chain(second).flatten() {
        largest = upper_max(largest, step(end));
    }
    for one in first.iter().flatten() {
        for other in second.iter().flatten() {
            let between = one.outwards.dot(other.outwards).abs();
            let [s, t] = [one, other].map(|end| (between + end.turn) / (1.0 - end.turn));
            let rest = 1.0 - s * t;
            if !(rest >= MIN_REST) {
                return None;
            }
            largest = upper_max(largest, ((1.0 + t) * step(one) + (1.0 + s) * step(other)) / rest);
        }
    }
    Some(largest)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::rounding::UNIT_ROUNDOFF;

    fn side(outwards: [f64; 2], excess: f64, dependence: f64, turn: f64) -> Option<OpenSide> {
        Some(OpenSide { outwards: DVec2::from(outwards), excess, dependence, turn })
    }

    fn assert_close(value: Option<f64>, expected: f64) {
        assert!(
            value.is_some_and(|value| (value - expected).abs() <= 100.0 * UNIT_ROUNDOFF),
            "{value:?} {expected}"
        );
    }

    /// Across one end the excess counts with its turn, the larger of two opposite ones.
    #[test]
    fn the_larger_of_two_opposite_steps_counts() {
        let [one, other] = [side([1.0, 0.0], 0.2, 0.0, 0.0), side([-1.0, 0.0], 0.2, 0.0, 0.5)];
        assert_close(OpenSide::beyond([[None, None], [None, None]]), 0.0);
        assert_close(OpenSide::beyond([[one, None], [None, None]]), 0.2);
        assert_close(OpenSide::beyond([[one, other], [None, None]]), 0.4);
        assert_close(OpenSide::beyond([[None, None], [other, one]]), 0.4);
    }

    /// At a corner the steps x = e + s y and y = f + t x are solved, s and t the cosine and the turn over `1 - turn`.
    #[test]
    fn steps_at_a_corner_depend_on_each_other() {
        let one = side([1.0, 0.0], 0.2, 0.0, 0.0);
        assert_close(OpenSide::beyond([[one, None], [None, side([0.0, 1.0], 0.1, 0.0, 0.0)]]), 0.3);
        let (cosine, turn) = (-0.6, 0.1);
        let askew = side([cosine, 0.8], 0.1, 0.0, turn);
        let (s, t) = (0.6, (0.6 + turn) / (1.0 - turn));
        let (e, f) = (0.2, 0.1 / (1.0 - turn));
        let x = (e + s * f) / (1.0 - s * t);
        let y = (f + t * e) / (1.0 - s * t);
        assert!((x - (e + s * y)).abs() < 1e-15 && (y - (f + t * x)).abs() < 1e-15);
        assert_close(OpenSide::beyond([[None, one], [askew, None]]), x + y);
        // Nearly parallel ends leave nothing.
        assert_eq!(OpenSide::beyond([[None, one], [side([0.9, 0.435], 0.1, 0.0, 0.1), None]]), None);
    }

    /// Steps may depend on the distance by an eighth at most, at a corner in sum.
    #[test]
    fn steps_depend_little_on_the_distance() {
        let of = |dependence: f64| side([1.0, 0.0], 0.1, dependence, 0.0);
        assert!(OpenSide::beyond([[of(0.124), None], [None, None]]).is_some());
        assert_eq!(OpenSide::beyond([[of(0.126), None], [None, None]]), None);
        let [x, y] = [of(0.07), side([0.0, 1.0], 0.1, 0.07, 0.0)];
        assert!(OpenSide::beyond([[x, None], [None, None]]).is_some());
        assert_eq!(OpenSide::beyond([[x, None], [y, None]]), None);
    }
}
