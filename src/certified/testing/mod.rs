//! Models and cells for the tests of this method.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod biquadratic;
mod faces;
mod patches;
mod surfaces;

pub(super) use biquadratic::{oblique, patch, through};
pub(crate) use faces::{face, plane_between, unit_plane};
pub(super) use patches::{
    Net, PatchModel, ROUNDING, assert_attained, bilinear, evaluate, graph, line, pair, plane, point,
};
pub(super) use surfaces::{Surfaces, clamped, closed, whole_block};
