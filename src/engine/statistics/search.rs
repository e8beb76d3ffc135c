//! The refinement of parts until the intervals are as narrow as requested.

use super::audited::audit;
use super::cover::{Cells, Cover};
use super::pages::{bounded, halve_page};
use super::sums::Sums;
use super::{Beyond, CertifiedStatistics, Measure, Percentile, StatisticsOptions};
use crate::area::Area;
use crate::certified::{AuditReport, Pair};
use crate::engine::clock::Clock;
use crate::engine::outlook::Outlook;
use crate::engine::query::Opened;
use crate::engine::{Computation, Engine, PreparedModel, Seconds};
use crate::error::{Error, Result};
use crate::facets::{Parts, PreparedFacets, Source, Spread, Start, Weighted};
use crate::interval::Interval;
use crate::progress::{Monitor, Progress};
use crate::sorting::sort_by_number;
use std::ops::Range;

/// The part of the tolerance within which a cell is taken to lie on surfaces: it is never halved.
const WHOLE_PART: f64 = 0.125;

/// The part of the tolerance for the interval of the distance of a point.
const POINT_PART: f64 = 0.125;

/// The part of an interval's permitted width that parts which are not halved may have.
const KEPT_PART: f64 = 0.75;

/// The part of a percentile's permitted width that parts near it may have: less than half, as a
/// percentile between two parts has the width of both.
const PERCENTILE_PART: f64 = 0.45;

/// The share of the area that parts near a percentile may have however wide they are, in units of the
/// tolerance of parts, while there are others to halve: where distances jump, no number of parts makes the
/// percentile narrow.
const LEVEL_PART: f64 = 0.25;

/// The part of the tolerance below which parts near a percentile are not halved: what still widens
/// it is a jump of the distances.
const LEAST_PERCENTILE_PART: f64 = 0.05;

/// The width of a part, in what rounding adds to one of its ends, below which it is not halved to decide
/// on which side of the limit it is: two are no part's own.
const OPEN_ROUNDINGS: f64 = 2.5;

/// The part of an interval's permitted width that is left to the parts where rounding takes all of it:
/// the search then ends without convergence.
const LEAST_ROOM: f64 = 0.125;

/// The share of the largest urgency below which parts wait. Some parts are wider than others by orders of magnitude: they
/// are halved many times before all the others are halved once.
const URGENT_SHARE: f64 = 0.125;

/// The parts from which on none is halved for a limit whose part beyond is not to be expected to become narrow: where faces
/// are just as far as the limit.
const PATIENCE: usize = 8192;

/// The number of parts between two checkpoints, and where there is a limit of time, which each of them looks at.
const PARTS_AT_ONCE: usize = 4096;
const TIMED_PARTS_AT_ONCE: usize = 256;

