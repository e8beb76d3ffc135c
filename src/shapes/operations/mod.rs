//! Operations that change the control net or the position of a surface and keep
//! its shape, and refits, offsets and reductions of degree, which change the shape.

mod control_net;
mod cut;
mod degree_elevation;
mod degree_reduction;
mod knot_insertion;
mod offset;
mod refit;
mod transformed;

pub use cut::{cut_model, cut_surface, part};
pub use degree_elevation::elevate_degree;
pub use degree_reduction::reduce_degree;
pub use knot_insertion::insert_knot;
pub use offset::offset_surface;
pub use refit::{refit_model, refit_surface};
pub use transformed::transformed;
