//! The pairs of faces that come near each other.

use super::options::GapOptions;
use super::{run, witness};
use crate::clearance::{Goal, Search};
use crate::engine::query::Opened;
use crate::engine::{Computation, Engine, PreparedModel, Seconds, Stop, Witness};
use crate::error::Result;
use crate::interval::Interval;
use crate::progress::{Monitor, Progress};
use crate::sorting::sort_by_number;
use serde::Serialize;
use std::collections::BTreeMap;

/// Two faces that come near each other.
///
/// Guarantee: the least distance of their points is in `[lower, upper]`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FaceGap {
    /// A lower bound on the least distance of the two faces.
    pub lower: f64,
    /// An upper bound on the least distance of the two faces.
    pub upper: f64,
    /// Whether the interval is as narrow as requested.
    pub converged: bool,
    /// The faces, with the points that are nearest to each other.
    pub witness: Witness,
}

/// The pairs of faces of two models that come nearer to each other than a distance.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct GapsResult {
    /// The distance.
    pub below: f64,
    /// The permitted width of the intervals, in model units.
    pub tolerance: f64,
    /// The pairs, the nearest first. Every pair of faces that is not listed is farther apart than
    /// `below`; one whose interval contains `below` may be.
    pub pairs: Vec<FaceGap>,
    /// Whether all faces were compared: a budget or a cancellation did not end the search.
    pub complete: bool,
    /// The larger diagonal of the two models' control-net boxes.
    pub diagonal: f64,
    /// Metres per unit of every length here, if A or B states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
    /// units have. Nothing was scaled for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The sum of both models' gaps, as in [`crate::DistanceResult::gap`].
    pub gap: f64,
    /// Whether `gap` is an upper bound by what both readers have proven.
    pub gap_proven: bool,
    /// Where the time went.
    pub seconds: Seconds,
}

impl Engine {
    /// Returns the pairs of faces of A, moved by the options' transform, and of B that come nearer
    /// to each other than `below`, each with an interval and the two points.
    ///
    /// Guarantee: as [`GapsResult`] states, if it is complete. O(pairs of patches as near).
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`]; [`crate::Error::OptionInvalid`];
    /// [`crate::Error::UnitsDiffer`].
    pub fn gaps<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a GapOptions,
    ) -> Computation<'a, GapsResult> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.gaps_of(a, b, options, watched.monitor()).await })
        })
    }

    async fn gaps_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &GapOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<GapsResult> {
        let opened = Opened::new([a, b], options)?;
        let [a, b] = opened.models_with_faces("gaps between faces")?;
        let targets = [a.certified_target(), b.certified_target()];
        let bodies = [targets[0].body(a), targets[1].body(b)];
        let (direction, clock) = (opened.forward(), opened.clock());
        let diagonal = direction.diagonal();
        let goal = Goal { tolerance: options.search().width(diagonal), limit: None };
        let mut faces: BTreeMap<[usize; 2], Vec<[u32; 2]>> = BTreeMap::new();
        for patches in Search::pairs_within(bodies, options.transform, options.below) {
            let face = |side: usize| {
                let patch = targets[side].target.patches.patch(patches[side] as usize);
                [a, b][side].face_of(patch.surface)
            };
            faces.entry([face(0), face(1)]).or_default().push(patches);
        }
        let prepare = clock.seconds();
        let mut progress = Progress::new(monitor, false);
        let (mut pairs, mut complete) = (Vec::new(), true);
        for patches in faces.values() {
            let mut search = Search::over(bodies, options.transform, goal, patches);
            let stop = run(&mut search, &options.search(), clock, &mut progress).await?;
            let Some(nearest) = search.nearest() else { continue };
            let Interval { lower, upper } = search.interval();
            if lower <= options.below {
                let witness = witness([a, b], [&targets[0], &targets[1]], &nearest);
                pairs.push(FaceGap { lower, upper, converged: stop == Stop::Converged, witness });
            }
            if matches!(stop, Stop::Cancelled | Stop::Time) {
                complete = false;
                break;
            }
        }
        progress.finish();
        sort_by_number(&mut pairs, |pair| pair.upper);
        let (unit, gap, gap_proven) = (direction.unit(), direction.gap(), direction.is_gap_proven());
        let solve = clock.seconds() - prepare;
        let seconds = Seconds { prepare, compile: 0.0, solve };
        let (below, tolerance, hint) = (options.below, goal.tolerance, opened.hint());
        Ok(GapsResult { below, tolerance, pairs, complete, diagonal, unit, hint, gap, gap_proven, seconds })
    }
}
