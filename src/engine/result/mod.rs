//! The result of a distance, which the command line and JavaScript pass on as it is.

mod directed_result;
mod symmetric;
mod with_gaps;

use super::{FaceDeviations, MethodName, Statistics};
pub use crate::certified::{AuditReport, Lemma, Lemmas};
pub use crate::interval::Stop;
use crate::iteration::StatusCounts;
use crate::surface_point::SurfacePoint;
pub(super) use directed_result::DirectedResult;
use serde::Serialize;
use std::fmt::{Display, Formatter};
pub use with_gaps::WithGaps;

/// The processor that computed a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Processor {
    /// A GPU, at least in part.
    Gpu,
    /// The CPU alone, in float64.
    Cpu,
}

impl Display for Processor {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(match self {
            Self::Gpu => "gpu",
            Self::Cpu => "cpu",
        })
    }
}

/// The distance of two models.
///
/// Guarantee: `lower <= true distance <= upper`, whether the method converged
/// or not; `computed` is the method's own number. As JSON the names are in
/// camelCase, and the key `method` names the variant of [`Details`], whose
/// fields stand next to those here.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct DistanceResult {
    /// The method, with the results that only it has.
    #[serde(flatten)]
    pub details: Details,
    /// The processor that computed the result.
    pub backend: Processor,
    /// The GPU's name, if it has one and was used.
    pub adapter: Option<String>,
    /// The larger diagonal of the two models' control-net boxes.
    pub diagonal: f64,
    /// Metres per unit of every length here, if A or B states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
    /// units have. Nothing was scaled for it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The sum of both models' gaps: how far the sources may be from what was measured, by
    /// what they state and by ends of trimming curves that were moved together. It is not
    /// part of the interval, which is that of the models as they are.
    pub gap: f64,
    /// Whether the gap is an upper bound by what both readers have proven.
    pub gap_proven: bool,
    /// The interval, and the verdict, that hold for the sources of the models.
    pub with_gaps: WithGaps,
    /// The distance of the witness, which the method takes for the farthest point.
    pub computed: f64,
    /// A lower bound on the true distance.
    pub lower: f64,
    /// An upper bound on the true distance.
    pub upper: f64,
    /// `certified`: whether the interval is as narrow as requested, or the
    /// limit is decided. `iteration`: whether `computed` is the largest
    /// distance of all samples up to rounding, or with the tangent-plane step
    /// whether the witness's iteration ended by its step tolerance.
    /// `hierarchy`: whether the interval, whose width follows from the grid, is
    /// as narrow as requested.
    pub converged: bool,
    /// Where the distance is attained.
    pub witness: Witness,
    /// Numbers of patches.
    pub patches: PatchCounts,
    /// Where the time went.
    pub seconds: Seconds,
    /// The reason why the GPU was not used although the options allow it, and that
    /// a relative tolerance is 0 where both models are single points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub notice: Option<String>,
    /// With `symmetric`: from A to B.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forward: Option<Box<DistanceResult>>,
    /// With `symmetric`: from B to A.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reverse: Option<Box<DistanceResult>>,
    /// With `deviations`: statistics of the deviation. Estimates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statistics: Option<Statistics>,
    /// With `deviations`: every sample, one entry a surface of the sampled model, or a piece of
    /// a trimmed face.
    /// Not part of the JSON.
    #[serde(skip)]
    pub deviations: Vec<FaceDeviations>,
}

impl DistanceResult {
    /// Returns the name of the method used.
    #[must_use]
    pub fn method(&self) -> MethodName {
        self.details.method()
    }

    /// The results that only method `certified` has.
    #[must_use]
    pub fn certified(&self) -> Option<CertifiedDetails> {
        self.details.certified()
    }

    /// The results that only method `iteration` has.
    #[must_use]
    pub fn iteration(&self) -> Option<IterationDetails> {
        self.details.iteration()
    }

