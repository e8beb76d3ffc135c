//! The refinement of parts until the intervals are as narrow as requested.

use super::sums::Sums;
use super::{Beyond, Bounded, CertifiedStatistics, Measure, Percentile, StatisticsOptions};
use crate::engine::direction::Direction;
use crate::engine::{Computation, DistanceOptions, Engine, PreparedModel, Seconds};
use crate::error::{Error, Result};
use crate::facets::{Facets, Measured, Parts, PreparedFacets, Source, Start, TriangleMesh, WeightedPart};
use crate::progress::{Monitor, Progress};
use crate::tessellate::{TessellationOptions, tessellate_patches};
use crate::threads::parallel::map_ranges;
use glam::DVec3;
use std::ops::Range;
use web_time::Instant;

/// The part of the tolerance that a mesh which stands for surfaces as B is made with.
const MESH_PART: f64 = 0.03125;

/// The part of the tolerance that it has to be within of the surfaces: more, so that this is soon
/// decided. Intervals are wider by twice as much.
const MESH_ERROR_PART: f64 = 0.0625;

/// The part of the tolerance for the interval of the distance of a point.
const POINT_PART: f64 = 0.125;

/// The part of an interval's permitted width that parts which are not halved may have.
const KEPT_PART: f64 = 0.75;

/// The part of it that parts near a percentile may have: less than half, as a percentile between two
/// parts has the width of both.
const PERCENTILE_PART: f64 = 0.45;

/// The number of parts between two checkpoints.
const PARTS_AT_ONCE: usize = 4096;

impl Engine {
    /// Returns statistics of the distances from the points of A, moved by the options' transform, to
    /// B: of a cloud by count, else by area.
    ///
    /// Guarantee: every number is in its interval. Parts of A are bounded and halved until the
    /// intervals are as narrow as requested or a budget is spent. Surfaces as B are replaced by a
    /// mesh, and its certified distance from them widens the intervals, unless A is a cloud.
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
            Box::pin(async move { self.statistics_of(a, b, options, watched.monitor()).await })
        })
    }

    async fn statistics_of(
        &self,
        a: &PreparedModel,
        b: &PreparedModel,
        options: &StatisticsOptions,
        monitor: &mut dyn Monitor,
    ) -> Result<CertifiedStatistics> {
        options.validate()?;
        let scaled = b.in_unit_of(a, options.scale_units)?;
        let b = scaled.as_deref().unwrap_or(b);
        let mut progress = Progress::new(monitor, false);
        let started = Instant::now();
        let direction = Direction { from: a, to: b, transform: options.transform };
        let diagonal = direction.diagonal();
        let tolerance = options.width(diagonal);
        let mesh = if b.facets().is_some() || a.is_cloud() {
            None
        } else {
            Some(self.stand_in(b, tolerance).await?)
        };
        let patches = (a.is_cloud() && b.facets().is_none()).then(|| b.certified_target());
        let (measured, excess) = match &mesh {
            Some((mesh, error)) => {
                let PreparedFacets { target, error: rounding, .. } =
                    mesh.facets().ok_or(Error::EmptyModel)?;
                (Measured::Facets { facets: target, error: *rounding }, *error)
            }
            None => (b.measured(patches.as_deref()).ok_or(Error::EmptyModel)?, 0.0),
        };
        let source = match a.facets() {
            Some(PreparedFacets { target, error, .. }) => Source::Facets { facets: target, error: *error },
            None => a.patches_as_source(&a.bezier().patches),
        };
        let over = if a.is_cloud() { Measure::Count } else { Measure::Area };
        let search = Search {
            over,
            parts: Parts::new(source, measured, options.transform, excess),
            tolerance,
            options,
            started,
        };
        let prepare = started.elapsed().as_secs_f64();
        let (sums, converged, cells) = search.run(&mut progress).await?;
        progress.finish();
        Ok(CertifiedStatistics {
            over,
            total: Bounded { lower: sums.total.lower, upper: sums.total.upper },
            mean: sums.mean,
            rms: sums.rms,
            percentiles: sums.percentiles,
            beyond: sums.beyond,
            converged,
            tolerance,
            diagonal,
            unit: direction.unit(),
            cells,
            seconds: Seconds { prepare, compile: 0.0, solve: started.elapsed().as_secs_f64() - prepare },
        })
    }

    /// Returns a mesh that stands for surfaces, and an upper bound on the Hausdorff distance of both.
    async fn stand_in(&self, surfaces: &PreparedModel, tolerance: f64) -> Result<(PreparedModel, f64)> {
        let options =
            TessellationOptions { tolerance: Some(MESH_PART * tolerance), relative_tolerance: None };
        let made = tessellate_patches(surfaces.bezier(), surfaces.pieces(), &options)?;
        let vertex = |position: &[f32; 3]| DVec3::from_array(position.map(f64::from)) + made.origin;
        let vertices: Vec<DVec3> = made.positions.as_chunks::<3>().0.iter().map(vertex).collect();
        let mesh = Facets::Mesh(TriangleMesh::of_indices(&vertices, &made.indices)?);
        let mesh = PreparedModel::of_facets(&mesh, surfaces.unit())?;
        let options = DistanceOptions {
            limit: Some(MESH_ERROR_PART * tolerance),
            symmetric: true,
            ..DistanceOptions::default()
        };
        let error = self.distance(surfaces, &mesh, &options).await?.upper;
        Ok((mesh, error))
    }
}

