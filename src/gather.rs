//! Vectors of what iterators yield.

/// `gather`, of every iterator.
pub(crate) trait Gather: Iterator + Sized {
    /// The items in order: `collect` into a vector, of which the standard
    /// library makes more functions of the wasm module for every caller.
    fn gather(self) -> Vec<Self::Item> {
        let mut items = Vec::with_capacity(self.size_hint().0);
        self.for_each(|item| items.push(item));
        items
    }
}

impl<I: Iterator> Gather for I {}
