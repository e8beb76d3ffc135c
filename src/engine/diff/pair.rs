//! The faces of two models, made once for both directions.

use super::face::FacePatches;
use super::face_search::{Faces, FacetFace};
use crate::bezier::PatchSet;
use crate::engine::direction::Direction;
use crate::engine::{PreparedModel, PreparedTarget};
use crate::facets::PreparedFacets;
use crate::flatness::Flatness;
use crate::model::RigidTransform;
use std::sync::Arc;

/// Two models with what both directions between their faces need.
pub(super) struct PairParts<'a> {
    models: [&'a PreparedModel; 2],
    /// The faces of both for the search over patches, if one direction is searched so.
    patches: Option<[OfPatches; 2]>,
    /// The patches of each face of a model of surfaces, if it is measured to facets.
    of_faces: [Vec<PatchSet>; 2],
    /// The patches that a cloud is measured to.
    targets: [Option<Arc<PreparedTarget>>; 2],
}

/// The flat patches of a model, whole and by face.
struct OfPatches {
    flat: Arc<PreparedTarget>,
    faces: Vec<FacePatches>,
}

impl<'a> PairParts<'a> {
    /// O(patches p q) for surfaces, O(n log n) for facets at first use.
    pub(super) fn new(models: [&'a PreparedModel; 2]) -> Self {
        let by_facets = [0, 1].map(|index| is_by_facets(models, index));
        let patches = (by_facets != [true; 2]).then(|| models.map(OfPatches::new));
        let of_faces = [0, 1].map(|index| {
            let is_needed = by_facets[index] && models[index].facets().is_none();
            if is_needed { patches_of_faces(models[index]) } else { Vec::new() }
        });
        let targets = [0, 1].map(|index| {
            let is_needed = by_facets[1 - index] && models[index].facets().is_none();
            is_needed.then(|| models[index].certified_target())
        });
        Self { models, patches, of_faces, targets }
    }

    /// Returns the faces of one model, measured to the other; `None` for a model without patches.
    pub(super) fn faces(&self, index: usize) -> Option<Faces<'_>> {
        let other = 1 - index;
        if !is_by_facets(self.models, index) {
            let parts = self.patches.as_ref()?;
            let operand = |index: usize| parts[index].flat.operand(self.models[index]);
            let (faces, others) = (&parts[index].faces, &parts[other].faces);
            return Some(Faces::Patches { whole: operand(index), faces, other: operand(other), others });
        }
        let faces = match self.models[index].facets() {
            Some(facets) => groups(facets),
            None => {
                let source = |patches| self.models[index].patches_as_source(patches);
                self.of_faces[index]
                    .iter()
                    .map(|patches| FacetFace::Patches(source(patches), patches))
                    .collect()
            }
        };
        let other = self.models[other].measured(self.targets[other].as_deref())?;
        Some(Faces::Facets { faces, other })
    }
}

/// Whether the search over facets measures the faces of this one of two models.
fn is_by_facets(models: [&PreparedModel; 2], index: usize) -> bool {
    let [from, to] = [models[index], models[1 - index]];
    Direction { from, to, transform: RigidTransform::IDENTITY }.is_of_facets()
}

fn groups(facets: &PreparedFacets) -> Vec<FacetFace<'_>> {
    let error = facets.error;
    let parts = facets.targets().iter().zip(facets.groups());
    parts
        .map(|(target, group)| FacetFace::Group { facets: target, first: group.facets.start, error })
        .collect()
}

/// Returns the Bézier patches of each face.
fn patches_of_faces(model: &PreparedModel) -> Vec<PatchSet> {
    let mut faces = vec![PatchSet::default(); model.face_count()];
    for patch in model.bezier().patches.iter() {
        faces[model.face_of(patch.surface)].push(patch);
    }
    faces
}

impl OfPatches {
    fn new(model: &PreparedModel) -> Self {
        // A triangle is flat.
        let flatness = if model.facets().is_some() { Flatness::None } else { Flatness::Loose };
        let flat = model.target(flatness);
        Self { faces: FacePatches::all(model, &flat), flat }
    }
}
