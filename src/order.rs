//! One sort for all, as every further one is kilobytes of the wasm module.

/// Indices of `keys` from the smallest key to the largest; equal keys keep
/// their order, and what is no number comes last or, if negative, first.
pub(crate) fn rising(keys: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..keys.len()).collect();
    order.sort_by(|&a, &b| keys[a].total_cmp(&keys[b]));
    order
}

/// `items` from the largest key to the smallest; equal keys keep their order.
pub(crate) fn by_falling<T: Copy>(items: &[T], key: impl Fn(&T) -> f64) -> Vec<T> {
    let keys: Vec<f64> = items.iter().map(|item| -key(item)).collect();
    rising(&keys).into_iter().map(|index| items[index]).collect()
}

#[cfg(test)]
mod tests {
    use super::{by_falling, rising};

    #[test]
    fn keys_rise_and_fall_stably() {
        let keys = [2.0, -1.0, 2.0, f64::INFINITY, 0.0];
        assert_eq!(rising(&keys), [1, 4, 0, 2, 3]);
        let items = [('a', 2.0), ('b', -1.0), ('c', 2.0), ('d', 7.0)];
        let names: String = by_falling(&items, |item| item.1).iter().map(|item| item.0).collect();
        assert_eq!(names, "dacb");
    }
}
