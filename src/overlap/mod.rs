//! The volume that two solids have in common, as an interval, without a boolean operation.
//!
//! It is an integral over the parts of each boundary that lie within the other solid ([`Search`]): pieces of patches
//! ([`piece`]) that have no point of the other boundary near them are on one side of it, those that may have are
//! halved, and what remains undecided is bounded by its area. Patches that both boundaries have ([`shared`]),
//! and plane pieces that lie on the other boundary ([`flush`]), count half for each. Lemmas and proofs are in docs/facts.md. Nothing here knows of files, options or results.

mod flush;
mod piece;
mod search;
mod separation;
mod shared;
mod solid;

pub(crate) use search::Search;
pub(crate) use solid::{BoundarySide, Known, PlacedSolid, Sides};
