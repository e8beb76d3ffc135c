//! Stage `reduce`: the largest of the least distances, and where it is.

use super::Projected;

/// The samples of a block, on CPU and GPU: sixteen for each thread of a workgroup.
pub(crate) const BLOCK_SIZE: usize = 1024;

/// The index of the largest squared distance of every block of samples, the
/// first of equals; the largest block first. O(n).
#[must_use]
pub fn reduce(projected: &[Projected]) -> Vec<usize> {
    let of_block = |(block, members): (usize, &[Projected])| {
        let mut largest = 0;
        for (index, this) in members.iter().enumerate() {
            if this.distance_squared > members[largest].distance_squared {
                largest = index;
            }
        }
        block * BLOCK_SIZE + largest
    };
    let mut blocks: Vec<usize> = projected.chunks(BLOCK_SIZE).enumerate().map(of_block).collect();
    blocks.sort_by(|&a, &b| projected[b].distance_squared.total_cmp(&projected[a].distance_squared));
    blocks
}
