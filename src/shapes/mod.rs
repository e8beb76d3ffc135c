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
mod sphere_parts;
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
pub use sphere_parts::sphere_parts;
pub use torus::torus;
pub use vessels::{bottle, glass};
pub use wavy_sheet::{WavySheet, wavy_sheet};
pub use wigley::wigley_hull;
pub use wing::{Wing, wing};

use crate::error::{Error, Result};
use crate::model::{Model, NurbsSurface, SurfaceArrays};

/// A model of this name.
fn named(name: &str, surfaces: Vec<NurbsSurface>) -> Result<Model> {
    Model::new(Some(name.to_owned()), surfaces)
}

/// The surface whose control point in row i along u and column j along v is `point(i, j)`.
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

/// `value` if it is finite and more than 0.
fn positive(option: &'static str, value: f64) -> Result<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Error::out_of_range(option, value, "a finite number above 0"))
}
