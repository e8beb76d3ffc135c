//! Many pairs, and their verdicts.

mod batch;
mod pairs;
mod verdicts;
