//! The area of the strips and cones that close a shell (lemma S6 of docs/solids.md).

use super::orientation::Joined;
use crate::bvh::Aabb;
use crate::rounding::gamma;
use glam::DVec3;

/// The roundings of an area: lengths, products and sums of many terms.
const AREA_ROUNDINGS: f64 = 4096.0;

/// The parts of strips and cones, by the surfaces that they join.
#[derive(Debug, Default)]
pub(super) struct Cracks {
    /// Upper bounds on the area of a strip and on the mean length of its two edges.
    pub(super) strips: Vec<(usize, [f64; 2])>,
    /// Upper bounds on the area of the cones of a corner, and on the length of their edges.
    corners: Vec<(Vec<usize>, [f64; 2])>,
}

impl Cracks {
    /// Adds the cones over the segments between the points of a corner, of which these surfaces have the edges.
    pub(super) fn add_corner(&mut self, points: &[DVec3], surfaces: Vec<usize>) {
        let extent = points.iter().copied().fold(Aabb::EMPTY, Aabb::with).diagonal();
        let length = extent * points.len() as f64;
        self.corners.push((surfaces, [0.5 * extent * length, length]));
    }

    /// Adds the areas to those of the shells; each edge is known up to `rounding`.
    pub(super) fn added_to(self, joined: &mut Joined, rounding: f64) {
        let Joined { shells, of_shell, .. } = joined;
        let mut add = |shell: u32, [area, length]: [f64; 2]| {
            let more = (area + 2.0 * rounding * length) * (1.0 + gamma(AREA_ROUNDINGS));
            of_shell[shell as usize].cracks += more;
        };
        for (surface, sizes) in self.strips {
            add(shells[surface], sizes);
        }
        for (surfaces, sizes) in self.corners {
            let mut of_corner: Vec<u32> = surfaces.into_iter().map(|surface| shells[surface]).collect();
            of_corner.sort_unstable();
            of_corner.dedup();
            of_corner.into_iter().for_each(|shell| add(shell, sizes));
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::joining::orientation::Orientations;

    /// Returns the area that two surfaces of two shells get.
    fn areas(cracks: Cracks, rounding: f64) -> [f64; 2] {
        let mut joined = Orientations::separate(2).shells();
        cracks.added_to(&mut joined, rounding);
        [0, 1].map(|surface: usize| joined.of_shell[joined.shells[surface] as usize].cracks)
    }

    /// Lemma S6, attained: two edges that are the same but for rounding, each off by as much to another side, have a
    /// strip between them that is twice as wide.
    #[test]
    fn the_rounding_of_both_edges_widens_a_strip() {
        let (rounding, length) = (1e-3, 5.0);
        let [found, other] =
            areas(Cracks { strips: vec![(0, [0.25, length])], corners: Vec::new() }, rounding);
        let exact = 0.25 + 2.0 * rounding * length;
        assert!(found >= exact && found < exact + 1e-9 && other == 0.0, "{found} {other}");
    }

    /// The cone from one corner of an equilateral triangle over its sides is the triangle.
    #[test]
    fn the_cones_of_a_corner_have_at_least_the_area_of_its_triangle() {
        let points = [DVec3::X, DVec3::Y, DVec3::Z];
        let mut cracks = Cracks::default();
        cracks.add_corner(&points, vec![1, 1]);
        let [other, found] = areas(cracks, 0.0);
        let side = 2.0_f64.sqrt();
        assert!(
            found >= 3.0_f64.sqrt() / 4.0 * side * side && found < 10.0 && other == 0.0,
            "{found} {other}"
        );
    }
}
