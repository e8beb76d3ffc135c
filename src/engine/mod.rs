//! The distance between two prepared models: the choice of method and backend,
//! and the result.

mod best_fit;
mod bodies;
mod certified;
mod check;
mod clearance;
mod clock;
mod computation;
mod deviation_maps;
mod diff;
mod direction;
mod dispatch;
mod embedding;
mod facets;
mod field;
mod hierarchy;
mod info;
mod iteration;
mod options;
mod outlook;
mod overlap;
mod points;
mod prepared;
mod query;
mod result;
mod score;
mod section;
mod signs;
mod solid;
mod statistics;

pub use best_fit::{BestFit, BestFitOptions, FitNorm, FitPose, FitStart, LeftOut, Zone, ZoneOptions};
pub use bodies::{Body, BodyKind};
pub use check::{
    BodyPair, CheckOptions, CheckResult, CheckRules, CheckedBody, NamedModel, NamesOfPair, PairState,
    RequiredDistance, Rule, UnkeptRule, checked_bodies,
};
pub use clearance::{
    ClearanceOptions, ClearanceResult, ClearanceWithGaps, FaceGap, GapOptions, GapsResult, Overlap,
    OverlapUnknown,
};
pub use computation::Computation;
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) use computation::Running;
pub use deviation_maps::MapPair;
#[cfg(not(target_arch = "wasm32"))]
pub use deviation_maps::SignedMap;
pub use deviation_maps::{DeviationMap, DeviationMapOptions, DeviationMaps};
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) use deviation_maps::{Here, MapPoints, Measurer};
pub use diff::{
    DiffOptions, DiffResult, FaceChange, FaceCounterpart, FaceDifference, FaceState, PartDifference,
    PartFaces, PartMotion, PartState, PartsUnknown,
};
pub use dispatch::Engine;
pub use embedding::{EmbeddedDoubt, EmbeddedUnknown, Embedding, SelfOverlap};
pub use field::{DeviationField, FaceDeviations, FieldOptions, Statistics};
pub use info::{BodyInfo, Counts, FaceInfo, ModelInfo};
pub use options::{
    Backend, CertifiedOptions, DistanceOptions, HierarchyOptions, IterationOptions, Method, MethodName,
    NamedOptions,
};
pub use overlap::{OverlapOptions, OverlapResult, OverlapVolumes, VolumesUnknown};
#[cfg(all(feature = "wasm", target_arch = "wasm32"))]
pub(crate) use points::{BLOCK, Layers, layers_of_grid, measuring_order};
pub use points::{
    ClosestPointOptions, ClosestPoints, Grid, GridOptions, Precision, SignedDistanceOptions, SignedDistances,
};
pub use prepared::PreparedModel;
pub use query::{CommonOptions, Query};
pub use result::{
    AuditReport, Bounds, CertifiedDetails, Details, DistanceResult, HierarchyDetails, IterationDetails,
    Lemma, Lemmas, PatchCounts, Processor, Seconds, Stop, WithGaps, Witness,
};
pub use score::{
    AtAngle, AtThreshold, Difference, EdgeLengths, EdgesAt, FaceCounts, HausdorffScore, Placement,
    Requirement, Score, ScoreAlignment, ScoreNumber, ScoreOptions, ScoredModel, SurfaceScore,
};
pub use signs::Signs;
pub use solid::{FreeEdge, Shell, Solid};
pub use statistics::{Beyond, CertifiedStatistics, Measure, Percentile, StatisticsOptions};

pub(crate) use prepared::{PreparedSampling, PreparedTarget};
