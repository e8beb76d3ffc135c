//! The commands.

pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod grid;
pub(crate) mod info;
mod scores;
mod two;

pub(crate) use scores::{score, summary};
pub(crate) use two::{align, clearance, diff, distance, overlap, statistics};
