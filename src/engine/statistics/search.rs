//! The refinement of parts until the intervals are as narrow as requested.

use super::sums::Sums;
use super::{Beyond, Bounded, CertifiedStatistics, Measure, Percentile, StatisticsOptions};
use crate::area::Area;
use crate::engine::direction::Direction;
use crate::engine::{Computation, Engine, PreparedModel, Seconds};
use crate::error::{Error, Result};
use crate::facets::{
    Measured, Parts, PreparedFacets, Source, Spread, StandIn, Start, Weighted, WeightedPart,
};
use crate::progress::{Monitor, Progress};
use crate::sorting::sort_by_number;
use crate::threads::parallel::map_ranges;
use std::ops::Range;
use web_time::Instant;

/// The part of the tolerance that a mesh which stands for surfaces as B may be off. Intervals are
/// wider by twice as much, and those of percentiles by four times.
const MESH_PART: f64 = 0.1;

/// The part of the tolerance for the interval of the distance of a point.
const POINT_PART: f64 = 0.125;

/// The part of an interval's permitted width that parts which are not halved may have.
const KEPT_PART: f64 = 0.75;

/// The part of a percentile's permitted width that parts near it may have: less than half, as a
/// percentile between two parts has the width of both.
const PERCENTILE_PART: f64 = 0.45;

/// The part of the tolerance below which parts near a percentile are not halved: what still widens
/// it is a jump of the distances.
const LEAST_PERCENTILE_PART: f64 = 0.05;

/// The width of a part, in what rounding and the mesh that stands for B add to one of its ends, below
/// which it is not halved to decide on which side of the limit it is: two are no part's own.
const OPEN_ROUNDINGS: f64 = 2.5;

/// The part of an interval's permitted width that is left to the parts where a mesh that stands for
/// B takes all of it: the search then ends without convergence.
const LEAST_ROOM: f64 = 0.125;

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
            Some(stand_in(b, MESH_PART * tolerance)?)
        };
        let patches = (a.is_cloud() && b.facets().is_none()).then(|| b.certified_target());
        let (measured, excess) = match &mesh {
            Some(StandIn { mesh, error }) => (Measured::Facets { facets: mesh, error: 0.0 }, *error),
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
}

