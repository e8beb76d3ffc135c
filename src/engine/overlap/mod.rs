//! The volumes that two models have in common and apart.

mod options;
mod solids;
mod volumes;

pub use options::OverlapOptions;
pub use solids::VolumesUnknown;
pub use volumes::OverlapVolumes;

use super::clock::Clock;
use super::outlook::Outlook;
use super::query::Opened;
use super::{Computation, Engine, PreparedModel, Seconds, Stop};
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::overlap::{Pair, Search};
use crate::progress::{Monitor, Progress};
use serde::Serialize;
use solids::Solids;

/// The volumes that two models have in common and apart.
///
/// Guarantee: the volumes are in their intervals, whether or not the search converged. They are those of the patches
/// that are measured, as in [`crate::Facts`]. As JSON the names are in camelCase.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct OverlapResult {
    /// The volumes, absent where `volumes_unknown` says why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volumes: Option<OverlapVolumes>,
    /// The volume of the intersection over that of the union.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ratio: Option<Interval>,
    /// Why there are no volumes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volumes_unknown: Option<VolumesUnknown>,
    /// Whether the interval of the intersection is as narrow as requested.
    pub converged: bool,
    /// Why the search ended.
    pub stop: Stop,
    /// The permitted width of the volume of the intersection, as a fraction of that of the union.
    pub tolerance: f64,
    /// About the volume between the faces and their sources: the sum of both models' gaps and deviations times their
    /// areas. It is an estimate, and no part of the intervals.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume_of_gap: Option<f64>,
    /// Metres per unit of length here, if A or B states its unit.
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
    /// The number of pieces of patches that were compared with the other boundary.
    pub cells: usize,
    /// Where the time went.
    pub seconds: Seconds,
}

/// How long a search goes on whose width hardly falls.
#[derive(Debug, Clone, Copy)]
pub(super) struct Patience {
    /// The number of pieces after which a search ends if its width no longer falls, first as the bodies lie and then after
    /// the motion. Coincident boundaries are separated only once pieces are small enough, so that the second search needs
    /// more patience: its width falls late, and at once.
    stalled: [usize; 2],
    /// The number of pieces from which on a search is given up that is not to be expected to reach its goal within the
    /// budget: the first one for that after the motion, and that for good.
    hopeless: [usize; 2],
}

impl Patience {
    /// Of a question about volumes: the whole budget.
    pub(super) const LONG: Self = Self { stalled: [8192, 131_072], hopeless: [usize::MAX; 2] };

    /// Of a question that has others beside it.
    pub(super) const SHORT: Self = Self { stalled: [8192, 131_072], hopeless: [2048, 8192] };
}

