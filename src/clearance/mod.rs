//! The clearance of two models: an interval around the least distance of their points.
//!
//! Both trees are descended together, best first ([`Search`]). A pair of pieces of patches is
//! bounded below by the distance of the convex hulls of their control points along a direction
//! ([`hull`]) or of the spheres, cylinders, cones or tori that they lie on ([`crate::carrier`]), and above by points, which
//! Newton's method brings together ([`newton`]).
//! docs/clearance.md has the lemmas. Nothing here knows of faces, files or processors.

mod body;
mod hull;
mod newton;
mod parted;
mod piece;
mod search;
mod simplex;

pub(crate) use body::Body;
pub(crate) use hull::hull_distance;
pub(crate) use parted::are_parted;
pub(crate) use search::{Goal, Nearest, Search};
