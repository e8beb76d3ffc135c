//! Independent work on all CPU cores natively, sequential in the browser.

use std::ops::Range;

/// The number of items in a range: enough to make the cost of scheduling negligible.
const RANGE_LENGTH: usize = 512;

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
    use rayon::prelude::*;
    if items.len() == 1 {
        return items.into_iter().map(work).collect();
    }
    items.into_par_iter().map(work).collect()
}

/// Calls `work` on all items; returns the results in order.
#[cfg(target_arch = "wasm32")]
pub(crate) fn map_items<I: Send, T: Send>(items: Vec<I>, work: impl Fn(I) -> T + Sync + Send) -> Vec<T> {
    items.into_iter().map(work).collect()
}

/// Calls `work` on `0..count` on all cores; returns the results in order.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    use rayon::prelude::*;
    if count == 1 {
        return vec![work(0)];
    }
    (0..count).into_par_iter().map(work).collect()
}

/// Calls `work` on `0..count`; returns the results in order.
#[cfg(target_arch = "wasm32")]
pub(crate) fn map<T>(count: usize, work: impl Fn(usize) -> T) -> Vec<T> {
    (0..count).map(work).collect()
}

/// A listener that is called with each result and its index, in order.
pub(crate) type Watch<'a, T> = Option<&'a mut dyn FnMut(usize, &T)>;

/// Maps as [`map`] does; with a listener on the calling thread alone, since what it draws is wanted in order.
pub(crate) fn map_watched<T: Send>(
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
