//! How near and how far the contents of two boxes can be.

use crate::bvh::Aabb;

/// Squared bounds of the distance from any point of a box, or of what a box
/// contains, to its nearest point of another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distances {
    /// At most the squared distance.
    pub near: f64,
    /// At least the squared distance.
    pub far: f64,
}

impl Distances {
    /// Before any pair is known: neutral for [`Distances::nearest`].
    pub const UNKNOWN: Self = Self { near: f64::INFINITY, far: f64::INFINITY };

    /// The least and the greatest squared distance of two points of two boxes.
    #[must_use]
    pub fn of(a: &Aabb, b: &Aabb) -> Self {
        let (low, high) = (a.min - b.max, b.min - a.max);
        Self {
            near: low.max(high).max(glam::DVec3::ZERO).length_squared(),
            far: low.abs().max(high.abs()).length_squared(),
        }
    }

    /// The range of the nearest of several boxes.
    #[must_use]
    pub fn nearest(self, other: Self) -> Self {
        Self { near: self.near.min(other.near), far: self.far.min(other.far) }
    }
}
