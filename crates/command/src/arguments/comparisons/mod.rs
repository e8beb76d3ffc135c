//! The arguments of the questions about two models.

pub(crate) mod align;
mod by_hand;
pub(crate) mod clearance;
mod diff;
mod distance;
mod overlap;
mod statistics;

pub(crate) use diff::DiffArguments;
pub(crate) use distance::DistanceArguments;
pub(crate) use overlap::OverlapArguments;
pub(crate) use statistics::StatisticsArguments;
