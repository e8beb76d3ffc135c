//! The options of a score.

use super::{Score, ScoreNumber};
use crate::engine::options::at_least_zero;
use crate::engine::query::{Query, impl_query};
use crate::error::{Error, Result};
use crate::model::RigidTransform;
use crate::tolerance::positive;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The default width of lengths, as a fraction of the truth's diagonal.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-3;

/// The default of [`ScoreOptions::part_tolerance`].
const DEFAULT_PART_TOLERANCE: f64 = 1e-3;

/// The default of [`ScoreOptions::max_cells`]: that of statistics.
const DEFAULT_MAX_CELLS: usize = 300_000;

/// The threshold unless the options name one, as a fraction of the truth's diagonal: that of CADGenBench.
pub(super) const DEFAULT_RELATIVE_THRESHOLD: f64 = 0.01;

/// The default of [`ScoreOptions::normal_angle`]: that of CADGenBench.
const DEFAULT_NORMAL_ANGLE: f64 = 30.0;

/// The largest angle between two planes, in degrees.
pub(super) const RIGHT_ANGLE: f64 = 90.0;

/// The default of [`ScoreOptions::feature_angle`]: that of CADGenBench.
const DEFAULT_FEATURE_ANGLE: f64 = 30.0;

/// The largest angle by which a surface turns at an edge, in degrees: there it is folded.
const FOLDED: f64 = 180.0;

/// How the candidate is laid on the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum ScoreAlignment {
    /// Where the files have it, moved by the options' transform.
    #[default]
    None,
    /// Scaled and shifted so that the middles and the longest sides of the boxes along the axes agree.
    Box,
    /// Moved by the best fit from any pose, without a scale.
    BestFit,
}

/// Options of [`crate::Engine::score`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct ScoreOptions {
    /// Distances at which precision, recall and F1 are stated, in model units, 0 or more.
    pub thresholds: Vec<f64>,
    /// The same as fractions of the diagonal of the truth's box; 0.01 if neither names any.
    pub relative_thresholds: Vec<f64>,
    /// The largest angle between tangent planes that count as alike, in degrees, from 0 to 90.
    pub normal_angle: f64,
    /// The angle by which a surface turns at a feature edge at least, in degrees, from 0 to 180.
    pub feature_angle: f64,
    /// How the candidate is laid on the truth.
    pub align: ScoreAlignment,
    /// The width of the intervals of lengths, in model units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the truth's diagonal; 1e-3 if neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// The width of the intervals of precision and recall, of areas, with normals and of edges, positive.
    pub part_tolerance: f64,
    /// The distance up to which a face counts as unchanged, in model units, positive: with it, faces are
    /// compared one by one.
    pub limit: Option<f64>,
    /// Numbers that have to be at least so large.
    pub at_least: BTreeMap<ScoreNumber, f64>,
    /// Numbers that have to be at most so large.
    pub at_most: BTreeMap<ScoreNumber, f64>,
    /// The parts of a model after which the intervals reached are returned, 1 or more.
    pub max_cells: usize,
    /// Seconds after which the intervals reached are returned, positive.
    pub max_seconds: Option<f64>,
    /// Whether the truth is scaled to the unit of the candidate where both state different ones; else they
    /// are an error.
    pub scale_units: bool,
    /// Moves the candidate before it is aligned. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for ScoreOptions {
    fn default() -> Self {
        Self {
            thresholds: Vec::new(),
            relative_thresholds: Vec::new(),
            normal_angle: DEFAULT_NORMAL_ANGLE,
            feature_angle: DEFAULT_FEATURE_ANGLE,
            align: ScoreAlignment::None,
            tolerance: None,
            relative_tolerance: None,
            part_tolerance: DEFAULT_PART_TOLERANCE,
            limit: None,
            at_least: BTreeMap::new(),
            at_most: BTreeMap::new(),
            max_cells: DEFAULT_MAX_CELLS,
            max_seconds: None,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(
    ScoreOptions, score -> Score,
    [tolerance, relative_tolerance, max_cells, scale_units, transform], max_seconds
);

impl ScoreOptions {
    /// # Errors
    /// [`Error::OptionOutOfRange`] naming the option, [`Error::OptionInvalid`] for a transform that an alignment would
    /// replace.
    fn require_own(&self) -> Result<()> {
        for &threshold in &self.thresholds {
            at_least_zero("thresholds", threshold)?;
        }
        for &threshold in &self.relative_thresholds {
            at_least_zero("relative thresholds", threshold)?;
        }
        if !(0.0..=RIGHT_ANGLE).contains(&self.normal_angle) {
            return Err(Error::out_of_range("normal angle", self.normal_angle, "0 to 90 degrees"));
        }
        if !(0.0..=FOLDED).contains(&self.feature_angle) {
            return Err(Error::out_of_range("feature angle", self.feature_angle, "0 to 180 degrees"));
        }
        positive("part tolerance", self.part_tolerance)?;
        self.limit.map_or(Ok(()), |limit| positive("limit", limit))?;
        for (_, &bound) in self.at_least.iter().chain(&self.at_most) {
            at_least_zero("requirement", bound)?;
        }
        if self.align == ScoreAlignment::Box && self.transform != RigidTransform::IDENTITY {
            let found = "found a transform and align box, expected one of them".to_owned();
            return Err(Error::OptionInvalid { found });
        }
        Ok(())
    }

    /// Returns the permitted width of lengths, in model units, for a truth of this diagonal.
    pub(super) fn width(&self, diagonal: f64) -> f64 {
        self.common().width(diagonal, DEFAULT_RELATIVE_TOLERANCE)
    }

    /// Returns the thresholds in model units, ascending, for a truth of this diagonal.
    pub(super) fn limits(&self, diagonal: f64) -> Vec<f64> {
        let is_default = self.thresholds.is_empty() && self.relative_thresholds.is_empty();
        let default = is_default.then_some(DEFAULT_RELATIVE_THRESHOLD);
        let relative = self.relative_thresholds.iter().copied().chain(default);
        let mut limits: Vec<f64> =
            self.thresholds.iter().copied().chain(relative.map(|part| part * diagonal)).collect();
        limits.sort_by(f64::total_cmp);
        limits.dedup();
        limits
    }
}
