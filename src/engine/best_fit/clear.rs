//! A model that tells how far a point is from it, at least.

use crate::alignment::{Clear, Clearance, Place};
use crate::closest::{self, closest_above, newton};
use crate::facets::{Facet, PreparedFacets, facet_rounding};
use crate::rounding::unit;
use glam::DVec3;

/// The largest number of Newton steps from the foot of the point before.
const MAX_ITERATIONS: u32 = 16;

/// The distance, as a part of the model's size, below which the model's normal is the direction.
const TOUCHING: f64 = 1e-6;

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

impl ToModel<'_> {
    fn direction(&self, offset: DVec3, normal: impl FnOnce() -> DVec3) -> DVec3 {
        if offset.length() > TOUCHING * self.size { unit(offset) } else { normal() }
    }
}

impl Clearance for ToModel<'_> {
    fn clear(&self, point: DVec3, place: &mut Place) -> Option<Clear> {
        match self.kind {
            Kind::Patches(target) => {
                let start = place.map(|(patch, start)| {
                    let parameters =
                        newton(&target.patches.patch(patch as usize), point, start, MAX_ITERATIONS)
                            .parameters;
                    (patch, parameters)
                });
                let found = closest_above(target, point, self.gap, start, 0.0, None)?;
                *place = Some((found.patch as u32, found.parameters));
                let normal = || {
                    let jet = target.patches.patch(found.patch).jet(found.parameters);
                    unit(jet.s.cross(jet.t))
                };
                let direction = self.direction(point - found.point, normal);
                Some(Clear { lower: found.lower - self.error, direction })
            }
            Kind::Facets(facets, length) => {
                let facets = facets?;
                let start = place.map_or(0, |(facet, _)| facet);
                let (foot, nearest, lower) = facets.target.certified(point, start);
                *place = Some((foot.facet, [0.0; 2]));
                let own = point.length();
                let rounding = facet_rounding(if own > length { own } else { length });
                let facet = facets.target.facet(foot.facet);
                let normal = || match facet {
                    Facet::Triangle([a, b, c]) => unit((b - a).cross(c - a)),
                    Facet::Point(_) => DVec3::Z,
                };
                let direction = self.direction(point - facet.point(nearest.weights), normal);
                Some(Clear { lower: lower - rounding - self.error, direction })
            }
        }
    }
}
