//! Lines in space.

use crate::model::RigidTransform;
use glam::DVec3;

/// The line through `origin` along a unit vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Line {
    pub(crate) origin: DVec3,
    pub(crate) direction: DVec3,
}

impl Line {
    /// The axis of the circle through three points; no number where they lie
    /// on a line.
    pub(super) fn axis([a, b, c]: [DVec3; 3]) -> Self {
        let (to_b, to_c) = (b - a, c - a);
        let normal = to_b.cross(to_c);
        let square = normal.length_squared();
        let center = (to_b.length_squared() * to_c - to_c.length_squared() * to_b).cross(normal);
        Self { origin: a + center / (2.0 * square), direction: normal / square.sqrt() }
    }

    pub(crate) fn moved(&self, transform: &RigidTransform) -> Self {
        Self { origin: transform.apply(self.origin), direction: transform.rotate(self.direction) }
    }

    /// From the nearest point of the line.
    pub(crate) fn way_to(&self, point: DVec3) -> DVec3 {
        let way = point - self.origin;
        way - way.dot(self.direction) * self.direction
    }

    /// At least how far two turns by one angle, about this line and about
    /// `other`, take a point apart that is within `reach` of this line's origin.
    ///
    /// With R and S the rotations and o' the point of `other` nearest to the
    /// origin o, `|R(x-o) + o - S(x-o') - o'| <= 2|o - o'| + |R - S| |x - o|`, and
    /// `|R - S|` is at most twice the angle between the lines, which is at most
    /// twice its sine.
    pub(crate) fn apart(&self, other: &Self, reach: f64) -> f64 {
        let between = other.way_to(self.origin).length();
        2.0 * between + 4.0 * self.direction.cross(other.direction).length() * reach
    }
}
