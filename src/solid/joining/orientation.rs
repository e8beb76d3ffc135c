//! Surfaces that joined edges connect, and the sides to which they turn.

use std::collections::HashMap;

/// The surfaces of a model in shells: sets that joined edges connect.
#[derive(Debug, Default)]
pub(crate) struct Joined {
    /// The number of the shell of each surface, from 0 in the order of their first surfaces.
    pub(crate) shells: Vec<u32>,
    /// Whether a surface is to be turned over so that it agrees with the first one of its shell.
    pub(crate) turned: Vec<bool>,
    /// What is known of each shell.
    pub(crate) of_shell: Vec<ShellState>,
}

/// What is known of the surfaces of a shell together.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ShellState {
    /// Whether no choice of sides agrees at all joined edges; or none agrees with the source, and there was a choice of
    /// edges to join.
    pub(crate) is_one_sided: bool,
    /// Whether the source turns its first surface over, where the surfaces of the shell agree as the source turns them;
    /// none where they do not.
    pub(crate) of_source: Option<bool>,
    /// The number of its edges without a partner.
    pub(crate) free: usize,
    /// An upper bound on the area of the strips and cones that close it (lemma S6 of docs/solids.md).
    pub(crate) cracks: f64,
}

/// Groups of surfaces with, for each, whether it turns to the other side than the first of its group.
#[derive(Debug)]
pub(super) struct Orientations {
    parents: Vec<u32>,
    /// Whether each surface turns to the other side than its parent.
    turned: Vec<bool>,
    /// Whether the group of each root has a contradiction.
    one_sided: Vec<bool>,
    /// Whether edges of the group of each root were joined that others are as near to.
    branched: Vec<bool>,
    /// Whether the source turns a surface over, for each.
    reversed: Vec<bool>,
}

impl Orientations {
    /// Makes `count` groups of one surface each.
    pub(super) fn separate(count: usize) -> Self {
        let parents = (0..count as u32).collect();
        let [turned, one_sided, branched, reversed] = [0; 4].map(|_| vec![false; count]);
        Self { parents, turned, one_sided, branched, reversed }
    }

    /// The same of surfaces that the source turns over, or not.
    pub(super) fn of_source(mut self, reversed: Vec<bool>) -> Self {
        self.reversed = reversed;
        self
    }

    /// Returns whether the source turns over one of two surfaces and not the other.
    pub(super) fn differ_in_source(&self, a: usize, b: usize) -> bool {
        self.is_reversed(a) != self.is_reversed(b)
    }

    fn is_reversed(&self, surface: usize) -> bool {
        self.reversed.get(surface).is_some_and(|&reversed| reversed)
    }

    /// States that there was a choice of edges to join, in the group of a surface.
    pub(super) fn branch(&mut self, surface: u32) {
        let (root, _) = self.of(surface);
        self.branched[root as usize] = true;
    }

    /// Makes one group of those of two surfaces, of which the second one is to be turned over where
    /// `is_turned`. A second statement on two surfaces that contradicts the first makes the group one-sided.
    pub(super) fn join(&mut self, a: u32, b: u32, is_turned: bool) {
        let [(of_a, a_turned), (of_b, b_turned)] = [a, b].map(|surface| self.of(surface));
        let turned = a_turned ^ b_turned ^ is_turned;
        if of_a == of_b {
            self.one_sided[of_a as usize] |= turned;
            return;
        }
        let [root, child] = [of_a.min(of_b), of_a.max(of_b)].map(|group| group as usize);
        self.parents[child] = root as u32;
        self.turned[child] = turned;
        self.one_sided[root] |= self.one_sided[child];
        self.branched[root] |= self.branched[child];
    }

    /// Makes one group of those of two surfaces whose sides are not known of each other, if they are in two.
    pub(super) fn connect(&mut self, a: u32, b: u32) {
        if self.turned(a, b).is_none() {
            self.join(a, b, false);
        }
    }

    /// Returns whether the second surface is to be turned over to agree with the first one, if they are of
    /// one group.
    pub(super) fn turned(&mut self, a: u32, b: u32) -> Option<bool> {
        let [(of_a, a_turned), (of_b, b_turned)] = [a, b].map(|surface| self.of(surface));
        (of_a == of_b).then_some(a_turned ^ b_turned)
    }

    /// Returns the first surface of the group, and whether this one is turned against it.
    fn of(&mut self, surface: u32) -> (u32, bool) {
        let (mut root, mut turned) = (surface as usize, false);
        while self.parents[root] as usize != root {
            turned ^= self.turned[root];
            root = self.parents[root] as usize;
        }
        // All on the way are made children of the root.
        let (mut next, mut rest) = (surface as usize, turned);
        while next != root {
            let (parent, own) = (self.parents[next] as usize, self.turned[next]);
            (self.parents[next], self.turned[next]) = (root as u32, rest);
            rest ^= own;
            next = parent;
        }
        (root as u32, turned)
    }

