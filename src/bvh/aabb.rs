//! Axis-aligned bounding boxes.

use glam::DVec3;

/// The box of all points between two corners.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// The corner of smallest coordinates.
    pub min: DVec3,
    /// The corner of largest coordinates.
    pub max: DVec3,
}

impl Aabb {
    /// The box that contains nothing: neutral for [`Aabb::union`].
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box that contains this one and `point`.
    #[must_use]
    pub fn with(self, point: DVec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// The smallest box that contains both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// This box, larger by `by` on every side.
    #[must_use]
    pub fn grown(self, by: f64) -> Self {
        Self { min: self.min - by, max: self.max + by }
    }

    /// The middle.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// The vector from the smallest to the largest corner.
    #[must_use]
    pub fn extent(&self) -> DVec3 {
        self.max - self.min
    }

    /// The length of the diagonal.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        self.extent().length()
    }

    /// Squared distance from `point` to the nearest point of the box, 0 inside.
    #[must_use]
    pub fn min_distance_squared(&self, point: DVec3) -> f64 {
        (self.min - point).max(point - self.max).max(DVec3::ZERO).length_squared()
    }

    /// Squared distance from `point` to the farthest corner of the box.
    #[must_use]
    pub fn max_distance_squared(&self, point: DVec3) -> f64 {
        (point - self.min).abs().max((self.max - point).abs()).length_squared()
    }
}
