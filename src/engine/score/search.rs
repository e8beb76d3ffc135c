//! The order of the work: what is cheap first, and what is required before the rest.

use super::numbers::Known;
use super::parts::{self, at_thresholds, within_least};
use super::placement::{Placed, Placement};
use super::requirements::{is_missed, judged, verdict};
use super::result::{Difference, FaceCounts, HausdorffScore, Score, ScoredModel, SurfaceScore};
use super::{ScoreNumber, ScoreOptions};
use crate::engine::clock::Clock;
use crate::engine::overlap::Patience;
use crate::engine::query::Opened;
use crate::engine::section::Section;
use crate::engine::statistics::{Asked, Sums};
use crate::engine::{
    Backend, Beyond, CertifiedOptions, Computation, DiffOptions, DistanceOptions, DistanceResult, Engine,
    Method, OverlapOptions, PreparedModel, Seconds, StatisticsOptions,
};
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::progress::Monitor;
use glam::DVec3;

/// The shares of the progress: the fit, and where each further computation starts with its length.
pub(super) const FIT_PART: f64 = 0.2;
const FORWARD_PART: [f64; 2] = [0.2, 0.3];
const REVERSE_PART: [f64; 2] = [0.5, 0.2];
const HAUSDORFF_PART: [f64; 2] = [0.85, 0.05];
const OVERLAP_PART: [f64; 2] = [0.9, 0.05];
const FACES_PART: [f64; 2] = [0.95, 0.05];

/// The pieces of patches after which the volume in common is left as it is known, after some seconds. Boundaries
/// that lie on each other without sharing their patches are never decided.
const OVERLAP_CELLS: usize = 40_000;

impl Engine {
    /// Scores a candidate against the truth: mean distances both ways, precision, recall and F1 by area, the
    /// Hausdorff distance, differences of facts, validity, each as an interval that holds it.
    ///
    /// Guarantee: every number is in its interval, for the candidate in the stated placement. Work that a
    /// certainly missed requirement ends leaves out what was not begun.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`]; [`crate::Error::OptionInvalid`]; [`crate::Error::UnitsDiffer`];
    /// [`crate::Error::NoArea`]; [`crate::Error::Cancelled`].
    pub fn score<'a>(
        &'a self,
        candidate: &'a PreparedModel,
        truth: &'a PreparedModel,
        options: &'a ScoreOptions,
    ) -> Computation<'a, Score> {
        Computation::new(move |mut watched| {
            Box::pin(async move { self.score_of(candidate, truth, options, watched.monitor()).await })
        })
    }

    async fn score_of(
        &self,
        candidate: &PreparedModel,
        truth: &PreparedModel,
        options: &ScoreOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<Score> {
        let opened = Opened::new([candidate, truth], options)?;
        let [candidate, truth] = opened.models();
        let Placed { placement, scaled } = Self::placed(candidate, truth, options, monitor).await?;
        let candidate = scaled.as_ref().unwrap_or(candidate);
        let prepare = opened.clock().seconds();
        let pair = Pair::new(self, [candidate, truth], placement.transform, options, opened.clock());
        let mut found = pair.begun(placement);
        found.hint = opened.hint();
        let mut known = pair.known_of(&found);
        let steps = [Step::Surfaces, Step::Normals, Step::Edges, Step::Hausdorff, Step::Overlap, Step::Faces];
        let (required, others): (Vec<_>, Vec<_>) =
            steps.into_iter().partition(|step| step.is_required(options));
        for step in required.into_iter().chain(others) {
            if is_missed(options, &known) {
                found.ended_early = true;
                break;
            }
            pair.advance(step, &mut found, &mut known, monitor).await?;
            // A search that is cancelled returns what it has.
            if monitor.cancelled() {
                return Err(Error::Cancelled);
            }
        }
        monitor.progress(1.0);
        found.requirements = judged(options, &known);
        found.met = verdict(&found.requirements);
        found.converged &= !found.ended_early;
        let solve = opened.clock().seconds() - prepare;
        found.seconds = Seconds { prepare, compile: 0.0, solve };
        Ok(found)
    }
}

