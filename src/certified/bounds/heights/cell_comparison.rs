//! A cell and the part of B over it.

use super::candidate::{Candidate, candidates};
use super::frame::{Frame, Image, Placement};
use super::piece::Piece;
use super::quadric::Quadric;
use crate::certified::cell_context::CellContext;
use crate::certified::faces::FaceChart;
use crate::certified::rounding::gamma;
use crate::rounding::{upper_max, upper_min};
use glam::Vec4Swizzles;

/// Roundings of the turns, relative to the sizes of their terms.
const TURN_ROUNDINGS: f64 = 64.0;

/// A cell about a foot and the part of B over it.
pub(super) struct CellComparison<'a> {
    pub(super) frame: Frame<'a>,
    /// The face whose surface it is, if that is trimmed.
    pub(super) face: Option<FaceChart<'a>>,
    pub(super) a: Piece,
    pub(super) image: Image,
    /// The fixed points by linear functions.
    pub(super) linear: Placement,
}

impl<'a> CellComparison<'a> {
    /// `None` where B turns too far or has too many patches over the cell.
    pub(super) fn new(
        context: &CellContext<'a>,
        frame: Frame<'a>,
        face: Option<FaceChart<'a>>,
    ) -> Option<Self> {
        let a = piece_of_a(context, &frame);
        let (image, linear) = frame.image(&a)?;
        Some(Self { frame, face, a, image, linear })
    }

    /// The bound where the fixed points are at this placement and their images drift at most so far from them to
    /// points of the face; no drift where all of them are in the face.
    ///
    /// A drift holds for feet within the threshold: the result is `None` where the bound exceeds what the drift
    /// leaves of it, and where the overhang does.
    pub(super) fn upper_bound(
        &self,
        placement: &Placement,
        drift: Option<f64>,
        threshold: f64,
    ) -> Option<f64> {
        let rest = threshold - drift.unwrap_or(0.0);
        if !(self.overhang(placement) <= rest) {
            return None;
        }
        let frame = &self.frame;
        let mut bound = f64::INFINITY;
        for candidate in candidates(&self.a, frame.normal, frame.tangents[0], rest) {
            bound = upper_min(bound, self.bound_by(placement, &candidate));
            if bound <= rest {
                break;
            }
        }
        let is_proven = drift.is_none() || bound <= rest;
        let of_face = self.face.as_ref().map_or(0.0, |face| face.point_error);
        is_proven.then_some(bound + drift.unwrap_or(0.0) + of_face)
    }

    /// Whether the points of B that are compared with the cell are in the face.
    pub(super) fn is_held(&self, placement: &Placement) -> bool {
        self.face.as_ref().is_none_or(|face| face.holds(placement.feet))
    }

    /// The sum of the largest distances of the cell's points and of those of B from the foot.
    pub(super) fn reach(&self) -> f64 {
        self.image.radius() + self.a.radius
    }

    /// l of the lemma.
    pub(super) fn overhang(&self, placement: &Placement) -> f64 {
        (0..2).map(|axis| self.frame.tangents[axis].length() * placement.overhang[axis]).sum()
    }

    /// The lemma's bound by a function where the fixed points are at this placement; infinite where it does not apply.
    pub(super) fn bound_by(&self, placement: &Placement, candidate: &Candidate) -> f64 {
        let Candidate { function, range: [low, high] } = candidate;
        let Frame { skew, normal, tangents, .. } = self.frame;
        let mut difference = 0.0_f64;
        for part in &self.image.parts {
            let [least, largest] = part.piece.range(function);
            difference = upper_max(difference, upper_max(largest - low, high - least));
        }
        let (reach, overhang) = (self.reach(), self.overhang(placement));
        let [bend_s, bend_t] =
            [0, 1].map(|axis| tangents[axis].length() * placement.functions[axis].size() * reach);
        let bend = bend_s + bend_t;
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
        ((difference + (skew + turn) * overhang) / shrunk + overhang) / rest
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
