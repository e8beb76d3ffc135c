//! Stage `reduce`: the largest of the least distances, and where it is.

use super::Projected;

/// The index of the largest squared distance, the first of equals; `None` for no samples.
#[must_use]
pub fn reduce(projected: &[Projected]) -> Option<usize> {
    let mut largest: Option<usize> = None;
    for (index, this) in projected.iter().enumerate() {
        if largest.is_none_or(|best| this.distance_squared > projected[best].distance_squared) {
            largest = Some(index);
        }
    }
    largest
}
