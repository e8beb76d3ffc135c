//! Sorting and ordering by a number, for all types by one sort: each further sort of the standard library is
//! about 5 KiB of the module that browsers fetch.

/// Sorts by a number of each item, in the total order of floating-point numbers; items of equal
/// numbers keep their order. O(n log n), and 16 bytes an item.
pub(crate) fn sort_by_number<T>(items: &mut [T], number: impl Fn(&T) -> f64) {
    let mut order: Vec<(f64, f64)> =
        items.iter().enumerate().map(|(place, item)| (number(item), place as f64)).collect();
    sort_pairs(&mut order);
    for place in 0..items.len() {
        let mut from = order[place].1 as usize;
        // The item of an earlier place was swapped to where that place took its own from.
        while from < place {
            from = order[from].1 as usize;
        }
        // What is noted here ends the next walk at once: all walks together are O(n).
        order[place].1 = from as f64;
        items.swap(place, from);
    }
}

/// Sorts pairs by their first numbers, and those of equal ones by their second, in place. O(n log n).
pub(crate) fn sort_pairs(pairs: &mut [(f64, f64)]) {
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
}

/// Orders the values of a type by a number of each, in the total order of floating-point numbers: in a heap the value of
/// the largest number comes first.
#[doc(hidden)]
#[macro_export]
macro_rules! ordered_by {
    ($type:ty, $number:expr) => {
        impl PartialEq for $type {
            fn eq(&self, other: &Self) -> bool {
                self.cmp(other) == std::cmp::Ordering::Equal
            }
        }
        impl Eq for $type {}
        impl PartialOrd for $type {
            fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
                Some(self.cmp(other))
            }
        }
        impl Ord for $type {
            fn cmp(&self, other: &Self) -> std::cmp::Ordering {
                let number: fn(&Self) -> f64 = $number;
                number(self).total_cmp(&number(other))
            }
        }
    };
}

pub use ordered_by;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::sort_by_number;

    #[test]
    fn is_the_stable_sort_of_the_standard_library() {
        let random = &mut fastrand::Rng::with_seed(3);
        for count in 0..200 {
            let mut items: Vec<(f64, usize)> =
                (0..count).map(|at| (f64::from(random.u8(..30)) - 15.0, at)).collect();
            if let Some(item) = items.get_mut(7) {
                item.0 = f64::NAN;
            }
            let mut expected = items.clone();
            expected.sort_by(|a, b| a.0.total_cmp(&b.0));
            sort_by_number(&mut items, |item| item.0);
            let bits = |items: &[(f64, usize)]| -> Vec<(u64, usize)> {
                items.iter().map(|&(number, at)| (number.to_bits(), at)).collect()
            };
            assert_eq!(bits(&items), bits(&expected));
        }
    }

    /// One cycle through all places, whose walks would take hours if each began anew.
    #[test]
    fn a_rotation_is_sorted_in_one_walk() {
        const COUNT: u32 = 1 << 20;
        let mut items: Vec<u32> = (1..COUNT).chain([0]).collect();
        sort_by_number(&mut items, |item| f64::from(*item));
        assert!((0..COUNT).eq(items));
    }
}
