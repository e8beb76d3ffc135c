//! Parts that several benchmarks share.
#![allow(dead_code, reason = "each benchmark uses a part")]

pub(crate) mod clock;
pub(crate) mod flops;
pub(crate) mod levels;
pub(crate) mod models;
pub(crate) mod peak;
pub(crate) mod shared;
