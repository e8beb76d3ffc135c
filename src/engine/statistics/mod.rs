//! Statistics of the distances of a model's points from another one, as intervals that hold them.

mod audited;
mod cover;
mod formula;
mod pages;
mod parts;
mod search;
mod sums;

use super::Seconds;
use super::query::{Query, impl_query, validate_limit};
use crate::certified::{Audit, AuditReport};
use crate::error::{Error, Result};
use crate::interval::Interval;
use crate::model::RigidTransform;
use crate::tolerance::positive;
pub(in crate::engine) use audited::audit;
pub(in crate::engine) use cover::{Cells, Cover};
pub(in crate::engine) use pages::{bounded, halve_page};
pub(in crate::engine) use search::Asked;
use serde::{Deserialize, Serialize};
pub(in crate::engine) use sums::Sums;

/// The default width of the intervals of lengths, as a fraction of the diagonal.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-4;

/// The default of [`StatisticsOptions::part_tolerance`].
const DEFAULT_PART_TOLERANCE: f64 = 1e-3;

/// The default of [`StatisticsOptions::max_cells`]: some seconds, and 100 MB.
const DEFAULT_MAX_CELLS: usize = 300_000;

/// The default of [`StatisticsOptions::percentiles`].
const DEFAULT_PERCENTILES: [f64; 3] = [0.5, 0.95, 0.99];

/// Options of [`super::Engine::statistics`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct StatisticsOptions {
    /// The width of the intervals of the mean, the root mean square and the percentiles, in model
    /// units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal; 1e-4 if neither is given. Both at once are an
    /// error.
    pub relative_tolerance: Option<f64>,
    /// The percentiles, as parts of the whole above 0 and below 1.
    pub percentiles: Vec<f64>,
    /// A limit: the part farther than it is returned. 0 or more.
    pub limit: Option<f64>,
    /// The width of the interval of that part, positive.
    pub part_tolerance: f64,
    /// The parts of A after which the intervals reached are returned, 1 or more. All facets or
    /// patches of A are bounded at least once.
    pub max_cells: usize,
    /// Seconds after which the intervals reached are returned, positive. Facets and patches that were not looked at
    /// then have the bounds of the models' boxes.
    pub max_seconds: Option<f64>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are
    /// an error.
    pub scale_units: bool,
    /// The parts whose bounds are audited at the end: a share of them, or all.
    pub audit: Audit,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for StatisticsOptions {
    fn default() -> Self {
        Self {
            tolerance: None,
            relative_tolerance: None,
            percentiles: DEFAULT_PERCENTILES.to_vec(),
            limit: None,
            part_tolerance: DEFAULT_PART_TOLERANCE,
            max_cells: DEFAULT_MAX_CELLS,
            max_seconds: None,
            scale_units: false,
            audit: Audit::default(),
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(
    StatisticsOptions, statistics -> CertifiedStatistics,
    [tolerance, relative_tolerance, max_cells, scale_units, transform], max_seconds
);

impl StatisticsOptions {
    fn require_own(&self) -> Result<()> {
        for &part in &self.percentiles {
            if !(part > 0.0 && part < 1.0) {
                return Err(Error::out_of_range("percentiles", part, "parts above 0 and below 1"));
            }
        }
        validate_limit(self.limit)?;
        positive("part tolerance", self.part_tolerance)
    }

    fn width(&self, diagonal: f64) -> f64 {
        self.common().width(diagonal, DEFAULT_RELATIVE_TOLERANCE)
    }
}

/// What statistics are over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Measure {
    /// The points of a cloud, each once.
    Count,
    /// The area of triangles or surfaces.
    Area,
}

/// A percentile of the distances.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Percentile {
    /// The part of A that is at most this far, at least.
    pub part: f64,
    /// The least such distance.
    pub distance: Interval,
}

/// The part of A farther than a limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Beyond {
    /// The limit, in model units.
    pub limit: f64,
    /// The part, between 0 and 1.
    pub part: Interval,
}

/// Statistics of the distances from the points of A to B.
///
/// Guarantee: every number is in its interval, for the models as they were read; of a trimmed face
/// the pieces that stand for it are measured (docs/trimming.md).
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct CertifiedStatistics {
    /// What they are over.
    pub over: Measure,
    /// The area of A in squares of the model unit, or the number of its points.
    pub total: Interval,
    /// The mean distance.
    pub mean: Interval,
    /// The root of the mean square distance.
    pub rms: Interval,
    /// The percentiles, in the order of the options.
    pub percentiles: Vec<Percentile>,
    /// The part beyond the limit, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond: Option<Beyond>,
    /// Whether all intervals are as narrow as requested. A percentile at which distances jump stays
    /// as wide as the jump.
    pub converged: bool,
    /// The requested width of lengths, in model units.
    pub tolerance: f64,
    /// The larger diagonal of the two models' boxes.
    pub diagonal: f64,
    /// Metres per unit of every length here, if A or B states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
    /// units have. Nothing was scaled for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The number of parts bounded.
    pub cells: usize,
    /// The parts whose bounds were compared with certified distances of their points.
    pub audit: AuditReport,
    /// What is to be known of the computation: a bound that its audit refuted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub notice: Option<String>,
    /// Where the time went.
    pub seconds: Seconds,
}
