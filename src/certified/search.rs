//! Stage `search`: halving cells until the interval is as narrow as asked.

use super::Operand;
use super::at_once::{at_once, farthest_at_once, farthest_corners};
use super::claim::Claim;
use super::feet::{Foot, Sample};
use super::nearest::nearest_within;
use super::profile::Profiles;
use super::queue::Queue;
use super::region::{Domain, SearchNode};
use crate::bezier::Patch;
use crate::closest::Closest;
use crate::model::RigidTransform;
use crate::parallel::{is_few, map_short, side_by_side, together};
use crate::rounding::coordinate_rounding;
use glam::DVec3;

/// Regions bounded between two looks at the largest distance: enough to keep
/// all threads busy, few enough that a better distance spares work soon.
const CHUNK: usize = 1024;

/// Half-width of a cell that float64 does not halve further with use.
const MIN_HALF: f64 = 1e-12;

/// Rounding of a bound in those of coordinates: a cell's sums take fewer than
/// some hundred roundings of 2^-53 each, and a flat piece's controls, followed
/// beyond an edge, are off by less than 600; 1024 in all.
const ROUNDING: f64 = 8.0;

/// Part of the tolerance that rounding may take; of a finer one, it takes all.
const MAX_LOST: f64 = 0.5;

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stop {
    /// The interval is as narrow as asked, or the limit is decided.
    Converged,
    /// The budget of cells is spent.
    Cells,
    /// The budget of time is spent.
    Time,
    /// Cells are as small as float64 can tell, or its rounding is wider than asked.
    Precision,
    /// The caller cancelled.
    Cancelled,
}

/// What a search knows at any time: `lower <= distance <= upper`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
}

/// The farthest point of A found, certified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Farthest {
    pub(crate) patch: u32,
    pub(crate) parameters: [f64; 2],
    pub(crate) point: DVec3,
    pub(crate) closest: Closest,
}

/// A branch and bound over A.
pub(crate) struct BranchAndBound<'a> {
    pub(super) a: Operand<'a>,
    pub(super) b: Operand<'a>,
    pub(super) transform: RigidTransform,
    /// What the bounds may differ by, so that the interval is as narrow as asked.
    pub(super) tolerance: f64,
    /// A bound above it need not be tighter.
    limit: Option<f64>,
    pub(super) rounding: f64,
    profiles: Profiles,
    pub(super) queue: Queue,
    pub(super) dropped: f64,
    pub(super) farthest: Option<Farthest>,
    /// What is taken on trust, and the regions that were dropped because of it.
    pub(super) claim: Option<Claim>,
    pub(super) held: Vec<SearchNode>,
    pub(super) trusting: bool,
    exhausted: bool,
    /// Cells bounded.
    pub(crate) cells: usize,
    /// Those of them that a kernel bounded.
    pub(crate) kernel_cells: usize,
    pub(crate) levels: u32,
}

/// What a kernel made of the cells lent to it.
#[derive(Debug, Default)]
pub(crate) struct BatchResult {
    /// The largest bound of the cells that it decided.
    pub(crate) dropped: f64,
    /// Cells that it bounded, and levels that it went down.
    pub(crate) cells: usize,
    pub(crate) levels: u32,
    /// Cells still to be bounded, by whomever.
    pub(crate) waiting: Vec<SearchNode>,
    /// Cells that are for float64.
    pub(crate) undecided: Vec<SearchNode>,
    /// A far point of A: patch and parameters.
    pub(crate) farthest: Option<(u32, [f64; 2])>,
}