struct Search<'a> {
    parts: Parts<'a>,
    over: Measure,
    tolerance: f64,
    options: &'a StatisticsOptions,
    started: Instant,
}

impl Search<'_> {
    /// Returns the intervals, whether they are narrow enough, and the number of parts bounded.
    async fn run(&self, progress: &mut Progress<'_>) -> Result<(Sums, bool, usize)> {
        let mut parts = self.first(progress).await?;
        let mut cells = parts.len();
        loop {
            let sums = Sums::of(&parts, self.options, self.over);
            if !(sums.total.lower > 0.0) {
                return Err(Error::NoArea);
            }
            let halved = self.halved(&parts, &sums);
            let is_over =
                self.options.max_seconds.is_some_and(|most| self.started.elapsed().as_secs_f64() >= most);
            if self.is_narrow(&sums) {
                return Ok((sums, true, cells));
            }
            let most = self.options.max_cells.saturating_sub(cells) / 2;
            let halved = &halved[..halved.len().min(most)];
            if halved.is_empty() || is_over {
                return Ok((sums, false, cells));
            }
            let before = cells;
            for page in halved.chunks(PARTS_AT_ONCE) {
                let found = map_ranges(page.len(), |range: Range<usize>| {
                    page[range].iter().map(|&index| self.parts.halves(&parts[index])).collect::<Vec<_>>()
                });
                for (&index, halves) in page.iter().zip(found.into_iter().flatten()) {
                    let Some([one, other]) = halves else { continue };
                    parts[index] = one;
                    parts.push(other);
                    cells += 2;
                }
                progress.checkpoint((cells as f64 / self.options.max_cells as f64).min(1.0)).await?;
            }
            if cells == before {
                return Ok((sums, false, cells));
            }
        }
    }

    /// Returns the bounds of all facets or patches.
    async fn first(&self, progress: &mut Progress<'_>) -> Result<Vec<WeightedPart>> {
        let count = self.parts.len();
        let mut parts = Vec::with_capacity(count);
        while parts.len() < count {
            let first = parts.len();
            let found = map_ranges(PARTS_AT_ONCE.min(count - first), |range| {
                let mut start = Start::default();
                range
                    .map(|index| {
                        let gap = POINT_PART * self.tolerance;
                        let (part, found) = self.parts.first((first + index) as u32, start, gap)?;
                        start = found;
                        Some(part)
                    })
                    .collect::<Option<Vec<_>>>()
            });
            for found in found {
                parts.append(&mut found.ok_or(Error::EmptyModel)?);
            }
            progress.checkpoint(0.0).await?;
        }
        Ok(parts)
    }

    fn is_narrow(&self, sums: &Sums) -> bool {
        let is_narrow = |of: &Bounded| of.upper - of.lower <= self.tolerance;
        is_narrow(&sums.mean)
            && is_narrow(&sums.rms)
            && sums.percentiles.iter().all(|percentile| is_narrow(&percentile.distance))
            && sums
                .beyond
                .is_none_or(|beyond| beyond.part.upper - beyond.part.lower <= self.options.part_tolerance)
    }

    /// Returns the parts that widen the intervals which are too wide. Any choice is valid: it decides
    /// only the number of parts.
    fn halved(&self, parts: &[WeightedPart], sums: &Sums) -> Vec<usize> {
        let wide = |of: &Bounded| of.upper - of.lower > self.tolerance;
        let share = |part: &WeightedPart| part.weight.upper / sums.total.upper;
        let mut is_taken = vec![false; parts.len()];
        if wide(&sums.mean) || wide(&sums.rms) {
            let width = |part: &WeightedPart| {
                let root = part.spread.square[1].sqrt() - part.spread.square[0].sqrt();
                share(part) * (part.spread.mean[1] - part.spread.mean[0]).max(root)
            };
            take_widest(parts, width, KEPT_PART * self.tolerance, &mut is_taken);
        }
        if let Some(Beyond { limit, part }) = sums.beyond
            && part.upper - part.lower > self.options.part_tolerance
        {
            let width = |part: &WeightedPart| {
                let is_open = part.spread.lower <= limit && limit < part.spread.upper;
                if is_open { share(part) } else { 0.0 }
            };
            take_widest(parts, width, KEPT_PART * self.options.part_tolerance, &mut is_taken);
        }
        for Percentile { distance, .. } in sums.percentiles.iter().filter(|of| wide(&of.distance)) {
            for (part, is_taken) in parts.iter().zip(&mut is_taken) {
                let [low, high] = [part.spread.lower, part.spread.upper];
                let is_near = low < distance.upper && high > distance.lower;
                *is_taken |= is_near && high - low > PERCENTILE_PART * self.tolerance;
            }
        }
        (0..parts.len()).filter(|&index| is_taken[index]).collect()
    }
}

/// Takes the parts of the largest widths, until the sum of the others is at most `kept`.
fn take_widest(
    parts: &[WeightedPart],
    width: impl Fn(&WeightedPart) -> f64,
    kept: f64,
    is_taken: &mut [bool],
) {
    let mut found: Vec<(f64, usize)> =
        parts.iter().map(width).zip(0..).filter(|(width, _)| *width > 0.0).collect();
    found.sort_by(|one, other| other.0.total_cmp(&one.0));
    let mut left: f64 = found.iter().map(|(width, _)| width).sum();
    for (width, index) in found {
        if left <= kept {
            break;
        }
        is_taken[index] = true;
        left -= width;
    }
}
