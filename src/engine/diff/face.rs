//! The patches of one face as an operand of the search.

use super::PreparedModel;
use crate::bezier::{LocalDerivativeBounds, PatchSet};
use crate::bvh::Aabb;
use crate::certified::Operand;
use crate::closest::Target;
use crate::engine::PreparedTarget;
use glam::DVec3;

/// The flat patches of one face.
pub(super) struct FacePatches {
    target: Target,
    bounds: Vec<LocalDerivativeBounds>,
    /// The box of the patches.
    aabb: Aabb,
}

impl FacePatches {
    /// Returns the faces of a model, each with its patches in their order. O(patches p q).
    pub(super) fn all(model: &PreparedModel, flat: &PreparedTarget) -> Vec<Self> {
        let count = model.face_count();
        let mut patches = vec![PatchSet::default(); count];
        let mut bounds: Vec<Vec<LocalDerivativeBounds>> = (0..count).map(|_| Vec::new()).collect();
        for (patch, place) in flat.target.patches.iter().zip(flat.places().iter()) {
            let face = model.face_of(patch.surface);
            patches[face].push(patch);
            bounds[face].push(LocalDerivativeBounds::new(place.extension));
        }
        let face = |(patches, bounds): (PatchSet, _)| Self {
            aabb: patches.bounding_box(),
            target: Target::new(patches),
            bounds,
        };
        patches.into_iter().zip(bounds).map(face).collect()
    }

    /// Returns the face as the operand that is searched; `whole` is that of its model.
    pub(super) fn operand<'a>(&'a self, whole: &Operand<'_>) -> Operand<'a> {
        Operand::new(&self.target, &self.bounds).with_accuracy_of(whole)
    }

    /// The patches.
    pub(super) fn patches(&self) -> &PatchSet {
        &self.target.patches
    }

    /// Returns the face of `others` that an edit most likely left this one as: of
    /// those with as many patches of the same degrees, the one whose box, or this
    /// one's moved by `offset`, differs least. The choice affects only speed.
    /// O(others).
    pub(super) fn counterpart<'a>(&self, others: &'a [Self], offset: DVec3) -> Option<&'a Self> {
        let degrees = |face: &Self| face.patches().iter().next().map(|patch| patch.degree);
        let difference = |other: &Self| {
            (self.aabb.min + offset).distance_squared(other.aabb.min)
                + (self.aabb.max + offset).distance_squared(other.aabb.max)
        };
        others
            .iter()
            .filter(|other| other.patches().len() == self.patches().len() && degrees(other) == degrees(self))
            .min_by(|one, other| difference(one).total_cmp(&difference(other)))
    }
}
