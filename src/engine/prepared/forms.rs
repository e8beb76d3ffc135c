//! The elementary surfaces that faces lie on.

use super::PreparedModel;
use crate::carrier::FaceForm;
use crate::threads::parallel::map;

impl PreparedModel {
    /// Returns for each face the plane, sphere, cylinder, cone or torus that it lies on, with bounds on how far its
    /// points are from it; `None` for other surfaces, and of a mesh or a cloud none at all. In about 30 µs a Bézier patch
    /// of an elementary surface, less for others, on all cores.
    #[must_use]
    pub fn face_forms(&self) -> Vec<Option<FaceForm>> {
        let surfaces = self.source().map_or(&[][..], |source| source.surfaces());
        map(surfaces.len(), |face| FaceForm::of(&surfaces[face]))
    }
}
