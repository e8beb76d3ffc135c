//! One sort and one selection for all: every one of the standard library's is
//! kilobytes of the wasm module.

use crate::gather::Gather;
/// Indices of `keys` from the smallest key to the largest; equal keys keep
/// their order, and what is no number comes last or, if negative, first.
pub(crate) fn rising(keys: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..keys.len()).gather();
    let mut merged = Vec::with_capacity(order.len());
    let mut run = 1;
    while run < order.len() {
        for runs in order.chunks(2 * run) {
            let (mut low, mut high) = runs.split_at(run.min(runs.len()));
            while let ([this, low_rest @ ..], [other, high_rest @ ..]) = (low, high) {
                if keys[*other].total_cmp(&keys[*this]).is_lt() {
                    merged.push(*other);
                    high = high_rest;
                } else {
                    merged.push(*this);
                    low = low_rest;
                }
            }
            merged.extend_from_slice(low);
            merged.extend_from_slice(high);
        }
        std::mem::swap(&mut order, &mut merged);
        merged.clear();
        run *= 2;
    }
    order
}

/// Reorders `items` so that none of the first `count`, which must be fewer
/// than all, has a larger key than any other. O(n) on average (Hoare's Find).
pub(crate) fn select(items: &mut [u32], count: usize, key: &dyn Fn(u32) -> f64) {
    let (mut first, mut last) = (0, items.len() - 1);
    while first < last {
        let pivot = key(items[first.midpoint(last)]);
        let (mut low, mut high) = (first, last);
        // What is left of `low` is at most the pivot, what is right of `high` at least.
        loop {
            while key(items[low]).total_cmp(&pivot).is_lt() {
                low += 1;
            }
            while key(items[high]).total_cmp(&pivot).is_gt() {
                high -= 1;
            }
            if low >= high {
                break;
            }
            items.swap(low, high);
            low += 1;
            high -= 1;
        }
        if count <= high {
            last = high;
        } else {
            first = high + 1;
        }
    }
}

/// `items` from the largest key to the smallest; equal keys keep their order.
pub(crate) fn by_falling<T: Copy>(items: &[T], key: impl Fn(&T) -> f64) -> Vec<T> {
    let keys: Vec<f64> = items.iter().map(|item| -key(item)).gather();
    rising(&keys).into_iter().map(|index| items[index]).gather()
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::{by_falling, rising, select};

    #[test]
    fn keys_rise_and_fall_stably() {
        let keys = [2.0, -1.0, 2.0, f64::INFINITY, 0.0];
        assert_eq!(rising(&keys), [1, 4, 0, 2, 3]);
        let items = [('a', 2.0), ('b', -1.0), ('c', 2.0), ('d', 7.0)];
        let names: String = by_falling(&items, |item| item.1).iter().map(|item| item.0).collect();
        assert_eq!(names, "dacb");
    }

    #[test]
    fn orders_are_those_of_the_standard_library() {
        let random = &mut fastrand::Rng::with_seed(13);
        for length in 1..200 {
            // Few different keys, many, and rising ones with some out of place.
            for keys in [3, 1000, 0] {
                let key = |index: usize, random: &mut fastrand::Rng| match (keys, random.u8(0..8)) {
                    (0, 1..) => index as f64,
                    (most, _) => f64::from(random.u32(0..most.max(9))),
                };
                let keys: Vec<f64> = (0..length).map(|index| key(index, random)).collect();
                let mut order: Vec<usize> = (0..length).collect();
                order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
                assert_eq!(rising(&keys), order);
                let count = random.usize(0..length);
                let mut items: Vec<u32> = (0..length as u32).collect();
                select(&mut items, count, &|item| keys[item as usize]);
                let of = |item: &u32| keys[*item as usize];
                let largest = items[..count].iter().map(of).fold(f64::NEG_INFINITY, f64::max);
                assert!(items[count..].iter().all(|item| of(item) >= largest));
                items.sort_unstable();
                assert!(items.into_iter().eq(0..length as u32));
            }
        }
    }
}
