//! Patches that both solids have.

use crate::overlap::piece::{Patches, Whole};
use crate::rounding::upper_max;
use crate::sorting::sort_by_number;
use glam::DVec4;
use glam::Vec4Swizzles;

/// The largest distance of control points of patches that count as one, relative to the larger diagonal.
pub(super) const RELATIVE_REACH: f64 = 1e-11;

/// The largest relative difference of weights of patches that count as one.
const WEIGHT_REACH: f64 = 1e-11;

/// The patch of the other solid that a patch is equal to.
#[derive(Debug, Clone, Copy)]
pub(in crate::overlap) struct Partner {
    index: usize,
    /// An upper bound on the distance of their points at each parameter.
    pub(in crate::overlap) distance: f64,
}

/// The partner of each patch of both solids.
#[derive(Debug)]
pub(in crate::overlap) struct Partners([Vec<Option<Partner>>; 2]);

impl Partners {
    /// Returns the partner of a patch.
    pub(in crate::overlap) fn of(&self, solid: usize, index: usize) -> Option<Partner> {
        self.0[solid].get(index).copied().flatten()
    }

    /// Returns whether every patch has a partner.
    pub(super) fn are_all(&self) -> bool {
        self.0.iter().flatten().all(Option::is_some)
    }

    /// Keeps the pairs of which both patches are kept: lemma O2 states the sum of both.
    pub(super) fn retain(&mut self, patches: [&Patches; 2], is_kept: impl Fn(&Whole) -> bool) {
        let kept = patches.map(|patches| patches.faces().map(&is_kept).collect::<Vec<bool>>());
        for (solid, partners) in self.0.iter_mut().enumerate() {
            for (partner, &is_kept) in partners.iter_mut().zip(&kept[solid]) {
                *partner = partner.filter(|partner| is_kept && kept[1 - solid][partner.index]);
            }
        }
    }

    /// Adds to all distances.
    pub(super) fn add(&mut self, distance: f64) {
        self.0.iter_mut().flatten().flatten().for_each(|partner| partner.distance += distance);
    }
}

/// Pairs patches of which one is the other in parameters that run along the same or other edges, and which no third
/// patch is near to. O(n log n) in general position.
pub(super) fn shared(a: &Patches, b: &Patches, reach: f64) -> Partners {
    let mut order: Vec<usize> = (0..b.faces().count()).collect();
    let at = |index: usize| b.wholes[index].root.middle.x;
    sort_by_number(&mut order, |&index| at(index));
    let mut found: [Vec<Vec<(usize, f64)>>; 2] =
        [a, b].map(|patches| patches.faces().map(|_| Vec::new()).collect());
    for (index, whole) in a.faces().enumerate() {
        let middle = whole.root.middle;
        let first = order.partition_point(|&other| at(other) < middle.x - reach);
        for &other in order[first..].iter().take_while(|&&other| at(other) <= middle.x + reach) {
            let partner = &b.wholes[other];
            if partner.root.middle.distance(middle) > 2.0 * reach {
                continue;
            }
            if let Some(distance) = distance(whole, partner).filter(|&distance| distance <= reach) {
                found[0][index].push((other, distance));
                found[1][other].push((index, distance));
            }
        }
    }
    let only = |list: &Vec<(usize, f64)>| if let [one] = list[..] { Some(one) } else { None };
    let partners = [0, 1].map(|solid: usize| {
        let own = found[solid].iter().enumerate();
        let partner = |(index, list): (usize, &Vec<(usize, f64)>)| {
            let (other, distance) = only(list)?;
            let (back, _) = only(&found[1 - solid][other])?;
            (back == index).then_some(Partner { index: other, distance })
        };
        own.map(partner).collect()
    });
    Partners(partners)
}

/// Returns an upper bound on the distance of points of two patches at parameters that correspond, the least over the
/// ways in which edges may; `None` where degrees or weights differ.
fn distance(a: &Whole, b: &Whole) -> Option<f64> {
    let [p, q] = a.degree();
    let [rows, columns] = [p + 1, q + 1];
    let mut least: Option<f64> = None;
    for turn in 0..8_u32 {
        let is_transposed = turn & 4 != 0;
        if b.degree() != if is_transposed { [q, p] } else { [p, q] } {
            continue;
        }
        let place = |index: usize| {
            let (i, j) = (index / columns, index % columns);
            let i = if turn & 1 != 0 { p - i } else { i };
            let j = if turn & 2 != 0 { q - j } else { j };
            if is_transposed { j * rows + i } else { i * columns + j }
        };
        let found = distance_as(a, b, place);
        if let Some(found) = found.filter(|&found| least.is_none_or(|least| found < least)) {
            least = Some(found);
        }
    }
    least
}