/// The computations that take time.
#[derive(Clone, Copy)]
enum Step {
    Surfaces,
    /// After that of the surfaces, which has the thresholds.
    Normals,
    /// As normals.
    Edges,
    Hausdorff,
    Overlap,
    Faces,
}

impl Step {
    /// Whether a number is required that follows from it.
    fn is_required(self, options: &ScoreOptions) -> bool {
        let numbers: &[ScoreNumber] = match self {
            Self::Surfaces => &[
                ScoreNumber::Precision,
                ScoreNumber::Recall,
                ScoreNumber::F1,
                ScoreNumber::NormalPrecision,
                ScoreNumber::NormalRecall,
                ScoreNumber::NormalF1,
                ScoreNumber::EdgePrecision,
                ScoreNumber::EdgeRecall,
                ScoreNumber::EdgeF1,
                ScoreNumber::Chamfer,
                ScoreNumber::ChamferSquared,
            ],
            Self::Normals => {
                &[ScoreNumber::NormalPrecision, ScoreNumber::NormalRecall, ScoreNumber::NormalF1]
            }
            Self::Edges => &[ScoreNumber::EdgePrecision, ScoreNumber::EdgeRecall, ScoreNumber::EdgeF1],
            Self::Hausdorff => &[ScoreNumber::Hausdorff],
            Self::Overlap => &[ScoreNumber::Iou],
            Self::Faces => &[],
        };
        options.at_least.keys().chain(options.at_most.keys()).any(|number| numbers.contains(number))
    }
}

/// The models to be compared.
pub(super) struct Pair<'a> {
    engine: &'a Engine,
    pub(super) candidate: &'a PreparedModel,
    pub(super) truth: &'a PreparedModel,
    /// Moves the candidate.
    pub(super) transform: RigidTransform,
    pub(super) options: &'a ScoreOptions,
    clock: Clock,
    /// The diagonal of the truth's box.
    pub(super) diagonal: f64,
    tolerance: f64,
    /// The thresholds, ascending.
    limits: Vec<f64>,
}

