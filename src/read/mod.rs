//! The way from the faces that a reader made of a file to a model, and the account of it.
//!
//! Readers, here and in JavaScript, make [`Assembled`]; [`validation`] makes a model of it, without the
//! faces that the model refuses; [`transfer`] carries it from the wasm module of the readers to
//! that of the core.

#![cfg_attr(
    not(feature = "cad"),
    allow(dead_code, unused_imports, reason = "without a reader there is nothing to make a model of")
)]

mod assembled;
mod report;
#[cfg(any(feature = "wasm", feature = "wasm-readers"))]
mod transfer;
pub(crate) mod validation;

pub(crate) use assembled::Assembled;
pub(crate) use report::FaceCounts;
pub use report::{FaceId, Note, ReadReport, Skipped};
