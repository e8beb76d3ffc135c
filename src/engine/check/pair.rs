//! How two bodies lie to each other.

use super::depth::depth;
use super::options::Limits;
use super::parting::are_parted_within;
use crate::bvh::Aabb;
use crate::clearance::{Goal, Nearest, Search, are_parted};
use crate::engine::clearance::{Overlap, OverlapUnknown, Solids};
use crate::engine::{PreparedModel, Stop};
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::solid::Side;
use serde::Serialize;

/// The way in which two bodies lie to each other, the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub enum PairState {
    /// A point is certainly inside both.
    Clash,
    /// Neither is certain: [`BodyPair::why`] says why.
    Undecided,
    /// They are certainly within the tolerance of each other, and either a motion by at most the tolerance certainly
    /// leaves them without a common inside, or no point inside both was found: about the place where they are
    /// nearest, in the box that both reach into, behind some hundred patches of each, and behind each other patch whose
    /// middle is inside the other body.
    Touching,
    /// They are certainly nearer than `below`, and certainly have no common inside.
    Near,
    /// They are certainly at least `below` apart, and farther than the tolerance where that is larger. One may lie in
    /// a void of the other.
    Apart,
}

/// Two bodies, and how they lie to each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct BodyPair {
    /// The name of the one body.
    pub a: String,
    /// The name of the other.
    pub b: String,
    /// How they lie to each other.
    pub state: PairState,
    /// The least distance of their points is in it; 0 where they clash.
    pub clearance: Interval,
    /// Of a clash, the volume of their common part is in it; none where a body does not close or has no volume, or it is
    /// not known whether it has a void.
    pub volume: Option<Interval>,
    /// Of a clash, the length of the shortest motion that leaves them without a common inside is in it; none where it is
    /// not known whether one of them has a void.
    pub depth: Option<Interval>,
    /// Of a clash, a point inside both; else the point of A that is nearest to B.
    pub point: [f64; 3],
    /// Whether a rule says that what happens between them is meant, so that it is not judged.
    pub intended: bool,
    /// Why their state is not decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<OverlapUnknown>,
}

/// What a search has found.
struct Found {
    interval: Interval,
    nearest: Nearest,
    stop: Stop,
    goal: Goal,
    at_least: Option<bool>,
}

/// Returns the pair of these bodies, without names.
///
/// A first search only decides whether they are nearer than `reach`, which is at least that of the limits; a second
/// one, for those that are, measures the clearance. `may_be_voids` are the bodies that may be voids of one of the two, or
/// have it as a void: a point that one of them encloses may be outside of both.
pub(super) fn judged(
    models: [&PreparedModel; 2],
    limits: &Limits,
    reach: f64,
    may_be_voids: &[&PreparedModel],
) -> Result<BodyPair> {
    let goal = |limit| Goal { tolerance: limits.tolerance, limit };
    let mut found = searched(models, goal(Some(reach)), limits.cells())?;
    let is_far = found.at_least == Some(true);
    if !is_far {
        found = searched(models, goal(None), limits.cells())?;
        let Interval { lower, upper } = found.interval;
        if lower <= limits.tolerance && limits.tolerance < upper {
            // A search with the tolerance as its limit decides whether the bodies touch.
            let decided = searched(models, goal(Some(limits.tolerance)), limits.cells())?;
            found.interval = found.interval.within(decided.interval);
            if decided.interval.upper < upper {
                found.nearest = decided.nearest;
            }
        }
    }
    let Found { interval, nearest, .. } = found;
    let (state, why, inside_both) = match of_parted(models, &found, limits, is_far) {
        Some(state) => (state, None, None),
        None => by_overlap(models, &found, limits, is_far),
    };
    let may_be_in_void = |point| may_be_voids.iter().any(|body| body.side(point) != Side::Outside);
    let (state, why, inside_both) = match inside_both {
        Some(point) if may_be_in_void(point) => (PairState::Undecided, Some(OverlapUnknown::Side), None),
        _ => (state, why, inside_both),
    };
    // Without the voids, bodies are deeper in each other.
    let measured = inside_both.filter(|_| may_be_voids.is_empty());
    let depth = measured.map(|point| depth(models, point, &nearest));
    Ok(BodyPair {
        a: String::new(),
        b: String::new(),
        state,
        clearance: if inside_both.is_some() { Interval::exactly(0.0) } else { interval },
        volume: None,
        depth,
        point: inside_both.unwrap_or(nearest.points[0].to_array()),
        intended: false,
        why,
    })
}

