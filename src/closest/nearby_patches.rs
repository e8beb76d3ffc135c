//! The patches that can be nearest to points in a neighbourhood.

use super::Target;
use crate::bvh::Aabb;
use crate::sorting::sort_by_number;
use glam::DVec3;

/// A patch near the centre of a [`NearbyPatches`].
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearbyPatch {
    /// The index of the patch.
    pub(crate) patch: u32,
    /// A lower bound on the distance from the centre to the patch.
    pub(crate) lower_bound: f64,
    /// A box around the patch.
    pub(crate) aabb: Aabb,
}

/// All patches that may be nearer to a centre than `radius`, with lower bounds.
///
/// Lemma (shortlist, 5.3 of docs/method.md). From a point x, a listed patch has at least the distance of its lower
/// bound less `|x - c|`, and every other patch at least `radius - |x - c|`.
#[derive(Debug)]
pub(crate) struct NearbyPatches {
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
    /// The patches by rising lower bound.
    pub(crate) list: Vec<NearbyPatch>,
}

impl NearbyPatches {
    /// Lists the patches near `center`. O(nodes of the tree that are within `radius`).
    pub(crate) fn new(target: &Target, center: DVec3, radius: f64) -> Self {
        let tree = &target.tree;
        let radius_squared = radius * radius;
        let mut list = Vec::new();
        for leaf in tree.leaves_within(center, radius_squared) {
            let (index, aabb) = (tree.primitive(&leaf), leaf.aabb);
            let lower_squared = target.distance_squared_to_boxes(index, &aabb, center);
            if lower_squared < radius_squared {
                list.push(NearbyPatch { patch: index, lower_bound: lower_squared.sqrt(), aabb });
            }
        }
        sort_by_number(&mut list, |patch| patch.lower_bound);
        Self { center, radius, list }
    }

    /// Returns the difference between the radius and the smallest lower bound of a listed patch.
    pub(crate) fn margin(&self) -> f64 {
        self.list.first().map_or(0.0, |nearest| self.radius - nearest.lower_bound)
    }

