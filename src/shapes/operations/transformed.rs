//! Rigid motions of models.

use crate::axis::Axis;
use crate::error::Result;
use crate::model::{Model, NurbsSurface, RigidTransform, SurfaceArrays};
use glam::DVec3;

/// Returns `model` moved by `transform`, with the same parameters, weights, trims and names.
///
/// # Errors
/// `NUMBER_TOO_LARGE` if a coordinate exceeds 1e100 in size after the motion.
pub fn transformed(model: &Model, transform: &RigidTransform) -> Result<Model> {
    let move_point = |&[x, y, z, w]: &[f64; 4]| {
        let point = transform.apply(DVec3::new(x, y, z));
        [point.x, point.y, point.z, w]
    };
    let surfaces = model.surfaces().iter().enumerate().map(|(index, surface)| {
        let arrays = SurfaceArrays {
            degree: surface.degree(),
            knots: Axis::BOTH.map(|axis| surface.knots(axis).to_vec()),
            counts: surface.counts(),
            control_points: surface.control_points().iter().map(move_point).collect(),
        };
        NurbsSurface::new(index, arrays)
    });
    // A rigid motion lengthens nothing.
    Ok(model.with_images(surfaces.collect::<Result<_>>()?, 1.0, model.unit()))
}
