//! Operations that change the control net or the position of a surface and keep
//! its shape, and refits, offsets and reductions of degree, which change the shape.

mod degree_elevation;
mod degree_reduction;
mod offset;
mod parts;
mod refit;
mod transformed;

pub use crate::refine::{cut_surface, insert_knot};
pub use degree_elevation::elevate_degree;
pub use degree_reduction::reduce_degree;
pub use offset::offset_surface;
pub use parts::{cut_model, part};
pub use refit::{refit_model, refit_surface};
pub use transformed::transformed;
