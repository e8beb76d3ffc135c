//! Stage `pyramid`: the box of every node, from the boxes of its children.

use super::ChildRange;
use crate::bvh::Aabb;

/// Returns the boxes of every level above `parts`, the root's level first. O(nodes).
#[must_use]
pub fn pyramid(levels: &[Vec<ChildRange>], parts: Vec<Aabb>) -> Vec<Vec<Aabb>> {
    let mut boxes = vec![parts];
    for level in levels.iter().rev() {
        let below = &boxes[boxes.len() - 1];
        let union =
            |children: &ChildRange| below[children.range()].iter().copied().fold(Aabb::EMPTY, Aabb::union);
        boxes.push(level.iter().map(union).collect());
    }
    boxes.reverse();
    boxes.truncate(levels.len());
    boxes
}