impl Engine {
    /// Returns statistics of the distances from the points of A, moved by the options' transform, to
    /// B: of a cloud by count, else by area.
    ///
    /// Guarantee: every number is in its interval. Parts of A are bounded and halved until the
    /// intervals are as narrow as requested or a budget is spent.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`]; [`Error::OptionInvalid`]; [`Error::UnitsDiffer`];
    /// [`Error::NoArea`] for an A whose area may be 0; [`Error::Cancelled`].
    pub fn statistics<'a>(
        &'a self,
        a: &'a PreparedModel,
        b: &'a PreparedModel,
        options: &'a StatisticsOptions,
    ) -> Computation<'a, CertifiedStatistics> {
        Computation::new(move |mut watched| {
            Box::pin(async move {
                let limits: Vec<f64> = options.limit.into_iter().collect();
                let asked = Asked { options, limits: &limits, is_enough: &|_| false };
                let (found, beyond) = self.statistics_of(a, b, asked, watched.monitor()).await?;
                Ok(CertifiedStatistics { beyond: beyond.first().copied(), ..found })
            })
        })
    }

    /// As [`Engine::statistics`], with the parts beyond each of the limits asked for.
    pub(in crate::engine) async fn statistics_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        asked: Asked<'_>,
        monitor: &mut dyn Monitor,
    ) -> Result<(CertifiedStatistics, Vec<Beyond>)> {
        let options = asked.options;
        let opened = Opened::new([a, b], options)?;
        let [a, b] = opened.models();
        let mut progress = Progress::new(monitor, false);
        let (direction, clock) = (opened.forward(), opened.clock());
        let diagonal = direction.diagonal();
        let tolerance = options.width(diagonal);
        let over = if a.is_cloud() { Measure::Count } else { Measure::Area };
        let search = Search { over, tolerance, asked, clock };
        let prepare = || clock.seconds();
        let (prepare, found) = if over == Measure::Area && b.facets().is_none() {
            let (from, to) = (a.certified_target(), b.certified_target());
            let pair = Pair { a: from.operand(a), b: to.operand(b), transform: options.transform };
            let triangles = a.facets().map(|facets| (&facets.target, facets.error));
            let mut cover = Cells::new(pair, triangles, search.sufficient());
            (prepare(), search.audited(&mut cover, &mut progress).await?)
        } else {
            let patches = b.facets().is_none().then(|| b.certified_target());
            let measured = b.measured(patches.as_deref()).ok_or(Error::EmptyModel)?;
            let source = match a.facets() {
                Some(PreparedFacets { target, error, .. }) => {
                    Source::Facets { facets: target, error: *error }
                }
                None => a.patches_as_source(&a.bezier().patches),
            };
            let mut parts = Parts::new(source, measured, options.transform, search.sufficient());
            let prepare = prepare();
            (
                prepare,
                match over {
                    Measure::Count => search.count(&parts, &mut progress).await?,
                    Measure::Area => search.audited(&mut parts, &mut progress).await?,
                },
            )
        };
        progress.finish();
        let Found { sums, converged, cells, audit, notice } = found;
        let found = CertifiedStatistics {
            over,
            total: Interval { lower: sums.total.lower, upper: sums.total.upper },
            mean: sums.mean,
            rms: sums.rms,
            percentiles: sums.percentiles,
            beyond: None,
            converged,
            tolerance,
            diagonal,
            unit: direction.unit(),
            hint: opened.hint(),
            cells,
            audit,
            notice,
            seconds: Seconds { prepare, compile: 0.0, solve: clock.seconds() - prepare },
        };
        Ok((found, sums.beyond))
    }
}

/// A question about several limits.
#[derive(Clone, Copy)]
pub(in crate::engine) struct Asked<'a> {
    /// The options, whose limit is not read.
    pub(in crate::engine) options: &'a StatisticsOptions,
    pub(in crate::engine) limits: &'a [f64],
    /// Whether intervals suffice that are wider than requested.
    pub(in crate::engine) is_enough: &'a (dyn Fn(&Sums) -> bool + Sync),
}

struct Search<'a> {
    over: Measure,
    tolerance: f64,
    asked: Asked<'a>,
    clock: Clock,
}

/// Intervals, whether they are narrow enough, the number of parts, and what their audit found.
struct Found {
    sums: Sums,
    converged: bool,
    cells: usize,
    audit: AuditReport,
    notice: Option<String>,
}

