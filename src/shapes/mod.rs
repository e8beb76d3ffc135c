//! Models made from published formulas, and operations on surfaces.
//!
//! Shapes stand at the origin with z upwards unless their documentation states
//! otherwise; [`operations::transformed`] moves them.

mod catalogue;
mod curves;
mod figure5;
mod freeform;
pub mod operations;
mod revolved;

pub use catalogue::{ShapeInfo, list, shape};
pub use curves::{Naca4, PlaneCurve, circle, half_circle};
pub use figure5::{FIGURE5_NEAREST_SAMPLE, FIGURE5_RADIUS, FIGURE5_SAMPLES, figure5_cylinder, figure5_plane};
#[cfg(all(test, not(target_arch = "wasm32")))]
pub(crate) use freeform::bicubic_patch;
pub use freeform::{WavySheet, Wing, wavy_sheet, wigley_hull, wing};
pub use revolved::{bottle, cone, cylinder, disc, glass, lateral, revolve, sphere, sphere_parts, torus};

use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface, SurfaceArrays};

/// Makes a model of this name.
fn named(name: &str, surfaces: Vec<NurbsSurface>) -> Result<Model> {
    Model::new(Some(name.to_owned()), surfaces)
}

/// Makes the surface whose control point in row i along u and column j along v is
/// `point(i, j)`, `[x, y, z, w]`.
fn net_surface(
    degree: [usize; 2],
    knots: [&[f64]; 2],
    counts: [usize; 2],
    point: &dyn Fn(usize, usize) -> [f64; 4],
) -> Result<NurbsSurface> {
    let mut control_points = Vec::with_capacity(counts[0] * counts[1]);
    for i in 0..counts[0] {
        for j in 0..counts[1] {
            control_points.push(point(i, j));
        }
    }
    NurbsSurface::new(0, SurfaceArrays { degree, knots: knots.map(<[f64]>::to_vec), counts, control_points })
}

/// Returns `value` if it is finite and above 0, else `OPTION_OUT_OF_RANGE`.
fn positive(option: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::out_of_range(option, value, "a finite number above 0"))
}
