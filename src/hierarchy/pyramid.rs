//! Stage `pyramid`: the box of every node, from those of its children.

use super::Children;
use crate::bvh::Aabb;

/// The boxes of every level above `parts`, the root's level first. O(nodes).
#[must_use]
pub fn pyramid(levels: &[Vec<Children>], parts: Vec<Aabb>) -> Vec<Vec<Aabb>> {
    let mut boxes = vec![parts];
    for level in levels.iter().rev() {
        let below = &boxes[boxes.len() - 1];
        let union =
            |children: &Children| below[children.range()].iter().copied().fold(Aabb::EMPTY, Aabb::union);
        boxes.push(level.iter().map(union).collect());
    }
    boxes.reverse();
    boxes.truncate(levels.len());
    boxes
}
