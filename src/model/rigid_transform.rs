//! The rigid transform that moves model A against model B.

use crate::error::{Error, Result};
use crate::limits::is_in_range;
use glam::{DQuat, DVec3};

/// How far the length of a rotation quaternion may be from 1 before it is
/// refused: the rounding of a quaternion given in single precision.
const UNIT_LENGTH_TOLERANCE: f64 = 1e-5;

/// A rotation about the origin followed by a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidTransform {
    rotation: DQuat,
    translation: DVec3,
}

impl RigidTransform {
    /// Moves nothing.
    pub const IDENTITY: Self = Self { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };

    /// From a unit quaternion and a translation; the quaternion is normalised.
    ///
    /// # Errors
    /// [`Error::TransformNotRigid`] if a number is not finite, the translation
    /// more than 1e100 along an axis, or the quaternion's length is not 1 to about single precision.
    pub fn new(rotation: DQuat, translation: DVec3) -> Result<Self> {
        if !translation.to_array().into_iter().all(is_in_range) {
            let found = format!("translation is {:?}", translation.to_array());
            return Err(Error::TransformNotRigid { found });
        }
        let length = rotation.length();
        if !length.is_finite() || (length - 1.0).abs() > UNIT_LENGTH_TOLERANCE {
            return Err(Error::TransformNotRigid { found: format!("rotation has length {length:?}") });
        }
        Ok(Self { rotation: rotation.normalize(), translation })
    }

    /// A translation.
    ///
    /// # Errors
    /// [`Error::TransformNotRigid`] if a number is not finite or more than 1e100.
    pub fn translation(translation: DVec3) -> Result<Self> {
        Self::new(DQuat::IDENTITY, translation)
    }

    /// Where `point` goes.
    #[must_use]
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// Where the free vector `vector` goes.
    #[must_use]
    pub fn rotate(&self, vector: DVec3) -> DVec3 {
        self.rotation * vector
    }

    /// Where the point comes from.
    #[must_use]
    pub fn apply_inverse(&self, point: DVec3) -> DVec3 {
        self.rotation.inverse() * (point - self.translation)
    }

    /// The transform that undoes this one.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// The rotation, a unit quaternion.
    #[must_use]
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }

    /// The translation applied after the rotation.
    #[must_use]
    pub fn offset(&self) -> DVec3 {
        self.translation
    }
}
