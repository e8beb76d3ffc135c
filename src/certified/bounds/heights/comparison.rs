//! The difference of the heights of a cell and of a part of B over a plane.

use super::fit::{Fit, ORDERS, POINTS_ALONG};
use super::piece::Piece;
use super::quadric::{Cubic, Quadric};
use crate::certified::rounding::gamma;
use crate::rounding::{upper_max, upper_min};
use glam::DVec3;

/// The part of the threshold, for each order, by which a function may vary over a cell: no closer one of that
/// order is looked for.
const SUFFICIENT_SPREAD: f64 = 0.125;

/// Roundings of the turns, relative to the sizes of their terms.
const TURN_ROUNDINGS: f64 = 64.0;

/// What lemma 3.17 compares by a function f.
pub(super) struct Comparison<'s> {
    pub(super) a: &'s Piece,
    pub(super) b: Vec<&'s Piece>,
    pub(super) normal: DVec3,
    /// ν.
    pub(super) skew: f64,
    /// θ.
    pub(super) bend: f64,
    /// l.
    pub(super) beyond: f64,
}

/// A function with its range on the cell.
pub(super) struct Candidate {
    function: Cubic,
    range: [f64; 2],
}

/// Functions of rising order that nearly vanish on a cell, with the height over the plane at first: those whose values
/// on the cell may let a bound reach the threshold.
///
/// It is boxed, and taken as a trait object: one copy of the code is smaller in the browser, and a function takes
/// thousands of times as long.
pub(super) fn candidates(
    a: &Piece,
    normal: DVec3,
    tangent: DVec3,
    threshold: f64,
) -> Box<dyn Iterator<Item = Candidate> + '_> {
    let plane = std::iter::once(Cubic::of(Quadric::of_plane(normal)));
    let fits = std::iter::once_with(move || Fit::new(normal, tangent, &a.samples([POINTS_ALONG; 2])));
    let fitted = fits.flatten().flat_map(move |mut fit| {
        let mut sufficient = threshold;
        ORDERS.into_iter().filter_map(move |terms| {
            sufficient *= SUFFICIENT_SPREAD;
            fit.add(terms, sufficient);
            (fit.spread() <= threshold).then(|| fit.function())
        })
    });
    let all = plane.chain(fitted).map(move |function| Candidate::new(function, a));
    Box::new(all.filter(move |candidate| {
        let [low, high] = candidate.range;
        high - low <= 2.0 * threshold
    }))
}

impl Candidate {
    /// Takes any function.
    pub(super) fn new(function: Cubic, a: &Piece) -> Self {
        let range = a.range(&function);
        Self { function, range }
    }

    /// Whether the value at a point of B lets a bound be at most the threshold.
    pub(super) fn is_near(&self, point: DVec3, threshold: f64) -> bool {
        let (value, [low, high]) = (self.function.at(point), self.range);
        value - low <= threshold && high - value <= threshold
    }
}

impl Comparison<'_> {
    /// The sum of the largest distances of the cell's points and of those of B from the foot.
    fn reach(&self) -> f64 {
        self.b.iter().fold(0.0, |radius, piece| upper_max(radius, piece.radius)) + self.a.radius
    }

    /// The least of the bounds by these functions, or the first that is at most the threshold.
    pub(super) fn least_bound(&self, candidates: &mut dyn Iterator<Item = Candidate>, threshold: f64) -> f64 {
        let mut least = f64::INFINITY;
        for candidate in candidates {
            least = upper_min(least, self.bound_by(&candidate));
            if least <= threshold {
                break;
            }
        }
        least
    }

    /// The lemma's bound; infinite where it does not apply.
    pub(super) fn bound_by(&self, Candidate { function, range: [low, high] }: &Candidate) -> f64 {
        let Self { normal, skew, bend, beyond, .. } = *self;
        let mut difference = 0.0_f64;
        for piece in &self.b {
            let [least, largest] = piece.range(function);
            difference = upper_max(difference, upper_max(largest - low, high - least));
        }
        let reach = self.reach();
        let Quadric { linear, form } = function.quadric;
        let tilt = linear - normal;
        let turn = tilt.length() + function.quadric.size() * reach + function.size() * reach * reach;
        let turn_of_normal = normal.dot(tilt).abs()
            + (form * normal).length() * reach
            + function.size_along(normal) * reach * reach
            + gamma(TURN_ROUNDINGS) * (1.0 + turn);
        let shrunk = 1.0 - turn_of_normal;
        let rest = 1.0 - bend - skew - (skew * (1.0 + bend) + turn * (bend + skew)) / shrunk;
        let applies = turn <= 1.0 && turn_of_normal <= 0.5 && rest >= 0.5;
        if !applies {
            return f64::INFINITY;
        }
        ((difference + (skew + turn) * beyond) / shrunk + beyond) / rest
    }
}
