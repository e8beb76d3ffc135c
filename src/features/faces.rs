//! The faces on both sides of an edge, by their normals along it.

use crate::axis::Axis;
use crate::bezier::PatchSet;
use crate::facets::FacetTarget;
use crate::normals::NormalCone;
use crate::param_box::ParamBox;
use crate::solid::{Arc, EdgePlace};

/// The faces of a model.
#[derive(Clone, Copy)]
pub(crate) enum Faces<'a> {
    /// Patches, whose edges are sides of their parameters.
    Patches(&'a PatchSet),
    /// Triangles, whose corners are off by at most the length.
    Triangles(&'a FacetTarget, f64),
}

impl Faces<'_> {
    /// Returns a cone about the normals at the points of a part of an arc, to the side of the face's normal; `None`
    /// where that is not shown. The part is given by fractions of the arc.
    pub(super) fn cone(&self, arc: &Arc, [start, end]: [f64; 2]) -> Option<NormalCone> {
        match *self {
            Self::Patches(patches) => {
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
                NormalCone::of_sided_plane(&patch).or_else(|| NormalCone::of_part(&patch, part))
            }
            Self::Triangles(facets, error) => NormalCone::of_facet(facets, arc.place.index, error),
        }
    }
}
