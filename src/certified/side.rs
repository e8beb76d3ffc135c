//! One of the two models, as this method wants it.

use crate::bezier::{DerivativeBounds, Jet, Patch};
use crate::iteration::Target;
use crate::model::RigidTransform;
use glam::DVec3;

/// Flat patches with their tree and derivative bounds.
#[derive(Debug)]
pub(crate) struct Side<'a> {
    pub(super) target: &'a Target,
    pub(super) bounds: &'a [DerivativeBounds],
}

impl<'a> Side<'a> {
    /// `bounds` belong to the target's patches, one each.
    pub(crate) fn new(target: &'a Target, bounds: &'a [DerivativeBounds]) -> Self {
        Self { target, bounds }
    }

    pub(super) fn patch(&self, index: u32) -> Patch<'a> {
        self.target.patches.patch(index as usize)
    }

    /// Derivative bounds of all patches.
    pub(crate) fn all_bounds(&self) -> &'a [DerivativeBounds] {
        self.bounds
    }

    pub(super) fn bounds(&self, index: u32) -> &'a DerivativeBounds {
        &self.bounds[index as usize]
    }
}

/// The jet of a moved surface.
pub(super) fn moved(jet: &Jet, transform: &RigidTransform) -> Jet {
    let rotate = |vector: DVec3| transform.rotate(vector);
    Jet {
        point: transform.apply(jet.point),
        s: rotate(jet.s),
        t: rotate(jet.t),
        ss: rotate(jet.ss),
        st: rotate(jet.st),
        tt: rotate(jet.tt),
    }
}
