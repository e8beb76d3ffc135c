//! One of the two models, as this method wants it.

use crate::bezier::{DerivativeBounds, Jet, LocalDerivativeBounds, Patch, PatchSet};
use crate::closest::Candidates;
use crate::closest::Target;
use crate::model::RigidTransform;
use crate::symmetry::{Revolution, Sphere};
use glam::DVec3;
use std::sync::atomic::AtomicUsize;

/// Patches with their tree and derivative bounds.
#[derive(Debug)]
pub(crate) struct Operand<'a> {
    pub(crate) target: &'a Target,
    pub(super) bounds: &'a [LocalDerivativeBounds],
    /// Its patches cut as the other side's are.
    pub(super) alike: &'a PatchSet,
    /// What each surface is, where that is known.
    pub(super) revolutions: &'a [Option<Revolution>],
    /// A sphere among them.
    pub(super) sphere: Option<Sphere>,
    /// The patches near a point about which many others are looked at.
    pub(super) candidates: Option<Candidates>,
    /// Patches looked at since those were listed.
    pub(super) looks: AtomicUsize,
}

impl<'a> Operand<'a> {
    /// `bounds` belong to the target's patches, one each.
    pub(crate) fn new(target: &'a Target, bounds: &'a [LocalDerivativeBounds]) -> Self {
        Self {
            target,
            bounds,
            alike: &target.patches,
            revolutions: &[],
            sphere: None,
            candidates: None,
            looks: AtomicUsize::new(0),
        }
    }

    /// Beside one whose patches are cut otherwise, as these of the same model are.
    pub(crate) fn beside(self, alike: &'a PatchSet) -> Self {
        Self { alike, ..self }
    }

    /// Knowing what each surface is.
    pub(crate) fn with(self, revolutions: &'a [Option<Revolution>]) -> Self {
        let sphere = revolutions.iter().flatten().find_map(|surface| surface.sphere);
        Self { revolutions, sphere, ..self }
    }

    pub(super) fn patch(&self, index: u32) -> Patch<'a> {
        self.target.patches.patch(index as usize)
    }

    /// Derivative bounds of a whole patch.
    pub(super) fn whole_bounds(&self, index: u32) -> &'a DerivativeBounds {
        self.bounds[index as usize].whole(&self.patch(index))
    }

    /// Derivative bounds over a whole patch, or over all its room where the box is not inside.
    pub(super) fn bounds_about(&self, index: u32, low: [f64; 2], high: [f64; 2]) -> &'a DerivativeBounds {
        self.bounds[index as usize].about(&self.patch(index), low, high)
    }

    /// Derivative bounds over a box in the patch's room.
    pub(crate) fn bounds(&self, index: u32, low: [f64; 2], high: [f64; 2]) -> DerivativeBounds {
        self.bounds[index as usize].over(&self.patch(index), low, high)
    }

    /// The surface as one of revolution.
    pub(super) fn revolution(&self, surface: usize) -> Option<&'a Revolution> {
        self.revolutions.get(surface)?.as_ref()
    }

    /// The parameters at which the patch's controls tell points of the model.
    pub(crate) fn room(&self, index: u32) -> [[f64; 2]; 2] {
        self.bounds[index as usize].room
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