/// Returns the state of two bodies if a plane shows that they have no common inside; `None` if none of the planes that are
/// tried shows it. No side of a point is asked for, so that no edges are joined.
fn of_parted(models: [&PreparedModel; 2], found: &Found, limits: &Limits, is_far: bool) -> Option<PairState> {
    let &Found { interval, ref nearest, .. } = found;
    if interval.upper <= limits.tolerance {
        return are_parted_within(models, nearest, limits.tolerance).then_some(PairState::Touching);
    }
    let state = by_clearance(interval, limits, is_far)?;
    let [a, b] = models.map(PreparedModel::certified_target);
    let bodies = [a.body(models[0]), b.body(models[1])];
    are_parted(bodies, nearest.points[0] - nearest.points[1]).then_some(state)
}

/// Returns the state of two bodies that no tried plane separates; if it is undecided, the reason; if they clash, a
/// point inside both.
fn by_overlap(
    models: [&PreparedModel; 2],
    found: &Found,
    limits: &Limits,
    is_far: bool,
) -> (PairState, Option<OverlapUnknown>, Option<[f64; 3]>) {
    let &Found { interval, nearest, stop, goal, .. } = found;
    let solids = Solids::new(models, RigidTransform::IDENTITY);
    let is_late = || limits.is_over();
    let overlap = solids.and_then(|solids| solids.overlap(interval, goal, stop, &nearest, &is_late));
    let [a, b] = models;
    let one_in_other = may_be_within(a, b) || may_be_within(b, a);
    let apart = by_clearance(interval, limits, is_far);
    let or_undecided =
        |why| apart.map_or((PairState::Undecided, Some(why), None), |state| (state, None, None));
    match overlap {
        Ok(Overlap::Intersecting { inside_both } | Overlap::Contained { inside_both }) => {
            (PairState::Clash, None, Some(inside_both))
        }
        Ok(Overlap::Touching) => (PairState::Touching, None, None),
        // The clearance is that of `below` but for the tolerance, unless a budget ended the search before.
        Ok(Overlap::None) if matches!(stop, Stop::Converged | Stop::Precision) => {
            or_undecided(OverlapUnknown::Precision)
        }
        Ok(Overlap::None) => or_undecided(OverlapUnknown::Budget),
        // Without an inside of its own a body is inside the other one only if their boxes are, too.
        Err(why) if is_of_sheets(why) && interval.lower > limits.tolerance && !one_in_other => {
            or_undecided(why)
        }
        Err(why) => (PairState::Undecided, Some(why), None),
    }
}

/// Returns the state of bodies that have no common inside; `None` where the interval decides none.
fn by_clearance(interval: Interval, limits: &Limits, is_far: bool) -> Option<PairState> {
    if is_far || interval.lower >= limits.reach() {
        Some(PairState::Apart)
    } else if interval.upper <= limits.tolerance {
        Some(PairState::Touching)
    } else if interval.upper < limits.below {
        Some(PairState::Near)
    } else {
        None
    }
}

/// Returns whether nothing is known of the inside because one body has none, or is too large to be joined.
fn is_of_sheets(why: OverlapUnknown) -> bool {
    use OverlapUnknown::{AOpen, BOpen, BothOpen, TooLarge};
    matches!(why, AOpen | BOpen | BothOpen | TooLarge)
}

/// Returns whether a body may lie within another one: whether the box of that has the corners of its patches.
fn may_be_within(one: &PreparedModel, other: &PreparedModel) -> bool {
    let corners = (0..one.surface_count()).map(|surface| one.box_of_points(surface));
    other.control_box().contains(&corners.fold(Aabb::EMPTY, Aabb::union))
}

/// Searches until the goal is reached or the budget of cells is spent.
fn searched([a, b]: [&PreparedModel; 2], goal: Goal, max_cells: usize) -> Result<Found> {
    let targets = [a.certified_target(), b.certified_target()];
    let bodies = [targets[0].body(a), targets[1].body(b)];
    let mut search = Search::new(bodies, RigidTransform::IDENTITY, goal);
    let stop = loop {
        if let Some(stop) = search.advance(max_cells.saturating_sub(search.pairs()).max(1)) {
            break stop;
        }
        if search.pairs() >= max_cells && search.nearest().is_some() {
            break Stop::Cells;
        }
    };
    let nearest = search.nearest().ok_or(Error::EmptyModel)?;
    Ok(Found { interval: search.interval(), nearest, stop, goal, at_least: search.at_least() })
}
