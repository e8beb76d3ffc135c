//! Models made from published formulas, and operations that keep a surface's
//! points while changing its control net.
//!
//! Shapes stand at the origin with z up unless they say otherwise; move them
//! with [`operations::transformed`].

mod catalogue;
mod circle;
mod cylinder;
mod disc;
mod figure5;
mod interpolation;
mod naca;
pub mod operations;
mod plane_curve;
mod revolution;
mod sphere;
mod torus;
mod vessels;
mod wavy_sheet;
mod wigley;
mod wing;

pub use catalogue::{ShapeInfo, list, shape};
pub use circle::{circle, half_circle};
pub use cylinder::{cone, cylinder, lateral};
pub use disc::disc;
pub use figure5::{FIGURE5_NEAREST_SAMPLE, FIGURE5_RADIUS, FIGURE5_SAMPLES, figure5_cylinder, figure5_plane};
pub use naca::Naca4;
pub use plane_curve::PlaneCurve;
pub use revolution::revolve;
pub use sphere::sphere;
pub use torus::torus;
pub use vessels::{bottle, glass};
pub use wavy_sheet::{WavySheet, wavy_sheet};
pub use wigley::wigley_hull;
pub use wing::{Wing, wing};

use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface};
use crate::shown::Shown;

/// A model of this name.
fn named(name: &str, surfaces: Vec<NurbsSurface>) -> Result<Model> {
    Model::new(Some(name.to_owned()), surfaces)
}

/// `value` if it is finite and more than 0.
fn positive(option: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::OptionOutOfRange {
        option,
        found: Shown(value).to_string(),
        expected: "a finite number above 0",
    })
}
