//! The coordinates of both models and of a result, which are those of A after its transform.

use crate::model::RigidTransform;
use glam::DVec3;

/// Where both models are. B's unit is `scale` units of A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placing {
    /// Moves A.
    pub(crate) transform: RigidTransform,
    /// A's units in one of B's.
    pub(crate) scale: f64,
    /// Whether the map is one of A, or of B.
    pub(crate) is_of_a: bool,
}

impl Placing {
    /// Returns a point of the map's model in the coordinates of the result.
    pub(super) fn placed(&self, point: DVec3) -> DVec3 {
        if self.is_of_a { self.transform.apply(point) } else { point * self.scale }
    }

    /// Returns a normal of the map's model in the coordinates of the result.
    pub(super) fn turned(&self, normal: DVec3) -> DVec3 {
        if self.is_of_a { self.transform.rotate(normal) } else { normal }
    }

    /// Returns a point in the coordinates of the other model.
    pub(super) fn of_other(&self, point: DVec3) -> DVec3 {
        if self.is_of_a { point / self.scale } else { self.transform.apply_inverse(point) }
    }

    /// Returns a distance in the other model's unit in that of the result.
    pub(super) fn measured(&self, distance: f64) -> f64 {
        if self.is_of_a { distance * self.scale } else { distance }
    }
}
