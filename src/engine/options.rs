//! What a caller may choose.

use crate::closest::Projection;
use crate::error::{Error, Result};
use crate::flatness::Flatness;
use crate::iteration::{Culling, Rule, SamplingRule};
use crate::model::RigidTransform;
use serde::Serialize;

/// How the distance is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// An interval to the tolerance asked for.
    #[default]
    Certified,
    /// The 2012 paper's sampling and projection.
    Iteration,
    /// The 2011 paper's pairs of boxes.
    Hierarchy,
}

/// Where the kernels run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Backend {
    /// On the GPU if there is one, else on the CPU, and the result says why.
    #[default]
    Auto,
    /// On the GPU; without one, an error.
    Gpu,
    /// On the CPU in float64.
    Cpu,
}

/// Options of [`super::Engine::distance`], with the defaults of the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How the distance is computed.
    pub method: Method,
    /// `certified`: the width asked of the interval, positive; `hierarchy`
    /// only says whether its interval is as narrow.
    pub tolerance: f64,
    /// Whether `tolerance` is in model units; else it is relative to the
    /// larger diagonal of the two models' control-net boxes.
    pub absolute: bool,
    /// `certified`: only whether the distance is at most this is asked, in
    /// model units, 0 or more; the search ends as soon as it is known.
    pub limit: Option<f64>,
    /// `certified`: seconds after which the interval so far is returned, positive.
    pub max_seconds: Option<f64>,
    /// `certified`: cells after which the interval so far is returned, 1 or more.
    pub max_cells: Option<usize>,
    /// `iteration`: samples along each direction of every surface, 2 to 1024.
    pub samples: usize,
    /// `iteration`: how they are spread.
    pub sampling: SamplingRule,
    /// How flat the patches are cut.
    pub flatness: Flatness,
    /// The step of the projection.
    pub projection: Projection,
    /// Which patches are tried.
    pub culling: Culling,
    /// Steps on one patch, 1 to 300.
    pub iterations: u32,
    /// Change of distance that ends the tangent-plane iteration, in model
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
    /// Moves A before it is measured.
    pub transform: RigidTransform,
    /// Where the kernels run.
    pub backend: Backend,
    /// Whether every sample of the grid and its foot are returned, with
    /// statistics; also with method `certified`.
    pub field: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            method: Method::default(),
            tolerance: 1e-6,
            absolute: false,
            limit: None,
            max_seconds: None,
            max_cells: None,
            samples: 64,
            sampling: SamplingRule::default(),
            flatness: Flatness::default(),
            projection: Projection::default(),
            culling: Culling::default(),
            iterations: 5,
            step_tolerance: 0.01,
            grid: 64,
            memory_budget: MAX_MEMORY,
            symmetric: false,
            transform: RigidTransform::IDENTITY,
            backend: Backend::default(),
            field: false,
        }
    }
}

/// MiB for pairs, at most: two lists, each in one binding of the GPU.
const MAX_MEMORY: usize = 256;

/// Samples or cells along a direction, at most: a million a surface.
const MAX_SAMPLES: usize = 1024;

/// Steps on one patch, at most: far beyond any that still help, and few enough
/// that one patch of the highest degree stays within a kernel's turns.
const MAX_ITERATIONS: u32 = 300;

const POSITIVE: &str = "a positive finite number";
const AT_LEAST_0: &str = "a finite number of at least 0";

impl Options {
    /// Checks every range.
    ///
    /// # Errors
    /// [`Error::OptionOutOfRange`] naming the option.
    pub fn validate(&self) -> Result<()> {
        let positive = |found: f64| found.is_finite() && found > 0.0;
        let at_least_0 = |found: f64| found.is_finite() && found >= 0.0;
        let counts = 2..=MAX_SAMPLES;
        let memory = (1..=MAX_MEMORY).contains(&self.memory_budget);
        let iterations = (1..=MAX_ITERATIONS).contains(&self.iterations);
        // One list, as every call that may fail is code of the wasm module.
        let checks = [
            ("samples", counts.contains(&self.samples), self.samples as f64, "2 to 1024"),
            ("grid", counts.contains(&self.grid), self.grid as f64, "2 to 1024"),
            ("memory budget", memory, self.memory_budget as f64, "1 to 256 MiB"),
            ("iterations", iterations, self.iterations.into(), "1 to 300"),
            ("tolerance", positive(self.tolerance), self.tolerance, POSITIVE),
            ("limit", self.limit.is_none_or(at_least_0), self.limit.unwrap_or_default(), AT_LEAST_0),
            (
                "max seconds",
                self.max_seconds.is_none_or(positive),
                self.max_seconds.unwrap_or_default(),
                POSITIVE,
            ),
            ("max cells", self.max_cells != Some(0), 0.0, "at least 1"),
            ("step tolerance", positive(self.step_tolerance), self.step_tolerance, POSITIVE),
        ];
        match checks.into_iter().find(|(_, valid, ..)| !valid) {
            Some((option, _, found, expected)) => Err(Error::out_of_range(option, found, expected)),
            None => Ok(()),
        }
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
