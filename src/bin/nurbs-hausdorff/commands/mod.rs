//! The commands.

pub(crate) mod align;
pub(crate) mod check;
pub(crate) mod clearance;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod diff;
pub(crate) mod distance;
pub(crate) mod grid;
pub(crate) mod info;
pub(crate) mod overlap;
pub(crate) mod score;
pub(crate) mod statistics;
pub(crate) mod summary;
