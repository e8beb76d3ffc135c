//! The closest point of a whole model by best-first branch and bound.

use super::separating_plane::distance_along;
use super::{CriticalPoint, Located, NearbyPatches, SquaredDistance, Target, nearest_control, newton};
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::{closest_rounding, lower_min};
use glam::{DVec3, DVec4};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The largest number of Newton steps from one start; on a flat patch about five suffice.
const MAX_ITERATIONS: u32 = 32;

/// The largest number of sub-patches examined. A few dozen suffice, and a few hundred
/// where the target point is equally near to a whole curve of points, unless rounding
/// keeps such points apart; then the interval stays wider than requested.
const MAX_SUB_PATCHES: usize = 4096;

/// A point of a model near a target point, with bounds on the distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// The index of its patch.
    pub patch: usize,
    /// Its parameters (s, t).
    pub parameters: [f64; 2],
    /// The point.
    pub point: DVec3,
    /// Its distance, an upper bound on the distance from the target point to the model.
    pub upper: f64,
    /// A lower bound on the distance from the target point to the model.
    pub lower: f64,
}

/// A set that may contain the closest point; small, as the heap moves it often.
enum Region {
    Node(u32),
    Patch(u32),
    /// A patch whose lower bound, by the plane through the incumbent or about the incumbent on it, is within the gap of
    /// the upper bound.
    SettledPatch(u32),
    /// A patch with its squared distance in Bernstein form.
    BoundedPatch(u32, Box<SquaredDistance>),
    SubPatch(Box<SubPatch>),
}

/// A part of a patch, with a foot on the patch: the nearest point found of this part or, as
/// long as none is known, of the part that it was cut from.
struct SubPatch {
    patch: u32,
    controls: Vec<DVec4>,
    range: ParamBox,
    /// Its squared distance.
    form: SquaredDistance,
    foot: CriticalPoint,
}

/// A region in the priority queue.
struct QueueEntry {
    /// A lower bound on the squared distance to the region.
    lower_bound: f64,
    region: Region,
}

impl PartialEq for QueueEntry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for QueueEntry {}
impl PartialOrd for QueueEntry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for QueueEntry {
    /// The entry with the smallest lower bound is the heap's largest. Among entries with equal bounds, a region
    /// whose foot was not looked for comes first: many parts of a narrow patch beside the point have the bound 0,
    /// and the nearest foot may be on another patch.
    fn cmp(&self, other: &Self) -> Ordering {
        let by_bound = other.lower_bound.total_cmp(&self.lower_bound);
        by_bound.then_with(|| other.region.has_foot().cmp(&self.region.has_foot()))
    }
}

impl Region {
    /// Whether a foot on its patch was looked for.
    fn has_foot(&self) -> bool {
        matches!(self, Self::SubPatch(_))
    }
}

/// Returns the closest point of `target` to `point`, or `None` for a target without patches.
///
/// Guarantee: `lower <= d(point, target) <= upper`, and `upper - lower <= gap`
/// up to rounding, unless the point is so evenly near to many points that
/// `MAX_SUB_PATCHES` do not separate them. The search is best first: it
/// examines boxes of the tree, then patches, bounded by their own boxes, by a plane and
/// by a `SquaredDistance`, then halves of patches, in the order of their lower
/// bounds. O(log patches) in general position.
#[must_use]
pub fn closest(target: &Target, point: DVec3, gap: f64) -> Option<Closest> {
    closest_above(target, point, gap, None, 0.0, None)
}

/// Returns the closest point as [`closest`] does, from an incumbent given by
/// patch and parameters, and ends early, whatever the gap, once the distance is
/// known to be at most `floor`.
///
/// Where the incumbent is nearer than any patch outside `nearby` can be, by the
/// lemma of [`NearbyPatches`], only the patches of `nearby` are examined.
pub(crate) fn closest_above(
    target: &Target,
    point: DVec3,
    gap: f64,
    incumbent: Option<(u32, [f64; 2])>,
    floor: f64,
    nearby: Option<&NearbyPatches>,
) -> Option<Closest> {
    let root = target.tree.nodes().first()?;
    let mut search = ClosestPointSearch::new(target, point, gap)?;
    if let Some((patch, parameters)) = incumbent {
        search.critical_point(patch, parameters);
    }
    let upper = search.upper();
    let moved = nearby.map_or(0.0, |nearby| nearby.center.distance(point));
    if let Some(nearby) = nearby.filter(|nearby| upper <= nearby.radius - moved) {
        for candidate in &nearby.list {
            let lower_bound = (candidate.lower_bound - moved).max(0.0);
            // The bounds rise along the list.
            if lower_bound >= upper {
                break;
            }
            if candidate.aabb.min_distance_squared(point) < upper * upper {
                let to_boxes = target.distance_squared_to_boxes(candidate.patch, &candidate.aabb, point);
                search.push((lower_bound * lower_bound).max(to_boxes), Region::Patch(candidate.patch));
            }
        }
    } else {
        search.push(root.aabb.min_distance_squared(point), Region::Node(0));
    }
    let lower = search.run(floor);
    search.closest(lower)
}

