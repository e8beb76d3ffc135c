//! Vectors of what iterators yield.

/// `gather`, of every iterator.
pub(crate) trait Gather: Iterator + Sized {
    /// The items in order: `collect` into a vector, of which the standard
    /// library makes several functions of the wasm module for every caller.
    /// A loop where it is called is less code than any of them.
    #[inline(always)]
    fn gather(self) -> Vec<Self::Item> {
        let mut items = Vec::with_capacity(self.size_hint().0);
        self.gather_into(&mut items);
        items
    }

    /// Appends the items in order: `extend`, of which the same is true.
    #[inline(always)]
    fn gather_into(self, items: &mut Vec<Self::Item>) {
        for item in self {
            items.push(item);
        }
    }
}

impl<I: Iterator> Gather for I {}