impl<'a> Pair<'a> {
    fn new(
        engine: &'a Engine,
        [candidate, truth]: [&'a PreparedModel; 2],
        transform: RigidTransform,
        options: &'a ScoreOptions,
        clock: Clock,
    ) -> Self {
        let facts = truth.facts();
        let [low, high] = [facts.min, facts.max].map(|ends| DVec3::from_array(ends.map(|end| end.middle())));
        let diagonal = low.distance(high);
        let tolerance = options.width(diagonal);
        let limits = options.limits(diagonal);
        Self { engine, candidate, truth, transform, options, clock, diagonal, tolerance, limits }
    }

    /// Returns what facts say.
    fn begun(&self, placement: Placement) -> Score {
        let clock = self.clock;
        let is_late = move || clock.is_over();
        let candidate = ScoredModel::new(self.candidate, &self.transform, &is_late);
        let truth = ScoredModel::new(self.truth, &RigidTransform::IDENTITY, &is_late);
        let compared = |one: Option<Interval>, other: Option<Interval>| Some(Difference::new(one?, other?));
        let centroids = candidate.centroid.zip(truth.centroid);
        Score {
            placement,
            diagonal: self.diagonal,
            unit: self.candidate.unit().or(self.truth.unit()),
            hint: None,
            volume: compared(candidate.volume, truth.volume),
            area: compared(candidate.area, truth.area),
            centroid_distance: centroids.map(|(one, other)| parts::distance(one, other)),
            extent_differences: [0, 1, 2]
                .map(|axis: usize| (candidate.extents[axis] - truth.extents[axis]).absolute()),
            candidate,
            truth,
            forward: None,
            reverse: None,
            chamfer: None,
            chamfer_squared: None,
            thresholds: Vec::new(),
            edge_length: None,
            hausdorff: None,
            iou: None,
            faces: None,
            requirements: Vec::new(),
            met: None,
            ended_early: false,
            converged: true,
            tolerance: self.tolerance,
            seconds: Seconds::default(),
        }
    }

    /// Returns what facts tell about the numbers.
    fn known_of(&self, found: &Score) -> Known {
        let mut known = Known::new();
        known.narrow(ScoreNumber::Valid, Some(found.candidate.valid));
        known.narrow(ScoreNumber::VolumeRatio, found.volume.map(|volume| volume.ratio));
        known.narrow(ScoreNumber::AreaRatio, found.area.map(|area| area.ratio));
        known.narrow(ScoreNumber::CentroidDistance, found.centroid_distance);
        let [x, y, z] = found.extent_differences;
        known.narrow(ScoreNumber::ExtentDifference, Some(x.larger(y).larger(z)));
        known
    }

    async fn advance(
        &self,
        step: Step,
        found: &mut Score,
        known: &mut Known,
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        match step {
            Step::Surfaces => self.surfaces(found, known, monitor).await,
            Step::Normals => self.normals(found, known, monitor).await,
            Step::Edges => self.edges(found, known, monitor).await,
            Step::Hausdorff => self.hausdorff(found, known, monitor).await,
            Step::Overlap => self.overlap(found, known, monitor).await,
            Step::Faces => self.faces(found, monitor).await,
        }
    }

    /// Measures mean distances and parts within the thresholds, both ways; none where a direction ends early.
    async fn surfaces(&self, found: &mut Score, known: &mut Known, monitor: &mut dyn Monitor) -> Result<()> {
        let mut of_direction = Vec::new();
        for is_forward in [true, false] {
            let before = *known;
            let other = found.forward;
            let narrowed = |score: SurfaceScore, part: Option<Interval>| {
                let mut known = before;
                narrow(&mut known, is_forward, (score, other), part);
                known
            };
            let is_enough = |sums: &Sums| {
                let known = narrowed(SurfaceScore::of_sums(sums), within_least(&sums.beyond));
                is_missed(self.options, &known)
            };
            let (score, beyond, converged) = self.directed(is_forward, &is_enough, monitor).await?;
            *known = narrowed(score, within_least(&beyond));
            found.converged &= converged;
            *(if is_forward { &mut found.forward } else { &mut found.reverse }) = Some(score);
            of_direction.push(beyond);
            if is_missed(self.options, known) {
                // What the rest of this step would tell is left out.
                if is_forward {
                    return Ok(());
                }
                break;
            }
        }
        if let ([forward, reverse], Some(one), Some(other)) =
            (&of_direction[..], found.forward, found.reverse)
        {
            found.thresholds = at_thresholds(forward, reverse);
            found.chamfer = Some((one.mean + other.mean).not_negative());
            found.chamfer_squared = Some((one.mean_square + other.mean_square).not_negative());
        }
        Ok(())
    }

    /// Returns the distances of one model from the other one, the parts beyond the thresholds and whether all
    /// are as narrow as requested.
    async fn directed(
        &self,
        is_forward: bool,
        is_enough: &(dyn Fn(&Sums) -> bool + Sync),
        monitor: &mut dyn Monitor,
    ) -> Result<(SurfaceScore, Vec<Beyond>, bool)> {
        let options = StatisticsOptions {
            tolerance: Some(self.tolerance),
            percentiles: Vec::new(),
            part_tolerance: self.options.part_tolerance,
            max_cells: self.options.max_cells,
            max_seconds: self.seconds_left(),
            transform: if is_forward { self.transform } else { self.transform.inverse() },
            ..StatisticsOptions::default()
        };
        let asked = Asked { options: &options, limits: &self.limits, is_enough };
        let (from, to, part) = match is_forward {
            true => (self.candidate, self.truth, FORWARD_PART),
            false => (self.truth, self.candidate, REVERSE_PART),
        };
        let mut section = Section { whole: monitor, part };
        let (found, beyond) = self.engine.statistics_of(from, to, asked, &mut section).await?;
        Ok((SurfaceScore::new(found.mean, found.rms), beyond, found.converged))
    }

    async fn hausdorff(&self, found: &mut Score, known: &mut Known, monitor: &mut dyn Monitor) -> Result<()> {
        let budgets = CertifiedOptions { max_seconds: self.seconds_left(), ..CertifiedOptions::default() };
        let options = DistanceOptions {
            method: Method::Certified(budgets),
            tolerance: Some(self.tolerance),
            symmetric: true,
            transform: self.transform,
            backend: Backend::Cpu,
            ..DistanceOptions::default()
        };
        let mut section = Section { whole: monitor, part: HAUSDORFF_PART };
        let result = self.engine.distance_of(self.candidate, self.truth, &options, &mut section).await?;
        let of = |result: &DistanceResult| Interval { lower: result.lower, upper: result.upper };
        let directed = |result: &Option<Box<DistanceResult>>| {
            result.as_deref().map_or(Interval { lower: 0.0, upper: f64::INFINITY }, of)
        };
        found.converged &= result.converged;
        known.narrow(ScoreNumber::Hausdorff, Some(of(&result)));
        found.hausdorff = Some(HausdorffScore {
            forward: directed(&result.forward),
            reverse: directed(&result.reverse),
            distance: of(&result),
        });
        Ok(())
    }

    /// Measures the volume in common, if both models may have one.
    async fn overlap(&self, found: &mut Score, known: &mut Known, monitor: &mut dyn Monitor) -> Result<()> {
        if self.candidate.is_cloud() || self.truth.is_cloud() {
            return Ok(());
        }
        let options = OverlapOptions {
            tolerance: Some(self.options.part_tolerance),
            max_seconds: self.seconds_left(),
            max_cells: Some(self.options.max_cells.min(OVERLAP_CELLS)),
            transform: self.transform,
            ..OverlapOptions::default()
        };
        let mut section = Section { whole: monitor, part: OVERLAP_PART };
        let [a, b] = [self.candidate, self.truth];
        let result = self.engine.overlap_of(a, b, &options, Patience::SHORT, &mut section).await?;
        known.narrow(ScoreNumber::Iou, result.ratio);
        found.iou = result.ratio;
        Ok(())
    }

    /// Compares faces one by one, if the options have a limit.
    async fn faces(&self, found: &mut Score, monitor: &mut dyn Monitor) -> Result<()> {
        let Some(limit) = self.options.limit else { return Ok(()) };
        let options = DiffOptions {
            limit,
            max_seconds: self.seconds_left(),
            transform: self.transform,
            ..DiffOptions::default()
        };
        let mut section = Section { whole: monitor, part: FACES_PART };
        let diff = self.engine.diff_of_faces(self.candidate, self.truth, &options, &mut section).await?;
        found.faces = Some(FaceCounts::new(&diff));
        Ok(())
    }

    /// Returns the seconds that are left of the budget.
    pub(super) fn seconds_left(&self) -> Option<f64> {
        self.clock.left()
    }
}

/// Narrows what is known by the distances of one direction, and the part within the least threshold; the sums
/// are known from below by one direction, and by both once that of the other one is there.
fn narrow(
    known: &mut Known,
    is_forward: bool,
    (score, other): (SurfaceScore, Option<SurfaceScore>),
    part: Option<Interval>,
) {
    known.narrow(if is_forward { ScoreNumber::Precision } else { ScoreNumber::Recall }, part);
    known.derive();
    let any = Interval { lower: 0.0, upper: f64::INFINITY };
    let other = other.filter(|_| !is_forward).unwrap_or(SurfaceScore { mean: any, mean_square: any });
    known.narrow(ScoreNumber::Chamfer, Some(score.mean + other.mean));
    known.narrow(ScoreNumber::ChamferSquared, Some(score.mean_square + other.mean_square));
}
