//! Bounds on the distance between the contents of two boxes.

use crate::bvh::Aabb;
use glam::DVec3;

/// Bounds on the squared distance from any point of one box, or of its contents,
/// to the nearest point of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistanceBounds {
    /// A lower bound on the squared distance.
    pub near: f64,
    /// An upper bound on the squared distance.
    pub far: f64,
}

impl DistanceBounds {
    /// The bounds before any pair is known, neutral for [`DistanceBounds::nearest`].
    pub const UNKNOWN: Self = Self { near: f64::INFINITY, far: f64::INFINITY };

    /// Returns the smallest and the largest squared distance of points of two finite
    /// boxes; neither is NaN.
    #[must_use]
    pub fn between(a: &Aabb, b: &Aabb) -> Self {
        let (low, high) = (a.min - b.max, b.min - a.max);
        Self {
            near: low.max(high).max(DVec3::ZERO).length_squared(),
            far: low.abs().max(high.abs()).length_squared(),
        }
    }

    /// Returns the bounds for the nearer of two sets, given the bounds for each.
    #[must_use]
    pub fn nearest(self, other: Self) -> Self {
        Self { near: self.near.min(other.near), far: self.far.min(other.far) }
    }
}
