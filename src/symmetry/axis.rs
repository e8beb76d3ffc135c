//! Axes of rotation.

use crate::model::RigidTransform;
use crate::rounding::unit;
use glam::DVec3;

/// The oriented line through `origin` along the unit vector `direction`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RotationAxis {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

impl RotationAxis {
    /// Returns the axis of the circle through three points; its origin is NaN or infinite where
    /// they lie on a line.
    pub(super) fn of_circle([a, b, c]: [DVec3; 3]) -> Self {
        let (to_b, to_c) = (b - a, c - a);
        let normal = to_b.cross(to_c);
        let square = normal.length_squared();
        let center = (to_b.length_squared() * to_c - to_c.length_squared() * to_b).cross(normal);
        Self { origin: a + center / (2.0 * square), direction: unit(normal) }
    }

    /// Returns the axis moved by `transform`.
    pub(crate) fn moved(&self, transform: &RigidTransform) -> Self {
        Self { origin: transform.apply(self.origin), direction: transform.rotate(self.direction) }
    }

    /// Returns the vector to `point` from the nearest point of the axis.
    pub(crate) fn radial(&self, point: DVec3) -> DVec3 {
        let offset = point - self.origin;
        offset - offset.dot(self.direction) * self.direction
    }

    /// Returns an upper bound on the distance between the images of a point under
    /// rotations by one angle about this axis and about `other`; the point is at
    /// most `radius` from this axis' origin.
    ///
    /// With R and S the rotations and o' the point of `other` nearest to the
    /// origin o, `|R(x-o) + o - S(x-o') - o'| <= 2|o - o'| + |R - S| |x - o|`, and
    /// `|R - S|` is at most twice the angle between the axes, which is at most
    /// twice its sine.
    pub(crate) fn rotation_difference(&self, other: &Self, radius: f64) -> f64 {
        let between = other.radial(self.origin).length();
        2.0 * between + 4.0 * self.direction.cross(other.direction).length() * radius
    }
}
