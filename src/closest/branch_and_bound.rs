//! The closest point of a whole model, with a certificate.

use super::{Candidates, CriticalPoint, Foot, SquaredDistance, Target, nearest_control, newton};
use crate::axis::Axis;
use crate::bezier::Patch;
use crate::param_box::ParamBox;
use crate::rounding::coordinate_rounding;
use glam::{DVec3, DVec4, Vec4Swizzles};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Newton steps a start may take; from a flat patch it takes about five.
const ITERATIONS: u32 = 32;

/// Pieces examined, at most. A few dozen suffice unless the target is nearly
/// as near to a whole curve or sheet of points; then the certificate is wider.
const MAX_PIECES: usize = 4096;

/// A point of a model near a target, and how near any point can be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Closest {
    /// Index of the patch.
    pub patch: usize,
    /// (s, t) on it.
    pub parameters: [f64; 2],
    /// The point.
    pub point: DVec3,
    /// Its distance: at least the distance from the target to the model.
    pub upper: f64,
    /// At most the distance from the target to the model.
    pub lower: f64,
}

/// What may hold the closest point; small, as the heap moves it about.
enum Item {
    Node(u32),
    Patch(u32),
    /// A patch of which more is known.
    Formed(u32, Box<SquaredDistance>),
    Piece(Box<Piece>),
}

/// A part of a patch with the nearest point known of the patch.
struct Piece {
    patch: u32,
    controls: Vec<DVec4>,
    range: ParamBox,
    foot: CriticalPoint,
}

struct Entry {
    least: f64,
    item: Item,
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Entry {}
impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Entry {
    /// The heap's largest entry is the nearest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.least.total_cmp(&self.least)
    }
}

/// The closest point of `target` to `point`, or `None` if there are no patches.
///
/// Guarantee: `lower <= d(point, target) <= upper`, and `upper - lower <= gap`
/// (plus rounding) unless the point is so evenly near to many points that a
/// fixed number of pieces does not separate them. Best first: whatever can be
/// nearest is examined next, boxes of the tree, then patches, by their own boxes
/// and by a [`SquaredDistance`], then their halves. O(log patches) in general position.
#[must_use]
pub fn closest(target: &Target, point: DVec3, gap: f64) -> Option<Closest> {
    closest_above(target, point, gap, None, 0.0, None)
}

/// The same from a point that is known, a patch and its parameters, and given
/// up, with whatever gap, where the distance is at most `floor`.
///
/// Where the known point is nearer than any patch that is not among
/// `candidates` can be, by their lemma, only they are examined.
pub(crate) fn closest_above(
    target: &Target,
    point: DVec3,
    gap: f64,
    known: Option<(u32, [f64; 2])>,
    floor: f64,
    candidates: Option<&Candidates>,
) -> Option<Closest> {
    let mut search = Search { target, point, heap: BinaryHeap::new(), best: None };
    let root = target.tree.nodes().first()?;
    if let Some((patch, parameters)) = known {
        let distance_squared = search.patch(patch).point(parameters).distance_squared(point);
        search.offer(patch, parameters, distance_squared);
    }
    let upper = search.upper();
    let moved = |about: &&Candidates| about.center.distance(point);
    if let Some(about) = candidates.filter(|about| upper <= about.reach - moved(about)) {
        for candidate in &about.list {
            let least = (candidate.least - moved(&about)).max(0.0);
            search.push(least * least, Item::Patch(candidate.patch));
        }
    } else {
        search.push(root.aabb.min_distance_squared(point), Item::Node(0));
    }
    let mut pieces = 0;
    let mut lower_squared = f64::INFINITY;
    while let Some(Entry { least, item }) = search.heap.pop() {
        let upper = search.upper();
        if least.sqrt() >= upper - gap || upper <= floor || pieces >= MAX_PIECES {
            lower_squared = least;
            break;
        }
        match item {
            Item::Node(node) => search.open_node(node as usize),
            Item::Patch(patch) => search.open_patch(patch),
            Item::Formed(patch, form) => search.open_formed(patch, &form),
            Item::Piece(piece) => {
                pieces += 1;
                search.open_piece(&piece);
            }
        }
    }
    let (index, parameters, distance_squared) = search.best?;
    let coordinate = root.aabb.min.abs().max(root.aabb.max.abs()).max(point.abs()).max_element();
    let upper = distance_squared.sqrt();
    let lower = (lower_squared.sqrt().min(upper) - coordinate_rounding(coordinate)).max(0.0);
    let point = search.patch(index).point(parameters);
    Some(Closest { patch: index as usize, parameters, point, upper, lower })
}

