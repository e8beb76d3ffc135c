//! Parts of exact offsets and copies with unrelated parametrisations.

use crate::error::Result;
use crate::model::{Model, RigidTransform};
use crate::param_box::ParamBox;
use crate::shapes::operations::{part, transformed};
use crate::shapes::{named, sphere};
use glam::{DQuat, DVec3};

/// The part of the sphere that is A, in fractions of its parameters.
const PART_A: ParamBox = ParamBox::new([0.25, 0.5], [0.25, 0.75]);

/// The part of the sphere that is B; it contains A's nearest points with a margin.
const PART_B: ParamBox = ParamBox::new([0.0, 0.75], [0.0, 1.0]);

/// The rotation of A against B: its axis, and its angle in radians.
const AXIS: DVec3 = DVec3::new(1.0, 2.0, 3.0);
const ANGLE: f64 = 0.3;

/// Returns A, a quarter of a sphere between latitudes of ±45°, and B, a sphere
/// about the same centre without one quarter; A is rotated, so that the parameter
/// lines of both do not correspond.
///
/// The distance of every point of A from B is the difference of the radii, yet
/// neither model is invariant under rotations, and no affine map takes A's
/// parameters to B's: the hardest kind of pair with a known distance.
///
/// # Errors
/// Those of [`sphere`].
pub fn sphere_parts(radii: [f64; 2]) -> Result<[Model; 2]> {
    let [a, b] = [0, 1].map(|index| {
        let whole = sphere(DVec3::ZERO, radii[index])?;
        named("part of a sphere", vec![part(&whole.surfaces()[0], [PART_A, PART_B][index])?])
    });
    let turn = DQuat::from_axis_angle(AXIS.normalize(), ANGLE);
    Ok([transformed(&a?, &RigidTransform::new(turn, DVec3::ZERO)?)?, b?])
}
