//! Random pairs of models, and a check of their certified intervals by brute force.
//!
//! The example `honesty` and the test `soundness` share this folder; both have
//! `tests/support` at their root.

pub(crate) mod attacks;
mod brute;
pub(crate) mod check;
pub(crate) mod clearance;
mod collapsed;
pub(crate) mod facets;
mod offsets;
pub(crate) mod pairs;
mod partners;
mod refits;
mod reparametrized;
pub(crate) mod scores;
mod sheet;
pub(crate) mod solids;
mod surfaces;
pub(crate) mod trims;
pub(crate) mod zones;
