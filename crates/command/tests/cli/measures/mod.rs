//! Commands that measure, beside `distance` and `diff`.

mod align;
pub(crate) mod check;
mod grid;
pub(crate) mod overlap;
mod points;
mod score;
