//! Upper bounds for a cell, and what those of one cell share.

use super::audit::{Lemma, Lemmas};
use super::nearest::{Feet, Foot, NearestPoint, Sample};
use super::rounding::JetScale;
use super::{Cell, Pair};
use crate::bezier::{DerivativeBounds, Jet, Patch};
use std::cell::OnceCell;

/// An upper bound on `max d(a, B)` over the points a of a cell.
pub(super) trait UpperBound: Sync {
    /// The lemma that states and proves it.
    fn lemma(&self) -> Lemma;

    /// The bound; `None` where it does not apply or is not expected to reach
    /// the threshold. NaN counts as no bound.
    fn evaluate(&self, context: &mut CellContext<'_>, threshold: f64) -> Option<f64>;
}

/// The least of several bounds, with the lemma that it rests on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LeastBound {
    pub(super) upper: f64,
    /// `None` as long as there is no bound.
    pub(super) lemma: Option<Lemma>,
}

impl LeastBound {
    /// No bound yet.
    pub(super) const NONE: Self = Self { upper: f64::INFINITY, lemma: None };

    /// Takes a bound if it is less. NaN bounds nothing.
    pub(super) fn take(&mut self, upper: f64, lemma: Lemma) {
        if upper < self.upper {
            *self = Self { upper, lemma: Some(lemma) };
        }
    }
}

/// The bound by Taylor's theorem that a foot gives.
#[derive(Debug, Clone, Copy)]
pub(super) struct TaylorBound {
    pub(super) foot: Foot,
    /// B's jet at the foot.
    pub(super) jet: Jet,
    pub(super) bound: f64,
    /// Whether a map over the seams of B's patch may still give a smaller one.
    pub(super) may_cross_seams: bool,
}

/// A cell of A with its moved jet, its derivative bounds and the feet of its
/// centre.
pub(super) struct CellContext<'a> {
    pub(super) pair: &'a Pair<'a>,
    pub(super) nearest: &'a NearestPoint<'a>,
    pub(super) cell: Cell,
    /// A's patch, not moved.
    pub(super) patch: Patch<'a>,
    /// A's moved jet at the centre.
    pub(super) jet: Jet,
    /// Known feet of the centre.
    pub(super) feet: Feet,
    /// The farthest point of the cell evaluated so far.
    pub(super) farthest: Sample,
    /// An upper bound on the distance of the cell's points from its centre.
    pub(super) radius: f64,
    /// What the rounding of A's derivatives depends on.
    pub(super) jet_scale: JetScale,
    /// The lemmas whose bounds were refuted and are not tried.
    pub(super) struck: Lemmas,
    /// The latest Taylor bound.
    pub(super) taylor: Option<TaylorBound>,
    local_bounds: OnceCell<DerivativeBounds>,
}

impl<'a> CellContext<'a> {
    /// The context with one foot, found from the one inherited from the cell's parent.
    pub(super) fn new(
        pair: &'a Pair<'_>,
        nearest: &'a NearestPoint<'_>,
        cell: Cell,
        inherited: &Foot,
    ) -> Self {
        let jet = pair.jet_of_a(cell.patch, cell.center);
        let foot = nearest.on_patch(jet.point, inherited.patch, inherited.parameters);
        Self {
            pair,
            nearest,
            cell,
            patch: pair.a.patch(cell.patch),
            jet,
            feet: Feet::new(foot),
            farthest: Sample { patch: cell.patch, parameters: cell.center, foot },
            radius: cell.radius(pair.a.patch_bounds(cell.patch).first),
            jet_scale: pair.a.jet_scale(cell.patch),
            struck: Lemmas::default(),
            taylor: None,
            local_bounds: OnceCell::new(),
        }
    }

    /// The nearest known foot of the centre.
    pub(super) fn foot(&self) -> Foot {
        self.feet.nearest()
    }

    /// Takes the feet of a query for the centre.
    pub(super) fn set_feet(&mut self, feet: Feet) {
        self.farthest.foot = feet.nearest();
        self.feet = feet;
    }

    /// Takes note of a point of the cell that may be the farthest.
    pub(super) fn observe(&mut self, parameters: [f64; 2], foot: Foot) {
        if foot.distance_squared > self.farthest.foot.distance_squared {
            self.farthest = Sample { parameters, foot, ..self.farthest };
        }
    }

    /// Bounds of A's derivatives over the whole patch.
    pub(super) fn patch_bounds(&self) -> &DerivativeBounds {
        self.pair.a.patch_bounds(self.cell.patch)
    }

    /// Closer bounds over the parts of the patch that the cell touches.
    pub(super) fn local_bounds(&self) -> &DerivativeBounds {
        self.local_bounds.get_or_init(|| {
            let [s, t] = self.cell.ranges();
            let inside = |parameter: f64| parameter.clamp(0.0, 1.0);
            let [low, high] = [0, 1].map(|end| [inside(s[end]), inside(t[end])]);
            self.pair.a.bounds(self.cell.patch, low, high)
        })
    }
}
