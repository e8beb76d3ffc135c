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
    use crate::measure::{ask, check, closest_points, signed_distances};
    #[pymodule_export]
    use crate::model::{Model, names_beside};
}