    /// Returns a lower bound on the squared distance from `point` to a listed patch.
    ///
    /// It uses the box around the patch as well: with `δ = x - c`,
    /// `|y - x|² = |y - c|² - 2 δ·(y - c) + |δ|²` for its points y.
    pub(crate) fn lower_bound_squared(&self, candidate: &NearbyPatch, point: DVec3) -> f64 {
        let step = point - self.center;
        let [low, high] = [candidate.aabb.min - self.center, candidate.aabb.max - self.center];
        let along = (step * low).max(step * high).element_sum();
        candidate.lower_bound * candidate.lower_bound - 2.0 * along + step.length_squared()
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::{closest, closest_above};
    use super::NearbyPatches;
    use crate::bezier::extract;
    use crate::closest::Target;
    use crate::closest::branch_and_bound::tests::two_squares;
    use crate::rounding::UNIT_ROUNDOFF;
    use crate::shapes::shape;
    use crate::{Model, SurfaceArrays};
    use glam::DQuat;
    use glam::DVec3;

    const SIDE: usize = 24;

    /// A query beyond the reach of the list, from an incumbent on a listed patch, finds the
    /// patch that is not listed.
    #[test]
    fn the_list_is_used_only_within_its_reach() {
        let target = two_squares();
        let nearby = NearbyPatches::new(&target, DVec3::ZERO, 3.0);
        assert_eq!(nearby.list.len(), 1);
        let incumbent = Some((nearby.list[0].patch, [0.5, 0.5]));
        for (height, distance) in [(0.1, 2.85), (0.5, 2.75), (1.25, 2.0), (3.0, 0.25)] {
            let point = DVec3::new(0.0, 0.0, height);
            let found = closest_above(&target, point, 1e-9, incumbent, 0.0, Some(&nearby));
            assert!(found.is_some_and(|found| (found.upper - distance).abs() < 1e-9), "{height}");
        }
    }

    /// Lemma R12: the lower bound loses 160 roundings of the largest length, of the point as well as
    /// of the model.
    #[test]
    fn the_lower_bound_loses_its_rounding() {
        let square = |z: f64| SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]]
                .map(|[x, y]| [x, y, z, 1.0])
                .to_vec(),
        };
        for (z, height) in [(0.0, 1e6), (1e6, 0.0)] {
            let Ok(model) = Model::from_arrays(None, vec![square(z)]) else { unreachable!() };
            let target = Target::new(extract(&model).patches);
            let Some(found) = closest(&target, DVec3::new(0.5, 0.5, height), 0.0) else { unreachable!() };
            assert_eq!(found.upper, 1e6);
            assert!(found.upper - found.lower >= 160.0 * UNIT_ROUNDOFF * 1e6, "{found:?}");
        }
        // A wide gap ends the search at the incumbent, a corner: the distance is 1.
        let Ok(model) = Model::from_arrays(None, vec![square(0.0)]) else { unreachable!() };
        let target = Target::new(extract(&model).patches);
        let found = closest_above(&target, DVec3::new(0.5, 0.5, 1.0), 0.5, Some((0, [0.0; 2])), 0.0, None);
        assert!(found.is_some_and(|found| found.lower <= 1.0 && found.upper > 1.2), "{found:?}");
    }

    /// The plane through the incumbent gives a lower bound of 0.1875 on the distance to a
    /// parabola, by its control points: within the gap of the upper bound, 0.25, so that the search
    /// ends with it. The parabola's end is 0.194 away. Its boxes give less, as it is askew to them.
    #[test]
    fn a_patch_behind_a_plane_lowers_the_bound() {
        let turn = DQuat::from_rotation_y(0.7);
        let extruded = |profile: &[[f64; 2]]| {
            let points = profile.iter().flat_map(|&[x, z]| [-1.0, 1.0].map(|y| DVec3::new(x, y, z)));
            let degree = profile.len() - 1;
            let knots = [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat();
            SurfaceArrays {
                degree: [degree, 1],
                knots: [knots, vec![0.0, 0.0, 1.0, 1.0]],
                counts: [degree + 1, 2],
                control_points: points.map(|point| (turn * point).extend(1.0).to_array()).collect(),
            }
        };
        let incumbent = extruded(&[[-0.5, 0.25], [0.5, 0.25]]);
        let askew = extruded(&[[-1.0, 3.0], [-0.3, 0.1875], [0.05, 0.1875]]);
        let Ok(model) = Model::from_arrays(None, vec![incumbent, askew]) else { unreachable!() };
        let target = Target::new(extract(&model).patches);
        let known = Some((0, [0.5; 2]));
        let Some(found) = closest_above(&target, DVec3::ZERO, 0.07, known, 0.0, None) else { unreachable!() };
        assert!((found.upper - 0.25).abs() < 1e-12, "{found:?}");
        assert!((found.lower - 0.1875).abs() < 1e-12, "{found:?}");
    }

    /// The nearest of a grid of points on a patch is an upper bound on the patch's distance.
    #[test]
    fn bounds_hold_for_points_about_the_centre() {
        let random = &mut fastrand::Rng::with_seed(17);
        let mut direction = || DVec3::from_array([0; 3].map(|_| 2.0 * random.f64() - 1.0));
        let (mut listed, mut unlisted, mut used) = (0, 0, 0);
        for name in ["bottle", "torus", "wavy-sheet"] {
            let Ok(model) = shape(name) else { unreachable!() };
            let target = Target::new(extract(&model).patches);
            let Target { patches, tree, .. } = &target;
            let root = tree.nodes()[0].aabb;
            for _ in 0..10 {
                let center = root.center() + 0.5 * root.extent() * direction();
                let Some(nearest) = closest(&target, center, 1e-9) else { unreachable!() };
                let radius = nearest.upper + 0.1 * root.diagonal();
                let nearby = NearbyPatches::new(&target, center, radius);
                let point = center + 0.03 * root.diagonal() * direction();
                let moved = point.distance(center);
                for index in 0..patches.len() {
                    let patch = patches.patch(index);
                    let grid = (0..SIDE * SIDE).map(|k| [k / SIDE, k % SIDE]);
                    let parameter = |k: usize| k as f64 / (SIDE - 1) as f64;
                    let sampled = grid
                        .map(|at| patch.point(at.map(parameter)).distance(point))
                        .fold(f64::INFINITY, f64::min);
                    let candidate = nearby.list.iter().find(|candidate| candidate.patch as usize == index);
                    let lower_bound =
                        candidate.map_or(nearby.radius, |candidate| candidate.lower_bound) - moved;
                    assert!(lower_bound <= sampled + 1e-12, "{name}: patch {index}");
                    let squared = candidate.map(|candidate| nearby.lower_bound_squared(candidate, point));
                    assert!(squared.unwrap_or(0.0) <= sampled * sampled + 1e-12, "{name}: patch {index}");
                    *(if candidate.is_some() { &mut listed } else { &mut unlisted }) += 1;
                }
                assert!(nearby.list.is_sorted_by_key(|candidate| candidate.lower_bound.to_bits()));
                let by_tree = closest(&target, point, 1e-9);
                let known = Some((nearest.patch as u32, nearest.parameters));
                let by_list = closest_above(&target, point, 1e-9, known, 0.0, Some(&nearby));
                let (Some(by_tree), Some(by_list)) = (by_tree, by_list) else { unreachable!() };
                assert!(by_list.lower <= by_tree.upper && by_tree.lower <= by_list.upper);
                assert!(by_list.upper - by_list.lower < 2e-9);
                let at_known = patches.patch(nearest.patch).point(nearest.parameters).distance(point);
                used += usize::from(at_known <= radius - moved);
            }
        }
        assert!(listed > 30 && unlisted > 30 && used > 10, "{listed} {unlisted} {used}");
    }
}
