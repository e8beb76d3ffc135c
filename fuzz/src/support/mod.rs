//! The evaluator of the tests.
#![allow(dead_code, reason = "the tests use all of it")]

#[path = "../../../tests/support/evaluator.rs"]
pub mod evaluator;
