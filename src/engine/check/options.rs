//! The options of checks.

use super::CheckRules;
use crate::engine::options::at_least_zero;
use crate::error::{Error, Result};
use crate::tolerance::PermittedWidth;
use serde::Deserialize;

/// The width of intervals, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;

/// The default of [`CheckOptions::max_cells`]: about a second for one pair.
const DEFAULT_MAX_CELLS: usize = 200_000;

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
            scale_units: false,
            rules: CheckRules::default(),
        }
    }
}

impl CheckOptions {
    /// Checks every range.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] naming the option; [`Error::OptionInvalid`] for both widths.
    pub fn validate(&self) -> Result<()> {
        at_least_zero("below", self.below)?;
        self.permitted_width().validate()?;
        if self.max_cells == 0 {
            return Err(Error::out_of_range("max cells", 0, "at least 1"));
        }
        Ok(())
    }

    fn permitted_width(&self) -> PermittedWidth {
        PermittedWidth { tolerance: self.tolerance, relative_tolerance: self.relative_tolerance }
    }

    /// Returns the distances that bodies within a box of this diagonal are judged by.
    pub(super) fn limits(&self, diagonal: f64) -> Limits {
        let tolerance = self.permitted_width().in_units(diagonal, DEFAULT_RELATIVE_TOLERANCE);
        Limits { below: self.below, tolerance, max_cells: self.max_cells }
    }
}

/// The distances that pairs are judged by, in model units.
pub(super) struct Limits {
    pub(super) below: f64,
    pub(super) tolerance: f64,
    pub(super) max_cells: usize,
}

impl Limits {
    /// Returns the distance from which on bodies neither touch nor are near.
    pub(super) fn reach(&self) -> f64 {
        if self.below > self.tolerance { self.below } else { self.tolerance }
    }
}
