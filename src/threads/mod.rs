//! Work and values that threads share.

mod lazy_table;
pub(crate) mod parallel;
mod shared;

/// `Sync` natively, where loops run on all cores; nothing on the web, whose devices belong to one thread.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) use Sync as MaybeSync;
pub(crate) use lazy_table::LazyTable;
pub(crate) use shared::{computed, locked};

/// `Sync` natively, where loops run on all cores; nothing on the web, whose devices belong to one thread.
#[cfg(target_arch = "wasm32")]
pub(crate) trait MaybeSync {}

#[cfg(target_arch = "wasm32")]
impl<T> MaybeSync for T {}
