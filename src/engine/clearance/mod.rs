//! The clearance of two models: the least distance of their points.

mod common_point;
mod gaps;
mod options;
mod overlap;
mod with_gaps;

pub use gaps::{FaceGap, GapsResult};
pub use options::{ClearanceOptions, GapOptions};
pub(in crate::engine) use overlap::Solids;
pub use overlap::{Overlap, OverlapUnknown};
pub use with_gaps::ClearanceWithGaps;

use super::clock::Clock;
use super::query::Opened;
use super::{Computation, Engine, PreparedModel, PreparedTarget, Seconds, Stop, Witness};
use crate::clearance::{Body, Goal, Nearest, Search};
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::progress::{Monitor, Progress};
use serde::Serialize;

/// The clearance of two models.
///
/// Guarantee: `lower <= least distance of their points <= upper`, whether the search converged or
/// not. As JSON the names are in camelCase.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct ClearanceResult {
    /// A lower bound on the least distance, 0 where the models may meet.
    pub lower: f64,
    /// An upper bound on the least distance.
    pub upper: f64,
    /// Whether the interval is as narrow as requested, or the limit is decided.
    pub converged: bool,
    /// Why the search ended.
    pub stop: Stop,
    /// With a limit: whether the clearance is at least the limit, absent if the search ended
    /// before that was known. Solids that certainly overlap have no clearance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least: Option<bool>,
    /// Whether the solids overlap, absent where `overlap_unknown` says why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<Overlap>,
    /// Why nothing is stated of an overlap.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap_unknown: Option<OverlapUnknown>,
    /// The permitted width of the interval, in model units.
    pub tolerance: f64,
    /// The least tolerance, in model units, that the rounding of these coordinates allows; the
    /// search of a smaller one stops with [`Stop::Precision`].
    pub min_tolerance: f64,
    /// Two points, one of each model, whose distance is `upper` up to rounding.
    pub witness: Witness,
    /// The larger diagonal of the two models' control-net boxes.
    pub diagonal: f64,
    /// Metres per unit of every length here, if A or B states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
    /// units have. Nothing was scaled for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The sum of both models' gaps, as in [`super::DistanceResult::gap`].
    pub gap: f64,
    /// Whether `gap` is an upper bound by what both readers have proven.
    pub gap_proven: bool,
    /// What holds for the sources, which differ from the models by up to their gaps.
    pub with_gaps: ClearanceWithGaps,
    /// The number of pairs of cells bounded.
    pub cells: usize,
    /// The number of lower bounds that corners of both cells refuted. They were not relied on; there are none, unless
    /// the library has a fault: please report the pair.
    pub refuted: usize,
    /// Where the time went.
    pub seconds: Seconds,
}

impl Engine {
    /// Returns an interval that contains the least distance of a point of A, moved by the
    /// options' transform, from a point of B, with the two points nearest to each other.
    ///
    /// Guarantee: as [`ClearanceResult`] states. The boundaries are measured: a part inside
    /// another has the distance of their surfaces. Meshes are measured as their triangles. All in float64 on the CPU, best first over
    /// pairs of nodes of both trees. O(log patches) in general position; surfaces that are
    /// equally near over an area take time with the number of cells that the tolerance needs there.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::OptionInvalid`]; [`Error::UnitsDiffer`];
    /// [`Error::FacetsUnsupported`] for a cloud of points. Cancelling is a budget: the interval so far is returned with [`Stop::Cancelled`].
    pub fn clearance<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a ClearanceOptions,
    ) -> Computation<'a, ClearanceResult> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.clearance_of(a, b, options, watched.monitor()).await })
        })
    }

    async fn clearance_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &ClearanceOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<ClearanceResult> {
        let opened = Opened::new([a, b], options)?;
        let [a, b] = opened.models_with_faces("a clearance")?;
        let targets = [a.certified_target(), b.certified_target()];
        let bodies = [targets[0].body(a), targets[1].body(b)];
        let (direction, clock) = (opened.forward(), opened.clock());
        let diagonal = direction.diagonal();
        let solids = Solids::new([a, b], options.transform);
        let prepare = clock.seconds();
        let goal = Goal { tolerance: options.width(diagonal), limit: options.limit };
        let mut search = Search::new(bodies, options.transform, goal);
        let mut progress = Progress::new(monitor, false);
        let stop = run(&mut search, options, clock, &mut progress).await?;
        progress.finish();
        let nearest = search.nearest().ok_or(Error::EmptyModel)?;
        let interval = search.interval();
        let is_late = || clock.is_over();
        let overlap = solids.and_then(|solids| solids.overlap(interval, goal, stop, &nearest, &is_late));
        let overlaps = overlap.is_ok_and(|overlap| overlap.is_overlap());
        let at_least = if overlaps { options.limit.map(|_| false) } else { search.at_least() };
        Ok(ClearanceResult {
            lower: interval.lower,
            upper: interval.upper,
            converged: stop == Stop::Converged,
            stop,
            at_least,
            overlap: overlap.ok(),
            overlap_unknown: overlap.err(),
            tolerance: goal.tolerance,
            min_tolerance: search.min_tolerance(),
            witness: witness([a, b], [&targets[0], &targets[1]], &nearest),
            diagonal,
            unit: direction.unit(),
            hint: opened.hint(),
            gap: direction.gap(),
            gap_proven: direction.is_gap_proven(),
            with_gaps: ClearanceWithGaps::new(interval, direction.gap(), options.limit, at_least),
            cells: search.pairs(),
            refuted: search.refuted(),
            seconds: Seconds { prepare, compile: 0.0, solve: clock.seconds() - prepare },
        })
    }
}

/// Searches until the goal is reached or a budget ends the search.
async fn run(
    search: &mut Search<'_>,
    options: &ClearanceOptions,
    clock: Clock,
    progress: &mut Progress<'_>,
) -> Result<Stop> {
    let max_cells = options.max_cells.unwrap_or(usize::MAX);
    loop {
        if let Some(stop) = search.advance(max_cells.saturating_sub(search.pairs()).max(1)) {
            return Ok(stop);
        }
        if search.pairs() >= max_cells && search.nearest().is_some() {
            return Ok(Stop::Cells);
        }
        if clock.is_over() && search.nearest().is_some() {
            return Ok(Stop::Time);
        }
        if progress.is_due() && search.nearest().is_some() {
            let Interval { lower, upper } = search.interval();
            progress.interval(lower, upper, false);
            match progress.checkpoint(0.0).await {
                Err(Error::Cancelled) => return Ok(Stop::Cancelled),
                other => other?,
            }
        }
    }
}

/// Returns the points of the faces that are nearest to each other.
fn witness(models: [&PreparedModel; 2], targets: [&PreparedTarget; 2], nearest: &Nearest) -> Witness {
    let [a, b] = [0, 1].map(|side| {
        let patch = targets[side].target.patches.patch(nearest.patches[side] as usize);
        let parameters = patch.surface_parameters(nearest.parameters[side]);
        models[side].surface_point(patch.surface, parameters, nearest.points[side])
    });
    Witness { a, b }
}

impl PreparedTarget {
    /// Returns the patches, which must have been cut from those of `model`, for a clearance.
    pub(in crate::engine) fn body<'a>(&'a self, model: &'a PreparedModel) -> Body<'a> {
        Body { target: &self.target, control_box: model.control_box(), point_error: self.point_error(model) }
    }
}
