//! The commands that measure two models.

pub(crate) mod align;
mod asked;
pub(crate) mod clearance;
pub(crate) mod diff;
pub(crate) mod distance;
pub(crate) mod gaps;
pub(crate) mod overlap;
pub(crate) mod statistics;

pub(crate) use asked::answered;
