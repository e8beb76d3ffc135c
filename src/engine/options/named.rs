//! The options of a distance as a caller names them, before they are known to belong together.

use super::{
    Backend, CertifiedOptions, DistanceOptions, HierarchyOptions, IterationOptions, Method, MethodName,
};
use crate::certified::Audit;
use crate::closest::Projection;
use crate::error::{Error, Result};
use crate::flatness::Flatness;
use crate::iteration::{Culling, SamplingRule};
use crate::model::RigidTransform;
use serde::Deserialize;

/// The options of a distance by name, those of all methods beside each other, each of them given or
/// not: what a command line, an object of JavaScript or keywords of Python hold.
///
/// `DistanceOptions::try_from` refuses options of another method than the one named. Names are in
/// camelCase when deserialized. For the meaning of the options see [`DistanceOptions`] and
/// [`Method`].
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "camelCase")]
#[allow(missing_docs, reason = "the options are documented where they belong")]
pub struct NamedOptions {
    pub method: MethodName,
    pub tolerance: Option<f64>,
    pub relative_tolerance: Option<f64>,
    pub limit: Option<f64>,
    pub max_seconds: Option<f64>,
    pub max_cells: Option<usize>,
    pub audit: Option<Audit>,
    pub samples: Option<usize>,
    pub sampling: Option<SamplingRule>,
    pub flatness: Option<Flatness>,
    pub projection: Option<Projection>,
    pub culling: Option<Culling>,
    pub iterations: Option<u32>,
    pub step_tolerance: Option<f64>,
    pub grid: Option<usize>,
    pub memory_budget: Option<usize>,
    pub symmetric: bool,
    pub scale_units: bool,
    #[serde(skip)]
    pub transform: RigidTransform,
    pub backend: Backend,
    pub deviations: bool,
}

impl NamedOptions {
    /// # Errors
    /// [`Error::OptionInvalid`] for the first option that is given and does not belong to the method.
    fn require_own(&self) -> Result<()> {
        let [certified, iteration, hierarchy] =
            [MethodName::Certified, MethodName::Iteration, MethodName::Hierarchy];
        let owned = [
            ("maxSeconds", self.max_seconds.is_some(), certified),
            ("maxCells", self.max_cells.is_some(), certified),
            ("audit", self.audit.is_some(), certified),
            ("flatness", self.flatness.is_some(), iteration),
            ("projection", self.projection.is_some(), iteration),
            ("culling", self.culling.is_some(), iteration),
            ("iterations", self.iterations.is_some(), iteration),
            ("stepTolerance", self.step_tolerance.is_some(), iteration),
            ("grid", self.grid.is_some(), hierarchy),
            ("memoryBudget", self.memory_budget.is_some(), hierarchy),
        ];
        for (name, is_given, owner) in owned {
            if is_given && owner != self.method {
                let found = format!("{name} is an option of method {owner}, found method {}", self.method);
                return Err(Error::OptionInvalid { found });
            }
        }
        let has_samples = self.method == MethodName::Iteration || self.deviations;
        let samples = [("samples", self.samples.is_some()), ("sampling", self.sampling.is_some())];
        match samples.into_iter().find(|(_, is_given)| *is_given && !has_samples) {
            Some((name, _)) => {
                let found = format!(
                    "{name} is an option of method iteration and of deviations, found method {}",
                    self.method
                );
                Err(Error::OptionInvalid { found })
            }
            None => Ok(()),
        }
    }

    fn method(&self) -> Method {
        match self.method {
            MethodName::Certified => Method::Certified(CertifiedOptions {
                max_seconds: self.max_seconds,
                max_cells: self.max_cells,
                audit: self.audit.unwrap_or_default(),
            }),
            MethodName::Iteration => {
                let default = IterationOptions::default();
                Method::Iteration(IterationOptions {
                    flatness: self.flatness.unwrap_or(default.flatness),
                    projection: self.projection.unwrap_or(default.projection),
                    culling: self.culling.unwrap_or(default.culling),
                    iterations: self.iterations.unwrap_or(default.iterations),
                    step_tolerance: self.step_tolerance.unwrap_or(default.step_tolerance),
                })
            }
            MethodName::Hierarchy => {
                let default = HierarchyOptions::default();
                Method::Hierarchy(HierarchyOptions {
                    grid: self.grid.unwrap_or(default.grid),
                    memory_budget: self.memory_budget.unwrap_or(default.memory_budget),
                })
            }
        }
    }
}

impl TryFrom<NamedOptions> for DistanceOptions {
    type Error = Error;

    /// # Errors
    /// [`Error::OptionInvalid`] for an option of another method than the one named. The ranges are
    /// those of [`crate::Query::validate`].
    fn try_from(named: NamedOptions) -> Result<Self> {
        named.require_own()?;
        let default = Self::default();
        Ok(Self {
            method: named.method(),
            tolerance: named.tolerance,
            relative_tolerance: named.relative_tolerance,
            limit: named.limit,
            symmetric: named.symmetric,
            scale_units: named.scale_units,
            transform: named.transform,
            backend: named.backend,
            deviations: named.deviations,
            samples: named.samples.unwrap_or(default.samples),
            sampling: named.sampling.unwrap_or(default.sampling),
        })
    }
}
