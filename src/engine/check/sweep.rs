//! The pairs of boxes that come near each other.

use crate::bvh::Aabb;
use crate::sorting::sort_by_number;

/// Returns the pairs of boxes that may be at most `reach` apart along every axis, the lower index first, in order.
///
/// Every other pair is farther apart than `reach`. A sweep along the longest axis: O(n log n + pairs that overlap
/// along that axis).
pub(super) fn pairs_within(boxes: &[Aabb], reach: f64) -> Vec<[usize; 2]> {
    let extent = boxes.iter().fold(Aabb::EMPTY, |all, &aabb| all.union(aabb)).extent();
    let axis = (1..3).fold(0, |longest, axis| if extent[axis] > extent[longest] { axis } else { longest });
    let mut order: Vec<usize> = (0..boxes.len()).collect();
    sort_by_number(&mut order, |&index| boxes[index].min[axis]);
    let mut pairs = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for index in order {
        open.retain(|&other| !is_beyond(&boxes[other], &boxes[index], axis, reach));
        let is_near = |other: usize| are_within(&boxes[other], &boxes[index], reach);
        pairs.extend(
            open.iter()
                .copied()
                .filter(|&other| is_near(other))
                .map(|other| if other < index { [other, index] } else { [index, other] }),
        );
        open.push(index);
    }
    pairs.sort_unstable();
    pairs
}

/// Returns whether two boxes may be at most `reach` apart along every axis.
pub(super) fn are_within(one: &Aabb, other: &Aabb, reach: f64) -> bool {
    (0..3).all(|axis| !is_beyond(one, other, axis, reach) && !is_beyond(other, one, axis, reach))
}

/// Returns whether a box certainly begins more than `reach` behind the end of another one: the difference is rounded
/// down.
fn is_beyond(one: &Aabb, other: &Aabb, axis: usize, reach: f64) -> bool {
    (other.min[axis] - one.max[axis]).next_down() > reach
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use glam::DVec3;

    /// The same pairs as by comparing all, for boxes that meet, touch, contain each other and are apart.
    #[test]
    fn a_sweep_finds_the_pairs_that_all_comparisons_find() {
        let random = &mut fastrand::Rng::with_seed(12);
        for reach in [0.0, 0.25] {
            let boxes: Vec<Aabb> = (0..60)
                .map(|_| {
                    let min = DVec3::from_array([0; 3].map(|_| f64::from(random.u32(0..24)) * 0.125));
                    let size = DVec3::from_array([0; 3].map(|_| f64::from(random.u32(0..8)) * 0.125));
                    Aabb { min, max: min + size }
                })
                .collect();
            let mut expected = Vec::new();
            for a in 0..boxes.len() {
                for b in a + 1..boxes.len() {
                    let gap = (boxes[b].min - boxes[a].max).max(boxes[a].min - boxes[b].max);
                    if gap.max_element() <= reach {
                        expected.push([a, b]);
                    }
                }
            }
            assert!(expected.len() > 20 && expected.len() < 1700, "{}", expected.len());
            assert_eq!(pairs_within(&boxes, reach), expected);
        }
    }
}
