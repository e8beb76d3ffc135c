//! Work and values that threads share.

mod lazy_table;
pub(crate) mod parallel;
mod shared;

pub(crate) use lazy_table::LazyTable;
pub(crate) use shared::{computed, locked};
