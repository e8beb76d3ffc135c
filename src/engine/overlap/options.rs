//! The options of overlaps.

use super::OverlapResult;
use crate::engine::query::impl_query;
use crate::error::Result;
use crate::model::RigidTransform;
use crate::tolerance::positive;
use serde::Deserialize;

/// The width of the common volume, as a fraction of the union's, unless the options state one.
const DEFAULT_TOLERANCE: f64 = 1e-3;

/// The number of pieces after which the interval so far is returned, unless the options state one: curved boundaries that
/// lie on each other in patches that differ take many, and some tens of seconds then.
const DEFAULT_MAX_CELLS: usize = 400_000;

/// Options of [`crate::Engine::overlap`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct OverlapOptions {
    /// The permitted width of the volume of the common part, as a fraction of the volume of the union, positive: 1e-3
    /// if it is left out.
    pub tolerance: Option<f64>,
    /// Seconds after which the interval so far is returned, positive.
    pub max_seconds: Option<f64>,
    /// Pieces of patches after which the interval so far is returned, 1 or more: 400,000 if it is left out.
    pub max_cells: Option<usize>,
    /// Whether B is scaled to the unit of A where both state different ones; else they are an
    /// error.
    pub scale_units: bool,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
}

impl Default for OverlapOptions {
    fn default() -> Self {
        let transform = RigidTransform::IDENTITY;
        Self { tolerance: None, max_seconds: None, max_cells: None, scale_units: false, transform }
    }
}

impl_query!(OverlapOptions, overlap -> OverlapResult, [max_cells, scale_units, transform], max_seconds);

impl OverlapOptions {
    fn require_own(&self) -> Result<()> {
        self.tolerance.map_or(Ok(()), |tolerance| positive("tolerance", tolerance))
    }

    /// Returns the permitted width, as a fraction of the union's volume.
    pub(super) fn relative_width(&self) -> f64 {
        self.tolerance.unwrap_or(DEFAULT_TOLERANCE)
    }

    /// Returns the largest number of pieces.
    pub(super) fn most_cells(&self) -> usize {
        self.max_cells.unwrap_or(DEFAULT_MAX_CELLS)
    }
}
