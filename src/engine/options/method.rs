//! The methods, each with the options that only it has.

use super::require;
use crate::certified::Audit;
use crate::closest::Projection;
use crate::error::Result;
use crate::flatness::Flatness;
use crate::iteration::{Culling, Rule};
use crate::tolerance::positive;
use serde::Deserialize;
use std::fmt::{Display, Formatter};
use std::ops::RangeInclusive;

/// The name of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum MethodName {
    /// Branch and bound to an interval of the requested width.
    #[default]
    Certified,
    /// The 2012 paper's sampling and projection.
    Iteration,
    /// The 2011 paper's hierarchy of pairs of boxes.
    Hierarchy,
}

impl Display for MethodName {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Certified => "certified",
            Self::Iteration => "iteration",
            Self::Hierarchy => "hierarchy",
        })
    }
}

/// The method that computes the distance, with the options that only it has.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// Branch and bound to an interval of the requested width.
    Certified(CertifiedOptions),
    /// The 2012 paper's sampling and projection.
    Iteration(IterationOptions),
    /// The 2011 paper's hierarchy of pairs of boxes.
    Hierarchy(HierarchyOptions),
}

/// The budgets of [`Method::Certified`], none by default, and its audit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CertifiedOptions {
    /// Seconds a direction after which the interval so far is returned, positive.
    pub max_seconds: Option<f64>,
    /// Cells a direction after which the interval so far is returned, 1 or more.
    pub max_cells: Option<usize>,
    /// The bounds that are audited while the search runs.
    pub audit: Audit,
}

/// Options of [`Method::Iteration`], with the defaults of the 2012 paper. Its samples are those of
/// [`super::DistanceOptions::samples`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IterationOptions {
    /// The flatness to which patches of B are cut.
    pub flatness: Flatness,
    /// The step of the projection.
    pub projection: Projection,
    /// The patches on which a sample is projected.
    pub culling: Culling,
    /// Steps on one patch, 1 to 300.
    pub iterations: u32,
    /// Change of distance that ends the tangent-plane iteration, in model units, positive;
    /// also the paper's `E_B` in `k_b`.
    pub step_tolerance: f64,
}

/// Options of [`Method::Hierarchy`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HierarchyOptions {
    /// Cells along each direction of every surface, 2 to 1024, as long as a model has at most
    /// 2^22 cells.
    pub grid: usize,
    /// Memory for the pairs of boxes of two levels, in MiB, 1 to 256, which is one binding a
    /// level on the GPU.
    pub memory_budget: usize,
}

/// Largest memory for pairs, in MiB: two lists, each in one binding of the GPU.
const MAX_MEMORY: usize = 256;

/// Numbers of samples or cells along a direction: up to a million a surface.
pub(super) const COUNTS: RangeInclusive<usize> = 2..=1024;

/// Largest number of steps on one patch: far beyond any that still help, and few
/// enough that one patch of the highest degree stays within a kernel's turns.
const MAX_ITERATIONS: u32 = 300;

impl Default for IterationOptions {
    fn default() -> Self {
        Self {
            flatness: Flatness::default(),
            projection: Projection::default(),
            culling: Culling::default(),
            iterations: 5,
            step_tolerance: 0.01,
        }
    }
}

impl Default for HierarchyOptions {
    fn default() -> Self {
        Self { grid: 64, memory_budget: MAX_MEMORY }
    }
}

impl Default for Method {
    fn default() -> Self {
        Self::Certified(CertifiedOptions::default())
    }
}

impl From<MethodName> for Method {
    /// Returns the method with its defaults.
    fn from(name: MethodName) -> Self {
        match name {
            MethodName::Certified => Self::Certified(CertifiedOptions::default()),
            MethodName::Iteration => Self::Iteration(IterationOptions::default()),
            MethodName::Hierarchy => Self::Hierarchy(HierarchyOptions::default()),
        }
    }
}

impl Method {
    /// Returns the name of the method.
    #[must_use]
    pub fn name(&self) -> MethodName {
        match self {
            Self::Certified(_) => MethodName::Certified,
            Self::Iteration(_) => MethodName::Iteration,
            Self::Hierarchy(_) => MethodName::Hierarchy,
        }
    }

    /// Checks the ranges of the options of the papers' methods. The budgets are options of all questions.
    ///
    /// # Errors
    /// [`crate::Error::OptionOutOfRange`] naming the option.
    pub(super) fn validate_own(&self) -> Result<()> {
        match self {
            Self::Certified(_) => Ok(()),
            Self::Iteration(options) => {
                let iterations = (1..=MAX_ITERATIONS).contains(&options.iterations);
                require("iterations", iterations, options.iterations, "1 to 300")?;
                positive("step tolerance", options.step_tolerance)
            }
            Self::Hierarchy(options) => {
                let memory = (1..=MAX_MEMORY).contains(&options.memory_budget);
                require("grid", COUNTS.contains(&options.grid), options.grid, "2 to 1024")?;
                require("memory budget", memory, options.memory_budget, "1 to 256 MiB")
            }
        }
    }
}

impl IterationOptions {
    pub(crate) fn rule(&self) -> Rule {
        Rule {
            projection: self.projection,
            iterations: self.iterations,
            step_tolerance: self.step_tolerance,
            culling: self.culling,
        }
    }
}
