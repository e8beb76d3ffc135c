//! Groups of points that lie close together.

use glam::DVec3;
use std::collections::HashMap;

/// The side of a cell of points as a multiple of the distance up to which they are joined. The neighbours of most points
/// then lie in one cell. With a side of one distance they could lie in 27 cells.
const CELL_SIDE: f64 = 4.0;

/// Points in groups: those of a chain whose links are at most a given length.
#[derive(Debug)]
pub(crate) struct Clusters {
    parents: Vec<u32>,
}

impl Clusters {
    /// Makes `count` groups of one element each.
    pub(crate) fn separate(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// Makes one group of those of points, each with its number, that are within a distance of each other. O(n) in general
    /// position.
    pub(super) fn join_near(&mut self, points: &[(u32, DVec3)], reach: f64) {
        let cell_of = |point: DVec3| {
            (point / (CELL_SIDE * reach)).floor().to_array().map(|coordinate| coordinate as i64)
        };
        // The last point of each cell, and of each point the one before it in its cell.
        let mut last: HashMap<[i64; 3], usize> = HashMap::with_capacity(points.len());
        let mut before: Vec<Option<usize>> = Vec::with_capacity(points.len());
        for (index, &(number, point)) in points.iter().enumerate() {
            let [low, high] = [-reach, reach].map(|offset| cell_of(point + offset));
            let cells = (low[0]..=high[0]).flat_map(|x| {
                (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z]))
            });
            for cell in cells {
                let mut next = last.get(&cell).copied();
                while let Some(other) = next {
                    let (other_number, at) = points[other];
                    if at.distance_squared(point) <= reach * reach {
                        self.join(number, other_number);
                    }
                    next = before[other];
                }
            }
            before.push(last.insert(cell_of(point), index));
        }
    }

    /// Returns the number of a point's group, the same for all its points.
    pub(crate) fn of(&mut self, index: u32) -> u32 {
        let mut root = index;
        while self.parents[root as usize] != root {
            let parent = self.parents[root as usize];
            self.parents[root as usize] = self.parents[parent as usize];
            root = parent;
        }
        root
    }

    /// Makes one group of two.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let [a, b] = [self.of(a), self.of(b)];
        self.parents[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn points_are_grouped_by_chains_of_short_links() {
        let at = |x: f64| DVec3::new(x, 1e3, -7.0);
        let points: Vec<(u32, DVec3)> = (0..).zip([0.0, 3.0, 0.9, 1.8, 4.1].map(at)).collect();
        let mut clusters = Clusters::separate(points.len());
        clusters.join_near(&points, 1.0);
        let groups: Vec<u32> = (0..5).map(|index| clusters.of(index)).collect();
        assert_eq!(groups, [0, 1, 0, 0, 4]);
        // Groups that are made are kept.
        clusters.join_near(&points[1..3], 2.5);
        assert_eq!((0..5).map(|index| clusters.of(index)).collect::<Vec<_>>(), [0, 0, 0, 0, 4]);
    }
}
