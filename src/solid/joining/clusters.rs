//! Groups of points that lie close together.

use glam::DVec3;
use std::collections::HashMap;

/// Points in groups: those of a chain whose links are at most a given length.
#[derive(Debug)]
pub(super) struct Clusters {
    parents: Vec<u32>,
}

impl Clusters {
    /// Groups the points. O(n) in general position.
    pub(super) fn new(points: &[DVec3], reach: f64) -> Self {
        let mut clusters = Self::separate(points.len());
        let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
        for (index, &point) in points.iter().enumerate() {
            let cell = (point / reach).floor().to_array().map(|coordinate| coordinate as i64);
            for neighbour in 0..27_i64 {
                let offset = [neighbour % 3, neighbour / 3 % 3, neighbour / 9];
                let key = [0, 1, 2].map(|axis| cell[axis].saturating_add(offset[axis] - 1));
                for &other in cells.get(&key).map_or(&[][..], Vec::as_slice) {
                    if points[other as usize].distance_squared(point) <= reach * reach {
                        clusters.join(index as u32, other);
                    }
                }
            }
            cells.entry(cell).or_default().push(index as u32);
        }
        clusters
    }

    /// Makes `count` groups of one element each.
    pub(super) fn separate(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// Returns the number of a point's group, the same for all its points.
    pub(super) fn of(&mut self, index: u32) -> u32 {
        let mut root = index;
        while self.parents[root as usize] != root {
            let parent = self.parents[root as usize];
            self.parents[root as usize] = self.parents[parent as usize];
            root = parent;
        }
        root
    }

    /// Makes one group of two.
    pub(super) fn join(&mut self, a: u32, b: u32) {
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
        let mut clusters = Clusters::new(&[at(0.0), at(3.0), at(0.9), at(1.8), at(4.1)], 1.0);
        let groups: Vec<u32> = (0..5).map(|index| clusters.of(index)).collect();
        assert_eq!(groups, [0, 1, 0, 0, 4]);
    }
}
