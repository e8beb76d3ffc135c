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
        /// The normal of each surface that lies in a plane, and of each patch that does, from their first use on.
        planes: [Vec<OnceLock<Option<NormalCone>>>; 2],
    },
    /// Triangles, whose corners are off by at most the length.
    Triangles(&'a FacetTarget, f64),
}

impl<'a> Faces<'a> {
    /// Makes the faces of patches; nothing is computed yet.
    pub(crate) fn of_patches(patches: &'a PatchSet) -> Self {
        let surfaces = patches.iter().map(|patch| patch.surface + 1).max().unwrap_or(0);
        let planes = [surfaces, patches.len()].map(|count| (0..count).map(|_| OnceLock::new()).collect());
        Self::Patches { patches, planes }
    }

    /// Returns a cone about the normals at the points of a part of an arc, to the side of the face's normal; `None`
    /// where that is not shown. The part is given by fractions of the arc.
    pub(super) fn cone(&self, arc: &Arc, [start, end]: [f64; 2]) -> Option<NormalCone> {
        match self {
            Self::Patches { patches, planes: [of_surfaces, of_patches] } => {
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
                let of_surface = || {
                    let all = patches.iter().filter(|other| other.surface == patch.surface);
                    NormalCone::of_surface(&all.collect::<Vec<_>>())
                };
                let of_patch = || NormalCone::of_sided_plane(&patch);
                let plane = *of_patches.get(index as usize)?.get_or_init(|| {
                    of_surfaces.get(patch.surface)?.get_or_init(of_surface).or_else(of_patch)
                });
                plane.or_else(|| NormalCone::of_part(&patch, part))
            }
            &Self::Triangles(facets, error) => NormalCone::of_facet(facets, arc.place.index, error),
        }
    }
}
