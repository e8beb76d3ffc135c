//! A cell and the part of B over it.

use super::comparison::{Comparison, candidates};
use super::frame::{Frame, Image, Placement};
use super::piece::Piece;
use super::rim;
use crate::certified::cell_context::CellContext;
use crate::certified::faces::FaceChart;
use glam::Vec4Swizzles;
use std::cell::OnceCell;

/// The largest length of `T o`, relative to the threshold, that is not looked at more closely.
const MAX_BEYOND: f64 = 0.125;

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
        let mut placement = self.linear;
        let mut overrun = None;
        if self.beyond(&placement) > MAX_BEYOND * threshold || !self.is_held(&placement) {
            placement = self.closer_placement(threshold);
            if !self.is_held(&placement) {
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
        let frame = &self.frame;
        let mut candidates = candidates(&self.a, frame.normal, frame.tangents[0], rest);
        let bound = self.comparison(placement).least_bound(&mut *candidates, rest);
        let is_proven = overrun.is_none() || bound <= rest;
        let of_face = self.face.as_ref().map_or(0.0, |face| face.point_error);
        is_proven.then_some(bound + overrun.unwrap_or(0.0) + of_face)
    }

    /// The fixed points by functions that follow B's parameters to second order, or that vanish at the ends of the
    /// surface beyond which the cell goes, where the former say too little about these.
    pub(super) fn closer_placement(&self, threshold: f64) -> Placement {
        *self.closer.get_or_init(|| {
            let (frame, a, image) = (&self.frame, &self.a, &self.image);
            let closer = frame.closer_placement(a, image);
            let open = self.open_ends(&closer, threshold);
            let loose = [0, 1].map(|axis| {
                let is_loose = frame.tangents[axis].length() * closer.bracket[axis] > MAX_BEYOND * threshold;
                open[axis].map(|is_open| is_open && is_loose)
            });
            if loose == [[false; 2]; 2] || !self.is_held(&closer) {
                return closer;
            }
            let at_ends = frame.placement_at_ends(a, image, loose, threshold);
            at_ends.filter(|placement| self.is_held(placement)).unwrap_or(closer)
        })
    }

    /// Whether the points of B that are compared with the cell are in the face.
    fn is_held(&self, placement: &Placement) -> bool {
        self.face.as_ref().is_none_or(|face| face.holds(placement.feet))
    }

    /// The sum of the largest distances of the cell's points and of those of B from the foot.
    pub(super) fn reach(&self) -> f64 {
        self.image.radius() + self.a.radius
    }

    /// l of the lemma.
    fn beyond(&self, placement: &Placement) -> f64 {
        (0..2).map(|axis| self.frame.tangents[axis].length() * placement.overshoot[axis]).sum()
    }

    /// What is compared where the fixed points are at this placement.
    pub(super) fn comparison(&self, placement: &Placement) -> Comparison<'_> {
        let Frame { skew, normal, tangents, .. } = self.frame;
        let reach = self.reach();
        let bend = |axis: usize| tangents[axis].length() * self.frame.turn(placement, axis, reach);
        Comparison {
            a: &self.a,
            b: self.image.parts.iter().map(|part| &part.piece).collect(),
            normal,
            skew,
            bend: bend(0) + bend(1),
            beyond: self.beyond(placement),
        }
    }
}

/// The cell about the foot.
pub(super) fn piece_of_a(context: &CellContext<'_>, frame: &Frame<'_>) -> Piece {
    let (patch, transform) = (&context.patch, &context.pair.transform);
    let [s, t] = context.cell.ranges();
    let mut controls = patch.restricted(s, t);
    for control in &mut controls {
        *control = transform.rotate(control.xyz()).extend(control.w);
    }
    let shift = frame.jet.point - transform.apply(patch.center);
    Piece::new(patch.degree, controls, shift, context.patch_bounds().radius)
}
