//! A model, as what is certain of the distances of points from it.

use crate::alignment::{Clear, Clearance, Place, direction_from_facet, foot_on_patches};
use crate::closest;
use crate::facets::{PreparedFacets, facet_rounding};
use crate::rounding::{unit, upper_max};
use glam::DVec3;

/// A model to which certified distances are measured.
pub(super) struct ToModel<'a> {
    pub(super) kind: Kind<'a>,
    /// The error of points of the model.
    pub(super) error: f64,
    /// The excess of the distances of patches.
    pub(super) gap: f64,
    pub(super) size: f64,
}

/// Patches, or facets with the largest length of their corners.
pub(super) enum Kind<'a> {
    Patches(&'a closest::Target),
    Facets(Option<&'a PreparedFacets>, f64),
}

impl Clearance for ToModel<'_> {
    type Memory = Place;

    const SIGNED: bool = false;

    fn clear(&self, point: DVec3, place: &mut Place) -> Option<Clear> {
        match self.kind {
            Kind::Patches(target) => {
                let (found, direction) = foot_on_patches(target, (self.gap, self.size), point, place)?;
                let [lower, upper] = [found.lower - self.error, found.upper + self.error];
                Some(Clear { lower, upper, direction })
            }
            Kind::Facets(facets, length) => {
                let facets = facets?;
                let start = place.map_or(0, |(facet, _)| facet);
                let (foot, nearest, lower) = facets.target.certified(point, start);
                *place = Some((foot.facet, [0.0; 2]));
                let error = facet_rounding(upper_max(length, point.length())) + self.error;
                let facet = facets.target.facet(foot.facet);
                let offset = point - facet.point(nearest.weights);
                let direction = direction_from_facet(&facet, offset, self.size);
                let [lower, upper] = [lower - error, foot.distance_squared.sqrt() + error];
                Some(Clear { lower, upper, direction: direction.unwrap_or_else(|| unit(offset)) })
            }
        }
    }
}
