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

    /// Returns a point of the result in the coordinates of the map's model.
    pub(super) fn unplaced(&self, point: DVec3) -> DVec3 {
        if self.is_of_a { self.transform.apply_inverse(point) } else { point / self.scale }
    }

    /// Returns a length of the map's model in the result's unit.
    pub(crate) fn length(&self, length: f64) -> f64 {
        if self.is_of_a { length } else { length * self.scale }
    }

    /// Returns a point of the map's model in the coordinates of the other model.
    pub(super) fn of_other(&self, point: DVec3) -> DVec3 {
        let placed = self.placed(point);
        if self.is_of_a { placed / self.scale } else { self.transform.apply_inverse(placed) }
    }

    /// Returns a point of the other model in the coordinates of the result.
    pub(super) fn foot(&self, foot: DVec3) -> DVec3 {
        if self.is_of_a { foot * self.scale } else { self.transform.apply(foot) }
    }

    /// Returns a distance in the other model's unit in that of the result.
    pub(super) fn measured(&self, distance: f64) -> f64 {
        if self.is_of_a { distance * self.scale } else { distance }
    }
}