impl Search<'_> {
    /// The distance within which a part is near enough to be decided whole, and within every limit too.
    fn sufficient(&self) -> f64 {
        let limits = self.asked.limits.iter().filter(|limit| **limit > 0.0);
        limits.fold(WHOLE_PART * self.tolerance, |least, &limit| least.min(limit))
    }

    fn sums<T: Weighted>(&self, parts: &[T], known: Area) -> Sums {
        Sums::of(parts, (self.asked.limits, &self.asked.options.percentiles), self.over, known)
    }

    /// Returns the intervals of a cloud. Points have certified distances of their own, which nothing is to be
    /// compared with.
    async fn count(&self, parts: &Parts<'_>, progress: &mut Progress<'_>) -> Result<Found> {
        let gap = POINT_PART * self.tolerance;
        let points = bounded(parts.len(), self.at_once(), progress, |range| {
            let mut start = Start::default();
            let next = |index: usize| {
                if self.is_late() {
                    return Some(parts.unmeasured_point());
                }
                let (point, found) = parts.point(index as u32, start, gap)?;
                start = found;
                Some(point)
            };
            range.map(next).collect()
        });
        let points = points.await?;
        let known = Area { lower: 0.0, upper: f64::INFINITY };
        let sums = self.sums(&points, known);
        let converged = self.is_narrow(&sums);
        let (cells, audit) = (points.len(), AuditReport::default());
        Ok(Found { sums, converged, cells, audit, notice: None })
    }

    /// Returns the intervals, whose parts are audited: where one is refuted, those without the lemma.
    async fn audited<C: Cover>(&self, cover: &mut C, progress: &mut Progress<'_>) -> Result<Found> {
        let mut report = AuditReport::default();
        let (parts, (sums, converged, cells)) = self.run(cover, progress).await?;
        let notice = audit(cover, &parts, self.asked.options.audit, &mut report);
        if notice.is_none() {
            return Ok(Found { sums, converged, cells, audit: report, notice });
        }
        cover.strike();
        let (_, (sums, converged, cells)) = self.run(cover, progress).await?;
        Ok(Found { sums, converged, cells, audit: report, notice })
    }

    /// Returns the parts that the intervals rest on, the intervals, whether they are narrow enough, and the number
    /// of parts bounded.
    async fn run<C: Cover>(
        &self,
        cover: &C,
        progress: &mut Progress<'_>,
    ) -> Result<(Vec<C::Part>, (Sums, bool, usize))> {
        let mut known = Area { lower: 0.0, upper: f64::INFINITY };
        let first = |range: Range<usize>| cover.first(range, &|| self.is_late());
        let mut parts = bounded(cover.len(), self.at_once(), progress, first).await?;
        let mut cells = parts.len();
        let mut outlooks = vec![Outlook::new(PATIENCE); self.asked.limits.len()];
        loop {
            let sums = self.sums(&parts, known);
            known = sums.total;
            if !(known.lower > 0.0) {
                return Err(Error::NoArea);
            }
            if self.is_narrow(&sums) {
                return Ok((parts, (sums, true, cells)));
            }
            if (self.asked.is_enough)(&sums) {
                return Ok((parts, (sums, false, cells)));
            }
            let open = self.open_limits(&sums, &mut outlooks, cells);
            let mut halved = self.halved(&parts, cover.rounding(), (&sums, &open), LEVEL_PART);
            if halved.is_empty() {
                halved = self.halved(&parts, cover.rounding(), (&sums, &open), 0.0);
            }
            halved.truncate(self.asked.options.max_cells.saturating_sub(cells) / 2);
            if self.is_late() || self.halve(cover, &mut parts, &halved, &mut cells, progress).await? == 0 {
                return Ok((parts, (sums, false, cells)));
            }
        }
    }

    /// The number of parts between two looks at the time.
    fn at_once(&self) -> usize {
        if self.asked.options.max_seconds.is_some() { TIMED_PARTS_AT_ONCE } else { PARTS_AT_ONCE }
    }

    fn is_late(&self) -> bool {
        self.clock.is_over()
    }

    /// Halves the parts of these indices until the time is spent, and returns how many could be.
    async fn halve<C: Cover>(
        &self,
        cover: &C,
        parts: &mut Vec<C::Part>,
        indices: &[usize],
        cells: &mut usize,
        progress: &mut Progress<'_>,
    ) -> Result<usize> {
        let mut count = 0;
        for page in indices.chunks(self.at_once()) {
            if self.is_late() {
                break;
            }
            count += halve_page(parts, page, |part| if self.is_late() { None } else { cover.halves(part) });
            let spent = (*cells + 2 * count) as f64 / self.asked.options.max_cells as f64;
            progress.checkpoint(spent.min(1.0)).await?;
        }
        *cells += 2 * count;
        Ok(count)
    }

    fn is_narrow(&self, sums: &Sums) -> bool {
        let is_narrow = |of: &Interval| of.upper - of.lower <= self.tolerance;
        is_narrow(&sums.mean)
            && is_narrow(&sums.rms)
            && sums.percentiles.iter().all(|percentile| is_narrow(&percentile.distance))
            && sums.beyond.iter().all(|beyond| !self.is_open(beyond))
    }

    /// Whether the part beyond a limit is wider than requested.
    fn is_open(&self, beyond: &Beyond) -> bool {
        beyond.part.upper - beyond.part.lower > self.asked.options.part_tolerance
    }

    /// Returns the limits whose parts beyond are wider than requested, and may be expected to become narrow.
    fn open_limits(&self, sums: &Sums, outlooks: &mut [Outlook], cells: usize) -> Vec<f64> {
        let goal = [self.asked.options.part_tolerance, self.asked.options.max_cells as f64];
        let limit = |(beyond, outlook): (&Beyond, &mut Outlook)| {
            let width = beyond.part.upper - beyond.part.lower;
            let is_open = self.is_open(beyond) && !outlook.is_hopeless(cells, width, goal);
            is_open.then_some(beyond.limit)
        };
        sums.beyond.iter().zip(outlooks).filter_map(limit).collect()
    }

    /// Returns the parts that widen the intervals which are too wide most, the widest first. Any
    /// choice is valid: it decides only the number of parts. Parts near percentiles are left alone where they have
    /// `level` of the tolerance of parts together.
    fn halved<T: Weighted>(
        &self,
        parts: &[T],
        rounding: f64,
        (sums, limits): (&Sums, &[f64]),
        level: f64,
    ) -> Vec<usize> {
        let wide = |of: &Interval| of.upper - of.lower > self.tolerance;
        let share = |part: &T| part.weight().upper / sums.total.upper;
        let mut urgency = vec![0.0; parts.len()];
        let kept = KEPT_PART * self.room(2.0 * rounding);
        if wide(&sums.mean) {
            let width = |part: &T| {
                let [lower, upper] = part.spread().mean;
                share(part) * (upper - lower - 2.0 * rounding)
            };
            take_widest(parts, width, kept, &mut urgency);
        }
        if wide(&sums.rms) {
            // The difference of two roots is that of the squares by their sum.
            let sum = sums.rms.lower + sums.rms.upper;
            let width = |part: &T| {
                let [lower, upper] = part.spread().square;
                share(part) * (upper - lower - 4.0 * rounding * upper.sqrt()) / sum
            };
            take_widest(parts, width, kept, &mut urgency);
        }
        for &limit in limits {
            let width = |part: &T| {
                let Spread { lower, upper, .. } = part.spread();
                // Halves of a part that is as narrow as its rounding are as open.
                let [certain, possible] = part.beyond(limit);
                if upper - lower > OPEN_ROUNDINGS * rounding {
                    share(part) * (possible - certain)
                } else {
                    0.0
                }
            };
            take_widest(parts, width, KEPT_PART * self.asked.options.part_tolerance, &mut urgency);
        }
        for Percentile { distance, .. } in sums.percentiles.iter().filter(|of| wide(&of.distance)) {
            let width = |part: &T| {
                let Spread { lower, upper, .. } = part.spread();
                let is_near = lower < distance.upper && upper > distance.lower;
                if is_near { part.thickness() - 2.0 * rounding } else { 0.0 }
            };
            let widest = parts.iter().map(width).fold(0.0, f64::max);
            // Where all are narrow and the percentile is not, the wider half of them goes on.
            let kept = (PERCENTILE_PART * self.room(4.0 * rounding))
                .min(0.5 * widest)
                .max(LEAST_PERCENTILE_PART * self.tolerance);
            let open = |part: &T| if width(part) > kept { share(part) } else { 0.0 };
            take_widest(parts, open, level * self.asked.options.part_tolerance, &mut urgency);
        }
        let mut halved: Vec<(f64, usize)> =
            urgency.into_iter().zip(0..).filter(|(urgency, _)| *urgency > 0.0).collect();
        sort_by_number(&mut halved, |one| -one.0);
        let least = halved.first().map_or(0.0, |widest| URGENT_SHARE * widest.0);
        halved.into_iter().take_while(|one| one.0 >= least).map(|(_, index)| index).collect()
    }

    /// Returns the permitted width that is left to the parts where so much of it is taken.
    fn room(&self, taken: f64) -> f64 {
        (self.tolerance - taken).max(LEAST_ROOM * self.tolerance)
    }
}

/// Takes the parts of the largest widths, until the sum of the others is at most `kept`; their urgency is
/// at least their width in units of `kept`.
fn take_widest<T>(parts: &[T], width: impl Fn(&T) -> f64, kept: f64, urgency: &mut [f64]) {
    let mut found: Vec<(f64, usize)> =
        parts.iter().map(width).zip(0..).filter(|(width, _)| *width > 0.0).collect();
    sort_by_number(&mut found, |one| -one.0);
    let mut left: f64 = found.iter().map(|(width, _)| width).sum();
    for (width, index) in found {
        if left <= kept {
            break;
        }
        urgency[index] = urgency[index].max(width / kept);
        left -= width;
    }
}
