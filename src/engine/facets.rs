//! One direction from or to a mesh or a cloud, within its budgets.

use super::certified::fraction;
use super::clock::Clock;
use super::direction::{DirectedRun, Direction};
use super::options::CertifiedOptions;
use super::prepared::PreparedTarget;
use super::result::DirectedResult;
use super::{CertifiedDetails, Details, DistanceOptions, PreparedModel, Processor, Seconds, Stop};
use crate::bezier::PatchSet;
use crate::certified::{AuditReport, Gains};
use crate::error::{Error, Result};
use crate::facets::{Certified, Domain, End, FacetSearch, Measured, PreparedFacets, Source, Start};
use crate::flatness::MAX_HALVINGS;
use crate::interval::{Interval, Limit};
use crate::progress::Progress;
use crate::rounding::gamma;
use crate::surface_point::SurfacePoint;

/// The roundings of the points of a part of a patch, for each degree, relative to the largest
/// distance of its control points from its centre: lemma R6 of docs/rounding.md.
const RESTRICTION_ROUNDINGS: f64 = 16.0;

impl PreparedModel {
    /// Returns patches of this model as A of a search over facets.
    pub(super) fn patches_as_source<'a>(&self, patches: &'a PatchSet) -> Source<'a> {
        let control_box = self.control_box();
        let degrees = patches.iter().fold(0, |most, patch| most.max(patch.degree[0] + patch.degree[1]));
        let restriction = gamma(RESTRICTION_ROUNDINGS * degrees as f64) * control_box.diagonal();
        let error = self.bezier().point_error.after(0) + restriction;
        Source::Patches { patches, error, control_box }
    }

    /// Returns this model as B of a search over facets; `patches` are its certified target where it
    /// has no facets, and `None` is returned without them.
    pub(super) fn measured<'a>(&'a self, patches: Option<&'a PreparedTarget>) -> Option<Measured<'a>> {
        match self.facets() {
            Some(PreparedFacets { target, error, .. }) => {
                Some(Measured::Facets { facets: target, error: *error })
            }
            None => patches.map(|patches| Measured::Patches {
                target: &patches.target,
                error: self.bezier().point_error.after(MAX_HALVINGS),
            }),
        }
    }

    /// Returns the point of this model that a search over facets found nearest.
    pub(super) fn point_of_b(&self, closest: &Certified) -> SurfacePoint {
        let Start { piece, parameters } = closest.start;
        match self.facets() {
            Some(_) => self.facet_point(piece, closest.weights, closest.point),
            None => self.certified_target().surface_point(self, piece, parameters, closest.point),
        }
    }
}

