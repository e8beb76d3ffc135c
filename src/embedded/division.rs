//! Parts of a boundary that are divided until each of them, and every two that are near each other, is decided.

use super::audit::Audited;
use super::{Doubt, Limits, Verdict};
use crate::bvh::{Aabb, Bvh};
use crate::rounding::upper_max;

/// The largest number of divisions of a part.
const MAX_LEVEL: u32 = 40;

/// The ways between points that are near each other, relative to what is near, up to which parts are not divided for shorter
/// ones, and the divisions after which they are not.
const GOOD_STRETCH: f64 = 64.0;
const PATIENCE: u32 = 6;

/// The pairs of parts that are looked at for each whole part and pair of whole parts that are near each other; most take
/// one.
const PAIRS_EACH: usize = 512;

/// The pairs between two looks at the time.
const PAIRS_AT_ONCE: usize = 1024;

/// What is to be decided.
#[derive(Debug, Clone, Copy)]
pub(super) enum Task {
    /// That a part does not meet itself.
    One(u32),
    /// That two parts meet nowhere but beside what they share.
    Two([u32; 2]),
}

/// What the division of parts depends on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    /// The patch that the part is of.
    pub(super) patch: u32,
    pub(super) aabb: Aabb,
    /// The number of divisions from the whole part.
    pub(super) level: u32,
    /// Whether the part is divided before others.
    pub(super) is_first: bool,
}

/// Parts that are divided.
pub(super) trait Division {
    fn shape(&self, part: u32) -> Shape;

    /// Returns how much is gained by dividing a part.
    fn gain(&self, part: u32) -> f64;

    /// Returns the two parts of a part.
    fn halves(&mut self, part: u32) -> [u32; 2];

    /// Returns an upper bound on the ways between points of one or two parts that are near each other, 0 if there are none,
    /// if a bound of at most `most` is found.
    fn within(&self, task: Task, most: f64) -> Option<f64>;

    fn audited(&self) -> &Audited;
}

/// Decides every whole part, and every two whole parts whose boxes are near each other if `is_pair` accepts them. Returns
/// the first part or pair that is not decided, if there is one.
pub(super) fn decide(
    mut division: impl Division,
    wholes: u32,
    is_pair: impl Fn([u32; 2]) -> bool,
    limits: &Limits<'_>,
) -> Verdict {
    let apart = division.audited().apart();
    let boxes: Vec<Aabb> = (0..wholes).map(|part| division.shape(part).aabb.grown(apart)).collect();
    let mut tasks: Vec<Task> = (0..wholes).map(Task::One).collect();
    Bvh::new(&boxes).for_each_pair(|a, b| {
        if is_pair([a, b]) {
            tasks.push(Task::Two([a, b]));
        }
    });
    let budget = PAIRS_EACH * tasks.len();
    let (mut count, mut largest) = (0, 0.0);
    while let Some(task) = tasks.pop() {
        count += 1;
        let shapes = task.parts().map(|part| division.shape(part));
        if count > budget || (count % PAIRS_AT_ONCE == 0 && (limits.is_late)()) {
            return undecided(shapes, Doubt::Budget);
        }
        let is_early = shapes.iter().any(|shape| shape.level < PATIENCE);
        let most = if is_early { GOOD_STRETCH * apart } else { limits.most };
        let within = division.within(task, most);
        if division.audited().is_refuted() {
            return undecided(shapes, Doubt::Refuted);
        }
        if let Some(within) = within {
            largest = upper_max(largest, within);
            continue;
        }
        let is_small = |shape: &Shape| shape.level >= MAX_LEVEL || shape.aabb.diagonal() <= apart;
        if shapes.iter().all(is_small) {
            return undecided(shapes, Doubt::Contact);
        }
        match task {
            Task::One(part) => {
                let [low, high] = division.halves(part);
                tasks.extend([Task::One(low), Task::One(high), Task::Two([low, high])]);
            }
            Task::Two([a, b]) => {
                let [of_a, of_b] = [(a, shapes[0]), (b, shapes[1])].map(|(part, shape)| {
                    (shape.is_first, if shape.level < MAX_LEVEL { division.gain(part) } else { 0.0 })
                });
                let (divided, other) = if of_a >= of_b { (a, b) } else { (b, a) };
                tasks.extend(division.halves(divided).map(|half| Task::Two([half, other])));
            }
        }
    }
    Verdict::Embedded { within: largest }
}

/// Returns the verdict without an answer for two parts.
fn undecided(shapes: [Shape; 2], doubt: Doubt) -> Verdict {
    let [a, b] = shapes.map(|shape| shape.aabb);
    // Where the boxes come near each other.
    let common = Aabb { min: a.min.max(b.min), max: a.max.min(b.max) };
    Verdict::Undecided { doubt, parts: shapes.map(|shape| shape.patch), point: common.center() }
}

impl Task {
    fn parts(self) -> [u32; 2] {
        match self {
            Self::One(part) => [part; 2],
            Self::Two(parts) => parts,
        }
    }
}
