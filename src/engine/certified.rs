//! One direction of method `certified`, within its budgets.

use super::clock::Clock;
use super::options::CertifiedOptions;
use super::result::DirectedResult;
use super::{Backend, CertifiedDetails, Details, DistanceOptions, PreparedModel, Stop};
use crate::certified::{
    AuditReport, BranchAndBound, Gains, Generatrix, Lemma, Pair, Refutation, audit_whole,
};
use crate::error::{Error, Result};
use crate::gpu::{Gpu, GpuCertified, Turn};
use crate::interval::{Interval, Limit};
use crate::progress::Progress;
use crate::surface_point::SurfacePoint;
use glam::DVec3;
use std::sync::Arc;
use web_time::Instant;

/// Searches until the interval is as narrow as requested or a budget ends the
/// search, and returns a notice if the GPU failed; `None` for a model without
/// patches, which validation rules out. The lengths are the larger diagonal and the sum of
/// the gaps.
///
/// Cancelling is a budget too: the interval so far is returned. Surfaces of revolution are reduced to their
/// generatrices, unless points of them refute that.
pub(super) async fn certified(
    pair: Pair<'_>,
    models: [&PreparedModel; 2],
    lengths: [f64; 2],
    options: &DistanceOptions,
    budgets: &CertifiedOptions,
    gpu: Option<&Arc<Gpu>>,
    progress: &mut Progress<'_>,
) -> Result<Option<(DirectedResult, Option<String>)>> {
    let deadline = Clock::start(budgets.max_seconds).deadline();
    let run = Run { models, lengths, options, budgets, gpu, deadline };
    let Some(generatrix) = Generatrix::new(&pair, options.width(lengths[0])) else {
        return run.search(pair, 0.0, progress).await;
    };
    let reduced = Pair { a: generatrix.operand(), ..pair };
    let Some((mut result, notice)) = run.search(reduced, generatrix.slack, progress).await? else {
        return Ok(None);
    };
    let (report, refutation) = audit_whole(&pair, result.upper, Lemma::Generatrix);
    let Some(refutation) = refutation else {
        add_report(&mut result, &report);
        return Ok(Some((result, notice)));
    };
    let again = run.search(pair, 0.0, progress).await?;
    Ok(again.map(|(mut result, notice)| {
        add_report(&mut result, &report);
        let refuted = refuted(&pair, models[0], &refutation);
        (result, Some(notice.map_or(refuted.clone(), |notice| format!("{notice}; {refuted}"))))
    }))
}

/// Adds what an audit did to that of the search.
fn add_report(result: &mut DirectedResult, report: &AuditReport) {
    if let Details::Certified(details) = &mut result.details {
        details.audit = details.audit.combined(report);
    }
}

/// A notice of a refuted bound.
fn refuted(pair: &Pair<'_>, from: &PreparedModel, refutation: &Refutation) -> String {
    let Refutation { lemma, patch, parameters, upper, distance } = *refutation;
    let patch = pair.patch_of_a(patch);
    let point = from.surface_point(patch.surface, patch.surface_parameters(parameters), DVec3::ZERO);
    let SurfacePoint { face, u, v, .. } = point;
    format!(
        "the bound {upper:?} of lemma {lemma} is refuted by the point ({u:?}, {v:?}) of face {face}, which is at least \
         {distance:?} away; the interval was computed without that lemma and is valid. This is a fault of the library: \
         please report this pair of models"
    )
}

/// One direction with its options.
struct Run<'a> {
    models: [&'a PreparedModel; 2],
    /// The larger diagonal, and the sum of the gaps.
    lengths: [f64; 2],
    options: &'a DistanceOptions,
    budgets: &'a CertifiedOptions,
    gpu: Option<&'a Arc<Gpu>>,
    deadline: Option<Instant>,
}

