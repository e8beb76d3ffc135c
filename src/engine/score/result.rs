//! The result of a score.

use super::{Placement, Requirement};
use crate::engine::Seconds;
use crate::interval::Interval;
use serde::Serialize;

/// The score of a candidate against the truth.
///
/// Guarantee: every number is in its interval, for the models as they were read and the placement stated; of a
/// trimmed face the pieces that stand for it are measured (docs/trimming.md). Distances are in model units,
/// averages over the area of a surface; of a cloud over its points. What is not there was not measured: a model
/// that does not close has no volume, and work that ended early leaves the rest out.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Score {
    /// How the candidate was laid on the truth.
    pub placement: Placement,
    /// The diagonal of the truth's box, to which relative thresholds and tolerances refer.
    pub diagonal: f64,
    /// Metres per unit of every length here, if a model states its unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<f64>,
    /// What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
    /// units have. Nothing was scaled for it; A is the candidate and B the truth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hint: Option<String>,
    /// The candidate where it was laid.
    pub candidate: ScoredModel,
    /// The truth.
    pub truth: ScoredModel,
    /// The difference of the volumes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<Difference>,
    /// The difference of the areas.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<Difference>,
    /// The distance of the centroids of the volumes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centroid_distance: Option<Interval>,
    /// The differences of the extents along x, y and z, without their signs.
    pub extent_differences: [Interval; 3],
    /// From the candidate to the truth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forward: Option<SurfaceScore>,
    /// From the truth to the candidate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reverse: Option<SurfaceScore>,
    /// The sum of both mean distances.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chamfer: Option<Interval>,
    /// The sum of both mean squared distances.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chamfer_squared: Option<Interval>,
    /// Precision, recall and F1 at each threshold, ascending.
    pub thresholds: Vec<AtThreshold>,
    /// The lengths of the feature edges.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edge_length: Option<EdgeLengths>,
    /// The Hausdorff distance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hausdorff: Option<HausdorffScore>,
    /// The volume of the intersection over that of the union, if both models close. It has a budget of its own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iou: Option<Interval>,
    /// The faces compared one by one, if the options have a limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<FaceCounts>,
    /// The requirements of the options with what was found.
    pub requirements: Vec<Requirement>,
    /// Whether all requirements are met: `Some(false)` as soon as one is certainly missed, `None` if one is
    /// undecided or if there are none.
    pub met: Option<bool>,
    /// Whether a missed requirement ended the work before all numbers were there.
    pub ended_early: bool,
    /// Whether all intervals of lengths and of parts of areas are as narrow as requested.
    pub converged: bool,
    /// The requested width of lengths, in model units.
    pub tolerance: f64,
    /// Where the time went.
    pub seconds: Seconds,
}

/// A model as a score sees it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct ScoredModel {
    /// 1 if it is closed, oriented, without copies of faces, and all its bodies are embedded; 0 if it certainly is not.
    pub valid: Interval,
    /// Whether there is a body, and every edge of every face has a partner.
    pub closed: bool,
    /// Whether the normals of all faces point out of their bodies; `None` where that is not decided.
    pub oriented: Option<bool>,
    /// The number of faces with the surface and the loops of an earlier face of the same body, together with all faces of
    /// bodies that repeat an earlier body. Of a mesh it is the number of triangles with the corners of an earlier one.
    pub duplicates: usize,
    /// Whether all bodies are certainly embedded up to their gaps, or one certainly is not; `None` where neither is known.
    pub embedded: Option<bool>,
    /// The number of bodies that certainly meet themselves ([`crate::SelfOverlap`]).
    pub self_overlaps: usize,
    /// The number of bodies that close.
    pub bodies: usize,
    /// The number of bodies that do not.
    pub sheets: usize,
    /// The number of voids in bodies.
    pub voids: usize,
    /// The volume, if all bodies close.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volume: Option<Interval>,
    /// The area of all faces; none of points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub area: Option<Interval>,
    /// The centroid of the volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub centroid: Option<[Interval; 3]>,
    /// The lengths along x, y and z.
    pub extents: [Interval; 3],
}

/// Two numbers compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct Difference {
    /// That of the candidate less that of the truth.
    pub difference: Interval,
    /// The smaller over the larger: 1 if they are equal.
    pub ratio: Interval,
}

/// The distances of one model's points from the other model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct SurfaceScore {
    /// The mean distance.
    pub mean: Interval,
    /// The mean of the squared distances.
    pub mean_square: Interval,
}

/// The parts of the surfaces within a threshold of each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct AtThreshold {
    /// The threshold, in model units.
    pub threshold: f64,
    /// The part of the candidate's area within the threshold of the truth.
    pub precision: Interval,
    /// The part of the truth's area within the threshold of the candidate.
    pub recall: Interval,
    /// Their harmonic mean.
    pub f1: Interval,
    /// The same of the parts of the areas with like counterparts; none of clouds, which have no normals.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub normals: Option<AtAngle>,
    /// The same of the lengths of feature edges; none of clouds, and of meshes of more than 250,000 triangles.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub edges: Option<EdgesAt>,
}

/// The parts of the feature edges within a threshold of each other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct EdgesAt {
    /// The part of the length of the candidate's feature edges within the threshold of the truth's.
    pub edge_precision: Interval,
    /// The part of the length of the truth's feature edges within the threshold of the candidate's.
    pub edge_recall: Interval,
    /// Their harmonic mean.
    #[serde(rename = "edgeF1")]
    pub edge_f1: Interval,
}

/// The lengths of all feature edges.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct EdgeLengths {
    /// The angle by which a surface turns at a feature edge at least, in degrees.
    pub feature_angle: f64,
    /// That of the candidate.
    pub candidate: Interval,
    /// That of the truth.
    pub truth: Interval,
}

/// The parts of the surfaces with like counterparts: points of the other surface within a threshold whose tangent
/// planes form at most an angle.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct AtAngle {
    /// The largest angle, in degrees.
    pub normal_angle: f64,
    /// The part of the candidate's area with a like counterpart in the truth.
    pub normal_precision: Interval,
    /// The part of the truth's area with a like counterpart in the candidate.
    pub normal_recall: Interval,
    /// Their harmonic mean.
    #[serde(rename = "normalF1")]
    pub normal_f1: Interval,
}

/// The Hausdorff distance of candidate and truth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct HausdorffScore {
    /// From the candidate to the truth.
    pub forward: Interval,
    /// From the truth to the candidate.
    pub reverse: Interval,
    /// The larger of both.
    pub distance: Interval,
}

/// The numbers of faces by their states.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
#[non_exhaustive]
pub struct FaceCounts {
    /// The distance up to which a face counts as unchanged, in model units.
    pub limit: f64,
    /// The part of the candidate's faces, by number, that are within the limit of the truth.
    pub candidate: Interval,
    /// The part of the truth's faces, by number, that are within the limit of the candidate.
    pub truth: Interval,
    /// The numbers of the candidate's faces that certainly changed, and of all.
    pub changed_of_candidate: [usize; 2],
    /// The numbers of the truth's faces that certainly changed, and of all.
    pub changed_of_truth: [usize; 2],
}
