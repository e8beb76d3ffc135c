//! The rigid transform that moves model A relative to model B.

use crate::error::{Error, Result};
use crate::limits::is_in_range;
use crate::rounding::gamma;
use glam::{DQuat, DVec3};

/// The largest accepted difference of a quaternion's length from 1: the rounding
/// of a quaternion given in single precision.
const UNIT_LENGTH_TOLERANCE: f64 = 1e-5;

/// The roundings of a rotated vector, relative to its length: lemma R2 of
/// docs/rounding.md.
const ROTATION_ROUNDINGS: f64 = 64.0;

/// A rotation about the origin followed by a translation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidTransform {
    rotation: DQuat,
    translation: DVec3,
}

impl Default for RigidTransform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl RigidTransform {
    /// The identity.
    pub const IDENTITY: Self = Self { rotation: DQuat::IDENTITY, translation: DVec3::ZERO };

    /// Makes a transform from a unit quaternion, which is normalised, and a translation.
    ///
    /// # Errors
    /// [`Error::TransformNotRigid`] if a number is not finite, a coordinate of the
    /// translation exceeds 1e100, or the quaternion's length differs from 1 by more
    /// than 1e-5.
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

    /// Makes a translation.
    ///
    /// # Errors
    /// [`Error::TransformNotRigid`] if a coordinate is not finite or exceeds 1e100.
    pub fn translation(translation: DVec3) -> Result<Self> {
        Self::new(DQuat::IDENTITY, translation)
    }

    /// Returns the rotation that moves the point `from` onto `to`.
    pub(crate) fn about(rotation: DQuat, from: DVec3, to: DVec3) -> Self {
        Self { rotation, translation: to - rotation * from }
    }

    /// Returns the transform followed by a rotation about `center` and a shift. The rotation vector
    /// has the direction of the axis and the length of the angle in radians.
    pub(crate) fn followed(&self, vector: DVec3, center: DVec3, shift: DVec3) -> Self {
        let turn = DQuat::from_scaled_axis(vector);
        Self {
            rotation: (turn * self.rotation).normalize(),
            translation: turn * (self.translation - center) + center + shift,
        }
    }

    /// Returns the image of a point.
    #[must_use]
    pub fn apply(&self, point: DVec3) -> DVec3 {
        self.rotation * point + self.translation
    }

    /// Returns an upper bound on the error of the images of points at most `length`
    /// from the origin, for this transform or its inverse: the
    /// rotation of the point and, in an inverse, of the translation, and their sum
    /// (lemma R2 of docs/rounding.md).
    pub(crate) fn rounding(&self, length: f64) -> f64 {
        let moved = length + self.translation.length();
        gamma(ROTATION_ROUNDINGS + 1.0) * moved
    }

    /// Returns the image of a free vector.
    #[must_use]
    pub fn rotate(&self, vector: DVec3) -> DVec3 {
        self.rotation * vector
    }

    /// Returns the point whose image is `point`.
    #[must_use]
    pub fn apply_inverse(&self, point: DVec3) -> DVec3 {
        self.rotation.inverse() * (point - self.translation)
    }

    /// Returns the inverse transform.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.inverse();
        Self { rotation, translation: -(rotation * self.translation) }
    }

    /// Returns the rotation, a unit quaternion.
    #[must_use]
    pub fn rotation(&self) -> DQuat {
        self.rotation
    }

    /// Returns the translation, which is applied after the rotation.
    #[must_use]
    pub fn offset(&self) -> DVec3 {
        self.translation
    }
}
