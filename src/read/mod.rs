//! The way from the faces that a reader made of a file to a model, and the account of it.
//!
//! Readers, in crates of their own and in JavaScript, make [`Assembled`]; [`validation`] makes a model of it, without the
//! faces that the model refuses; [`transfer`] carries it from the wasm module of the readers to
//! that of the core.

mod assembled;
mod report;
#[cfg(feature = "js")]
mod transfer;
mod unpacked;
mod validation;

pub use assembled::Assembled;
pub use report::{FaceCounts, FaceId, Note, ReadReport, Skipped};
pub use unpacked::Budget;
pub use validation::into_model;
