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
use crate::model::{Model, NurbsSurface};
use crate::refine::net_surface;

/// Makes a model of this name.
fn named(name: &str, surfaces: Vec<NurbsSurface>) -> Result<Model> {
    Model::new(Some(name.to_owned()), surfaces)
}

/// Returns `value` if it is finite and above 0, else `OPTION_OUT_OF_RANGE`.
fn positive(option: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::out_of_range(option, value, "a finite number above 0"))
}
