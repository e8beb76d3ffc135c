//! Axis-aligned bounding boxes.

use crate::rounding::upper_max;
use bytemuck::Zeroable;
use glam::DVec3;

/// An axis-aligned box, given by two opposite corners.
#[derive(Debug, Clone, Copy, PartialEq, Zeroable)]
pub struct Aabb {
    /// The corner of smallest coordinates.
    pub min: DVec3,
    /// The corner of largest coordinates.
    pub max: DVec3,
}

impl Aabb {
    /// The empty box, neutral for [`Aabb::union`].
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// Returns the smallest box that contains this one and `point`.
    #[must_use]
    pub fn with(self, point: DVec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// Returns the smallest box that contains both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Returns whether both boxes have a point in common.
    #[must_use]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Returns whether the other box lies within this one.
    #[must_use]
    pub fn contains(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Returns this box enlarged by `margin` on every side.
    #[must_use]
    pub fn grown(self, margin: f64) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Returns the centre.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Returns the corners; that of x varies fastest, then that of y.
    #[must_use]
    pub(crate) fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|index| {
            let pick = |axis: usize| if index >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] };
            DVec3::new(pick(0), pick(1), pick(2))
        })
    }

    /// Returns the vector from the smallest to the largest corner.
    #[must_use]
    pub fn extent(&self) -> DVec3 {
        self.max - self.min
    }

    /// Returns the length of the diagonal.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        self.extent().length()
    }

    /// Returns the distance from the origin to the farthest corner of the box.
    #[must_use]
    pub fn farthest_from_origin(&self) -> f64 {
        self.min.abs().max(self.max.abs()).length()
    }

    /// Returns the squared distance from `point` to the nearest point of the box, 0 inside.
    #[must_use]
    pub fn min_distance_squared(&self, point: DVec3) -> f64 {
        (self.min - point).max(point - self.max).max(DVec3::ZERO).length_squared()
    }

    /// Returns the shortest way between the boxes along each axis, 0 where they overlap.
    #[must_use]
    pub fn gap(&self, other: &Self) -> DVec3 {
        (self.min - other.max).max(other.min - self.max).max(DVec3::ZERO)
    }

    /// Returns the largest distance between a point of this box, after an affine map, and
    /// one of `other`: that of a corner, as a convex function attains its maximum over a
    /// box at a corner.
    #[must_use]
    pub fn max_distance(&self, map: impl Fn(DVec3) -> DVec3, other: &Self) -> f64 {
        let ends = [self.min, self.max];
        let corner = |index: usize| DVec3::new(ends[index & 1].x, ends[index >> 1 & 1].y, ends[index >> 2].z);
        (0..8).map(|index| other.max_distance_squared(map(corner(index)))).fold(0.0, upper_max).sqrt()
    }

    /// Returns the squared distance from `point` to the farthest corner of the box.
    #[must_use]
    pub fn max_distance_squared(&self, point: DVec3) -> f64 {
        (point - self.min).abs().max((self.max - point).abs()).length_squared()
    }
}
