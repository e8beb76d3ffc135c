//! The edges of faces, joined in pairs: what closes, and which way it turns.

mod arcs;
mod boundary;
mod clusters;
mod cracks;
mod edges;
mod joints;
mod orientation;
mod pairing;
mod part;

pub(crate) use arcs::{Arc, JoinedArc, joined_arcs};
pub(crate) use boundary::Boundary;
pub(crate) use clusters::Clusters;
pub(crate) use edges::{EdgePlace, Edges, SurfaceOrigin};
pub(crate) use orientation::{Joined, ShellState};
