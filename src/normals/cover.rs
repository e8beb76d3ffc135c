//! Parts within the threshold of whole faces, and beyond it, with audits: lemmas N5 and N6 of docs/score.md.

use super::comparison::Own;
use super::target::Node;
use super::{DISTANCE_ROUNDINGS, Likenesses, Region};
use crate::rounding::gamma;

impl Likenesses<'_> {
    /// Returns whether all points of a part are within the threshold of a part of a patch, by the quadrilateral that the
    /// latter covers, and the audit does not refute it. O(p q), and the audit's some steps of Newton's method.
    pub(super) fn is_covered(&self, own: &Own<'_>, node: &Node) -> bool {
        self.covers(node, own.region) && !self.is_refuted(own, node)
    }

    /// Lemma N5 alone.
    fn covers(&self, node: &Node, region: &Region) -> bool {
        let Some(quad) = self.target.quad(node) else { return false };
        let left = self.reach.certain() - quad.off();
        left > 0.0 && self.are_within(region, left, |point| quad.distance_squared(point))
    }

    /// The audit: returns whether at a corner or in the middle of the part no point of the other one is found within the
    /// threshold. Both are evaluated by their formulas; no quadrilateral and no control point of a part is used.
    fn is_refuted(&self, own: &Own<'_>, node: &Node) -> bool {
        let most = self.reach.beyond(self.reach.threshold());
        let is_near =
            |point| self.target.near_point(node, point).is_some_and(|near| near.distance(point) <= most);
        // Not "is any far", so that NaN refutes.
        !own.formula.points().into_iter().all(is_near)
    }

    /// Returns whether no point of a part is within the threshold of a part of a patch (lemma N6), and no point of that is
    /// found nearer to the middle of the first one than the lemma says. O(p q), and some steps of Newton's method.
    pub(super) fn is_apart(&self, region: &Region, node: &Node) -> bool {
        let Some(least) = self.least_distance(region, node) else { return false };
        let is_refuted = || {
            let near = self.target.near_point(node, region.middle);
            // Not "is nearer", so that NaN refutes.
            !near.is_some_and(|near| self.reach.beyond(near.distance(region.middle)) >= least)
        };
        least - region.radius > self.reach.beyond(self.reach.threshold()) && !is_refuted()
    }

    /// Returns a lower bound on the distance of a part of a patch from the middle of another part, but for rounding of
    /// points.
    fn least_distance(&self, region: &Region, node: &Node) -> Option<f64> {
        let quad = self.target.quad(node)?;
        let distance = quad.distance_squared(region.middle).sqrt();
        Some(distance * (1.0 - gamma(DISTANCE_ROUNDINGS)) - quad.off())
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::{Patch, PatchSet};
    use crate::closest::Target;
    use crate::normals::beside::tests::Points;
    use crate::normals::quad::Quad;
    use crate::normals::{NormalCone, NormalTarget, Reach};
    use glam::DVec3;
    use std::sync::OnceLock;

    /// A square of side 1/256 about a point, across z.
    fn tile(middle: DVec3) -> Vec<DVec3> {
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]]
            .map(|[x, y]| middle + DVec3::new(x, y, 0.0) / 512.0)
            .to_vec()
    }

    /// Calls with the first patch of a target of one patch, given by its rows of control points, and with a tile.
    fn of_pair<T>(
        degree: [usize; 2],
        controls: &[DVec3],
        middle: DVec3,
        threshold: f64,
        ask: impl FnOnce(&Likenesses<'_>, &Own<'_>, &mut Node) -> T,
    ) -> T {
        let controls: Vec<_> = controls.iter().map(|point| point.extend(1.0)).collect();
        let mut patches = PatchSet::default();
        patches.push(Patch::whole(degree, DVec3::ZERO, &controls));
        let target = Target::new(patches);
        let mut target = NormalTarget::of_patches(&target);
        let _ = target.root(0);
        let NormalTarget::Patches { roots, .. } = &mut target else { unreachable!() };
        let mut root = roots[0].take().unwrap();
        let likenesses = Likenesses::new(&target, Reach::new(threshold, [0.0, 0.0]), 0.1);
        let points = tile(middle);
        let cone = NormalCone::of_triangle([points[0], points[1], points[2]], 0.0).unwrap();
        let region = Region::of_points(points.clone());
        ask(
            &likenesses,
            &Own { region: &region, cone: &cone, formula: &Points(points.clone(), None) },
            &mut root,
        )
    }

    /// The rows of an arch of degree 8.
    fn arch() -> Vec<DVec3> {
        let row = |i: usize| {
            let height = if i == 0 || i == 8 { 0.0 } else { 1.0 };
            [0.0, 4.0].map(|y| DVec3::new(i as f64, y, height))
        };
        (0..=8).flat_map(row).collect()
    }

    /// An arch of degree 8 has its corners at the height 0, its inner control points at 1 and its middle at 127/128. A tile
    /// at −1 is at 1 + 127/128 from the middle. The lemma's bound is 2, the distance 1 from the quadrilateral and the bend
    /// 1, so that it is attained up to 1/128.
    #[test]
    fn the_bend_of_a_part_is_taken_off_the_threshold() {
        let arch = arch();
        let middle = DVec3::new(4.0, 2.0, -1.0);
        let asked = |threshold| {
            of_pair([8, 1], &arch, middle, threshold, |likenesses, own, root| {
                [likenesses.covers(root, own.region), likenesses.is_refuted(own, root)]
            })
        };
        assert_eq!(asked(1.99), [false, true], "the nearest point is at 1.9921");
        assert_eq!(asked(1.995), [false, false]);
        assert_eq!(asked(2.0 + 1e-5), [true, false]);
    }

    /// Above the same arch, whose middle is at 127/128: from a point at the height z the lemma's distance is z − 1, which is
    /// attained up to 1/128, and the tile is within 0.0028 of it.
    #[test]
    fn the_bend_of_a_part_is_taken_off_its_distance() {
        let asked = |height| {
            of_pair([8, 1], &arch(), DVec3::new(4.0, 2.0, height), 1.0, |likenesses, own, root| {
                [
                    likenesses.least_distance(own.region, root).unwrap(),
                    f64::from(likenesses.is_apart(own.region, root)),
                ]
            })
        };
        for (height, is_apart) in [(1.9, 0.0), (2.002, 0.0), (2.0029, 1.0), (5.0, 1.0)] {
            let [least, found] = asked(height);
            assert!((least - (height - 1.0)).abs() < 1e-12 && found == is_apart, "{height} {least} {found}");
        }
    }

    /// The quadrilateral of another place: the lemma's numbers say that it covers, and the audit that it does not.
    #[test]
    fn an_audit_refutes_the_quadrilateral_of_another_part() {
        let square =
            |at: DVec3| [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::X + DVec3::Y].map(|corner| at + corner);
        let asked = |middle: DVec3, at: DVec3| {
            of_pair([1, 1], &square(DVec3::ZERO), middle, 1.0, |likenesses, own, root| {
                root.quad = OnceLock::from(Quad::of(&square(at), [1, 1]));
                [likenesses.covers(root, own.region), likenesses.is_covered(own, root)]
            })
        };
        let above = DVec3::new(0.5, 0.5, 0.75);
        assert_eq!(asked(above, DVec3::ZERO), [true, true]);
        for shift in [DVec3::X * 3.0, DVec3::Z * 2.0] {
            assert_eq!(asked(above + shift, shift), [true, false], "{shift}");
        }
        let is_apart = |at: DVec3| {
            of_pair([1, 1], &square(DVec3::ZERO), above, 0.5, |likenesses, own, root| {
                root.quad = OnceLock::from(Quad::of(&square(at), [1, 1]));
                likenesses.is_apart(own.region, root)
            })
        };
        assert_eq!([DVec3::ZERO, -DVec3::Z].map(is_apart), [true, false]);
        let nowhere = |threshold| {
            of_pair([1, 1], &square(DVec3::ZERO), above, threshold, |likenesses, own, root| {
                let nan = Points(vec![DVec3::NAN], None);
                likenesses.is_covered(&Own { formula: &nan, ..*own }, root)
            })
        };
        assert!(!nowhere(1.0));
    }
}
