//! A cell and the part of B over it.

use super::fit::{Fit, ORDERS, POINTS_ALONG};
use super::frame::{Frame, Image, Part, Placement};
use super::piece::Piece;
use super::quadric::{Cubic, Quadric};
use super::rim;
use crate::certified::cell_context::CellContext;
use crate::certified::faces::FaceChart;
use crate::certified::rounding::gamma;
use crate::rounding::upper_max;
use glam::Vec4Swizzles;
use std::cell::OnceCell;

/// The part of the threshold, for each order, by which a function may vary over a cell: no closer one of that
/// order is looked for.
const SUFFICIENT_SPREAD: f64 = 0.125;

/// The largest length of `T o`, relative to the threshold, that is not looked at more closely.
const MAX_BEYOND: f64 = 0.125;

/// Roundings of the turns, relative to the sizes of their terms.
const TURN_ROUNDINGS: f64 = 64.0;

/// A cell about a foot and the part of B over it.
pub(super) struct Over<'a> {
    pub(super) frame: Frame<'a>,
    /// The face whose surface it is, if that is trimmed.
    pub(super) face: Option<FaceChart<'a>>,
    pub(super) a: Piece,
    pub(super) image: Image,
    /// The fixed points by linear functions.
    pub(super) linear: Placement,
    closer: OnceCell<Placement>,
}

impl<'a> Over<'a> {
    /// `None` where B turns too far or has too many patches over the cell.
    pub(super) fn new(
        context: &CellContext<'a>,
        frame: Frame<'a>,
        face: Option<FaceChart<'a>>,
    ) -> Option<Self> {
        let a = piece_of_a(context, &frame);
        let (image, linear) = frame.image(&a)?;
        Some(Self::of(frame, face, a, image, linear))
    }

    pub(super) fn of(
        frame: Frame<'a>,
        face: Option<FaceChart<'a>>,
        a: Piece,
        image: Image,
        linear: Placement,
    ) -> Self {
        Self { frame, face, a, image, linear, closer: OnceCell::new() }
    }

    /// The bound from this foot; `None` where a point of B that is compared with the cell may be beyond the face,
    /// or beyond the surface by more than the threshold.
    pub(super) fn upper_bound(&self, threshold: f64) -> Option<f64> {
        let is_held =
            |placement: &Placement| self.face.as_ref().is_none_or(|face| face.holds(placement.feet));
        let mut placement = self.linear;
        let mut overrun = None;
        if self.beyond(&placement) > MAX_BEYOND * threshold || !is_held(&placement) {
            placement = self.closer_placement();
            if !is_held(&placement) {
                overrun = Some(rim::overrun(self, self.face.as_ref()?, &placement, threshold)?);
            }
        }
        self.with_overrun(&placement, overrun, threshold)
    }

    /// The bound with what points of B may be beyond a rim of the face, where cells are over one.
    ///
    /// An overrun holds for feet within the threshold: the result is `None` where the bound exceeds what the
    /// overrun leaves of it, and where points of B may be beyond the surface by more than that.
    pub(super) fn with_overrun(
        &self,
        placement: &Placement,
        overrun: Option<f64>,
        threshold: f64,
    ) -> Option<f64> {
        let rest = threshold - overrun.unwrap_or(0.0);
        if !(self.beyond(placement) <= rest) {
            return None;
        }
        let bound = self.least_bound(placement, rest);
        let is_proven = overrun.is_none() || bound <= rest;
        let of_face = self.face.as_ref().map_or(0.0, |face| face.point_error);
        is_proven.then_some(bound + overrun.unwrap_or(0.0) + of_face)
    }

    /// The fixed points by functions that follow B's parameters to second order.
    pub(super) fn closer_placement(&self) -> Placement {
        *self.closer.get_or_init(|| self.frame.closer_placement(&self.a, &self.image))
    }

    /// The sum of the largest distances of the cell's points and of those of B from the foot.
    pub(super) fn reach(&self) -> f64 {
        self.image.radius() + self.a.radius
    }

    /// l of the lemma.
    fn beyond(&self, placement: &Placement) -> f64 {
        (0..2).map(|axis| self.frame.tangents[axis].length() * placement.overshoot[axis]).sum()
    }

    /// The least bound, or the first that is at most the threshold, by functions of rising order.
    fn least_bound(&self, placement: &Placement, threshold: f64) -> f64 {
        let plane = Cubic::of(Quadric::of_plane(self.frame.normal));
        let mut least = self.bound_by(&plane, placement, threshold);
        if least <= threshold {
            return least;
        }
        let samples = self.a.samples(POINTS_ALONG);
        let Some(mut fit) = Fit::new(self.frame.normal, self.frame.tangents[0], &samples) else {
            return least;
        };
        let mut sufficient = threshold;
        for terms in ORDERS {
            sufficient *= SUFFICIENT_SPREAD;
            fit.add(terms, sufficient);
            let function = fit.function();
            if fit.spread() > threshold {
                continue;
            }
            let bound = self.bound_by(&function, placement, threshold);
            least = if bound < least { bound } else { least };
            if least <= threshold {
                break;
            }
        }
        least
    }

    /// The lemma's bound; infinite where it does not apply or is not expected to reach the threshold.
    pub(super) fn bound_by(&self, function: &Cubic, placement: &Placement, threshold: f64) -> f64 {
        let Self { frame: Frame { skew, normal, tangents, .. }, a, .. } = self;
        let is_quadric = function.size() == 0.0;
        let range = |piece: &Piece| {
            if is_quadric { piece.values(&function.quadric) } else { piece.values_of_cubic(function) }.range()
        };
        let [low, high] = range(a);
        if high - low > 2.0 * threshold {
            return f64::INFINITY;
        }
        let mut difference = 0.0_f64;
        for Part { piece, .. } in &self.image.parts {
            let [least, largest] = range(piece);
            difference = upper_max(difference, upper_max(largest - low, high - least));
        }
        let reach = self.reach();
        let Quadric { linear, form } = function.quadric;
        let tilt = linear - *normal;
        let turn = tilt.length() + function.quadric.size() * reach + function.size() * reach * reach;
        let turn_of_normal = normal.dot(tilt).abs()
            + (form * *normal).length() * reach
            + function.size_along(*normal) * reach * reach
            + gamma(TURN_ROUNDINGS) * (1.0 + turn);
        let bend: f64 =
            (0..2).map(|axis| tangents[axis].length() * placement.functions[axis].size() * reach).sum();
        let beyond = self.beyond(placement);
        let shrunk = 1.0 - turn_of_normal;
        let rest = 1.0 - bend - skew - (skew * (1.0 + bend) + turn * (bend + skew)) / shrunk;
        let applies = turn <= 1.0 && turn_of_normal <= 0.5 && rest >= 0.5;
        if !applies {
            return f64::INFINITY;
        }
        ((difference + (skew + turn) * beyond) / shrunk + beyond) / rest
    }
}

/// The cell about the foot.
fn piece_of_a(context: &CellContext<'_>, frame: &Frame<'_>) -> Piece {
    let (patch, transform) = (&context.patch, &context.pair.transform);
    let [s, t] = context.cell.ranges();
    let mut controls = patch.restricted(s, t);
    for control in &mut controls {
        *control = transform.rotate(control.xyz()).extend(control.w);
    }
    let shift = frame.jet.point - transform.apply(patch.center);
    Piece::new(patch.degree, controls, shift, context.patch_bounds().radius)
}
