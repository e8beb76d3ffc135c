//! Solids: models whose faces close, and the side on which a point lies.
//!
//! [`Boundary`] joins the edges of the faces in pairs; where each has a partner, the faces and thin
//! strips between partners are closed. [`side`](Boundary::side) then counts, modulo 2, how often a
//! ray crosses the faces, along a ray that certainly avoids the strips. docs/solids.md has the
//! lemmas. Nothing here knows of files, processors or options.

mod clusters;
mod curve;
mod edges;
mod joints;
mod parity;
mod ray;
mod side;
mod strips;

pub(crate) use joints::Boundary;
pub use side::Side;