/// Returns the bound where control point i of the first patch corresponds to `place(i)` of the second one: the largest
/// distance of control points, and what weights that differ by a factor of up to 1 + d add, 2 d times the diameter.
fn distance_as(a: &Whole, b: &Whole, place: impl Fn(usize) -> usize) -> Option<f64> {
    let weight = |control: &DVec4| control.w;
    let scale = weight(&b.root.controls[place(0)]) / weight(&a.root.controls[0]);
    let (mut distance, mut difference) = (0.0, 0.0);
    for (index, (point, control)) in a.root.points.iter().zip(&a.root.controls).enumerate() {
        let other = place(index);
        distance = upper_max(distance, point.distance(b.root.points[other]));
        let ratio = b.root.controls[other].xyzw().w / (scale * control.w);
        difference = upper_max(difference, (ratio - 1.0).abs());
    }
    // Four roundings of a ratio.
    let difference = difference + 4.0 * f64::EPSILON;
    (difference <= WEIGHT_REACH).then_some(distance + 4.0 * difference * a.root.radius)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::overlap::BoundarySide;
    use crate::shapes::sphere;
    use glam::DVec3;
    use std::cell::Cell;

    fn patches(model: &crate::model::Model) -> Patches {
        Patches::new(&extract(model).patches, std::iter::empty(), None, |_| BoundarySide::Outward)
    }

    /// A patch and it moved: all points have the distance of the motion.
    #[test]
    fn the_distance_of_a_patch_that_moved_is_that_of_the_motion() {
        let ball = sphere(DVec3::ZERO, 1.0).unwrap();
        let vector = DVec3::new(3e-9, -2e-9, 6e-9);
        let (a, b) = (patches(&ball), patches(&ball).moved_by(vector));
        for (one, other) in a.faces().zip(b.faces()) {
            let found = distance(one, other).unwrap();
            assert!((7e-9 * (1.0 - 1e-6)..7e-9 * (1.0 + 1e-5)).contains(&found), "{found}");
        }
    }

    /// One weight of a patch in another proportion moves points, and no more than is added for it: the middle of a
    /// quarter of a circle about its control point, which has the weight cos 45°.
    #[test]
    fn weights_in_other_proportions_count_in_the_distance() {
        let ball = sphere(DVec3::ZERO, 1.0).unwrap();
        let a = patches(&ball);
        let mut b = patches(&ball);
        let change = 8e-12;
        let mut found = 0.0_f64;
        for (one, other) in a.faces().zip(&mut b.wholes) {
            let [p, q] = one.degree();
            let place = (p / 2) * (q + 1) + q / 2;
            // The point stays where it is, and counts more.
            other.root.controls[place] *= 1.0 + change;
            let same = distance(one, one).unwrap();
            let bound = distance(one, other).unwrap();
            let share = |controls: &[DVec4]| {
                // Of the middle of the square.
                let basis =
                    |degree: usize, k: usize| crate::bezier::binomials(degree)[k] / (1_u64 << degree) as f64;
                let at = |(index, control): (usize, &DVec4)| {
                    basis(p, index / (q + 1)) * basis(q, index % (q + 1)) * *control
                };
                let sum: DVec4 = controls.iter().enumerate().map(at).sum();
                sum.xyz() / sum.w
            };
            let moved = share(&one.root.controls).distance(share(&other.root.controls));
            assert!(bound - same >= moved, "{bound} {moved}");
            found = found.max(moved);
        }
        assert!(found > 0.05 * change, "{found}");
    }

    /// Lemma O2 states the sum of two patches: one that counts half must not meet one that counts whole.
    #[test]
    fn a_pair_is_kept_only_if_both_of_its_patches_are() {
        let ball = extract(&sphere(DVec3::ZERO, 1.0).unwrap());
        let [a, b] =
            [0, 1].map(|_| Patches::new(&ball.patches, std::iter::empty(), None, |_| BoundarySide::Outward));
        let count = a.faces().count();
        let mut partners = shared(&a, &b, 1e-11);
        assert!(count > 2 && partners.are_all());
        // The patches of A are asked first, so that the first question is about one of A alone.
        let asked = Cell::new(0);
        partners.retain([&a, &b], |_| asked.replace(asked.get() + 1) != 0);
        for solid in [0, 1] {
            let kept = (0..count).filter(|&index| partners.of(solid, index).is_some()).count();
            assert_eq!(kept, count - 1, "solid {solid}");
        }
    }
}
