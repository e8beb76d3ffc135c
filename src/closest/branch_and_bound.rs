//! The closest point of a whole model by best-first branch and bound.

use super::{CriticalPoint, Foot, NearbyPatches, SquaredDistance, Target, nearest_control, newton};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::closest_rounding;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The largest number of Newton steps from one start; on a flat patch about five suffice.
const MAX_ITERATIONS: u32 = 32;

/// The largest number of sub-patches examined. A few dozen suffice unless the
/// target point is almost equally near to a whole curve or surface of points;
/// then the interval stays wider than requested.
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
    /// A patch with its squared distance in Bernstein form.
    BoundedPatch(u32, Box<SquaredDistance>),
    SubPatch(Box<SubPatch>),
}

/// A part of a patch, with the nearest point found on the whole patch.
struct SubPatch {
    patch: u32,
    controls: Vec<DVec4>,
    range: ParamBox,
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
    /// The entry with the smallest lower bound is the heap's largest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.lower_bound.total_cmp(&self.lower_bound)
    }
}

/// Returns the closest point of `target` to `point`, or `None` for a target without patches.
///
/// Guarantee: `lower <= d(point, target) <= upper`, and `upper - lower <= gap`
/// up to rounding, unless the point is so evenly near to many points that
/// [`MAX_SUB_PATCHES`] do not separate them. The search is best first: it
/// examines boxes of the tree, then patches, bounded by their own boxes and then
/// by a [`SquaredDistance`], then halves of patches, in the order of their lower
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
    let mut search = ClosestPointSearch { target, point, queue: BinaryHeap::new(), incumbent: None };
    let root = target.tree.nodes().first()?;
    if let Some((patch, parameters)) = incumbent {
        let distance_squared = search.patch(patch).point(parameters).distance_squared(point);
        search.propose(patch, parameters, distance_squared);
    }
    let upper = search.upper();
    let moved = |nearby: &&NearbyPatches| nearby.center.distance(point);
    if let Some(nearby) = nearby.filter(|nearby| upper <= nearby.radius - moved(nearby)) {
        for candidate in &nearby.list {
            let lower_bound = (candidate.lower_bound - moved(&nearby)).max(0.0);
            search.push(lower_bound * lower_bound, Region::Patch(candidate.patch));
        }
    } else {
        search.push(root.aabb.min_distance_squared(point), Region::Node(0));
    }
    // The lower bound loses the rounding in the end, so a smaller gap cannot be had.
    let rounding = closest_rounding(root.aabb.farthest_from_origin().max(point.length()));
    let gap = gap.max(rounding);
    let mut sub_patches = 0;
    let mut lower_squared = f64::INFINITY;
    while let Some(QueueEntry { lower_bound, region }) = search.queue.pop() {
        let upper = search.upper();
        if lower_bound.sqrt() >= upper - gap || upper <= floor || sub_patches >= MAX_SUB_PATCHES {
            lower_squared = lower_bound;
            break;
        }
        match region {
            Region::Node(node) => search.expand_node(node as usize),
            Region::Patch(patch) => search.bound_patch(patch),
            Region::BoundedPatch(patch, form) => search.expand_patch(patch, &form),
            Region::SubPatch(sub_patch) => {
                sub_patches += 1;
                search.expand_sub_patch(&sub_patch);
            }
        }
    }
    let (index, parameters, distance_squared) = search.incumbent?;
    let upper = distance_squared.sqrt();
    let lower = (lower_squared.sqrt().min(upper) - rounding).max(0.0);
    let point = search.patch(index).point(parameters);
    Some(Closest { patch: index as usize, parameters, point, upper, lower })
}

/// The state of one search: its queue, and the nearest point found.
struct ClosestPointSearch<'a> {
    target: &'a Target,
    point: DVec3,
    queue: BinaryHeap<QueueEntry>,
    /// Patch, parameters and squared distance.
    incumbent: Option<(u32, [f64; 2], f64)>,
}

