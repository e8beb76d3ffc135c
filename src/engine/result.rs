//! The answer, in the shape that the command line and JavaScript hand on.

use super::{Method, Statistics};
pub use crate::certified::Stop;
use crate::iteration::StatusCounts;
use serde::Serialize;

/// The distance of two models.
///
/// `lower <= true distance <= upper` whatever converged or not; `computed` is
/// the method's own number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DistanceResult {
    /// The method used.
    pub method: Method,
    /// `"gpu"` or `"cpu"`.
    pub backend: &'static str,
    /// The GPU's name, if it has one and was used.
    pub adapter: Option<String>,
    /// The larger diagonal of the two models' control-net boxes.
    pub diagonal: f64,
    /// The distance of the witness, which the method takes for the farthest point.
    pub computed: f64,
    /// At most the true distance.
    pub lower: f64,
    /// At least the true distance.
    pub upper: f64,
    /// `certified`: whether the interval is as narrow as asked, or the limit
    /// is decided. `iteration`: whether `computed` is the largest distance of
    /// all samples to rounding, or with the tangent-plane step whether the
    /// witness's iteration ended by its step tolerance. `hierarchy`: whether
    /// the interval, whose width the grid decides, is as narrow as asked.
    pub converged: bool,
    /// Where the distance is attained.
    pub witness: Witness,
    /// What only method `iteration` tells.
    #[serde(flatten)]
    pub iteration: Option<IterationDetails>,
    /// What only method `certified` tells.
    #[serde(flatten)]
    pub certified: Option<CertifiedDetails>,
    /// What only method `hierarchy` tells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hierarchy: Option<HierarchyDetails>,
    /// Numbers of patches.
    pub patches: PatchCounts,
    /// Where the time went.
    pub seconds: Seconds,
    /// Why the GPU was not used although it was not ruled out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub notice: Option<String>,
    /// With `symmetric`: from A to B.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forward: Option<Box<DistanceResult>>,
    /// With `symmetric`: from B to A.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reverse: Option<Box<DistanceResult>>,
    /// With `field`: statistics of the deviation. Estimates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub statistics: Option<Statistics>,
    /// With `field`: every sample, one entry a surface of the sampled model.
    /// Not part of the JSON.
    #[serde(skip)]
    pub field: Vec<Field>,
}

/// What method `iteration` tells besides the interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IterationDetails {
    /// The paper's bounds, and the one that holds.
    pub bounds: Bounds,
    /// Number of samples.
    pub samples: usize,
    /// How their projections ended.
    pub statuses: StatusCounts,
}

/// What method `certified` tells besides the interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CertifiedDetails {
    /// The width asked of the interval, in model units.
    pub tolerance: f64,
    /// Number of cells bounded.
    pub cells: usize,
    /// Number of those bounded in float64 on the CPU.
    pub cpu_cells: usize,
    /// Halvings from the whole model to the smallest cell.
    pub levels: u32,
    /// Why the search ended.
    pub stop: Stop,
    /// With a limit: whether the distance is at most the limit, absent if the
    /// search ended before it was known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<bool>,
}

/// What method `hierarchy` tells besides the interval.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct HierarchyDetails {
    /// Cells along each direction of every surface.
    pub grid: usize,
    /// Levels of boxes, from the whole models to the cells.
    pub levels: usize,
    /// On every level, the pairs of boxes left after culling.
    pub pairs: Vec<u64>,
}

/// How far `computed` can be from the true distance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// The 2012 paper's `K_A`, half the largest diagonal of a cell's box. Not rigorous.
    pub k_a: f64,
    /// What a point between the samples can add, certainly.
    pub k_a_rigorous: f64,
    /// The 2012 paper's `K_B = α / (1 - α) E_B` with α observed at the
    /// witness; absent where α was not below 1. An estimate, not a guarantee.
    pub k_b: Option<f64>,
}

/// Two points, one a model, that are the distance apart.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Witness {
    /// On A, after its transform.
    pub a: SurfacePoint,
    /// On B.
    pub b: SurfacePoint,
}

/// A point of a model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SurfacePoint {
    /// Index of the surface.
    pub surface: usize,
    /// Parameter u on it.
    pub u: f64,
    /// Parameter v on it.
    pub v: f64,
    /// The point.
    pub point: [f64; 3],
}

/// Numbers of patches after cutting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct PatchCounts {
    /// Of A.
    pub a: usize,
    /// Of B.
    pub b: usize,
}

/// Where the time went.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
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

/// The samples of one surface, v fastest.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Field {
    /// Index of the surface in the sampled model.
    pub surface: usize,
    /// Numbers of samples along u and v.
    pub counts: [usize; 2],
    /// The points, x y z each.
    pub points: Vec<f64>,
    /// Their feet on the other model, x y z each.
    pub feet: Vec<f64>,
    /// Their distances.
    pub distances: Vec<f64>,
    /// The distances, negative behind the normal (u x v) of the other model's
    /// surface at the foot; no number where that has no normal.
    pub signed: Vec<f64>,
    /// The area of the surface that each sample stands for.
    pub areas: Vec<f64>,
    /// How the projections ended: [`crate::result::Status`] as a number.
    pub statuses: Vec<u8>,
}
