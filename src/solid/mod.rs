//! Solids: models whose faces close, and the side on which a point lies.
//!
//! [`Boundary`] joins the edges of the faces in pairs; where each has a partner, the faces and thin
//! strips between partners are closed. [`enclosing`](Boundary::enclosing) then counts, modulo 2, how
//! often a ray crosses the faces of each shell, along a ray that certainly avoids the strips;
//! [`Enclosing`] has the side that follows. [`windings`](Boundary::windings) counts the crossings with their signs: a
//! shell that encloses a point twice meets itself. A sheet has no sides, but a [`pseudonormal`] at each point. docs/solids.md has the lemmas. Nothing here knows of files, processors or options.

mod curve;
mod enclosing;
mod joining;
mod pseudonormal;
mod ray;
mod side;
mod strips;
mod winding;

pub(crate) use curve::Curve;
pub(crate) use enclosing::{Enclosing, SourceSolid};
pub(crate) use joining::{
    Arc, Boundary, Clusters, EdgePlace, Edges, Joined, JoinedArc, ShellState, SurfaceOrigin, joined_arcs,
};
pub(crate) use pseudonormal::pseudonormal;
pub use side::Side;
pub(crate) use strips::{Ruled, edge_width};
pub(crate) use winding::longer_axis_of_controls;
