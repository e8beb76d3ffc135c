//! The options of clearances.

use super::{ClearanceResult, GapsResult};
use crate::engine::options::at_least_zero;
use crate::engine::query::{Query, impl_query, validate_limit};
use crate::error::Result;
use crate::model::RigidTransform;
use serde::Deserialize;

/// The width of the interval, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;

/// Options of [`crate::Engine::clearance`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct ClearanceOptions {
    /// The permitted width of the interval, in model units, positive. Models nearer than it
    /// count as touching.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal of the two models' control-net boxes; 1e-6
    /// if neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// The search only decides whether the clearance is at least this limit, in model units, 0 or
    /// more, and ends as soon as that is known. At least 0 means certainly apart.
    pub limit: Option<f64>,
    /// Seconds after which the interval so far is returned, positive.
    pub max_seconds: Option<f64>,
    /// Pairs of cells after which the interval so far is returned, 1 or more.
    pub max_cells: Option<usize>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are an
    /// error.
    pub scale_units: bool,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for ClearanceOptions {
    fn default() -> Self {
        Self {
            tolerance: None,
            relative_tolerance: None,
            limit: None,
            max_seconds: None,
            max_cells: None,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(
    ClearanceOptions, clearance -> ClearanceResult,
    [tolerance, relative_tolerance, max_cells, scale_units, transform], max_seconds
);

impl ClearanceOptions {
    fn require_own(&self) -> Result<()> {
        validate_limit(self.limit)
    }

    /// Returns the permitted width in model units, for models of this diagonal.
    pub(super) fn width(&self, diagonal: f64) -> f64 {
        self.common().width(diagonal, DEFAULT_RELATIVE_TOLERANCE)
    }
}

/// Options of [`crate::Engine::gaps`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct GapOptions {
    /// The distance, in model units, 0 or more, below which pairs of faces are listed.
    pub below: f64,
    /// The permitted width of the intervals, in model units, positive.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal of the two models' control-net boxes; 1e-6
    /// if neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// Seconds after which the pairs so far are returned, positive.
    pub max_seconds: Option<f64>,
    /// Pairs of cells, for each pair of faces, after which its interval so far is taken, 1 or more.
    pub max_cells: Option<usize>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are an
    /// error.
    pub scale_units: bool,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for GapOptions {
    fn default() -> Self {
        Self {
            below: 0.0,
            tolerance: None,
            relative_tolerance: None,
            max_seconds: None,
            max_cells: None,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
        }
    }
}

impl_query!(
    GapOptions, gaps -> GapsResult,
    [tolerance, relative_tolerance, max_cells, scale_units, transform], max_seconds
);

impl GapOptions {
    fn require_own(&self) -> Result<()> {
        at_least_zero("below", self.below)
    }

    /// Returns the options of the search for one pair of faces.
    pub(super) fn search(&self) -> ClearanceOptions {
        ClearanceOptions {
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            limit: None,
            max_seconds: self.max_seconds,
            max_cells: self.max_cells,
            scale_units: self.scale_units,
            transform: self.transform,
        }
    }
}
