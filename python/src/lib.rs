//! The native half of the Python package `nurbs_hausdorff`: thin calls of the crate.
//!
//! Options come as dictionaries and results go as dictionaries, both by serde with the
//! crate's own names; the Python half writes them in snake case and gives them types.

#![recursion_limit = "256"] // GPU types within the engine nest deeply.

mod convert;
mod failure;
mod maps;
mod measure;
mod model;
mod running;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::maps::deviation_maps;
    #[pymodule_export]
    use crate::measure::{
        best_fit, check, clearance, closest_points, diff, distance, field, gaps, overlap, score,
        signed_distances, statistics,
    };
    #[pymodule_export]
    use crate::model::{Model, names_beside};
}
