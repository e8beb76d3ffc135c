//! The options of checks.

use super::CheckRules;
use crate::engine::clock::Clock;
use crate::engine::options::at_least_zero;
use crate::engine::query::CommonOptions;
use crate::error::Result;
use crate::model::RigidTransform;
use serde::Deserialize;

/// The width of intervals, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;

/// The default of [`CheckOptions::max_cells`]: about a second for one pair.
const DEFAULT_MAX_CELLS: usize = 200_000;

/// The pairs of cells of a pair that is searched after the time is over: its clearance is bounded once.
const CELLS_AFTER_TIME: usize = 1;

/// Options of [`crate::Engine::check`]; names in camelCase when deserialized.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct CheckOptions {
    /// The distance, in model units, 0 or more, below which bodies are near.
    pub below: f64,
    /// The distance, in model units, positive, up to which bodies touch; it is the permitted width of intervals too.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the diagonal of the box of all bodies; 1e-6 if neither is given. Both at once are
    /// an error.
    pub relative_tolerance: Option<f64>,
    /// Pairs of cells, for each pair of bodies, after which its interval so far is taken, 1 or more.
    pub max_cells: usize,
    /// Seconds after which a pair that is not searched yet is bounded once only, and is undecided where that decides
    /// nothing; volumes and duplicates are bounded once only, too. Positive.
    pub max_seconds: Option<f64>,
    /// Whether models are scaled to the unit of the first where they state different ones; else they are an error.
    pub scale_units: bool,
    /// What is meant, and what must be.
    pub rules: CheckRules,
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self {
            below: 0.0,
            tolerance: None,
            relative_tolerance: None,
            max_cells: DEFAULT_MAX_CELLS,
            max_seconds: None,
            scale_units: false,
            rules: CheckRules::default(),
        }
    }
}

impl CheckOptions {
    /// Checks every range.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`] naming the option; [`crate::Error::OptionInvalid`] for both widths.
    pub fn validate(&self) -> Result<()> {
        at_least_zero("below", self.below)?;
        self.common().validate()
    }

    /// Returns the options that a check shares with questions about two models.
    fn common(&self) -> CommonOptions {
        let &Self { tolerance, relative_tolerance, max_seconds, scale_units, .. } = self;
        let (max_cells, transform) = (Some(self.max_cells), RigidTransform::IDENTITY);
        CommonOptions { tolerance, relative_tolerance, max_seconds, max_cells, scale_units, transform }
    }

    /// Returns what bodies within a box of this diagonal are judged by, in a check with this clock.
    pub(super) fn limits(&self, diagonal: f64, clock: Clock) -> Limits {
        let tolerance = self.common().width(diagonal, DEFAULT_RELATIVE_TOLERANCE);
        let &Self { below, max_cells, .. } = self;
        Limits { below, tolerance, max_cells, clock }
    }
}

/// What pairs are judged by: distances in model units, and budgets.
pub(super) struct Limits {
    pub(super) below: f64,
    pub(super) tolerance: f64,
    max_cells: usize,
    clock: Clock,
}

impl Limits {
    /// Returns the distance from which on bodies neither touch nor are near.
    pub(super) fn reach(&self) -> f64 {
        if self.below > self.tolerance { self.below } else { self.tolerance }
    }

    /// Returns whether the time is spent.
    pub(super) fn is_over(&self) -> bool {
        self.clock.is_over()
    }

    /// Returns the pairs of cells of the next search.
    pub(super) fn cells(&self) -> usize {
        if self.is_over() { CELLS_AFTER_TIME } else { self.max_cells }
    }

    /// Returns the seconds left for a computation that has a budget of its own.
    pub(super) fn seconds(&self) -> Option<f64> {
        self.clock.left()
    }
}