impl Direction<'_> {
    /// Whether the search over facets measures this direction: where B has facets, and from points.
    /// Triangles are measured to surfaces as patches, by the search over those.
    pub(super) fn is_of_facets(&self) -> bool {
        self.to.facets().is_some() || self.from.is_cloud()
    }

    /// Runs the search over facets.
    pub(super) async fn between_facets(
        &self,
        options: &DistanceOptions,
        budgets: &CertifiedOptions,
        progress: &mut Progress<'_>,
    ) -> Result<DirectedRun> {
        let clock = Clock::start(budgets.max_seconds);
        let diagonal = self.diagonal();
        let source = match self.from.facets() {
            Some(PreparedFacets { target, error, .. }) => Source::Facets { facets: target, error: *error },
            None => self.from.patches_as_source(&self.from.bezier().patches),
        };
        let patches = self.to.facets().is_none().then(|| self.to.certified_target());
        let measured = self.to.measured(patches.as_deref()).ok_or(Error::EmptyModel)?;
        let tolerance = options.width(diagonal);
        let limit = options.limit.map(|at| Limit { at, gap: self.gap() });
        let mut search = FacetSearch::new(source, measured, self.transform, tolerance, limit);
        let prepare = clock.seconds();
        let stop = search_within(&mut search, budgets, tolerance, progress).await?;
        let result = self.result(&search, stop, options, tolerance)?;
        let count = |model: &PreparedModel| match model.facets() {
            Some(facets) => facets.target.len(),
            None => model.bezier().patches.len(),
        };
        Ok(DirectedRun {
            result,
            backend: Processor::Cpu,
            adapter: None,
            notice: None,
            diagonal,
            unit: self.unit(),
            gap: self.gap(),
            is_gap_proven: self.is_gap_proven(),
            limit: options.limit,
            from_patches: count(self.from),
            to_patches: count(self.to),
            seconds: Seconds { prepare, compile: 0.0, solve: clock.seconds() - prepare },
        })
    }

    fn result(
        &self,
        search: &FacetSearch<'_>,
        stop: Stop,
        options: &DistanceOptions,
        tolerance: f64,
    ) -> Result<DirectedResult> {
        let [lower, upper] = search.interval();
        let (within, work) = (search.within(), search.work());
        let witness = search.witness().ok_or(Error::EmptyModel)?;
        let is_decided = if options.limit.is_some() { within.is_some() } else { upper - lower <= tolerance };
        let stop = match stop {
            Stop::Converged if !is_decided => Stop::Precision,
            Stop::Precision if is_decided => Stop::Converged,
            other => other,
        };
        let closest = &witness.closest;
        let to = self.to.point_of_b(closest);
        Ok(DirectedResult {
            computed: closest.upper,
            lower,
            upper,
            converged: stop == Stop::Converged,
            from: self.point_of_a(search, witness.domain, witness.point),
            to,
            details: Details::Certified(CertifiedDetails {
                tolerance,
                min_tolerance: search.min_tolerance(),
                cells: work.cells,
                cpu_cells: work.cells,
                levels: work.levels,
                stop,
                within,
                audit: AuditReport::default(),
            }),
            deviations: Vec::new(),
        })
    }

    fn point_of_a(&self, search: &FacetSearch<'_>, domain: Domain, point: glam::DVec3) -> SurfacePoint {
        match (domain, self.from.facets()) {
            (Domain::Facet(place), Some(facets)) => {
                self.from.facet_point(place, search.weights(facets.target.facet(place), point), point)
            }
            (Domain::Facet(place), None) => self.from.facet_point(place, [1.0, 0.0, 0.0], point),
            (Domain::Patch(patch, parameters), _) => {
                let patch = self.from.bezier().patches.patch(patch as usize);
                self.from.surface_point(patch.surface, patch.surface_parameters(parameters), point)
            }
        }
    }
}

/// Searches until the interval is as narrow as requested or a budget ends the search. Cancelling is
/// a budget too: the interval so far is returned.
async fn search_within(
    search: &mut FacetSearch<'_>,
    budgets: &CertifiedOptions,
    tolerance: f64,
    progress: &mut Progress<'_>,
) -> Result<Stop> {
    let clock = Clock::start(budgets.max_seconds);
    if let Some(deadline) = clock.deadline() {
        search.stop_at(deadline);
    }
    progress.section(0.0, 1.0);
    let interval = |search: &FacetSearch<'_>| {
        let [lower, upper] = search.interval();
        Interval { lower, upper }
    };
    let first = interval(search);
    let mut gains = Gains::new(first);
    // Validation rules out 0.
    let max_cells = budgets.max_cells.unwrap_or(usize::MAX).max(1);
    let stop = loop {
        match search.advance(max_cells.saturating_sub(search.work().cells)) {
            Some(End::Searched) => break Stop::Converged,
            Some(End::Exhausted) => break Stop::Precision,
            None => {}
        }
        if search.work().cells >= max_cells {
            break Stop::Cells;
        }
        if clock.is_over() {
            break Stop::Time;
        }
        if progress.is_due() {
            let interval = interval(search);
            let stalled = gains.has_stalled(interval, search.work().cells);
            progress.interval(interval.lower, interval.upper, stalled);
            match progress.checkpoint(fraction(first, interval, tolerance)).await {
                Err(Error::Cancelled) => break Stop::Cancelled,
                other => other?,
            }
        }
    };
    let Interval { lower, upper } = interval(search);
    progress.interval(lower, upper, false);
    Ok(stop)
}
