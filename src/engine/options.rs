//! The options of a distance.

use crate::closest::Projection;
use crate::error::{Error, Result};
use crate::flatness::Flatness;
use crate::iteration::{Culling, Rule, SamplingRule};
use crate::model::RigidTransform;
use crate::tolerance::{PermittedWidth, positive};
use serde::Deserialize;
use std::fmt::Debug;
use std::ops::RangeInclusive;

/// The method that computes the distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Branch and bound to an interval of the requested width.
    #[default]
    Certified,
    /// The 2012 paper's sampling and projection.
    Iteration,
    /// The 2011 paper's hierarchy of pairs of boxes.
    Hierarchy,
}

/// Where the kernels run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Backend {
    /// On the GPU if there is one, else on the CPU, and the result says why.
    #[default]
    Auto,
    /// On the GPU; without one, an error.
    Gpu,
    /// On the CPU in float64.
    Cpu,
}

/// Options of [`super::Engine::distance`], with the defaults of the 2012 paper.
///
/// They can be deserialized from names in camelCase. The ranges are checked by
/// [`Self::validate`].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
pub struct Options {
    /// The method that computes the distance.
    pub method: Method,
    /// `certified`: the permitted width of the interval, in model units, positive.
    /// `hierarchy` only reports whether its interval is as narrow.
    pub tolerance: Option<f64>,
    /// The same as a fraction of the larger diagonal of the two models' control-net
    /// boxes; 1e-6 if neither is given. Both at once are an error.
    pub relative_tolerance: Option<f64>,
    /// `certified`: the search only decides whether the distance is at most this
    /// limit, in model units, 0 or more, and ends as soon as that is known.
    pub limit: Option<f64>,
    /// `certified`: seconds a direction after which the interval so far is
    /// returned, positive.
    pub max_seconds: Option<f64>,
    /// `certified`: cells a direction after which the interval so far is
    /// returned, 1 or more.
    pub max_cells: Option<usize>,
    /// `iteration` and the field: samples along each direction of every surface, 2 to 1024.
    pub samples: usize,
    /// `iteration` and the field: the rule by which they are spread.
    pub sampling: SamplingRule,
    /// `iteration`: the flatness to which patches of B are cut.
    pub flatness: Flatness,
    /// `iteration`: the step of the projection.
    pub projection: Projection,
    /// `iteration`: the patches on which a sample is projected.
    pub culling: Culling,
    /// `iteration`: steps on one patch, 1 to 300.
    pub iterations: u32,
    /// `iteration`: change of distance that ends the tangent-plane iteration, in model
    /// units, positive; also the paper's `E_B` in `k_b`.
    pub step_tolerance: f64,
    /// `hierarchy`: cells along each direction of every surface, 2 to 1024,
    /// as long as a model has at most 2^22 cells.
    pub grid: usize,
    /// `hierarchy`: memory for the pairs of boxes of two levels, in MiB, 1 to
    /// 256, which is one binding a level on the GPU.
    pub memory_budget: usize,
    /// Whether both directions are measured.
    pub symmetric: bool,
    /// Whether B is scaled to the unit of A where both state different ones; else they are
    /// an error.
    pub scale_units: bool,
    /// Moves A before it is measured. It is not deserialized, because only
    /// [`RigidTransform::new`] makes one.
    #[serde(skip)]
    pub transform: RigidTransform,
    /// Where the kernels run.
    pub backend: Backend,
    /// Whether the deviation at every sample of a grid is returned, with
    /// statistics; for all methods.
    pub field: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            method: Method::default(),
            tolerance: None,
            relative_tolerance: None,
            limit: None,
            max_seconds: None,
            max_cells: None,
            samples: DEFAULT_SAMPLES,
            sampling: SamplingRule::default(),
            flatness: Flatness::default(),
            projection: Projection::default(),
            culling: Culling::default(),
            iterations: 5,
            step_tolerance: 0.01,
            grid: 64,
            memory_budget: MAX_MEMORY,
            symmetric: false,
            scale_units: false,
            transform: RigidTransform::IDENTITY,
            backend: Backend::default(),
            field: false,
        }
    }
}

/// The width of the interval, as a fraction of the diagonal, unless the options state one.
const DEFAULT_RELATIVE_TOLERANCE: f64 = 1e-6;

/// The number of samples along a direction unless the options name another.
pub(super) const DEFAULT_SAMPLES: usize = 64;

/// Largest memory for pairs, in MiB: two lists, each in one binding of the GPU.
const MAX_MEMORY: usize = 256;

/// Numbers of samples or cells along a direction: up to a million a surface.
const COUNTS: RangeInclusive<usize> = 2..=1024;

/// Largest number of steps on one patch: far beyond any that still help, and few
/// enough that one patch of the highest degree stays within a kernel's turns.
const MAX_ITERATIONS: u32 = 300;

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
/// [`Error::OptionOutOfRange`] unless a grid may have so many samples along a direction.
pub(super) fn require_samples(found: usize) -> Result<()> {
    require("samples", COUNTS.contains(&found), found, "2 to 1024")
}

impl Options {
    /// Checks every range.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] naming the option.
    pub fn validate(&self) -> Result<()> {
        let memory = (1..=MAX_MEMORY).contains(&self.memory_budget);
        let iterations = (1..=MAX_ITERATIONS).contains(&self.iterations);
        require_samples(self.samples)?;
        require("grid", COUNTS.contains(&self.grid), self.grid, "2 to 1024")?;
        require("memory budget", memory, self.memory_budget, "1 to 256 MiB")?;
        require("iterations", iterations, self.iterations, "1 to 300")?;
        self.permitted_width().validate()?;
        positive("step tolerance", self.step_tolerance)?;
        if let Some(limit) = self.limit {
            at_least_zero("limit", limit)?;
        }
        if let Some(seconds) = self.max_seconds {
            positive("max seconds", seconds)?;
        }
        require("max cells", self.max_cells != Some(0), 0, "at least 1")
    }

    /// Returns the permitted width of the interval, in model units, for models of this diagonal.
    pub(super) fn width(&self, diagonal: f64) -> f64 {
        self.permitted_width().in_units(diagonal, DEFAULT_RELATIVE_TOLERANCE)
    }

    pub(super) fn permitted_width(&self) -> PermittedWidth {
        PermittedWidth { tolerance: self.tolerance, relative_tolerance: self.relative_tolerance }
    }

    pub(crate) fn rule(&self) -> Rule {
        Rule {
            projection: self.projection,
            iterations: self.iterations,
            step_tolerance: self.step_tolerance,
            culling: self.culling,
        }
    }
}
