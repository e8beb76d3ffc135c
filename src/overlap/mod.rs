//! The volume that two solids have in common, as an interval, without a boolean operation.
//!
//! It is an integral over the parts of each boundary that lie within the other solid ([`Search`]): pieces of patches
//! ([`piece`]) that have no point of the other boundary near them are on one side of it; of those that it crosses near a
//! level set ([`crossing`]) of a quadric ([`carrier`]) the parts above and below that are; all that are not decided are halved until what may be
//! wrong is little. Patches that both boundaries have ([`pair`]) count half for each, and planes on each other are
//! first moved apart by a short motion. Lemmas and proofs are in docs/facts.md. Nothing here knows of files,
//! options or results.

mod carrier;
mod crossing;
mod density;
mod look;
mod pair;
mod piece;
mod search;
mod separation;
mod solid;
mod undecided;

pub(crate) use pair::Pair;
pub(crate) use search::Search;
pub(crate) use solid::{BoundarySide, Known, PlacedSolid, Sides};
