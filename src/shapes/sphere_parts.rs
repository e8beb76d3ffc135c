//! Parts of exact offsets and copies, by parameters that have nothing to do with each other.

use super::operations::{part, transformed};
use super::{named, sphere};
use crate::error::Result;
use crate::model::{Model, RigidTransform};
use crate::param_box::ParamBox;
use glam::{DQuat, DVec3};

/// What of A is taken, of its turn about the axis and along the profile.
const OF_A: ParamBox = ParamBox::new([0.25, 0.5], [0.25, 0.75]);

/// What of B is taken: it contains A's nearest points with room to spare.
const OF_B: ParamBox = ParamBox::new([0.0, 0.75], [0.0, 1.0]);

/// How A is turned against B: about this axis by so many radians.
const AXIS: DVec3 = DVec3::new(1.0, 2.0, 3.0);
const ANGLE: f64 = 0.3;

/// A, a quarter of a sphere between its 45th degrees of latitude, and B, a
/// sphere about the same centre without one quarter; A is turned, so that no
/// parameter lines meet.
///
/// Every point of A is as far from B as the radii differ, yet neither model is
/// the same all around, nor does an affine map take A's parameters to B's: the
/// hardest kind of pair whose distance is known.
///
/// # Errors
/// As [`sphere`].
pub fn sphere_parts(radii: [f64; 2]) -> Result<[Model; 2]> {
    let [a, b] = [0, 1].map(|index| {
        let whole = sphere(DVec3::ZERO, radii[index])?;
        named("part of a sphere", vec![part(&whole.surfaces()[0], [OF_A, OF_B][index])?])
    });
    let turn = DQuat::from_axis_angle(AXIS.normalize(), ANGLE);
    Ok([transformed(&a?, &RigidTransform::new(turn, DVec3::ZERO)?)?, b?])
}
