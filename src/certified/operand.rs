//! The two models as the search uses them.

use super::rounding::JetScale;
use super::{Sheets, TrimmedFaces};
use crate::area::Area;
use crate::bezier::{DerivativeBounds, Jet, LocalDerivativeBounds, Patch, PatchSet, PointError};
use crate::bvh::Aabb;
use crate::closest::Target;
use crate::flatness::MAX_HALVINGS;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::symmetry::{Revolution, Sphere};
use glam::DVec3;

/// One model: its patches with their tree and derivative bounds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Operand<'a> {
    pub(super) target: &'a Target,
    bounds: &'a [LocalDerivativeBounds],
    /// The model's patches cut as the other operand's are, for the bound of
    /// equal control nets.
    pub(super) uncut_patches: &'a PatchSet,
    /// The revolution that each surface is, where it is one.
    pub(super) revolutions: &'a [Option<Revolution>],
    /// How the patches join, where that is known.
    pub(super) sheets: Option<Sheets<'a>>,
    /// The faces that its surfaces are cut from, where they are.
    pub(super) faces: Option<&'a TrimmedFaces>,
    /// A sphere among the surfaces.
    pub(super) sphere: Option<Sphere>,
    /// A box around the control points of the surfaces.
    pub(super) control_box: Aabb,
    /// How far computed points of the patches may be from the exact ones.
    pub(super) point_error: f64,
}

impl<'a> Operand<'a> {
    /// `bounds` belong to the target's patches, one each.
    pub(crate) fn new(target: &'a Target, bounds: &'a [LocalDerivativeBounds]) -> Self {
        let control_box = target.tree.bounding_box();
        let point_error = PointError::within(target.max_degree, &control_box).after(MAX_HALVINGS);
        let uncut_patches = &target.patches;
        Self {
            target,
            bounds,
            uncut_patches,
            revolutions: &[],
            sheets: None,
            faces: None,
            sphere: None,
            control_box,
            point_error,
        }
    }

    /// The same model with the box around its surfaces' own control points,
    /// which contains those of the patches, and the error of its points.
    pub(crate) fn with_accuracy(self, control_box: Aabb, point_error: f64) -> Self {
        Self { control_box, point_error, ..self }
    }

    /// The same patches, a part of the model `whole`, with the accuracy of its points.
    pub(crate) fn with_accuracy_of(self, whole: &Operand<'_>) -> Self {
        self.with_accuracy(whole.control_box, whole.point_error)
    }

    /// The same model for an operand whose patches are cut as `uncut_patches` are.
    pub(crate) fn with_uncut(self, uncut_patches: &'a PatchSet) -> Self {
        Self { uncut_patches, ..self }
    }

    /// The same model with the sheets that its patches are cut from, all of them: a search may
    /// take the sheets for the model.
    pub(crate) fn with_sheets(self, sheets: Sheets<'a>) -> Self {
        Self { sheets: Some(sheets), ..self }
    }

    /// The same model with the faces that its surfaces are cut from.
    pub(crate) fn with_faces(self, faces: Option<&'a TrimmedFaces>) -> Self {
        Self { faces, ..self }
    }

    /// The same model with what is known of its surfaces.
    pub(crate) fn with_revolutions(self, revolutions: &'a [Option<Revolution>]) -> Self {
        let sphere = revolutions.iter().flatten().find_map(|surface| surface.sphere);
        Self { revolutions, sphere, ..self }
    }

    pub(crate) fn patches(&self) -> &'a PatchSet {
        &self.target.patches
    }

    pub(super) fn patch(&self, index: u32) -> Patch<'a> {
        self.target.patches.patch(index as usize)
    }

    /// Derivative bounds over a whole patch.
    pub(super) fn patch_bounds(&self, index: u32) -> &'a DerivativeBounds {
        self.bounds[index as usize].whole(&self.patch(index))
    }

    /// What the rounding of the patch's derivatives depends on. O(p q) for
    /// rational patches.
    pub(super) fn jet_scale(&self, index: u32) -> JetScale {
        JetScale::new(&self.patch(index), self.patch_bounds(index).radius)
    }

    /// Derivative bounds over a whole patch, or over its whole extension where
    /// the box does not lie in the patch.
    pub(super) fn extended_bounds(&self, index: u32, low: [f64; 2], high: [f64; 2]) -> &'a DerivativeBounds {
        self.bounds[index as usize].about(&self.patch(index), low, high)
    }

    /// Derivative bounds over a box in the patch's extension.
    pub(crate) fn bounds(&self, index: u32, low: [f64; 2], high: [f64; 2]) -> DerivativeBounds {
        self.bounds[index as usize].over(&self.patch(index), low, high)
    }

    /// The revolution that a surface is.
    pub(super) fn revolution(&self, surface: usize) -> Option<&'a Revolution> {
        self.revolutions.get(surface)?.as_ref()
    }

    /// The parameters, by axis, at which the patch's control net represents
    /// points of the model.
    pub(crate) fn room(&self, index: u32) -> ParamBox {
        self.bounds[index as usize].extension
    }
}

/// The two operands of a directed distance from A to B, and the motion of A.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair<'a> {
    pub(crate) a: Operand<'a>,
    pub(crate) b: Operand<'a>,
    pub(crate) transform: RigidTransform,
}

impl<'a> Pair<'a> {
    /// A patch of A, not moved.
    pub(crate) fn patch_of_a(&self, patch: u32) -> Patch<'a> {
        self.a.patch(patch)
    }

    /// The area of a part of a patch of A.
    pub(crate) fn area_of_a(&self, patch: u32, range: ParamBox) -> Area {
        let target = self.a.target;
        if range == ParamBox::UNIT { target.area(patch) } else { target.area_of_part(patch, range) }
    }

    /// The moved point of a patch of A.
    pub(super) fn point_of_a(&self, patch: u32, parameters: [f64; 2]) -> DVec3 {
        self.transform.apply(self.a.patch(patch).point(parameters))
    }

    /// The moved point of a patch of A with its derivatives.
    pub(super) fn jet_of_a(&self, patch: u32, parameters: [f64; 2]) -> Jet {
        let jet = self.a.patch(patch).jet(parameters);
        let rotate = |vector: DVec3| self.transform.rotate(vector);
        Jet {
            point: self.transform.apply(jet.point),
            s: rotate(jet.s),
            t: rotate(jet.t),
            ss: rotate(jet.ss),
            st: rotate(jet.st),
            tt: rotate(jet.tt),
        }
    }
}
