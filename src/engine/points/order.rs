//! The order in which points are measured.

use crate::bvh::Aabb;
use glam::DVec3;

/// The number of bits of a coordinate along the curve: three of them fill 63 of 64.
const BITS: u32 = 21;

/// Returns the indices of points, x, y, z each, along a Morton curve through their box; of points that
/// share a cell of it, the smaller index first. O(n log n).
///
/// The foot of a point is a start for the next one, and the space between them often has no points of the
/// model: the nearer they are, the less is left to search.
pub(super) fn along_curve(points: &[f64]) -> Vec<u32> {
    let (points, _) = points.as_chunks::<3>();
    let aabb = points.iter().fold(Aabb::EMPTY, |aabb, &point| aabb.with(DVec3::from_array(point)));
    // Cells are cubes, so that those that follow each other are near each other.
    let scale = f64::from((1_u32 << BITS) - 1) / aabb.extent().max_element();
    let mut keys: Vec<(u64, u32)> = points
        .iter()
        .zip(0..)
        .map(|(&point, index)| {
            // A conversion of NaN, of points that are all the same, gives 0.
            let cell = (scale * (DVec3::from_array(point) - aabb.min)).to_array().map(|cell| cell as u64);
            (spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2, index)
        })
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, index)| index).collect()
}

/// Returns the lowest [`BITS`] bits of a number with two zeros between each and the next.
fn spread(number: u64) -> u64 {
    // Each step moves the upper half of every group of bits; the masks keep the groups.
    const STEPS: [(u32, u64); 5] = [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ];
    let kept = number & ((1 << BITS) - 1);
    STEPS.iter().fold(kept, |bits, &(shift, mask)| (bits | bits << shift) & mask)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn bits_are_spread_to_every_third_place() {
        for number in [0, 1, 0b1011, 0x0f_f0f5, (1 << BITS) - 1] {
            let expected =
                (0..BITS).map(|bit| (number >> bit & 1) << (3 * bit)).fold(0, |sum, bit| sum | bit);
            assert_eq!(spread(number), expected, "{number:b}");
        }
    }

    /// The corners of a cube in the order of the curve, x fastest, whichever order they are given in.
    #[test]
    fn points_follow_the_curve() {
        let corner = |index: usize| [index & 1, index >> 1 & 1, index >> 2].map(|end| end as f64 - 7.0);
        let points: Vec<f64> = [5, 2, 7, 0, 1, 6, 3, 4].into_iter().flat_map(corner).collect();
        assert_eq!(along_curve(&points), [3, 4, 1, 6, 7, 0, 5, 2]);
        // Each point is there once, equal ones in their order.
        assert_eq!(along_curve(&[1.0; 9]), [0, 1, 2]);
        assert!(along_curve(&[]).is_empty());
    }
}
