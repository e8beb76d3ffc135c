//! The parts of surfaces and of feature edges that have counterparts in the other model.

mod cuts;
mod edges;
mod normals;
mod shares;

use super::ScoreNumber;
use super::numbers::Known;
use super::options::RIGHT_ANGLE;
use super::requirements::is_missed;
use super::result::{AtAngle, EdgeLengths, EdgesAt, Score};
use super::search::Pair;
use crate::engine::section::Section;
use crate::error::Result;
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::progress::Monitor;
use edges::{AskedEdges, feature_edges, matched_edges, with_none};
use normals::{AskedNormals, alike_part};

/// The shares of the progress: start and length.
const NORMALS_PART: [f64; 2] = [0.7, 0.1];
const EDGES_PART: [f64; 2] = [0.8, 0.05];

/// The parts of a surface after which the part with like counterparts is left as it is known: some seconds. Where
/// angles or distances are just what is permitted, parts are never decided.
const NORMAL_CELLS: usize = 30_000;

/// The largest total length of feature edges, as a part of the truth's diagonal, with which a model counts as one
/// without them.
const NO_EDGES: f64 = 1e-6;

/// The largest length, as a part of the truth's diagonal, of a part of an edge that is left out because a face may have
/// no normal there, as at a pole.
const POINT: f64 = 1e-7;

/// The pieces of edges after which the part with counterparts is left as it is known.
const EDGE_PIECES: usize = 100_000;

impl Pair<'_> {
    fn has_cloud(&self) -> bool {
        self.candidate.is_cloud() || self.truth.is_cloud()
    }

    /// Measures the parts of both areas with like counterparts at each threshold.
    pub(super) async fn normals(
        &self,
        found: &mut Score,
        known: &mut Known,
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        let [start, length] = NORMALS_PART;
        let each = length / (2 * found.thresholds.len().max(1)) as f64;
        for index in 0..found.thresholds.len() {
            let at = found.thresholds[index];
            let mut parts = [at.precision, at.recall];
            if self.options.normal_angle == RIGHT_ANGLE && !self.has_cloud() {
                // All planes are alike.
                found.thresholds[index].normals = Some(AtAngle::new(RIGHT_ANGLE, parts));
                continue;
            }
            for (direction, part) in parts.iter_mut().enumerate() {
                let asked = AskedNormals {
                    threshold: at.threshold,
                    angle: self.options.normal_angle.to_radians(),
                    part_tolerance: self.options.part_tolerance,
                    max_cells: self.options.max_cells.min(NORMAL_CELLS),
                    max_seconds: self.seconds_left(),
                };
                let (models, transform) = match direction {
                    0 => ([self.candidate, self.truth], self.transform),
                    _ => ([self.truth, self.candidate], self.transform.inverse()),
                };
                let done = (2 * index + direction) as f64;
                let mut section = Section { whole: monitor, part: [start + done * each, each] };
                let Some((alike, is_narrow)) = alike_part(models, transform, asked, &mut section).await?
                else {
                    return Ok(());
                };
                // No more is alike than is near.
                *part = alike.within(Interval { lower: 0.0, upper: part.upper });
                found.converged &= is_narrow;
                let numbers = [ScoreNumber::NormalPrecision, ScoreNumber::NormalRecall];
                known.narrow(numbers[direction], (index == 0).then_some(*part));
                known.derive();
                if is_missed(self.options, known) {
                    return Ok(());
                }
            }
            found.thresholds[index].normals = Some(AtAngle::new(self.options.normal_angle, parts));
        }
        Ok(())
    }

    /// Measures the parts of the feature edges with counterparts at each threshold.
    pub(super) async fn edges(
        &self,
        found: &mut Score,
        known: &mut Known,
        monitor: &mut dyn Monitor,
    ) -> Result<()> {
        let angle = self.options.feature_angle.to_radians();
        let of = |model, transform| feature_edges(model, transform, [angle, POINT * self.diagonal]);
        let both = of(self.candidate, self.transform).zip(of(self.truth, RigidTransform::IDENTITY));
        let Some((candidate, truth)) = both else { return Ok(()) };
        let [start, length] = EDGES_PART;
        let each = length / (2 * found.thresholds.len().max(1)) as f64;
        let least = NO_EDGES * self.diagonal;
        for index in 0..found.thresholds.len() {
            let mut both = Vec::new();
            for (direction, pair) in [[&candidate, &truth], [&truth, &candidate]].into_iter().enumerate() {
                let asked = AskedEdges {
                    threshold: found.thresholds[index].threshold,
                    part_tolerance: self.options.part_tolerance,
                    max_pieces: self.options.max_cells.min(EDGE_PIECES),
                    max_seconds: self.seconds_left(),
                    least,
                };
                let done = (2 * index + direction) as f64;
                let mut section = Section { whole: monitor, part: [start + done * each, each] };
                both.push(matched_edges(pair, asked, &mut section).await?);
            }
            let [one, other] = &both[..] else { return Ok(()) };
            let parts = [with_none([one, other], least), with_none([other, one], least)];
            found.converged &= one.is_narrow && other.is_narrow;
            found.thresholds[index].edges = Some(EdgesAt::new(parts));
            if index > 0 {
                continue;
            }
            known.narrow(ScoreNumber::EdgePrecision, Some(parts[0]));
            known.narrow(ScoreNumber::EdgeRecall, Some(parts[1]));
            known.derive();
            let feature_angle = self.options.feature_angle;
            found.edge_length =
                Some(EdgeLengths { feature_angle, candidate: one.length, truth: other.length });
            if is_missed(self.options, known) {
                return Ok(());
            }
        }
        Ok(())
    }
}
