//! Operations that change the control net or the position of a surface and keep
//! its shape, and refits, which change the shape slightly.

mod control_net;
mod cut;
mod degree_elevation;
mod knot_insertion;
mod refit;
mod transformed;

pub use cut::{cut_model, cut_surface, part};
pub use degree_elevation::elevate_degree;
pub use knot_insertion::insert_knot;
pub use refit::{refit_model, refit_surface};
pub use transformed::transformed;
