//! Operations that change a surface's net or place, not its shape.

mod control_net;
mod cut;
mod degree_elevation;
mod knot_insertion;
mod transformed;

pub use cut::{cut_model, cut_surface, part};
pub use degree_elevation::elevate_degree;
pub use knot_insertion::insert_knot;
pub use transformed::transformed;
