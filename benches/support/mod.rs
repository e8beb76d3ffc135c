//! Parts that several benchmarks share.
#![allow(dead_code, clippy::panic, reason = "each benchmark uses a part, and ends at what it cannot count")]

pub(crate) mod certified;
pub(crate) mod clock;
pub(crate) mod flops;
pub(crate) mod models;
pub(crate) mod peak;
pub(crate) mod random;
pub(crate) mod shared;