impl<'a> ClosestPointSearch<'a> {
    fn patch(&self, index: u32) -> Patch<'a> {
        self.target.patches.patch(index as usize)
    }

    /// Returns the incumbent's squared distance, +∞ before there is one.
    fn upper_squared(&self) -> f64 {
        self.incumbent.map_or(f64::INFINITY, |incumbent| incumbent.2)
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

    /// Makes a point the incumbent if it is nearer.
    fn propose(&mut self, patch: u32, parameters: [f64; 2], distance_squared: f64) {
        if distance_squared < self.upper_squared() || self.incumbent.is_none() {
            self.incumbent = Some((patch, parameters, distance_squared));
        }
    }

    fn expand_node(&mut self, index: usize) {
        let Target { tree, boxes, .. } = self.target;
        let node = &tree.nodes()[index];
        if node.is_leaf() {
            let patch = tree.primitive(node);
            let aligned = node.aabb.min_distance_squared(self.point);
            let oriented = boxes[patch as usize].min_distance_squared(self.point);
            self.push(aligned.max(oriented), Region::Patch(patch));
            return;
        }
        for child in [index + 1, node.right_child as usize] {
            let lower_bound = tree.nodes()[child].aabb.min_distance_squared(self.point);
            self.push(lower_bound, Region::Node(child as u32));
        }
    }

    /// Bounds a patch by its squared distance, which usually prunes it.
    fn bound_patch(&mut self, index: u32) {
        let patch = self.patch(index);
        let form = SquaredDistance::new(patch.degree, patch.controls, self.point - patch.center);
        self.push(form.lower_bound(), Region::BoundedPatch(index, Box::new(form)));
    }

    fn expand_patch(&mut self, index: u32, form: &SquaredDistance) {
        let patch = self.patch(index);
        // A point near the closest one, if the incumbent is on this patch.
        let start = match self.incumbent {
            Some((incumbent, parameters, _)) if incumbent == index => parameters,
            _ => nearest_control(&patch, self.point),
        };
        let foot = self.critical_point(index, newton(&patch, self.point, start, MAX_ITERATIONS));
        let controls = patch.controls.to_vec();
        self.push_sub_patch(SubPatch { patch: index, controls, range: ParamBox::UNIT, foot }, form);
    }

    fn expand_sub_patch(&mut self, sub_patch: &SubPatch) {
        let &SubPatch { patch: index, ref controls, range, foot: known } = sub_patch;
        let patch = self.patch(index);
        let middle = range.middle();
        let mut foot = known;
        if patch.point(middle).distance_squared(self.point) < self.upper_squared() {
            let found = self.critical_point(index, newton(&patch, self.point, middle, MAX_ITERATIONS));
            if found.distance_squared < known.distance_squared {
                foot = found;
            }
        }
        let piece = Patch { controls, domain: range, ..patch };
        let axis = longer_axis(&piece);
        for (controls, range) in piece.halves(axis).into_iter().zip(range.halves(axis)) {
            let form = SquaredDistance::new(patch.degree, &controls, self.point - patch.center);
            self.push_sub_patch(SubPatch { patch: index, controls, range, foot }, &form);
        }
    }

    /// Proposes the end of an iteration, and returns it with its gradient.
    fn critical_point(&mut self, index: u32, foot: Foot) -> CriticalPoint {
        self.propose(index, foot.parameters, foot.distance_squared);
        CriticalPoint::new(&self.patch(index), self.point, foot.parameters)
    }

    /// Queues a sub-patch, whose squared distance is `form`.
    fn push_sub_patch(&mut self, sub_patch: SubPatch, form: &SquaredDistance) {
        let SubPatch { range, foot, .. } = &sub_patch;
        let local = foot.on_piece(range.low(), range.lengths());
        let mut lower_bound = form.lower_bound();
        if ParamBox::UNIT.contains(local.parameters) {
            lower_bound = lower_bound.max(form.lower_bound_about(&local));
        }
        self.push(lower_bound, Region::SubPatch(Box::new(sub_patch)));
    }
}

/// Returns the axis along which the net is longer, by its largest single leg.
fn longer_axis(piece: &Patch<'_>) -> Axis {
    let columns = piece.degree[1] + 1;
    let point = |index: usize| piece.controls[index].xyz() / piece.controls[index].w;
    let mut leg = [0.0_f64; 2];
    for index in 0..piece.controls.len() {
        if index + columns < piece.controls.len() {
            leg[0] = leg[0].max(point(index + columns).distance_squared(point(index)));
        }
        if (index + 1) % columns != 0 {
            leg[1] = leg[1].max(point(index + 1).distance_squared(point(index)));
        }
    }
    Axis::of_larger([0, 1].map(|axis| leg[axis] * (piece.degree[axis] * piece.degree[axis]) as f64))
}
