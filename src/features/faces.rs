//! The faces on both sides of an edge, by their normals along it.

use crate::axis::Axis;
use crate::bezier::PatchSet;
use crate::facets::FacetTarget;
use crate::normals::NormalCone;
use crate::param_box::ParamBox;
use crate::solid::{Arc, EdgePlace};
use std::sync::OnceLock;

/// The faces of a model.
pub(crate) enum Faces<'a> {
    /// Patches, whose edges are sides of their parameters.
    Patches {
        /// The patches.
        patches: &'a PatchSet,
        /// The normal of each that lies in a plane, from its first use on.
        planes: Vec<OnceLock<Option<NormalCone>>>,
    },
    /// Triangles, whose corners are off by at most the length.
    Triangles(&'a FacetTarget, f64),
}

impl<'a> Faces<'a> {
    /// Makes the faces of patches; nothing is computed yet.
    pub(crate) fn of_patches(patches: &'a PatchSet) -> Self {
        Self::Patches { patches, planes: (0..patches.len()).map(|_| OnceLock::new()).collect() }
    }

    /// Returns a cone about the normals at the points of a part of an arc, to the side of the face's normal; `None`
    /// where that is not shown. The part is given by fractions of the arc.
    pub(super) fn cone(&self, arc: &Arc, [start, end]: [f64; 2]) -> Option<NormalCone> {
        match self {
            Self::Patches { patches, planes } => {
                let EdgePlace { index, axis, end: side } = arc.place;
                let at = |fraction: f64| (1.0 - fraction) * arc.range[0] + fraction * arc.range[1];
                let (low, high) =
                    if at(start) <= at(end) { (at(start), at(end)) } else { (at(end), at(start)) };
                let fixed = [f64::from(side); 2];
                let part = match axis {
                    Axis::U => ParamBox::new(fixed, [low, high]),
                    Axis::V => ParamBox::new([low, high], fixed),
                };
                let patch = patches.patch(index as usize);
                let of_plane = || NormalCone::of_sided_plane(&patch);
                let plane = *planes.get(index as usize)?.get_or_init(of_plane);
                plane.or_else(|| NormalCone::of_part(&patch, part))
            }
            &Self::Triangles(facets, error) => NormalCone::of_facet(facets, arc.place.index, error),
        }
    }
}
