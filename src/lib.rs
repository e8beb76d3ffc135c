//! The Hausdorff distance between NURBS models, as an interval that contains it.
//!
//! `h(A, B) = max over a in A of min over b in B of |a - b|`, and with
//! [`DistanceOptions::symmetric`] the larger of `h(A, B)` and `h(B, A)`. Every method
//! returns `lower <= h <= upper`, whether or not its iterations converged, on
//! the GPU in float32 as on the CPU in float64: rounding is part of the bounds.
//!
//! ```
//! use nurbs_hausdorff::{Engine, Model, DistanceOptions, PreparedModel, Result};
//!
//! // The unit square at a height; control points are x, y, z and weight, v fastest.
//! let square = |z: f64| {
//!     Model::from_json(&format!(
//!         r#"{{"surfaces": [{{"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
//!             "ctrl": [[[0, 0, {z}, 1], [0, 1, {z}, 1]], [[1, 0, {z}, 1], [1, 1, {z}, 1]]]}}]}}"#
//!     ))
//! };
//! let (a, b) = (PreparedModel::new(&square(0.0)?)?, PreparedModel::new(&square(3.0)?)?);
//! let engine = Engine::cpu();
//! let result = engine.distance(&a, &b, &DistanceOptions::default()).wait()?;
//! assert!(result.lower <= 3.0 && 3.0 <= result.upper && result.upper - result.lower < 1e-5);
//! # Result::Ok(())
//! ```
//!
//! The same from arrays; [`shapes`] makes models from formulas.
//!
//! ```
//! use nurbs_hausdorff::{Engine, Model, DistanceOptions, PreparedModel, SurfaceArrays};
//!
//! // The parabolic sheet z = x^2 over the unit square, and the square.
//! let sheet = SurfaceArrays {
//!     degree: [2, 1],
//!     knots: [vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
//!     counts: [3, 2],
//!     control_points: [[0.0, 0.0], [0.5, 0.0], [1.0, 1.0]]
//!         .map(|[x, z]| [[x, 0.0, z, 1.0], [x, 1.0, z, 1.0]])
//!         .concat(),
//! };
//! let mut flat = sheet.clone();
//! flat.control_points.iter_mut().for_each(|point| point[2] = 0.0);
//! let [a, b] = [sheet, flat].map(|arrays| Model::from_arrays(None, vec![arrays]));
//! let (a, b) = (PreparedModel::new(&a?)?, PreparedModel::new(&b?)?);
//! let engine = Engine::cpu();
//! let result = engine.distance(&a, &b, &DistanceOptions::default()).wait()?;
//! // The edge x = 1 is 1 above the plane.
//! assert!(result.lower <= 1.0 && 1.0 <= result.upper && result.upper - result.lower < 1e-5);
//! # nurbs_hausdorff::Result::Ok(())
//! ```
//!
//! # Map
//!
//! A [`Model`] is valid once it is made, from interchange JSON, arrays or what a reader gives; a [`TriangleMesh`] and a [`PointCloud`] are too. A [`PreparedModel`] keeps what is
//! computed from it between distances: Bézier patches, trees, samples, and
//! their copies on the GPU. [`Engine::distance`] then runs one [`Method`]:
//!
//! - [`Method::Certified`]: branch and bound, to any tolerance that float64 resolves;
//! - [`Method::Iteration`]: samples with Newton or tangent-plane steps, after Hanniel,
//!   Krishnamurthy and McMains 2012, and a rigorous bound besides;
//! - [`Method::Hierarchy`]: pairs of boxes, after Krishnamurthy, McMains and Hanniel 2011.
//!
//! [`options`] and [`result`] hold the types of the fields of [`DistanceOptions`] and
//! [`DistanceResult`]. `docs/method.md` in the repository states the theorem,
//! every bound with its proof, the float32 error budget, and the literature.
//!
//! # Features
//!
//! `gpu`, on by default, is the kernels on WebGPU: without it, engines compute on the CPU. `shapes`, on by default, is the module [`shapes`]. `js` and `wasm` are for the wasm modules of the npm package:
//! another crate for the web needs neither.
//!
//! Files are read by crates of their own, `nurbs-hausdorff-cad` and `nurbs-hausdorff-meshes`; `nurbs-hausdorff-pictures`
//! draws models in the colours of their deviation, and `nurbs-hausdorff-command` is the command.
//!
//! `internals` shows the remaining modules to the crate's own tests, benchmarks
//! and examples. It promises no stability.

#![cfg_attr(
    not(feature = "gpu"),
    allow(dead_code, unused_imports, reason = "the kernels use what nothing else does")
)]
// Prepared models hold types of wgpu, nested deeper than 128.
#![recursion_limit = "256"]
#![cfg_attr(
    not(feature = "internals"),
    allow(unreachable_pub, reason = "public within the crate's own tests and benchmarks")
)]
#![cfg_attr(
    target_arch = "wasm32",
    allow(clippy::arc_with_non_send_sync, reason = "natively the same values are shared between threads")
)]

mod alignment;
mod approximation;
mod area;
mod axis;
mod bezier;
mod bvh;
mod carrier;
mod certified;
mod clearance;
mod closest;
mod deviation;
mod embedded;
mod engine;
mod error;
mod facets;
mod facts;
mod features;
mod flatness;
#[cfg(feature = "gpu")]
mod gpu;
#[cfg(not(feature = "gpu"))]
#[path = "gpu_absent.rs"]
mod gpu;
mod hierarchy;
mod interval;
mod iteration;
mod limits;
mod model;
mod normals;
mod one_line;
mod overlap;
mod param_box;
mod pieces;
mod progress;
mod read;
mod refine;
mod rounding;
#[cfg(feature = "shapes")]
pub mod shapes;
mod solid;
mod sorting;
mod surface_point;
mod symmetry;
pub mod tessellate;
mod threads;
mod tolerance;
mod untrim;
#[cfg(all(feature = "js", target_arch = "wasm32"))]
mod wasm;