/// Returns a mesh that stands for surfaces, with an upper bound on the Hausdorff distance of both.
fn stand_in(surfaces: &PreparedModel, tolerance: f64) -> Result<StandIn> {
    let patches = &surfaces.bezier().patches;
    let length = surfaces.control_box().farthest_from_origin();
    let StandIn { mesh, error } = StandIn::new(patches, tolerance, length)?;
    Ok(StandIn { mesh, error: error + surfaces.patches_as_source(patches).error() })
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
        let mut known = Area { lower: 0.0, upper: f64::INFINITY };
        if self.over == Measure::Count {
            let gap = POINT_PART * self.tolerance;
            let points = self.bounded(progress, |place, start| self.parts.point(place, start, gap)).await?;
            let sums = Sums::of(&points, self.options, self.over, known);
            let is_narrow = self.is_narrow(&sums);
            return Ok((sums, is_narrow, points.len()));
        }
        let mut parts = self.bounded(progress, |place, start| self.parts.first(place, start)).await?;
        let mut cells = parts.len();
        loop {
            let sums = Sums::of(&parts, self.options, self.over, known);
            known = sums.total;
            if !(known.lower > 0.0) {
                return Err(Error::NoArea);
            }
            if self.is_narrow(&sums) {
                return Ok((sums, true, cells));
            }
            let mut halved = self.halved(&parts, &sums);
            halved.truncate(self.options.max_cells.saturating_sub(cells) / 2);
            let is_late =
                self.options.max_seconds.is_some_and(|most| self.started.elapsed().as_secs_f64() >= most);
            if is_late || self.halve(&mut parts, &halved, &mut cells, progress).await? == 0 {
                return Ok((sums, false, cells));
            }
        }
    }

    /// Halves the parts of these indices, and returns how many could be.
    async fn halve(
        &self,
        parts: &mut Vec<WeightedPart>,
        indices: &[usize],
        cells: &mut usize,
        progress: &mut Progress<'_>,
    ) -> Result<usize> {
        let mut count = 0;
        for page in indices.chunks(PARTS_AT_ONCE) {
            let found = map_ranges(page.len(), |range: Range<usize>| {
                page[range].iter().map(|&index| self.parts.halves(&parts[index])).collect::<Vec<_>>()
            });
            for (&index, halves) in page.iter().zip(found.into_iter().flatten()) {
                let Some([one, other]) = halves else { continue };
                parts[index] = one;
                parts.push(other);
                count += 1;
            }
            let spent = (*cells + 2 * count) as f64 / self.options.max_cells as f64;
            progress.checkpoint(spent.min(1.0)).await?;
        }
        *cells += 2 * count;
        Ok(count)
    }

    /// Returns the bounds of all points, facets or patches, each searched from the place on B that the
    /// one before found.
    async fn bounded<T: Send>(
        &self,
        progress: &mut Progress<'_>,
        bound: impl Fn(u32, Start) -> Option<(T, Start)> + Sync,
    ) -> Result<Vec<T>> {
        let count = self.parts.len();
        let mut bounded = Vec::with_capacity(count);
        while bounded.len() < count {
            let first = bounded.len();
            let found = map_ranges(PARTS_AT_ONCE.min(count - first), |range| {
                let mut start = Start::default();
                let next = |index: usize| {
                    let (one, found) = bound((first + index) as u32, start)?;
                    start = found;
                    Some(one)
                };
                range.map(next).collect::<Option<Vec<T>>>()
            });
            for found in found {
                bounded.append(&mut found.ok_or(Error::EmptyModel)?);
            }
            progress.checkpoint(0.0).await?;
        }
        Ok(bounded)
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
        let share = |part: &WeightedPart| part.weight().upper / sums.total.upper;
        let mut is_taken = vec![false; parts.len()];
        if wide(&sums.mean) || wide(&sums.rms) {
            let width = |part: &WeightedPart| {
                let Spread { mean, square, .. } = part.spread();
                let width = (mean[1] - mean[0]).max(square[1].sqrt() - square[0].sqrt());
                share(part) * (width - 2.0 * self.parts.rounding())
            };
            take_widest(parts, width, KEPT_PART * self.room(2.0), &mut is_taken);
        }
        if let Some(Beyond { limit, part }) = sums.beyond
            && part.upper - part.lower > self.options.part_tolerance
        {
            let width = |part: &WeightedPart| {
                let Spread { lower, upper, .. } = part.spread();
                // Halves of a part that is as narrow as its rounding are as open.
                let is_open = lower <= limit && limit < upper;
                if is_open && upper - lower > OPEN_ROUNDINGS * self.parts.rounding() {
                    share(part)
                } else {
                    0.0
                }
            };
            take_widest(parts, width, KEPT_PART * self.options.part_tolerance, &mut is_taken);
        }
        for Percentile { distance, .. } in sums.percentiles.iter().filter(|of| wide(&of.distance)) {
            let width = |part: &WeightedPart| {
                let Spread { lower, upper, .. } = part.spread();
                let is_near = lower < distance.upper && upper > distance.lower;
                if is_near { upper - lower - 2.0 * self.parts.rounding() } else { 0.0 }
            };
            let widest = parts.iter().map(width).fold(0.0, f64::max);
            // Where all are narrow and the percentile is not, the wider half of them goes on.
            let kept = (PERCENTILE_PART * self.room(4.0))
                .min(0.5 * widest)
                .max(LEAST_PERCENTILE_PART * self.tolerance);
            for (part, is_taken) in parts.iter().zip(&mut is_taken) {
                *is_taken |= width(part) > kept;
            }
        }
        (0..parts.len()).filter(|&index| is_taken[index]).collect()
    }

    /// Returns the permitted width that rounding, and the mesh that stands for B, leave to the parts,
    /// where they widen an interval this many times.
    fn room(&self, times: f64) -> f64 {
        (self.tolerance - times * self.parts.rounding()).max(LEAST_ROOM * self.tolerance)
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
    sort_by_number(&mut found, |one| -one.0);
    let mut left: f64 = found.iter().map(|(width, _)| width).sum();
    for (width, index) in found {
        if left <= kept {
            break;
        }
        is_taken[index] = true;
        left -= width;
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::shapes::sphere;
    use glam::DVec3;

    /// Lemma F10: the triangles are within their distance of the computed surfaces, which are within
    /// their error of the exact ones.
    #[test]
    fn a_stand_in_has_the_error_of_its_surfaces() {
        let ball = PreparedModel::new(&sphere(DVec3::ZERO, 1.0).unwrap()).unwrap();
        let of_points = ball.bezier().point_error.after(0);
        let length = ball.control_box().farthest_from_origin();
        let of_cells = StandIn::new(&ball.bezier().patches, 1e-2, length).unwrap().error;
        assert!(of_points > 0.0 && of_cells + of_points > of_cells);
        assert!(stand_in(&ball, 1e-2).unwrap().error >= of_cells + of_points);
    }
}
