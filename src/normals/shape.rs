//! Where a part of a model is, and the cone of its normals.

use super::NormalCone;
use crate::bezier::Patch;
use crate::bvh::Aabb;
use crate::model::RigidTransform;
use crate::param_box::ParamBox;
use crate::rounding::upper_max;
use glam::{DVec3, Vec4Swizzles};

/// A part of a model: a box and a ball that contain it, up to the rounding of its control points, and its normals.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    /// Contains the part.
    pub(crate) aabb: Aabb,
    /// The middle of the box.
    pub(crate) middle: DVec3,
    /// No point of the part is farther from the middle.
    pub(crate) radius: f64,
    /// Contains all normals; `None` where that is not shown.
    pub(crate) cone: Option<NormalCone>,
}

impl Shape {
    /// A part of which nothing is known.
    pub(crate) const UNKNOWN: Self =
        Self { aabb: Aabb::EMPTY, middle: DVec3::ZERO, radius: f64::INFINITY, cone: None };

    /// Returns the shape of points whose convex hull contains a part.
    pub(crate) fn of_points(points: impl Iterator<Item = DVec3> + Clone, cone: Option<NormalCone>) -> Self {
        let aabb = points.clone().fold(Aabb::EMPTY, Aabb::with);
        let middle = aabb.center();
        let radius = points.map(|point| point.distance(middle)).fold(0.0, upper_max);
        Self { aabb, middle, radius, cone }
    }

    /// Returns the shape of a part of a patch, moved by a transform if there is one. O(p q (p + q) + degree³).
    pub(crate) fn of_part(patch: &Patch<'_>, part: ParamBox, transform: Option<&RigidTransform>) -> Self {
        let cone = NormalCone::of_plane(patch).or_else(|| NormalCone::of_part(patch, part));
        Self::with_cone(patch, part, transform, cone)
    }

    /// Returns the shape of a part of a patch whose normals before the transform are known.
    pub(crate) fn with_cone(
        patch: &Patch<'_>,
        part: ParamBox,
        transform: Option<&RigidTransform>,
        cone: Option<NormalCone>,
    ) -> Self {
        let [s, t] = part.intervals();
        let controls = patch.restricted(s, t);
        let points: Vec<DVec3> = controls
            .iter()
            .map(|control| {
                let point = patch.center + control.xyz() / control.w;
                transform.map_or(point, |transform| transform.apply(point))
            })
            .collect();
        let cone = cone.map(|cone| transform.map_or(cone, |transform| cone.moved(transform)));
        Self::of_points(points.iter().copied(), cone)
    }
}
