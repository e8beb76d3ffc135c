//! Where a part of a model is, and the cone about its normals.

use super::NormalCone;
use crate::bezier::Patch;
use crate::bvh::Aabb;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::{DVec3, DVec4, Vec4Swizzles};

/// A box and a ball about its middle, both around the convex hull of points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hull {
    pub(crate) aabb: Aabb,
    /// The middle of the box.
    pub(crate) middle: DVec3,
    /// No point is farther from the middle.
    pub(crate) radius: f64,
}

impl Hull {
    pub(crate) fn of(points: &[DVec3]) -> Self {
        let aabb = points.iter().copied().fold(Aabb::EMPTY, Aabb::with);
        let middle = aabb.center();
        let radius = points.iter().map(|point| point.distance(middle)).fold(0.0, upper_max);
        Self { aabb, middle, radius }
    }
}

/// Where a part of a model is: a box and a ball that contain it, up to the rounding of its control points.
#[derive(Debug, Clone)]
pub(crate) struct Region {
    /// Points whose convex hull contains the part.
    pub(crate) points: Vec<DVec3>,
    /// Contains the part.
    pub(crate) aabb: Aabb,
    /// The middle of the box.
    pub(crate) middle: DVec3,
    /// No point of the part is farther from the middle.
    pub(crate) radius: f64,
}

impl Region {
    /// Returns where the part of a patch is, moved by a transform if there is one. O(p q (p + q)).
    pub(crate) fn of_part(patch: &Patch<'_>, part: ParamBox, transform: Option<&RigidTransform>) -> Self {
        let [s, t] = part.intervals();
        let controls = patch.restricted(s, t);
        let moved = |control: &DVec4| {
            let point = patch.center + control.xyz() / control.w;
            transform.map_or(point, |transform| transform.apply(point))
        };
        Self::of_points(controls.iter().map(moved).collect())
    }

    /// Returns where a part is that the convex hull of points contains.
    pub(crate) fn of_points(points: Vec<DVec3>) -> Self {
        let Hull { aabb, middle, radius } = Hull::of(&points);
        Self { points, aabb, middle, radius }
    }

    /// Returns whether two parts are certainly farther from each other than `reach`: their boxes, or their extents along
    /// the line between their middles.
    pub(crate) fn is_beyond(&self, other: &Self, reach: f64) -> bool {
        if self.aabb.gap(&other.aabb).length_squared() > reach * reach {
            return true;
        }
        let between = other.middle - self.middle;
        // Extents along it that are so far apart are rare where the middles are not, and cost a product for each point.
        if between.length_squared() <= reach * reach {
            return false;
        }
        let Some(along) = between.try_normalize() else { return false };
        let level = |point: &DVec3| (*point - self.middle).dot(along);
        let own = self.points.iter().map(level).fold(f64::NEG_INFINITY, upper_max);
        let of_other = other.points.iter().map(|point| -level(point)).fold(f64::NEG_INFINITY, upper_max);
        -of_other - own > reach
    }
}

/// A part of a model with its normals.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    /// Where it is.
    pub(crate) region: Region,
    /// Contains all normals; `None` where that is not shown.
    pub(crate) cone: Option<NormalCone>,
}

impl Shape {
    /// The shape of an unknown part. Its radius is infinite, and it has no cone.
    pub(crate) const UNKNOWN: Self = Self {
        region: Region { points: Vec::new(), aabb: Aabb::EMPTY, middle: DVec3::ZERO, radius: f64::INFINITY },
        cone: None,
    };

    /// Returns the shape of points whose convex hull contains a part.
    pub(crate) fn of_points(points: Vec<DVec3>, cone: Option<NormalCone>) -> Self {
        Self { region: Region::of_points(points), cone }
    }

    /// Returns the shape of a part of a patch, moved. O(p q (p + q) + degree³).
    pub(crate) fn of_part(patch: &Patch<'_>, part: ParamBox, transform: &RigidTransform) -> Self {
        Self::with_cone(patch, part, transform, NormalCone::of_patch(patch, part))
    }

    /// Returns the shape of a part of a patch whose normals before the transform are known.
    pub(crate) fn with_cone(
        patch: &Patch<'_>,
        part: ParamBox,
        transform: &RigidTransform,
        cone: Option<NormalCone>,
    ) -> Self {
        let region = Region::of_part(patch, part, Some(transform));
        Self { region, cone: cone.map(|cone| cone.moved(transform)) }
    }
}
