//! A value for each of two.

/// The values for 0 and 1: of two directions of a surface, two models, two
/// buffers. Compiles to two calls, where `[0, 1].map` leaves a loop with guards.
#[inline(always)]
pub(crate) fn both<T>(mut of: impl FnMut(usize) -> T) -> [T; 2] {
    let first = of(0);
    [first, of(1)]
}

/// `of` each of two: `pair.map(of)`, compiled as [`both`] is.
#[inline(always)]
pub(crate) fn each<T, U>([first, second]: [T; 2], mut of: impl FnMut(T) -> U) -> [U; 2] {
    let first = of(first);
    [first, of(second)]
}
