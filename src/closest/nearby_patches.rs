//! The patches that can be nearest to points about one point.

use super::{Target, nearest_control, newton};
use crate::bvh::Aabb;
use glam::DVec3;

/// Newton steps from a start; the bounds hold wherever it stops.
const ITERATIONS: u32 = 16;

/// A patch near the centre.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Candidate {
    pub(crate) patch: u32,
    /// A point of it near the centre, (s, t).
    pub(crate) parameters: [f64; 2],
    /// At most the patch's distance to the centre.
    pub(crate) least: f64,
    /// A box around the patch.
    pub(crate) aabb: Aabb,
}

/// All patches that may be nearer to a centre than `reach`, with bounds.
///
/// Lemma. From a point x, a listed patch is at least its bound less `|x - c|`
/// away, and every other patch `reach - |x - c|`.
///
/// Proof. The distance to a set changes by no more than the point moves,
/// `d(x, P) >= d(c, P) - |x - c|`; the bounds of d(c, P) are the boxes'. ∎
#[derive(Debug)]
pub(crate) struct Candidates {
    pub(crate) center: DVec3,
    pub(crate) reach: f64,
    /// By rising bounds.
    pub(crate) list: Vec<Candidate>,
}

impl Candidates {
    /// How much farther than the nearest patch the nearest unlisted one is, by its bound.
    pub(crate) fn room(&self) -> f64 {
        self.list.first().map_or(0.0, |nearest| self.reach - nearest.least)
    }

    /// At most the squared distance from `point` to a listed patch.
    ///
    /// Also by the box around the patch: with `δ = x - c`,
    /// `|y - x|² = |y - c|² - 2 δ·(y - c) + |δ|²` for its points y.
    pub(crate) fn least_squared(&self, candidate: &Candidate, point: DVec3) -> f64 {
        let step = point - self.center;
        let [low, high] = [candidate.aabb.min - self.center, candidate.aabb.max - self.center];
        let along = (step * low).max(step * high).element_sum();
        candidate.least * candidate.least - 2.0 * along + step.length_squared()
    }

    /// Of all patches about `center`. O(p q) for each whose boxes are within reach.
    pub(crate) fn new(target: &Target, center: DVec3, reach: f64) -> Self {
        let Target { patches, tree, boxes } = target;
        let reach_squared = reach * reach;
        let mut list = Vec::new();
        for leaf in tree.leaves_within(center, reach_squared) {
            let (index, aabb) = (tree.item(&leaf), leaf.aabb);
            let of_box = boxes[index as usize].min_distance_squared(center);
            let least = of_box.max(aabb.min_distance_squared(center));
            if least < reach_squared {
                let patch = patches.patch(index as usize);
                let foot = newton(&patch, center, nearest_control(&patch, center), ITERATIONS);
                let parameters = foot.parameters;
                list.push(Candidate { patch: index, parameters, least: least.sqrt(), aabb });
            }
        }
        list.sort_by(|a, b| a.least.total_cmp(&b.least));
        Self { center, reach, list }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::{closest, closest_above};
    use super::Candidates;
    use crate::bezier::extract;
    use crate::closest::Target;
    use crate::shapes::shape;
    use glam::DVec3;

    const SIDE: usize = 24;

    /// Points on a grid of each patch tell the least distance that it may have at most.
    #[test]
    fn bounds_hold_for_points_about_the_centre() {
        let random = &mut fastrand::Rng::with_seed(17);
        let mut direction = || DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
        let (mut listed, mut unlisted, mut used) = (0, 0, 0);
        for name in ["bottle", "torus", "wavy-sheet"] {
            let Ok(model) = shape(name) else { unreachable!() };
            let target = Target::new(extract(&model).patches);
            let Target { patches, tree, .. } = &target;
            let box_ = tree.nodes()[0].aabb;
            for _ in 0..10 {
                let center = box_.center() + 0.5 * box_.extent() * direction();
                let Some(nearest) = closest(&target, center, 1e-9) else { unreachable!() };
                let reach = nearest.upper + 0.1 * box_.diagonal();
                let about = Candidates::new(&target, center, reach);
                let point = center + 0.03 * box_.diagonal() * direction();
                let moved = point.distance(center);
                for index in 0..patches.len() {
                    let patch = patches.patch(index);
                    let grid = (0..SIDE * SIDE).map(|k| [k / SIDE, k % SIDE]);
                    let place = |k: usize| k as f64 / (SIDE - 1) as f64;
                    let sampled = grid
                        .map(|at| patch.point(at.map(place)).distance(point))
                        .fold(f64::INFINITY, f64::min);
                    let candidate = about.list.iter().find(|candidate| candidate.patch as usize == index);
                    let least = candidate.map_or(about.reach, |candidate| candidate.least) - moved;
                    assert!(least <= sampled + 1e-12, "{name}: patch {index}");
                    *(if candidate.is_some() { &mut listed } else { &mut unlisted }) += 1;
                }
                assert!(about.list.is_sorted_by_key(|candidate| candidate.least.to_bits()));
                let by_tree = closest(&target, point, 1e-9);
                let known = Some((nearest.patch as u32, nearest.parameters));
                let by_list = closest_above(&target, point, 1e-9, known, 0.0, Some(&about));
                let (Some(by_tree), Some(by_list)) = (by_tree, by_list) else { unreachable!() };
                assert!(by_list.lower <= by_tree.upper && by_tree.lower <= by_list.upper);
                assert!(by_list.upper - by_list.lower < 2e-9);
                let at_known = patches.patch(nearest.patch).point(nearest.parameters).distance(point);
                used += usize::from(at_known <= reach - moved);
            }
        }
        assert!(listed > 30 && unlisted > 30 && used > 10, "{listed} {unlisted} {used}");
    }
}
