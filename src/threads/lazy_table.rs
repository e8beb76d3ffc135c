//! A table of values that are computed at their first use.

use std::sync::OnceLock;

/// The number of entries that are allocated together: of models of a million patches only few are used.
const CHUNK: usize = 64;

/// A chunk of entries.
type Chunk<T> = Box<[OnceLock<T>]>;

/// A table of values, each computed at its first use, in chunks that are allocated at theirs.
#[derive(Debug, Clone)]
pub(crate) struct LazyTable<T> {
    chunks: OnceLock<Vec<OnceLock<Chunk<T>>>>,
}

impl<T> Default for LazyTable<T> {
    fn default() -> Self {
        Self { chunks: OnceLock::new() }
    }
}

impl<T> LazyTable<T> {
    /// Returns entry `index` of a table of `count`, the same in every call. O(count / 64) in the
    /// first call, O(1) in others.
    pub(crate) fn get(&self, count: usize, index: usize, new: impl FnOnce() -> T) -> &T {
        let chunks = self.chunks.get_or_init(|| empty(count.div_ceil(CHUNK)));
        let chunk = chunks[index / CHUNK].get_or_init(|| empty(CHUNK).into_boxed_slice());
        chunk[index % CHUNK].get_or_init(new)
    }
}

/// So many values that are not computed yet.
fn empty<T>(count: usize) -> Vec<OnceLock<T>> {
    (0..count).map(|_| OnceLock::new()).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Each entry is computed once, and keeps its value.
    #[test]
    fn entries_are_computed_once() {
        const COUNT: usize = 2 * CHUNK + 1;
        let table = LazyTable::default();
        for index in (0..COUNT).rev() {
            assert_eq!(*table.get(COUNT, index, || 3 * index), 3 * index);
        }
        for index in 0..COUNT {
            assert_eq!(*table.get(COUNT, index, || 0), 3 * index);
        }
    }
}