impl<'a> BranchAndBound<'a> {
    /// Over all of A, moved by `transform`, down to a width of `tolerance`, or
    /// only as far as tells whether the distance exceeds `limit`.
    pub(crate) fn new(
        a: Operand<'a>,
        b: Operand<'a>,
        transform: RigidTransform,
        tolerance: f64,
        limit: Option<f64>,
    ) -> Self {
        let coordinate = |side: &Operand<'_>| {
            side.target
                .tree
                .nodes()
                .first()
                .map_or(0.0, |root| root.aabb.min.abs().max(root.aabb.max.abs()).max_element())
        };
        let largest = coordinate(&a) + transform.offset().abs().max_element() + coordinate(&b);
        let root = SearchNode {
            domain: Domain::Node(0),
            upper: farthest_corners(&a, &b, &transform).min(farthest_at_once(&a, &b, &transform)),
            foot: Foot::start(0, [0.5; 2]),
            level: 0,
        };
        let profiles = Profiles::new(&a, &b, &transform, tolerance);
        let rounding = ROUNDING * coordinate_rounding(largest);
        // Twice, as the interval's ends are rounded themselves.
        let lost = profiles.slack + 2.0 * rounding;
        let mut search = Self {
            a,
            b,
            transform,
            tolerance: if lost < MAX_LOST * tolerance { tolerance - lost } else { tolerance },
            limit,
            rounding,
            profiles,
            queue: Queue::new(root),
            dropped: 0.0,
            farthest: None,
            claim: None,
            held: Vec::new(),
            // A limit is decided by what is certain.
            trusting: limit.is_none(),
            exhausted: false,
            cells: 0,
            kernel_cells: 0,
            levels: 0,
        };
        search.begin();
        search
    }

    /// The interval so far.
    pub(crate) fn interval(&self) -> Interval {
        let lower = self.lower();
        let held = self.held.iter().fold(lower, |upper, region| upper.max(region.upper));
        let upper = self.dropped.max(self.queue.upper()).max(held);
        Interval { lower, upper: upper + self.profiles.slack + self.rounding }
    }

    /// The farthest point so far.
    pub(crate) fn farthest(&self) -> Option<&Farthest> {
        self.farthest.as_ref()
    }

    /// The patches of a farthest point and its foot.
    pub(crate) fn witness_patches(&self, farthest: &Farthest) -> [Patch<'a>; 2] {
        [self.a.patch(farthest.patch), self.b.target.patches.patch(farthest.closest.patch)]
    }

    /// The two models and the transform of the first.
    pub(crate) fn sides(&self) -> (&Operand<'a>, &Operand<'a>, &RigidTransform) {
        (&self.a, &self.b, &self.transform)
    }

    /// What the bounds may differ by.
    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Parts waiting to be bounded.
    pub(crate) fn waiting(&self) -> usize {
        self.queue.len()
    }

    /// Whether cells may be edges of patches, which kernels cannot bound.
    pub(crate) fn has_edges(&self) -> bool {
        self.profiles.any()
    }

    /// Whether there are cells that only float64 can bound.
    pub(crate) fn has_undecided(&self) -> bool {
        self.queue.has_undecided()
    }

    /// Takes the next cells out, up to `most`; they must come back by
    /// [`BranchAndBound::return_batch`], for until then nothing here knows of them.
    pub(crate) fn take_batch(&mut self, most: usize) -> Vec<SearchNode> {
        self.prove();
        let (cells, dropped) = self.queue.next_cells(most, self.prune_threshold());
        self.dropped = self.dropped.max(dropped);
        cells
    }

    /// Takes back what was lent.
    pub(crate) fn return_batch(&mut self, returned: BatchResult) {
        self.dropped = self.dropped.max(returned.dropped);
        self.cells += returned.cells;
        self.kernel_cells += returned.cells;
        self.levels = self.levels.max(returned.levels);
        self.queue.extend(returned.waiting);
        self.queue.extend_undecided(returned.undecided);
        let Some((patch, parameters)) = returned.farthest else { return };
        let point = self.transform.apply(self.a.patch(patch).point(parameters));
        let foot = nearest_within(&self.b, point, Foot::start(0, [0.5; 2]), 0.0);
        self.climb_from(patch, Sample { parameters, foot });
    }

    pub(super) fn lower(&self) -> f64 {
        self.farthest.map_or(0.0, |farthest| farthest.closest.lower)
    }

    /// A bound of at most this ends a cell.
    pub(crate) fn prune_threshold(&self) -> f64 {
        let within = self.believed() + self.tolerance;
        self.limit.map_or(within, |limit| within.max(limit - self.rounding))
    }

    /// Bounds about the next chunk of regions; `Some` when there is nothing left to do.
    pub(crate) fn advance(&mut self) -> Option<Stop> {
        let stop = self.advance_chunk();
        let is_due = |claim: &Claim| stop.is_some() || self.cells >= claim.cells + CHUNK;
        if self.claim.as_ref().is_some_and(is_due) {
            self.prove();
            return stop.filter(|_| self.queue.is_empty());
        }
        stop
    }

    fn advance_chunk(&mut self) -> Option<Stop> {
        if is_few(self.queue.len()) {
            return self.advance_once();
        }
        let most = self.cells + CHUNK;
        together(|| {
            loop {
                let stop = match self.claim.filter(|_| self.queue.is_ending()) {
                    Some(claim) => self.advance_beside(claim, most),
                    None => self.advance_once(),
                };
                if stop.is_some() || self.cells >= most {
                    return stop;
                }
            }
        })
    }

    /// Certifies a claim while regions are bounded, as long as it is not outdone.
    fn advance_beside(&mut self, claim: Claim, most: usize) -> Option<Stop> {
        let proof = self.proof(&claim);
        let (closest, stop) = side_by_side(
            || proof.closest(),
            || {
                loop {
                    let stop = self.advance_once();
                    if stop.is_some() || self.cells >= most || self.claim != Some(claim) {
                        return stop;
                    }
                }
            },
        );
        if self.claim == Some(claim) {
            self.take(claim, closest);
            return stop.filter(|_| self.queue.is_empty());
        }
        stop
    }

    /// Bounds the regions that wait, up to a chunk.
    pub(crate) fn advance_once(&mut self) -> Option<Stop> {
        if self.limit.is_some_and(|limit| self.lower() > limit) {
            return Some(Stop::Converged);
        }
        if self.queue.is_empty() {
            return Some(if self.exhausted { Stop::Precision } else { Stop::Converged });
        }
        let regions = self.queue.next(CHUNK);
        self.list_candidates(&regions[0]);
        let prune_threshold = self.prune_threshold();
        let bounded = map_short(regions.len(), |index| {
            let region = &regions[index];
            (region.upper > prune_threshold).then(|| self.bound(region, prune_threshold))
        });
        self.raise(&bounded);
        let prune_threshold = self.prune_threshold();
        let mut parts = Vec::new();
        for (region, bounded) in regions.iter().zip(&bounded) {
            self.levels = self.levels.max(region.level);
            let upper = bounded.as_ref().map_or(region.upper, |bounded| bounded.upper);
            self.cells += usize::from(bounded.is_some());
            let too_small =
                matches!(&region.domain, Domain::Cell(cell) if cell.half[0].max(cell.half[1]) < MIN_HALF);
            match bounded {
                Some(bounded) if upper > prune_threshold && !too_small => {
                    let first = parts.len();
                    region.split_into(&self.a, &self.profiles, upper, bounded.foot, &mut parts);
                    if matches!(region.domain, Domain::Node(_)) {
                        self.limit_at_once(&mut parts[first..]);
                    }
                }
                _ => {
                    self.exhausted |= upper > prune_threshold;
                    self.drop_region(SearchNode { upper, ..*region });
                }
            }
        }
        self.queue.extend(parts);
        None
    }

    /// Bounds whole patches at once where that can be.
    fn limit_at_once(&self, parts: &mut [SearchNode]) {
        for part in parts {
            if let Domain::Cell(cell) = &part.domain {
                part.upper = part.upper.min(at_once(&self.a, &self.b, &self.transform, cell.patch));
            }
        }
    }

    /// Whether the distance is at most the limit, once that is known.
    pub(crate) fn within(&self) -> Option<bool> {
        let (limit, interval) = (self.limit?, self.interval());
        if interval.upper <= limit {
            Some(true)
        } else if interval.lower > limit {
            Some(false)
        } else {
            None
        }
    }
}
