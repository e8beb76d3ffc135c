//! Rigid motions of models.

use crate::axis::Axis;
use crate::error::Result;
use crate::model::{Model, RigidTransform, SurfaceArrays};
use glam::DVec3;

/// Returns `model` moved by `transform`, with the same parameters and weights.
///
/// # Errors
/// `NUMBER_TOO_LARGE` if a coordinate exceeds 1e100 in size after the motion.
pub fn transformed(model: &Model, transform: &RigidTransform) -> Result<Model> {
    let move_point = |&[x, y, z, w]: &[f64; 4]| {
        let point = transform.apply(DVec3::new(x, y, z));
        [point.x, point.y, point.z, w]
    };
    let surfaces = model
        .surfaces()
        .iter()
        .map(|surface| SurfaceArrays {
            degree: surface.degree(),
            knots: Axis::BOTH.map(|axis| surface.knots(axis).to_vec()),
            counts: surface.counts(),
            control_points: surface.control_points().iter().map(move_point).collect(),
        })
        .collect();
    Model::from_arrays(model.name().map(str::to_owned), surfaces)
}