impl Engine {
    /// Returns intervals that contain the volumes of A ∩ B, A ∪ B, A \ B and B \ A, for A moved by the options'
    /// transform, and the ratio of the first two.
    ///
    /// No boolean operation is made: the volume of the intersection is an integral over the parts of each boundary that
    /// lie within the other body, and pieces of patches that may be on either side are halved until they weigh little.
    /// The width falls as one over the square of the number of pieces, where faces that are not plane lie on each other
    /// as one over it; patches that both boundaries have are paired first, so that two revisions of a part take only
    /// what differs. Models may have several bodies that are apart, and voids.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::UnitsDiffer`]; [`Error::FacetsUnsupported`] for a cloud of points.
    /// Cancelling is a budget: the intervals so far are returned with [`Stop::Cancelled`].
    pub fn overlap<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a OverlapOptions,
    ) -> Computation<'a, OverlapResult> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.overlap_of(a, b, options, Patience::LONG, watched.monitor()).await })
        })
    }

    pub(super) async fn overlap_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &OverlapOptions,
        patience: Patience,
        monitor: &mut dyn Monitor,
    ) -> Result<OverlapResult> {
        let opened = Opened::new([a, b], options)?;
        let [a, b] = opened.models_with_faces("an overlap")?;
        let (direction, clock) = (opened.forward(), opened.clock());
        let mut result = OverlapResult {
            volumes: None,
            ratio: None,
            volumes_unknown: None,
            converged: false,
            stop: Stop::Precision,
            tolerance: options.relative_width(),
            volume_of_gap: None,
            unit: direction.unit(),
            hint: opened.hint(),
            gap: direction.gap(),
            gap_proven: direction.is_gap_proven(),
            cells: 0,
            seconds: Seconds { prepare: 0.0, compile: 0.0, solve: 0.0 },
        };
        let solids = match Solids::new([a, b], options.transform) {
            Ok(solids) => solids,
            Err(why) => return Ok(OverlapResult { volumes_unknown: Some(why), ..result }),
        };
        let placed = || [0, 1].map(|index| solids.placed(index));
        let [first, second] = placed();
        let volumes = [first.volume, second.volume];
        result.seconds.prepare = clock.seconds();
        let mut progress = Progress::new(monitor, false);
        // The union has at least the volume of the larger one.
        let larger = volumes[0].larger(volumes[1]).lower;
        let width = options.relative_width() * larger;
        let is_late = || clock.is_over();
        let (left, outlook) = (options.most_cells(), Outlook::new(patience.hopeless[0]));
        let mut budget = Budget { clock, left, outlook };
        let pair = Pair::new([first, second], width, false);
        let mut search = Search::new(&pair, &solids, patience.stalled[0], &is_late);
        result.stop = run(&mut search, width, &mut budget, &mut progress).await?;
        let mut common = search.volume();
        if (search.has_stalled() || budget.outlook.has_given_up()) && budget.left > 0 && !is_late() {
            budget.outlook = Outlook::new(patience.hopeless[1]);
            let pair = Pair::new(placed(), width, true);
            let mut search = Search::new(&pair, &solids, patience.stalled[1], &is_late);
            result.stop = run(&mut search, width, &mut budget, &mut progress).await?;
            common = common.zip(search.volume()).map(|(one, other)| one.within(other));
        }
        progress.finish();
        let Some(common) = common.filter(|common| common.lower <= common.upper) else {
            return Ok(OverlapResult { volumes_unknown: Some(VolumesUnknown::Refuted), ..result });
        };
        let found = OverlapVolumes::new(volumes, common);
        let permitted = options.relative_width() * found.union.lower;
        result.converged = found.intersection.width() <= permitted;
        if result.converged {
            result.stop = Stop::Converged;
        }
        let gaps = [a, b].map(|model| model.facts().volume_of_gap);
        result.volume_of_gap = gaps.into_iter().flatten().reduce(|a, b| a + b);
        result.ratio = Some(found.ratio(volumes));
        result.volumes = Some(found);
        result.cells = options.most_cells() - budget.left;
        result.seconds.solve = clock.seconds() - result.seconds.prepare;
        Ok(result)
    }
}

/// What is left of the budgets.
struct Budget {
    clock: Clock,
    /// The number of pieces.
    left: usize,
    outlook: Outlook,
}

/// Searches until the volume is known to this width or a budget ends the search.
async fn run(
    search: &mut Search<'_>,
    width: f64,
    budget: &mut Budget,
    progress: &mut Progress<'_>,
) -> Result<Stop> {
    let (first, most) = (search.width(), budget.left as f64);
    loop {
        let before = search.pieces();
        if !search.advance(width) {
            return Ok(Stop::Precision);
        }
        budget.left = budget.left.saturating_sub(search.pieces() - before);
        // A search that has had half of the budget is not begun anew.
        let mut is_hopeless = || budget.outlook.is_hopeless(search.pieces(), search.width(), [width, most]);
        if budget.left == 0 || budget.left > search.pieces() && is_hopeless() {
            return Ok(Stop::Cells);
        }
        if budget.clock.is_over() {
            return Ok(Stop::Time);
        }
        if progress.is_due() {
            match progress.checkpoint(fraction(first, search.width(), width)).await {
                Err(Error::Cancelled) => return Ok(Stop::Cancelled),
                other => other?,
            }
        }
    }
}

/// Returns about the part of the work that is done: the pieces needed grow as one over the width.
fn fraction(first: f64, now: f64, goal: f64) -> f64 {
    let left = |width: f64| 1.0 / width - 1.0 / first;
    let done = left(now) / left(goal);
    if done.is_finite() { done.clamp(0.0, 1.0) } else { 0.0 }
}
