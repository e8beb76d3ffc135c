//! Independent work on all CPU cores natively, sequential in the browser.

use std::ops::Range;
#[cfg(not(target_arch = "wasm32"))]
use std::sync::{Mutex, PoisonError};

#[cfg(not(target_arch = "wasm32"))]
use super::locked;

/// The number of items in a range: enough to make the cost of scheduling negligible.
pub(crate) const RANGE_LENGTH: usize = 512;

/// Returns consecutive ranges that cover `0..count`.
pub(crate) fn ranges(count: usize) -> impl ExactSizeIterator<Item = Range<usize>> {
    (0..count.div_ceil(RANGE_LENGTH))
        .map(move |index| index * RANGE_LENGTH..((index + 1) * RANGE_LENGTH).min(count))
}

/// Calls `work` on consecutive ranges that cover `0..count`; returns the results in order.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn map_ranges<T: Send>(count: usize, work: impl Fn(Range<usize>) -> T + Sync + Send) -> Vec<T> {
    map_items(ranges(count).collect(), work)
}

/// Calls `work` on consecutive ranges that cover `0..count`; returns the results in order.
#[cfg(target_arch = "wasm32")]
pub(crate) fn map_ranges<T>(count: usize, work: impl Fn(Range<usize>) -> T) -> Vec<T> {
    ranges(count).map(work).collect()
}

/// The smallest number of items of a few microseconds each for which it pays to
/// wake other threads.
const MIN_PARALLEL: usize = 4;

/// Returns whether [`map_short`] runs this many items on the calling thread.
pub(crate) fn is_few(count: usize) -> bool {
    count < MIN_PARALLEL
}

/// Maps as [`map`] does, for items that take a few microseconds each.
pub(crate) fn map_short<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    if is_few(count) {
        return (0..count).map(work).collect();
    }
    map(count, work)
}

/// Runs two pieces of work, at a time if both are `large`.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn join(large: bool, first: impl FnOnce() + Send, second: impl FnOnce() + Send) {
    if large {
        rayon::join(first, second);
    } else {
        first();
        second();
    }
}

/// Runs two pieces of work.
#[cfg(target_arch = "wasm32")]
pub(crate) fn join(_large: bool, first: impl FnOnce(), second: impl FnOnce()) {
    first();
    second();
}

/// Runs `work`, which calls [`map`] several times, on a thread of the pool: from
/// outside the pool, every call would wait for a thread to wake.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn together<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::scope(|_| work())
}

/// Runs `work`.
#[cfg(target_arch = "wasm32")]
pub(crate) fn together<T>(work: impl FnOnce() -> T) -> T {
    work()
}

/// Calls `work` on all items on all cores; returns the results in order.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn map_items<I: Send, T: Send>(items: Vec<I>, work: impl Fn(I) -> T + Sync + Send) -> Vec<T> {
    if items.len() < 2 {
        return items.into_iter().map(work).collect();
    }
    let length = block_length(items.len());
    let mut rest = items.into_iter();
    let blocks: Vec<Mutex<Vec<I>>> = std::iter::from_fn(|| {
        let block: Vec<I> = rest.by_ref().take(length).collect();
        (!block.is_empty()).then(|| Mutex::new(block))
    })
    .collect();
    map_blocks(blocks.len(), |block| {
        let items = std::mem::take(&mut *locked(&blocks[block]));
        items.into_iter().map(&work).collect()
    })
}

/// Calls `work` on all items; returns the results in order.
#[cfg(target_arch = "wasm32")]
pub(crate) fn map_items<I: Send, T: Send>(items: Vec<I>, work: impl Fn(I) -> T + Sync + Send) -> Vec<T> {
    items.into_iter().map(work).collect()
}

/// Calls `work` on `0..count` on all cores; returns the results in order.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    if count < 2 {
        return (0..count).map(work).collect();
    }
    let length = block_length(count);
    map_blocks(count.div_ceil(length), |block| {
        (block * length..((block + 1) * length).min(count)).map(&work).collect()
    })
}

/// Calls `work` on `0..count`; returns the results in order.
#[cfg(target_arch = "wasm32")]
pub(crate) fn map<T>(count: usize, work: impl Fn(usize) -> T) -> Vec<T> {
    (0..count).map(work).collect()
}

/// The largest number of items that one thread takes at a time: what a block costs, a fraction of a
/// microsecond, is little beside the work on so many.
#[cfg(not(target_arch = "wasm32"))]
const MAX_BLOCK_LENGTH: usize = 16;

/// The least number of blocks for each thread, so that all of them end at nearly the same time.
#[cfg(not(target_arch = "wasm32"))]
const BLOCKS_PER_THREAD: usize = 16;

/// The number of consecutive items, at least one, that a thread takes at a time.
#[cfg(not(target_arch = "wasm32"))]
fn block_length(count: usize) -> usize {
    (count / (BLOCKS_PER_THREAD * rayon::current_num_threads())).clamp(1, MAX_BLOCK_LENGTH)
}

/// Calls `work` on the numbers of `count` blocks on all cores; returns their results, one after another.
#[cfg(not(target_arch = "wasm32"))]
fn map_blocks<T: Send>(count: usize, work: impl Fn(usize) -> Vec<T> + Sync) -> Vec<T> {
    let results: Vec<Mutex<Vec<T>>> = (0..count).map(|_| Mutex::default()).collect();
    for_each(count, &|block| {
        let result = work(block);
        *locked(&results[block]) = result;
    });
    let blocks = results.into_iter().map(|block| block.into_inner().unwrap_or_else(PoisonError::into_inner));
    blocks.flatten().collect()
}

/// Calls `work` on `0..count` on all cores. The pool's generic code, a seventh of the functions of the
/// crate where it was compiled for each kind of work and result, is compiled here alone.
#[cfg(not(target_arch = "wasm32"))]
fn for_each(count: usize, work: &(dyn Fn(usize) + Sync)) {
    use rayon::prelude::*;
    (0..count).into_par_iter().for_each(work);
}

/// A listener that is called with each result and its index, in order.
pub type Watch<'a, T> = Option<&'a mut dyn FnMut(usize, &T)>;

/// Maps on all cores; with a listener on the calling thread alone, since what it draws is wanted in order.
pub fn map_watched<T: Send>(
    count: usize,
    work: impl Fn(usize) -> T + Sync + Send,
    watch: Watch<'_, T>,
) -> Vec<T> {
    let Some(watch) = watch else { return map(count, work) };
    let told = |index| {
        let item = work(index);
        watch(index, &item);
        item
    };
    (0..count).map(told).collect()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    /// Results stand in the order of their items, however these are shared out.
    #[test]
    fn results_are_in_order() {
        for count in [0, 1, 2, 3, 15, 16, 17, 1000, 12_345] {
            let squares: Vec<usize> = (0..count).map(|index| index * index).collect();
            assert_eq!(map(count, |index| index * index), squares);
            assert_eq!(map_items((0..count).collect(), |item| item * item), squares);
            let ranges: Vec<usize> = map_ranges(count, |range| range.map(|index| index * index).sum());
            assert_eq!(ranges.iter().sum::<usize>(), squares.iter().sum::<usize>());
        }
    }
}
