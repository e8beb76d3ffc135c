//! Coordinate systems.

use glam::{DMat3, DVec3, DVec4};

/// An origin and three orthogonal unit vectors, right-handed or left-handed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    pub(crate) origin: DVec3,
    pub(crate) x: DVec3,
    pub(crate) y: DVec3,
    pub(crate) z: DVec3,
}

impl Frame {
    /// A right-handed frame with this z axis; `None` without a direction.
    pub(crate) fn about(origin: DVec3, axis: DVec3) -> Option<Self> {
        let z = axis.try_normalize()?;
        let (x, y) = z.any_orthonormal_pair();
        Some(Self { origin, x, y, z })
    }

    /// Returns 1 for a right-handed frame and -1 for a left-handed one.
    pub(crate) fn handedness(&self) -> f64 {
        self.x.cross(self.y).dot(self.z).signum()
    }

    /// Returns the frame whose coordinates are those of space for what has coordinates of this one: what
    /// [`Self::local_point`] takes there, it takes back.
    pub(crate) fn inverse(&self) -> Self {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| self.local_vector(axis));
        Self { origin: self.local_point(DVec3::ZERO), x, y, z }
    }

    /// Returns the frame turned about its z axis.
    pub(crate) fn turned_by(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { x: cos * self.x + sin * self.y, y: cos * self.y - sin * self.x, ..*self }
    }

    /// Returns the point of local coordinates that are turned about z by an angle.
    pub(crate) fn turned(&self, local: DVec3, angle: f64) -> DVec3 {
        let (sin, cos) = angle.sin_cos();
        let turned = DVec3::new(cos * local.x - sin * local.y, sin * local.x + cos * local.y, local.z);
        self.point(turned)
    }

    /// Returns a point of the frame's coordinates in space.
    pub(crate) fn point(&self, local: DVec3) -> DVec3 {
        self.origin + self.vector(local)
    }

    /// Returns a vector of the frame's coordinates in space.
    pub(crate) fn vector(&self, local: DVec3) -> DVec3 {
        local.x * self.x + local.y * self.y + local.z * self.z
    }

    /// Returns the frame's coordinates of a vector in space.
    pub(crate) fn local_vector(&self, vector: DVec3) -> DVec3 {
        let matrix = DMat3::from_cols(self.x, self.y, self.z);
        // Orthonormal, so that the transpose is the inverse.
        matrix.transpose() * vector
    }

    /// Returns the frame's coordinates of a point in space.
    pub(crate) fn local_point(&self, point: DVec3) -> DVec3 {
        self.local_vector(point - self.origin)
    }

    /// Returns homogeneous coordinates of the frame in space.
    pub(crate) fn homogeneous(&self, local: DVec4) -> DVec4 {
        (local.w * self.origin + self.vector(local.truncate())).extend(local.w)
    }
}
