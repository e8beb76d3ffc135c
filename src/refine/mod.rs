//! Changes of a surface's control net that keep its shape: knots inserted, surfaces cut.

mod control_net;
mod cut;
mod knot_insertion;

#[cfg(feature = "shapes")]
pub(crate) use control_net::{map_lines, net_surface};
pub use cut::cut_surface;
#[cfg(feature = "shapes")]
pub use knot_insertion::insert_knot;
