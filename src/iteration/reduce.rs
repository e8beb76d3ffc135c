//! Stage `reduce`: the largest distance of a sample, and the sample.

use super::Projected;
use crate::sorting::sort_by_number;

/// The number of samples in a block, on CPU and GPU: sixteen for each thread of
/// a workgroup.
pub(crate) const BLOCK_SIZE: usize = 1024;

/// Returns the index of the farthest sample of every block, the first of equals;
/// the indices are sorted by falling distance. O(n).
#[must_use]
pub fn reduce(projected: &[Projected]) -> Vec<usize> {
    let farthest_of_block = |(block, samples): (usize, &[Projected])| {
        let mut farthest = 0;
        for (index, sample) in samples.iter().enumerate() {
            if sample.distance_squared > samples[farthest].distance_squared {
                farthest = index;
            }
        }
        block * BLOCK_SIZE + farthest
    };
    let mut farthest: Vec<usize> = projected.chunks(BLOCK_SIZE).enumerate().map(farthest_of_block).collect();
    sort_by_number(&mut farthest, |&sample| -projected[sample].distance_squared);
    farthest
}