    /// Returns the groups as shells, numbered in the order of their first surfaces.
    pub(super) fn shells(mut self) -> Joined {
        let mut numbers = HashMap::new();
        let mut joined = Joined::default();
        let mut agrees = vec![true; self.parents.len()];
        for surface in 0..self.parents.len() as u32 {
            let (root, turned) = self.of(surface);
            agrees[root as usize] &=
                (turned != self.is_reversed(surface as usize)) == self.is_reversed(root as usize);
        }
        for surface in 0..self.parents.len() as u32 {
            let (root, turned) = self.of(surface);
            let shell = *numbers.entry(root).or_insert(joined.of_shell.len() as u32);
            if shell as usize == joined.of_shell.len() {
                let (first, agrees) = (root as usize, agrees[root as usize]);
                joined.of_shell.push(ShellState {
                    is_one_sided: self.one_sided[first] || (self.branched[first] && !agrees),
                    of_source: agrees.then(|| self.is_reversed(first)),
                    ..ShellState::default()
                });
            }
            joined.shells.push(shell);
            joined.turned.push(turned);
        }
        joined
    }
}

impl Joined {
    /// Returns the triangles of a mesh that share edges exactly, by the neighbour of each along its edges
    /// from a corner to the next, or `none`; triangles with two equal corners have no edges. `branched` has the
    /// triangles of edges that more than two have. O(n).
    ///
    /// No edges are joined that only lie near each other, so that this takes meshes of any size.
    pub(crate) fn of_neighbours(
        triangles: &[[u32; 3]],
        neighbours: &[[u32; 3]],
        branched: &[u32],
        none: u32,
    ) -> Self {
        let mut orientations = Orientations::separate(triangles.len());
        let edge = |[a, b, c]: [u32; 3], place: usize| [[a, b], [b, c], [c, a]][place];
        for (triangle, others) in neighbours.iter().enumerate() {
            for (place, &other) in others.iter().enumerate() {
                if other == none || (other as usize) < triangle {
                    continue;
                }
                let own = edge(triangles[triangle], place);
                let is_back = |place: usize| neighbours[other as usize][place] == triangle as u32;
                let runs_alike =
                    (0..3).any(|place| is_back(place) && edge(triangles[other as usize], place) == own);
                orientations.join(triangle as u32, other, runs_alike);
            }
        }
        branched.iter().for_each(|&triangle| orientations.branch(triangle));
        let mut joined = orientations.shells();
        for (triangle, others) in neighbours.iter().enumerate() {
            let [a, b, c] = triangles[triangle];
            if a != b && b != c && c != a {
                let free = others.iter().filter(|&&other| other == none).count();
                joined.of_shell[joined.shells[triangle] as usize].free += free;
            }
        }
        joined
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn surfaces_turn_with_those_that_they_are_joined_to() {
        let mut orientations = Orientations::separate(6);
        for (a, b, is_turned) in [(4, 5, true), (3, 4, false), (0, 3, true), (2, 1, true)] {
            orientations.join(a, b, is_turned);
        }
        // A second statement that agrees.
        orientations.join(0, 5, false);
        let joined = orientations.shells();
        assert_eq!(joined.shells, [0, 1, 1, 0, 0, 0]);
        assert_eq!(joined.turned, [false, false, true, true, true, false]);
        assert!(joined.of_shell.iter().all(|shell| !shell.is_one_sided));
    }

    #[test]
    fn a_contradiction_makes_a_shell_one_sided() {
        let mut orientations = Orientations::separate(5);
        for (a, b, is_turned) in [(0, 1, false), (1, 2, false), (2, 0, true), (3, 4, true)] {
            orientations.join(a, b, is_turned);
        }
        let joined = orientations.shells();
        assert_eq!(joined.of_shell.iter().map(|shell| shell.is_one_sided).collect::<Vec<_>>(), [true, false]);
    }

    /// A tetrahedron whose last triangle is turned over, one without its last, and a triangle of two corners.
    #[test]
    fn triangles_are_joined_along_edges_of_the_same_vertices() {
        const NONE: u32 = u32::MAX;
        let triangles =
            [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 3, 0], [4, 6, 5], [4, 5, 7], [5, 6, 7], [4, 4, 5]];
        let neighbours =
            [[3, 2, 1], [0, 2, 3], [0, 3, 1], [2, 1, 0], [NONE, 6, 5], [4, 6, NONE], [4, NONE, 5], [NONE; 3]];
        let joined = Joined::of_neighbours(&triangles, &neighbours, &[], NONE);
        assert_eq!(joined.shells, [0, 0, 0, 0, 1, 1, 1, 2]);
        assert_eq!(joined.turned[..4], [false, false, false, true]);
        let free: Vec<usize> = joined.of_shell.iter().map(|shell| shell.free).collect();
        assert_eq!(free, [0, 3, 0]);
        assert!(joined.of_shell.iter().all(|shell| !shell.is_one_sided));
    }
}
