//! What the tests check against: an evaluator that shares no code with the
//! crate, and the models that lie beside the project.
#![allow(
    dead_code,
    unreachable_pub,
    clippy::unwrap_used,
    clippy::panic,
    reason = "each test crate uses a part, and a panic is how a test fails"
)]

pub mod cpu;
pub mod evaluator;
pub mod fixtures;
pub mod gpu;
pub mod models;
pub mod quadrature;
pub mod root;
pub mod trims;
pub mod writers;