impl Run<'_> {
    /// Searches a pair whose points of A may be farther by `slack` than those of the operand.
    async fn search(
        &self,
        pair: Pair<'_>,
        slack: f64,
        progress: &mut Progress<'_>,
    ) -> Result<Option<(DirectedResult, Option<String>)>> {
        let Self {
            models: [from_model, to_model],
            lengths: [diagonal, gap],
            options,
            budgets,
            gpu,
            deadline,
        } = *self;
        let tolerance = options.width(diagonal);
        let limit = options.limit.map(|at| Limit { at, gap });
        let mut search = BranchAndBound::new(pair, tolerance, limit, slack);
        search.audit(budgets.audit);
        if let Some(deadline) = deadline {
            search.stop_at(deadline);
        }
        progress.section(0.0, 1.0);
        let first = search.interval();
        let mut gains = Gains::new(first);
        let needed = options.backend == Backend::Gpu;
        // Validation rules out 0.
        let max_cells = budgets.max_cells.unwrap_or(usize::MAX).max(1);
        let mut kernels = Kernels { gpu, needed, driver: None, failure: None, slowest: f64::INFINITY };
        let stop = loop {
            let cells_left = max_cells.saturating_sub(search.work().cells).max(1);
            if let Some(stop) = kernels.advance(&mut search, cells_left).await? {
                break stop;
            }
            if search.work().cells >= max_cells {
                break Stop::Cells;
            }
            if deadline.is_some_and(|deadline| Instant::now() >= deadline) {
                break Stop::Time;
            }
            if progress.is_due() {
                let interval = search.interval();
                let stalled = gains.has_stalled(interval, search.work().cells);
                progress.interval(interval.lower, interval.upper, stalled);
                match progress.checkpoint(fraction(first, interval, tolerance)).await {
                    Err(Error::Cancelled) => break Stop::Cancelled,
                    other => other?,
                }
            }
        };
        search.finish();
        let Interval { lower, upper } = search.interval();
        progress.interval(lower, upper, false);
        let Some(witness) = search.witness() else { return Ok(None) };
        let (within, work) = (search.within(), search.work());
        let is_decided = if options.limit.is_some() { within.is_some() } else { upper - lower <= tolerance };
        let stop = match stop {
            Stop::Converged if !is_decided => Stop::Precision,
            Stop::Precision if is_decided => Stop::Converged,
            other => other,
        };
        let [from, to] = search.witness_patches(witness);
        let mut notices: Vec<String> = search
            .refutations()
            .iter()
            .map(|refutation| refuted(search.pair(), from_model, refutation))
            .collect();
        notices.extend(kernels.failure.map(|error| format!("{error}; the rest was computed on the CPU")));
        let directed = DirectedResult {
            computed: witness.closest.upper,
            lower,
            upper,
            converged: stop == Stop::Converged,
            from: from_model.surface_point(
                from.surface,
                from.surface_parameters(witness.parameters),
                witness.point,
            ),
            to: to_model.surface_point(
                to.surface,
                to.surface_parameters(witness.closest.parameters),
                witness.closest.point,
            ),
            details: Details::Certified(CertifiedDetails {
                tolerance,
                min_tolerance: search.min_tolerance(),
                cells: work.cells,
                cpu_cells: work.cells - work.kernel_cells,
                levels: work.levels,
                stop,
                within,
                audit: search.audit_report(),
            }),
            deviations: Vec::new(),
        };
        Ok(Some((directed, (!notices.is_empty()).then(|| notices.join("; ")))))
    }
}

/// The progress of the width from the first to the requested one, in orders
/// of magnitude, as each takes about as long as the one before or longer.
pub(super) fn fraction(first: Interval, now: Interval, tolerance: f64) -> f64 {
    let width = |interval: Interval| (interval.upper - interval.lower).max(tolerance);
    let orders = (width(first) / tolerance).ln();
    if orders > 0.0 { ((width(first) / width(now)).ln() / orders).clamp(0.0, 1.0) } else { 1.0 }
}

/// The number of waiting cells from which on the GPU is set up, which takes tenths of a
/// second: float64 reaches this number in less.
const MIN_CELLS_FOR_SETUP: usize = 8192;

/// The number of waiting cells from which on the GPU gains more than a submission's latency.
const MIN_CELLS_FOR_SUBMISSION: usize = 512;

/// The GPU's part in a search.
struct Kernels<'a> {
    gpu: Option<&'a Arc<Gpu>>,
    /// Whether an error of the GPU ends the search; else float64 does the rest.
    needed: bool,
    driver: Option<(GpuCertified, Turn)>,
    /// The failure that ended the GPU's part early.
    failure: Option<Error>,
    /// The largest time of a cell on the GPU, in seconds: a software adapter can be slower
    /// than float64.
    slowest: f64,
}

impl Kernels<'_> {
    /// Bounds the next cells, on the GPU where they are many; `Some` when there
    /// is nothing left to do. Where float32 is not exact enough, float64 does
    /// the rest. At most `max_cells`, unless the GPU bounds them: a batch of its own
    /// size.
    async fn advance(&mut self, search: &mut BranchAndBound<'_>, max_cells: usize) -> Result<Option<Stop>> {
        let (started, before) = (Instant::now(), search.work().cells);
        let worth = if self.driver.is_some() { MIN_CELLS_FOR_SUBMISSION } else { MIN_CELLS_FOR_SETUP };
        let many = search.waiting() >= worth && search.begins_with_cell() && !search.has_undecided();
        let Some(gpu) = self.gpu.filter(|_| many) else {
            let stop = search.advance(max_cells);
            if search.work().cells > before {
                self.slowest = started.elapsed().as_secs_f64() / (search.work().cells - before) as f64;
            }
            return Ok(stop);
        };
        let first = self.driver.is_none();
        let step = self.step(gpu, search).await;
        let per_cell = started.elapsed().as_secs_f64() / (search.work().cells - before).max(1) as f64;
        // The first submission waits for the driver's compiler.
        let too_slow = !first && !self.needed && per_cell > self.slowest;
        if too_slow || !matches!(step, Ok(true)) {
            (self.gpu, self.driver) = (None, None);
        }
        match step {
            Err(error) if self.needed => return Err(error),
            Err(error) => self.failure = Some(error),
            Ok(_) => {}
        }
        Ok(None)
    }

    async fn step(&mut self, gpu: &Arc<Gpu>, search: &mut BranchAndBound<'_>) -> Result<bool> {
        if self.driver.is_none() {
            let turn = gpu.turn().await;
            self.driver = GpuCertified::new(gpu, search)?.map(|driver| (driver, turn));
        }
        let Some((driver, _)) = &mut self.driver else { return Ok(false) };
        driver.advance(search).await?;
        Ok(true)
    }
}
