//! Proves the interval of a result anew, in interval arithmetic and with none of the search's code.
//!
//! Both models are cut into Bézier patches by their definition, in intervals: the rounding of
//! everything that follows, from the knots on, is enclosed. Near points are found in float64 first;
//! what is proved holds for them whether they are the nearest or not.

mod bezier;
mod boxes;
mod closest;
pub(crate) mod cut;
mod deadline;
mod frame;
pub(crate) mod interval;
mod least;
mod surface;
mod target;
mod upper;
mod vector;

#[allow(
    unused_imports,
    reason = "the benchmarks and tests prove cuts in the time that `check` measures"
)]
pub(crate) use deadline::Deadline;
pub(crate) use frame::Motion;
pub(crate) use least::{LeastClaim, check_least};
pub(crate) use surface::{Model, Surface};
pub(crate) use upper::Witness;

use bezier::Patch;
use frame::Frame;
use std::time::{Duration, Instant};
pub(crate) use target::Side;
use target::{Comparison, Target};
use upper::Finding;

/// The pieces of B that the comparison of the witness with B looks at.
const MAX_PIECES: usize = 1_000_000;

/// What a result says.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Claim {
    pub(crate) lower: f64,
    pub(crate) upper: f64,
    /// The point of A that is said to be `lower` away from B.
    pub(crate) witness: Witness,
}

/// What a claim is checked by.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settings {
    /// The time to give up after.
    pub(crate) time: Duration,
    /// What is added to both sides of the interval before it is proved, relative to the diagonal, or
    /// to the upper end where both models are points.
    pub(crate) slack: f64,
}

/// What became of one end, or of the whole.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    Proved,
    NotProved,
    Refuted,
}

/// What became of a claim.
#[derive(Debug, Clone)]
pub(crate) struct Report {
    pub(crate) lower: Verdict,
    pub(crate) upper: Verdict,
    /// Sentences on what was seen besides: a point that refutes, a witness that is too near.
    pub(crate) notes: Vec<String>,
    /// The cells of A that were looked at.
    pub(crate) cells: usize,
}

impl Report {
    /// Of both ends: refuted if one is, proved if both are.
    pub(crate) fn verdict(&self) -> Verdict {
        let ends = [self.lower, self.upper];
        if ends.contains(&Verdict::Refuted) {
            Verdict::Refuted
        } else if ends == [Verdict::Proved; 2] {
            Verdict::Proved
        } else {
            Verdict::NotProved
        }
    }
}

/// Two models in their common frame, for comparisons of single points of A with B.
pub(crate) struct Pair {
    frame: Frame,
    patches: Vec<Patch>,
    target: Target,
}

impl Pair {
    pub(crate) fn new(a: &Model, motion: &Motion, b: &Model) -> Self {
        let frame = Frame::new(a, motion, b);
        let patches = bezier::patches(a, &frame, motion);
        let target = Target::new(bezier::patches(b, &frame, &Motion::IDENTITY));
        Self { frame, patches, target }
    }

    /// Whether A's point at these parameters is farther than `limit` from all of B: proved if it is
    /// said to be, to rounding if it is said not to be, and `None` if neither by the deadline.
    pub(crate) fn is_farther(&self, point: Witness, limit: f64, deadline: Instant) -> Option<bool> {
        let Witness { surface, u, v } = point;
        // On a knot, a point has several patches; each of their points is a point of A.
        let mut verdicts = self.verdicts(surface, [[u, v]; 2], limit, deadline, &|_, _| Side::Inside);
        let mut is_open = false;
        let farther = verdicts.any(|verdict| {
            is_open |= verdict.is_none();
            verdict == Some(true)
        });
        if farther || !is_open { Some(farther) } else { None }
    }

    /// Whether every point of A at parameters in the box `[low, high]` is farther than `limit` from
    /// the part of B that is not outside by `side`; as [`Self::is_farther`].
    pub(crate) fn is_farther_from_part(
        &self,
        surface: usize,
        parameters: [[f64; 2]; 2],
        limit: f64,
        deadline: Instant,
        side: &dyn Fn(usize, [[f64; 2]; 2]) -> Side,
    ) -> Option<bool> {
        let mut all = Some(true);
        for verdict in self.verdicts(surface, parameters, limit, deadline, side) {
            match verdict {
                Some(true) => {}
                Some(false) => return Some(false),
                None => all = None,
            }
        }
        all
    }

    /// The comparison of every patch of A that a box of parameters touches.
    fn verdicts<'a>(
        &'a self,
        surface: usize,
        parameters: [[f64; 2]; 2],
        limit: f64,
        deadline: Instant,
        side: &'a dyn Fn(usize, [[f64; 2]; 2]) -> Side,
    ) -> impl Iterator<Item = Option<bool>> + 'a {
        let limit = limit * self.frame.scale;
        let patches = self.patches.iter().filter(move |patch| patch.surface == surface);
        patches.filter_map(move |patch| {
            let point = patch.net.evaluate(patch.local(parameters)?);
            Some(match self.target.compare_part(&point, limit, MAX_PIECES, deadline, side) {
                Comparison::Farther => Some(true),
                Comparison::Nearer(_) => Some(false),
                Comparison::Open => None,
            })
        })
    }
}

/// Proves `lower - slack <= max over A of the distance to B <= upper + slack`, or the contrary.
///
/// The lower end is proved by the witness, else by any point of A that is far enough; it is refuted
/// if all of A is proved nearer. The upper end is refuted by a point of A that is proved farther.
pub(crate) fn check(a: &Model, motion: &Motion, b: &Model, claim: &Claim, settings: &Settings) -> Report {
    let deadline = Instant::now() + settings.time;
    let pair = Pair::new(a, motion, b);
    let Pair { frame, patches, target } = &pair;
    let size = if frame.diagonal > 0.0 { frame.diagonal } else { claim.upper };
    let slack = settings.slack * size;
    let mut report =
        Report { lower: Verdict::NotProved, upper: Verdict::NotProved, notes: Vec::new(), cells: 0 };
    check_lower(&mut report, &pair, claim.witness, claim.lower - slack, deadline);
    if report.lower == Verdict::Refuted && claim.lower <= claim.upper {
        // All of A was proved nearer than lower, hence than upper.
        report.upper = Verdict::Proved;
        return report;
    }
    let search = upper::prove(patches, target, (claim.upper + slack) * frame.scale, deadline);
    report.cells += search.cells;
    report.upper = match search.finding {
        Finding::Within => Verdict::Proved,
        Finding::Open => Verdict::NotProved,
        Finding::Beyond(Witness { surface, u, v }) => {
            report.notes.push(format!("upper: A's point at ({u}, {v}) of surface {surface} is farther"));
            Verdict::Refuted
        }
    };
    report
}

/// Decides the lower end.
fn check_lower(report: &mut Report, pair: &Pair, witness: Witness, limit: f64, deadline: Instant) {
    // No distance is below 0.
    if limit < 0.0 || pair.is_farther(witness, limit, deadline) == Some(true) {
        report.lower = Verdict::Proved;
        return;
    }
    let search = upper::prove(&pair.patches, &pair.target, limit * pair.frame.scale, deadline);
    report.cells += search.cells;
    report.lower = match search.finding {
        Finding::Open => Verdict::NotProved,
        Finding::Within => {
            report.notes.push("lower: all of A is nearer".to_owned());
            Verdict::Refuted
        }
        Finding::Beyond(Witness { surface, u, v }) => {
            report.notes.push(format!(
                "the witness is nearer than lower, but A's point at ({u}, {v}) of surface {surface} is not"
            ));
            Verdict::Proved
        }
    };
}