struct Search<'a> {
    target: &'a Target,
    point: DVec3,
    heap: BinaryHeap<Entry>,
    best: Option<(u32, [f64; 2], f64)>,
}

impl<'a> Search<'a> {
    fn patch(&self, index: u32) -> Patch<'a> {
        self.target.patches.patch(index as usize)
    }

    fn best_squared(&self) -> f64 {
        self.best.map_or(f64::INFINITY, |best| best.2)
    }

    fn upper(&self) -> f64 {
        self.best_squared().sqrt()
    }

    fn push(&mut self, least: f64, item: Item) {
        if least < self.best_squared() || self.best.is_none() {
            self.heap.push(Entry { least, item });
        }
    }

    fn offer(&mut self, patch: u32, parameters: [f64; 2], distance_squared: f64) {
        if distance_squared < self.best_squared() || self.best.is_none() {
            self.best = Some((patch, parameters, distance_squared));
        }
    }

    fn open_node(&mut self, index: usize) {
        let Target { tree, boxes, .. } = self.target;
        let node = &tree.nodes()[index];
        if node.is_leaf() {
            let patch = tree.item(node);
            let least = node.aabb.min_distance_squared(self.point);
            let least = least.max(boxes[patch as usize].min_distance_squared(self.point));
            self.push(least, Item::Patch(patch));
            return;
        }
        for child in [index + 1, node.second as usize] {
            let least = tree.nodes()[child].aabb.min_distance_squared(self.point);
            self.push(least, Item::Node(child as u32));
        }
    }

    /// Its form mostly tells that it is too far.
    fn open_patch(&mut self, index: u32) {
        let patch = self.patch(index);
        let form = SquaredDistance::new(patch.degree, patch.controls, self.point - patch.center);
        self.push(form.least(), Item::Formed(index, Box::new(form)));
    }

    fn open_formed(&mut self, index: u32, form: &SquaredDistance) {
        let patch = self.patch(index);
        let start = nearest_control(&patch, self.point);
        let foot = self.foot(index, newton(&patch, self.point, start, ITERATIONS));
        let controls = patch.controls.to_vec();
        self.push_piece(Piece { patch: index, controls, range: ParamBox::UNIT, foot }, form);
    }

    fn open_piece(&mut self, piece: &Piece) {
        let &Piece { patch: index, ref controls, range, foot: known } = piece;
        let patch = self.patch(index);
        let middle = range.middle();
        let mut foot = known;
        if patch.point(middle).distance_squared(self.point) < self.best_squared() {
            let found = self.foot(index, newton(&patch, self.point, middle, ITERATIONS));
            if found.distance_squared < known.distance_squared {
                foot = found;
            }
        }
        let piece = Patch { controls, domain: range, ..patch };
        let axis = longer_axis(&piece);
        for (controls, range) in piece.halves(axis).into_iter().zip(range.halves(axis)) {
            let form = SquaredDistance::new(patch.degree, &controls, self.point - patch.center);
            self.push_piece(Piece { patch: index, controls, range, foot }, &form);
        }
    }

    /// Offers what an iteration ended at.
    fn foot(&mut self, index: u32, foot: Foot) -> CriticalPoint {
        self.offer(index, foot.parameters, foot.distance_squared);
        CriticalPoint::new(&self.patch(index), self.point, &foot)
    }

    fn push_piece(&mut self, piece: Piece, form: &SquaredDistance) {
        let Piece { range, foot, .. } = &piece;
        let width = range.lengths();
        let local = CriticalPoint {
            parameters: [0, 1].map(|axis| (foot.parameters[axis] - range[axis][0]) / width[axis]),
            gradient: [0, 1].map(|axis| width[axis] * foot.gradient[axis]),
            ..*foot
        };
        let mut least = form.least();
        if local.parameters.iter().all(|parameter| (0.0..=1.0).contains(parameter)) {
            least = least.max(form.least_about(&local));
        }
        self.push(least, Item::Piece(Box::new(piece)));
    }
}

/// The direction in which the net is longer, by its largest single leg.
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
    let legs = [
        leg[0] * (piece.degree[0] * piece.degree[0]) as f64,
        leg[1] * (piece.degree[1] * piece.degree[1]) as f64,
    ];
    Axis::of_larger(legs)
}