/// Returns the closest point as [`closest_above`] does, from a foot that is as near as all other patches but for the
/// gap: only the foot's own patch is examined. `None` if the bound on the others does not show that.
///
/// The distance to the model is the smaller one of those to the foot's patch and to the others, and so is its
/// lower bound.
pub(crate) fn closest_beside(target: &Target, point: DVec3, gap: f64, located: Located) -> Option<Closest> {
    let Located { patch, parameters, others, .. } = located;
    let mut search = ClosestPointSearch::new(target, point, gap)?;
    let foot = search.critical_point(patch, parameters);
    // A NaN shows nothing.
    if !(foot.distance_squared.sqrt() - search.gap <= others) {
        return None;
    }
    search.push(0.0, Region::Patch(patch));
    let lower = lower_min(search.run(0.0), others);
    search.closest(lower)
}

/// Returns the rounding of a lower bound on the distance from a point (lemma R12 of docs/rounding.md); `None` for a target
/// without patches.
pub(super) fn rounding(target: &Target, point: DVec3) -> Option<f64> {
    let root = target.tree.nodes().first()?;
    Some(closest_rounding(root.aabb.farthest_from_origin().max(point.length())))
}

/// The state of one search: its queue, and the nearest point found.
struct ClosestPointSearch<'a> {
    target: &'a Target,
    point: DVec3,
    gap: f64,
    /// The rounding of the lower bound (lemma R12 of docs/rounding.md).
    rounding: f64,
    queue: BinaryHeap<QueueEntry>,
    /// The nearest foot found, and its patch.
    incumbent: Option<(u32, CriticalPoint)>,
}

impl<'a> ClosestPointSearch<'a> {
    /// Returns a search with nothing to examine, or `None` for a target without patches.
    fn new(target: &'a Target, point: DVec3, gap: f64) -> Option<Self> {
        let rounding = rounding(target, point)?;
        // The lower bound loses the rounding in the end, so a smaller gap cannot be had.
        let gap = gap.max(rounding);
        Some(Self { target, point, gap, rounding, queue: BinaryHeap::new(), incumbent: None })
    }

    /// Examines regions until the rest is farther than the incumbent less the gap, and returns a lower bound on the
    /// distance to all that was queued, +∞ if nothing is left, but for rounding.
    fn run(&mut self, floor: f64) -> f64 {
        let mut sub_patches = 0;
        while let Some(QueueEntry { lower_bound, region }) = self.queue.pop() {
            let upper = self.upper();
            if lower_bound.sqrt() >= upper - self.gap || upper <= floor || sub_patches >= MAX_SUB_PATCHES {
                return lower_bound.sqrt();
            }
            match region {
                Region::Node(node) => self.expand_node(node as usize),
                Region::Patch(patch) => self.bound_patch(patch),
                Region::SettledPatch(patch) => self.bound_patch_by_distance(patch),
                Region::BoundedPatch(patch, form) => self.expand_patch(patch, *form),
                Region::SubPatch(sub_patch) => {
                    sub_patches += 1;
                    self.expand_sub_patch(*sub_patch, lower_bound);
                }
            }
        }
        f64::INFINITY
    }

    /// Returns the incumbent with a lower bound on the distance, from which the rounding is subtracted.
    fn closest(&self, least: f64) -> Option<Closest> {
        let (index, CriticalPoint { parameters, .. }) = self.incumbent?;
        let upper = self.upper();
        let lower = (least.min(upper) - self.rounding).max(0.0);
        let point = self.patch(index).point(parameters);
        Some(Closest { patch: index as usize, parameters, point, upper, lower })
    }

