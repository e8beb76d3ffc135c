//! The model that samples are laid on: the foot of a point, and the direction in which its distance
//! changes.

use crate::closest::{self, Closest, closest_above, newton};
use crate::facets::{Facet, FacetTarget};
use crate::model::RigidTransform;
use crate::threads::parallel::map_ranges;
use glam::DVec3;

/// The largest number of Newton steps from the foot of the step before: near it a few suffice.
const MAX_ITERATIONS: u32 = 16;

/// The distance, as a part of the model's size, below which rounding dominates the direction from foot to
/// point. The model's normal is used there.
const TOUCHING: f64 = 1e-6;

/// The place of a foot on its model: a patch with parameters, or a facet.
pub(crate) type Place = Option<(u32, [f64; 2])>;

/// A point, its offset from its foot, and the direction along which that is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Residual {
    pub(crate) point: DVec3,
    /// The point less its foot.
    pub(crate) offset: DVec3,
    /// The unit vector along which the distance to the model changes; `None` if the foot is a point
    /// of a cloud, towards which all three coordinates change it.
    pub(crate) direction: Option<DVec3>,
}

impl Residual {
    /// Returns the distance from the foot.
    pub(crate) fn distance(&self) -> f64 {
        self.offset.length()
    }

    /// Returns the offset along the direction: the distance with a sign where the direction has a side of its own.
    pub(crate) fn height(&self) -> f64 {
        self.direction.map_or_else(|| self.distance(), |direction| self.offset.dot(direction))
    }
}

/// A model as the residuals of points.
pub(crate) trait Field: Sync {
    /// Whether residuals are measured by their heights, which may be negative, and not by their distances.
    const SIGNED: bool = false;

    /// Returns the residual of a point; `place` is where its foot was last, and is set to where it is
    /// now. `None` for a model without points.
    fn residual(&self, point: DVec3, place: &mut Place) -> Option<Residual>;

    /// Returns whether a sample with its foot there counts.
    fn is_counted(&self, _place: &Place) -> bool {
        true
    }
}

/// Patches or facets, with their closest points. No sign is decided.
#[derive(Clone, Copy)]
pub(crate) enum FootField<'a> {
    /// Patches; the excess of a distance over the least one; the size of the model; for each patch whether samples with
    /// their feet there count, where not all do.
    Patches { target: &'a closest::Target, gap: f64, size: f64, counted: Option<&'a [bool]> },
    /// Facets, whose nearest is found exactly.
    Facets { target: &'a FacetTarget, size: f64 },
}

impl<'a> FootField<'a> {
    /// Returns the field with feet up to another excess.
    pub(crate) fn up_to(mut self, excess: f64) -> Self {
        if let Self::Patches { gap, .. } = &mut self {
            *gap = excess;
        }
        self
    }

    /// Returns the field in which only samples with their feet on these patches count.
    pub(crate) fn on_patches(mut self, patches: &'a [bool]) -> Self {
        if let Self::Patches { counted, .. } = &mut self {
            *counted = Some(patches);
        }
        self
    }
}

impl Field for FootField<'_> {
    fn residual(&self, point: DVec3, place: &mut Place) -> Option<Residual> {
        match self {
            Self::Patches { target, gap, size, .. } => {
                let (closest, direction) = foot_on_patches(target, (*gap, *size), point, place)?;
                Some(Residual { point, offset: point - closest.point, direction: Some(direction) })
            }
            Self::Facets { target, size } => {
                let start = place.map_or(0, |(facet, _)| facet);
                let foot = target.nearest(point, start, 0.0);
                *place = Some((foot.facet, [0.0; 2]));
                let facet = target.facet(foot.facet);
                let offset = point - facet.point(facet.nearest(point).weights);
                Some(Residual { point, offset, direction: direction_from_facet(&facet, offset, *size) })
            }
        }
    }

    fn is_counted(&self, place: &Place) -> bool {
        match (self, place) {
            (Self::Patches { counted: Some(counted), .. }, Some((patch, _))) => counted[*patch as usize],
            _ => true,
        }
    }
}

/// Returns the closest point on patches of a model of this size, up to a gap, with the direction from there; the search
/// starts at the place of the last foot.
pub(crate) fn foot_on_patches(
    target: &closest::Target,
    (gap, size): (f64, f64),
    point: DVec3,
    place: &mut Place,
) -> Option<(Closest, DVec3)> {
    let start = place.map(|(patch, start)| {
        let patch_of_foot = target.patches.patch(patch as usize);
        (patch, newton(&patch_of_foot, point, start, MAX_ITERATIONS).parameters)
    });
    let closest = closest_above(target, point, gap, start, 0.0, None)?;
    *place = Some((closest.patch as u32, closest.parameters));
    let normal = || {
        let jet = target.patches.patch(closest.patch).jet(closest.parameters);
        jet.s.cross(jet.t).normalize_or_zero()
    };
    Some((closest, direction(point - closest.point, size, normal)))
}

/// Returns the direction of an offset from a facet of a model of this size; none from a point of a cloud.
pub(crate) fn direction_from_facet(facet: &Facet, offset: DVec3, size: f64) -> Option<DVec3> {
    match facet {
        Facet::Point(_) => None,
        Facet::Triangle([a, b, c]) => {
            let normal = || (*b - *a).cross(*c - *a).normalize_or_zero();
            Some(direction(offset, size, normal))
        }
    }
}

/// Returns the residuals of points under a motion, with the places of their feet; the feet are looked for from those
/// places on that are known, else from that of the point before. `None` for a model without points.
pub(super) fn residuals(
    field: &impl Field,
    points: &[DVec3],
    places: &[Place],
    motion: &RigidTransform,
) -> Option<(Vec<Residual>, Vec<Place>)> {
    let parts = map_ranges(points.len(), |range| {
        let mut last = None;
        let of = |index: usize| {
            let mut place = places.get(index).copied().flatten().or(last);
            let residual = field.residual(motion.apply(points[index]), &mut place)?;
            last = place;
            Some((residual, place))
        };
        range.map(of).collect::<Option<Vec<_>>>()
    });
    let all = parts.into_iter().collect::<Option<Vec<_>>>()?;
    Some(all.into_iter().flatten().unzip())
}

/// Returns the direction of an offset from a foot; the model's normal where the point touches it.
pub(super) fn direction(offset: DVec3, size: f64, normal: impl FnOnce() -> DVec3) -> DVec3 {
    let length = offset.length();
    if length > TOUCHING * size { offset / length } else { normal() }
}
