//! The models that the experiments measure, the pairs of them and their paths, as planned
//! in `sweep.json`.

pub(super) mod models;
pub(super) mod pairs;
pub(super) mod plan;