    fn patch(&self, index: u32) -> Patch<'a> {
        self.target.patches.patch(index as usize)
    }

    /// Returns the incumbent's squared distance, +∞ before there is one.
    fn upper_squared(&self) -> f64 {
        self.incumbent.map_or(f64::INFINITY, |(_, foot)| foot.distance_squared)
    }

    fn upper(&self) -> f64 {
        self.upper_squared().sqrt()
    }

    /// Queues a region unless its lower bound prunes it.
    fn push(&mut self, lower_bound: f64, region: Region) {
        if lower_bound < self.upper_squared() || self.incumbent.is_none() {
            self.queue.push(QueueEntry { lower_bound, region });
        }
    }

    fn expand_node(&mut self, index: usize) {
        let tree = &self.target.tree;
        let node = &tree.nodes()[index];
        if node.is_leaf() {
            let index = tree.primitive(node);
            let lower_bound = self.target.distance_squared_to_boxes(index, &node.aabb, self.point);
            // A foot within the gap ends the search, before the patch is bounded more closely.
            if self.upper() > self.gap && lower_bound <= self.gap * self.gap {
                let patch = self.patch(index);
                let found = newton(&patch, self.point, nearest_control(&patch, self.point), MAX_ITERATIONS);
                self.critical_point(index, found.parameters);
            }
            self.push(lower_bound, Region::Patch(index));
            return;
        }
        for child in [index + 1, node.right_child as usize] {
            let lower_bound = tree.nodes()[child].aabb.min_distance_squared(self.point);
            self.push(lower_bound, Region::Node(child as u32));
        }
    }

    /// Bounds a patch by the plane through the incumbent, normal to the direction of the target;
    /// where that bound is too small, by its squared distance.
    fn bound_patch(&mut self, index: u32) {
        if let Some((_, foot)) = self.incumbent {
            let upper = self.upper();
            let direction = (self.point - foot.point) / upper;
            let lower_bound = distance_along(&self.patch(index), self.point, direction);
            if lower_bound >= upper - self.gap {
                self.push(lower_bound * lower_bound, Region::SettledPatch(index));
                return;
            }
        }
        self.bound_patch_by_distance(index);
    }

    fn bound_patch_by_distance(&mut self, index: u32) {
        let patch = self.patch(index);
        let form = SquaredDistance::new(patch.degree, patch.controls, self.point - patch.center);
        if let Some((_, foot)) = self.incumbent.filter(|&(patch, _)| patch == index) {
            // About a foot there is no gap where the squared distance is convex: nothing else is asked of the patch.
            let lower_bound = form.lower_bound_about(&foot);
            if lower_bound.sqrt() >= self.upper() - self.gap {
                self.push(lower_bound, Region::SettledPatch(index));
                return;
            }
        }
        self.push(form.lower_bound(), Region::BoundedPatch(index, Box::new(form)));
    }

    fn expand_patch(&mut self, index: u32, form: SquaredDistance) {
        let patch = self.patch(index);
        let start = match self.incumbent {
            Some((patch, foot)) if patch == index => foot.parameters,
            _ => nearest_control(&patch, self.point),
        };
        let found = newton(&patch, self.point, start, MAX_ITERATIONS);
        let foot = self.critical_point(index, found.parameters);
        let controls = patch.controls.to_vec();
        self.push_sub_patch(SubPatch { patch: index, controls, range: ParamBox::UNIT, form, foot });
    }

    /// Bounds a part of a patch about the nearest point found of its own, and halves it where
    /// that does not raise its bound.
    ///
    /// Where a curve of points is as near, every part of it is bounded about a point in it; cut
    /// across the curve alone, the parts become narrow enough long before they are short.
    fn expand_sub_patch(&mut self, mut sub_patch: SubPatch, lower_bound: f64) {
        let SubPatch { patch: index, ref controls, range, .. } = sub_patch;
        let patch = self.patch(index);
        let piece = Patch { controls, domain: range, ..patch };
        let is_inside = range.contains(sub_patch.foot.parameters);
        let middle = patch.point(range.middle()).distance_squared(self.point);
        if !is_inside || middle < self.upper_squared() {
            let found = newton(&piece, self.point, [0.5; 2], MAX_ITERATIONS);
            let foot = self.critical_point(index, range.at(found.parameters));
            if !is_inside || foot.distance_squared < sub_patch.foot.distance_squared {
                sub_patch.foot = foot;
                if sub_patch.lower_bound() > lower_bound {
                    self.push_sub_patch(sub_patch);
                    return;
                }
            }
        }
        let axis = sub_patch.form.curved_axis(self.upper_squared());
        let SubPatch { foot, .. } = sub_patch;
        for (controls, range) in piece.halves(axis).into_iter().zip(range.halves(axis)) {
            let form = SquaredDistance::new(patch.degree, &controls, self.point - patch.center);
            self.push_sub_patch(SubPatch { patch: index, controls, range, form, foot });
        }
    }

    /// Returns a point of a patch, which becomes the incumbent if it is nearer.
    fn critical_point(&mut self, index: u32, parameters: [f64; 2]) -> CriticalPoint {
        let foot = CriticalPoint::new(&self.patch(index), self.point, parameters);
        if foot.distance_squared < self.upper_squared() || self.incumbent.is_none() {
            self.incumbent = Some((index, foot));
        }
        foot
    }

    /// Queues a sub-patch.
    fn push_sub_patch(&mut self, sub_patch: SubPatch) {
        self.push(sub_patch.lower_bound(), Region::SubPatch(Box::new(sub_patch)));
    }
}

