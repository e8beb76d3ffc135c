//! The options of a distance.

mod method;
mod named;

use super::query::{CommonOptions, Query, validate_limit};
use super::{Computation, DistanceResult, Engine, PreparedModel};
use crate::error::{Error, Result};
use crate::iteration::SamplingRule;
use crate::model::RigidTransform;
use method::COUNTS;
pub use method::{CertifiedOptions, HierarchyOptions, IterationOptions, Method, MethodName};
pub use named::NamedOptions;
use serde::{Deserialize, Serialize};
use std::fmt::Debug;

/// Where the kernels run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Backend {
    /// On the GPU if there is one, else on the CPU, and the result says why.
    #[default]
    Auto,
    /// On the GPU; without one, an error.
    Gpu,
    /// On the CPU in float64.
    Cpu,
}

/// Options of [`super::Engine::distance`]: those of all methods, and in [`Method`] those that only one
/// has. Later versions may have more fields, so that a literal ends with `..Default::default()`.
///
/// The ranges are checked by [`Query::validate`]. [`NamedOptions`] makes them from names.
#[derive(Debug, Clone, PartialEq)]
pub struct DistanceOptions {
    /// The method that computes the distance, with its own options.
    pub method: Method,
    /// The permitted width of the interval, in model units, positive. Methods other than
    /// `certified` only report whether their interval is as narrow.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal of the two models' control-net
    /// boxes; 1e-6 if neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// The length that the verdict is about, in model units, 0 or more. The search of method
    /// `certified` then only decides whether the distance is at most this limit, and ends as soon
    /// as that is known.
    pub limit: Option<f64>,
    /// Whether both directions are measured.
    pub symmetric: bool,
    /// Whether B is scaled to the unit of A where both state different ones; else they are
    /// an error.
    pub scale_units: bool,
    /// Moves A before it is measured.
    pub transform: RigidTransform,
    /// Where the kernels run.
    pub backend: Backend,
    /// Whether the deviation at every sample of a grid is returned, with statistics.
    pub deviations: bool,
    /// Samples along each direction of every surface, 2 to 1024: those of method `iteration`, and
    /// of the deviations.
    pub samples: usize,
    /// The rule by which they are spread.
    pub sampling: SamplingRule,
}

impl Default for DistanceOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            tolerance: None,
            relative_tolerance: None,
            limit: None,
            symmetric: false,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
            backend: Backend::default(),
            deviations: false,
            samples: DEFAULT_SAMPLES,
            sampling: SamplingRule::default(),
        }
    }
}

/// The width of the interval, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;

/// The number of samples along a direction unless the options name another.
pub(super) const DEFAULT_SAMPLES: usize = 64;

/// # Errors
/// [`Error::OptionOutOfRange`] unless the option is `valid`.
fn require(option: &'static str, valid: bool, found: impl Debug, expected: &'static str) -> Result<()> {
    if valid { Ok(()) } else { Err(Error::out_of_range(option, found, expected)) }
}

/// # Errors
/// [`Error::OptionOutOfRange`] unless the option is 0 or more and finite.
pub(super) fn at_least_zero(option: &'static str, found: f64) -> Result<()> {
    require(option, found.is_finite() && found >= 0.0, found, "a finite number of at least 0")
}

/// # Errors
/// [`Error::OptionOutOfRange`] unless a grid may have this number of samples along a direction.
pub(super) fn require_samples(found: usize) -> Result<()> {
    require("samples", COUNTS.contains(&found), found, "2 to 1024")
}

/// # Errors
/// [`Error::OptionOutOfRange`] for the number 0.
pub(super) fn at_least_one(option: &'static str, found: Option<usize>) -> Result<()> {
    require(option, found != Some(0), 0, "at least 1")
}

impl Query for DistanceOptions {
    type Answer = DistanceResult;

    fn common(&self) -> CommonOptions {
        let budgets = match self.method {
            Method::Certified(budgets) => budgets,
            _ => CertifiedOptions::default(),
        };
        CommonOptions {
            tolerance: self.tolerance,
            relative_tolerance: self.relative_tolerance,
            max_seconds: budgets.max_seconds,
            max_cells: budgets.max_cells,
            scale_units: self.scale_units,
            transform: self.transform,
        }
    }

    fn moved(self, transform: RigidTransform) -> Self {
        Self { transform, ..self }
    }

    fn within(mut self, max_seconds: Option<f64>) -> Self {
        if let Method::Certified(budgets) = &mut self.method {
            budgets.max_seconds = budgets.max_seconds.or(max_seconds);
        }
        self
    }

    fn validate_own(&self) -> Result<()> {
        require_samples(self.samples)?;
        validate_limit(self.limit)?;
        self.method.validate_own()
    }

    fn ask<'a>(
        &'a self,
        engine: &'a Engine,
        [a, b]: [&'a PreparedModel; 2],
    ) -> Computation<'a, DistanceResult> {
        engine.distance(a, b, self)
    }
}

impl DistanceOptions {
    /// Returns whether a GPU is worth its initialisation. Method `certified` usually ends in float64 before.
    #[must_use]
    pub fn may_use_gpu(&self) -> bool {
        let is_sampled = self.method.name() != MethodName::Certified || self.deviations;
        self.backend == Backend::Gpu || is_sampled && self.backend == Backend::Auto
    }

    /// Returns the permitted width of the interval, in model units, for models of this diagonal.
    pub(super) fn width(&self, diagonal: f64) -> f64 {
        self.common().width(diagonal, DEFAULT_RELATIVE_TOLERANCE)
    }
}
