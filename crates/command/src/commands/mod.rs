//! The commands.

pub(crate) mod check;
pub(crate) mod closest_points;
mod comparisons;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod grid;
pub(crate) mod info;
mod scores;

pub(crate) use comparisons::{align, clearance, diff, distance, gaps, overlap, statistics};
pub(crate) use scores::{score, summary};