impl SubPatch {
    /// Returns a lower bound on its squared distance.
    fn lower_bound(&self) -> f64 {
        let local = self.foot.on_piece(self.range.low(), self.range.lengths());
        let lower_bound = self.form.lower_bound();
        if ParamBox::UNIT.contains(local.parameters) {
            return lower_bound.max(self.form.lower_bound_about(&local));
        }
        lower_bound
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
pub(super) mod tests {
    use super::*;
    use crate::bezier::extract;
    use crate::{Model, SurfaceArrays};

    /// Two squares: from (0.25, 0, 0.125) the first one is 2.875 away, at the parameters (0.625, 0.5), the second one 3.125.
    pub(in crate::closest) fn two_squares() -> Target {
        let Ok(model) = Model::from_arrays(None, vec![square(-2.75), square(3.25)]) else { unreachable!() };
        Target::new(extract(&model).patches)
    }

    fn square(z: f64) -> SurfaceArrays {
        SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]]
                .map(|[x, y]| [x, y, z, 1.0])
                .to_vec(),
        }
    }

    /// A bound on the other patches decides a point if it is at least the point's distance minus the gap. If it is smaller
    /// than the bound on the foot's patch, it is the lower bound of the result.
    #[test]
    fn a_bound_on_others_decides_within_the_gap() {
        const GAP: f64 = 0.125;
        let target = two_squares();
        let point = DVec3::new(0.25, 0.0, 0.125);
        let beside = |others: f64, parameters: [f64; 2]| {
            closest_beside(&target, point, GAP, Located { patch: 0, parameters, own: f64::NAN, others })
        };
        let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-12;
        for (others, lower) in [(3.125, 2.875), (2.8125, 2.8125), (2.75, 2.75)] {
            let Some(found) = beside(others, [0.625, 0.5]) else { unreachable!() };
            assert!(close(found.upper, 2.875) && close(found.lower, lower), "{others}: {found:?}");
            assert!(found.lower < lower, "rounding");
        }
        for others in [2.75 - 1e-9, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(beside(others, [0.625, 0.5]), None, "{others}");
        }
        // A foot that is not the closest point of its patch is a start; what is needed of others is by its distance.
        let Some(found) = beside(3.125, [0.25, 0.75]) else { unreachable!() };
        assert!(close(found.upper, 2.875) && close(found.lower, 2.875), "{found:?}");
    }

    /// A patch with nearly parallel axes passes the point at a distance larger than the gap. The lower bounds of
    /// many of its parts stay 0 until the search gives up. A square whose box contains the point is nearer.
    #[test]
    fn a_foot_beside_a_narrow_patch_is_found() {
        const WIDTH: f64 = 1e-4;
        const HEIGHT: f64 = 9e-5;
        const DISTANCE: f64 = 1e-6;
        let bilinear = |corners: [DVec3; 4]| SurfaceArrays {
            degree: [1, 1],
            knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
            counts: [2, 2],
            control_points: corners.map(|corner| corner.extend(1.0).to_array()).to_vec(),
        };
        let [x, far] = [DVec3::X, DVec3::new(10.0, WIDTH, 0.0)];
        let narrow = bilinear([DVec3::ZERO, x, far, far + x]);
        let point = DVec3::new(5.0, 0.5 * WIDTH, HEIGHT);
        let normal = DVec3::ONE.normalize();
        let (along, across) = normal.any_orthonormal_pair();
        let center = point + DISTANCE * normal;
        let square = bilinear([
            center - along - across,
            center + along - across,
            center - along + across,
            center + along + across,
        ]);
        let Ok(model) = Model::from_arrays(None, vec![narrow, square]) else { unreachable!() };
        let target = Target::new(extract(&model).patches);
        let Some(found) = closest(&target, point, 0.5 * HEIGHT) else { unreachable!() };
        assert!((found.upper - DISTANCE).abs() < 1e-9, "{found:?}");
        assert_eq!(found.patch, 1);
    }
}
