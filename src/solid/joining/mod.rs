//! The edges of faces, joined in pairs: what closes, and which way it turns.

mod clusters;
mod cracks;
mod edges;
mod joints;
mod orientation;

pub(crate) use edges::Edges;
pub(crate) use joints::Boundary;
pub(crate) use orientation::{Joined, ShellState};