/// The parts of the private modules on which the other crates of the workspace are built. It promises no stability.
#[doc(hidden)]
pub mod workspace {
    pub use crate::approximation::bernstein::{Linear, binomial, elevated};
    pub use crate::approximation::chebyshev;
    pub use crate::bezier::{BezierModel, Interpolation, bernstein, extract};
    pub use crate::closest::{Target, closest};
    pub use crate::deviation::{FLOOR, Map, Triangles, Vertex};
    pub use crate::engine::MapPair;
    #[cfg(not(target_arch = "wasm32"))]
    pub use crate::engine::SignedMap;
    pub use crate::limits::{MAX_DEGREE, MAX_FILE_DEGREE};
    pub use crate::model::{IDENTITY, MAX_FACES, blossom, level};
    pub use crate::read::{Assembled, Budget, FaceCounts, into_model};
    pub use crate::sorting::ordered_by;
    pub use crate::threads::parallel::{Watch, map_watched};
    #[cfg(all(feature = "js", target_arch = "wasm32"))]
    pub use crate::wasm::to_object;
}

/// What the crate's own tests, benchmarks and examples see of the private modules.
#[cfg(feature = "internals")]
#[doc(hidden)]
pub mod internals {
    macro_rules! shown {
        ($($module:ident)*) => {
            $(pub mod $module {
                pub use crate::$module::*;
            })*
        };
    }
    #[cfg(feature = "gpu")]
    shown!(gpu);
    shown!(bezier bvh certified closest engine error facets flatness hierarchy iteration model progress untrim);
}

pub use alignment::{Datum, DatumFit, Feature, PointPair, Robust};
pub use area::Area;
pub use axis::Axis;
pub use bvh::Aabb;
pub use carrier::FaceForm;
pub use deviation::{FarthestPoint, KnownDeviation};
pub use engine::{
    AtAngle, AtThreshold, Backend, BestFit, BestFitOptions, Beyond, Body, BodyInfo, BodyKind, BodyPair,
    CertifiedOptions, CertifiedStatistics, CheckOptions, CheckResult, CheckRules, CheckedBody,
    ClearanceOptions, ClearanceResult, ClearanceWithGaps, ClosestPointOptions, ClosestPoints, CommonOptions,
    Computation, Counts, Details, DeviationField, DeviationMap, DeviationMapOptions, DeviationMaps,
    DiffOptions, DiffResult, Difference, DistanceOptions, DistanceResult, EdgeLengths, EdgesAt,
    EmbeddedDoubt, EmbeddedUnknown, Embedding, Engine, FaceChange, FaceCounterpart, FaceCounts,
    FaceDifference, FaceGap, FaceInfo, FaceState, FieldOptions, FitNorm, FitPose, FitStart, FreeEdge,
    GapOptions, GapsResult, Grid, GridOptions, HausdorffScore, HierarchyOptions, IterationOptions, LeftOut,
    Measure, Method, MethodName, ModelInfo, NamedModel, NamedOptions, NamesOfPair, Overlap, OverlapOptions,
    OverlapResult, OverlapUnknown, OverlapVolumes, PairState, PartDifference, PartFaces, PartMotion,
    PartState, PartsUnknown, Percentile, Placement, Precision, PreparedModel, Query, RequiredDistance,
    Requirement, Rule, Score, ScoreAlignment, ScoreNumber, ScoreOptions, ScoredModel, SelfOverlap, Shell,
    SignedDistanceOptions, SignedDistances, Signs, Solid, Statistics, StatisticsOptions, SurfaceScore,
    UnkeptRule, VolumesUnknown, Witness, Zone, ZoneOptions, checked_bodies,
};
pub use error::{Error, Result};
pub use facets::{Facets, MeshGroup, MeshReport, PointCloud, TriangleMesh};
pub use facts::{Facts, Orientation, VolumeUnknown};
/// The vectors and rotations of points, models and transforms.
pub use glam::{DQuat, DVec2, DVec3};
pub use interval::Interval;
pub use model::{
    Face, InstanceArrays, Model, ModelArrays, NurbsSurface, RigidTransform, SurfaceArrays, face_path,
};
pub use one_line::one_line;
pub use param_box::ParamBox;
pub use progress::{Monitor, NoMonitor};
pub use read::{FaceId, Note, ReadReport, Skipped};
pub use solid::Side;
pub use surface_point::SurfacePoint;

/// The trimming of faces.
pub mod trim {
    pub use crate::error::TrimFault;
    pub use crate::model::trim::{
        FaceArrays, RESOLUTION, Trim, TrimCurveArrays, TrimPiece, Winding, oriented,
    };
}

/// The choices within [`DistanceOptions`].
pub mod options {
    pub use crate::certified::Audit;
    pub use crate::closest::Projection;
    pub use crate::flatness::Flatness;
    pub use crate::iteration::{Culling, SamplingRule};
}

/// The parts of a [`DistanceResult`].
pub mod result {
    pub use crate::closest::Status;
    pub use crate::engine::{
        AuditReport, Bounds, CertifiedDetails, FaceDeviations, HierarchyDetails, IterationDetails, Lemma,
        Lemmas, PatchCounts, Processor, Seconds, Stop, WithGaps,
    };
    pub use crate::iteration::StatusCounts;
}
