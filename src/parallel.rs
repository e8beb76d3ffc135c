//! Independent work on all processors natively, in turn in the browser.

use std::ops::Range;

/// Items of a range: enough that handing it out costs nothing beside it.
const RANGE: usize = 512;

/// `work` on consecutive ranges that cover 0 to `count`, results in order.
pub(crate) fn map_ranges<T: Send>(count: usize, work: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    let range = |index: usize| index * RANGE..((index + 1) * RANGE).min(count);
    map(count.div_ceil(RANGE), |index| work(range(index)))
}

/// Items of some microseconds that are not worth waking another thread for.
const FEW: usize = 4;

/// Whether so many items, which take microseconds, are done on this thread.
pub(crate) fn is_few(count: usize) -> bool {
    count < FEW
}

/// [`map`] of items that take microseconds.
pub(crate) fn map_short<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    if is_few(count) {
        return (0..count).map(work).collect();
    }
    map(count, work)
}

/// `work` that calls [`map`] several times, as one of the threads that share it:
/// from elsewhere, every call would wait for one of them to wake.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn together<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::scope(|_| work())
}

/// `work` itself.
#[cfg(target_arch = "wasm32")]
pub(crate) fn together<T>(work: impl FnOnce() -> T) -> T {
    work()
}

/// `work` on 0 to `count`, results in order.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    use rayon::prelude::*;
    if count == 1 {
        return vec![work(0)];
    }
    (0..count).into_par_iter().map(work).collect()
}

/// `work` on 0 to `count`, results in order.
#[cfg(target_arch = "wasm32")]
pub(crate) fn map<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..count).map(work).collect()
}