    /// The results that only method `hierarchy` has.
    #[must_use]
    pub fn hierarchy(&self) -> Option<&HierarchyDetails> {
        self.details.hierarchy()
    }
}

/// The results that only one method has.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "method", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Details {
    /// The details of method `certified`.
    Certified(CertifiedDetails),
    /// The details of method `iteration`.
    Iteration(IterationDetails),
    /// The details of method `hierarchy`.
    Hierarchy(HierarchyDetails),
}

impl Details {
    pub(super) fn method(&self) -> MethodName {
        match self {
            Self::Certified(_) => MethodName::Certified,
            Self::Iteration(_) => MethodName::Iteration,
            Self::Hierarchy(_) => MethodName::Hierarchy,
        }
    }

    pub(super) fn certified(&self) -> Option<CertifiedDetails> {
        if let Self::Certified(details) = self { Some(*details) } else { None }
    }

    fn iteration(&self) -> Option<IterationDetails> {
        if let Self::Iteration(details) = self { Some(*details) } else { None }
    }

    fn hierarchy(&self) -> Option<&HierarchyDetails> {
        if let Self::Hierarchy(details) = self { Some(details) } else { None }
    }
}

/// The results that only method `iteration` has.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct IterationDetails {
    /// The paper's bounds, and the rigorous one.
    pub bounds: Bounds,
    /// Number of samples.
    pub samples: usize,
    /// Numbers of samples by how their projections ended.
    pub statuses: StatusCounts,
}

/// The results that only method `certified` has.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct CertifiedDetails {
    /// The requested width of the interval, in model units.
    pub tolerance: f64,
    /// The least tolerance, in model units, that the rounding of these
    /// coordinates allows; the search of a smaller one stops with
    /// [`Stop::Precision`] at about this width.
    pub min_tolerance: f64,
    /// Number of cells bounded.
    pub cells: usize,
    /// Number of those bounded in float64 on the CPU.
    pub cpu_cells: usize,
    /// Number of halvings from the whole model to the smallest cell.
    pub levels: u32,
    /// Why the search ended.
    pub stop: Stop,
    /// With a limit: whether the distance is at most the limit, absent if the
    /// search ended before that was known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<bool>,
    /// The bounds that were looked at while the search ran.
    pub audit: AuditReport,
}

/// The results that only method `hierarchy` has.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct HierarchyDetails {
    /// Cells along each direction of every surface.
    pub grid: usize,
    /// Levels of boxes, from the whole models to the cells.
    pub levels: usize,
    /// On every level, the pairs of boxes left after culling.
    pub pairs: Vec<u64>,
}

/// Bounds on the difference between `computed` and the true distance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Bounds {
    /// The 2012 paper's `K_A`, half the largest diagonal of a cell's box. Not rigorous.
    pub k_a: f64,
    /// A rigorous bound on what a point between the samples can add.
    pub k_a_rigorous: f64,
    /// The 2012 paper's `K_B = α / (1 - α) E_B` with α observed at the
    /// witness; absent where α was not below 1. An estimate, not a guarantee.
    pub k_b: Option<f64>,
}

/// Two points, one a model, that are the distance apart.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Witness {
    /// On A, after its transform.
    pub a: SurfacePoint,
    /// On B.
    pub b: SurfacePoint,
}

/// Numbers of patches after cutting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct PatchCounts {
    /// The number of patches of A.
    pub a: usize,
    /// The number of patches of B.
    pub b: usize,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct Seconds {
    /// Cutting, trees, samples, upload; 0 if kept from before.
    pub prepare: f64,
    /// Making pipelines, with the driver's first compilation.
    pub compile: f64,
    /// The rest.
    pub solve: f64,
}

impl std::ops::AddAssign for Seconds {
    fn add_assign(&mut self, other: Self) {
        self.prepare += other.prepare;
        self.compile += other.compile;
        self.solve += other.solve;
    }
}
