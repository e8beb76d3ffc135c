// The types and the error class that the package's entries share.

export type { CadKind } from "./cad/kind.js";
export type { MeshFormat, MeshOptions } from "./cad/mesh.js";
export type { CadOptions } from "./cad/options.js";
export type { Libraries, LibraryOptions, PeerLoader } from "./cad/peers/peers.js";
export type { CadReader, CadReport, FaceNote, SkippedFace } from "./cad/report.js";
export { type ErrorCode, HausdorffError, type HausdorffErrorOptions } from "./error.js";
export type { ModuleSource } from "./load.js";
export type {
  BodyPair,
  CheckedBody,
  CheckOptions,
  CheckResult,
  CheckRules,
  EmbeddedUnknown,
  NamesOfPair,
  PairState,
  SelfOverlap,
  UnkeptRule,
} from "./measure/bodies/check.js";
export type {
  ClearanceOptions,
  ClearanceResult,
  FaceGap,
  GapOptions,
  GapsResult,
  Overlap,
  OverlapUnknown,
} from "./measure/bodies/clearance.js";
export type { OverlapOptions, OverlapResult, VolumesUnknown } from "./measure/bodies/overlap.js";
export type {
  AtThreshold,
  Difference,
  EdgeLengths,
  FaceCounts,
  HausdorffScore,
  Placement,
  Requirement,
  Score,
  ScoredModel,
  ScoreNumber,
  ScoreOptions,
  SurfaceScore,
} from "./measure/bodies/score.js";
export type {
  DiffOptions,
  DiffResult,
  FaceCounterpart,
  FaceDifference,
  FaceState,
  PartDifference,
  PartState,
} from "./measure/diff.js";
export type { DistanceEngine } from "./measure/engine.js";
export { Latest } from "./measure/latest.js";
export type {
  Backend,
  CertifiedOptions,
  CommonOptions,
  DistanceOptions,
  HierarchyOptions,
  IterationOptions,
  Transform,
  Vector3,
} from "./measure/options.js";
export type { ClosestPointOptions, ClosestPoints } from "./measure/points/closest.js";
export type { DeviationField, FieldOptions } from "./measure/points/field.js";
export type {
  BestFit,
  BestFitOptions,
  Datum,
  DatumFeature,
  FitPose,
  PointPair,
  Rigid,
  Zone,
  ZoneOptions,
} from "./measure/points/fit.js";
export type {
  DeviationMap,
  DeviationMapOptions,
  DeviationMaps,
  KnownDeviation,
} from "./measure/points/maps.js";
export type {
  Precision,
  SignedDistanceOptions,
  SignedDistances,
} from "./measure/points/signed-distances.js";
export type { OnProgress } from "./measure/progress.js";
export type {
  AuditReport,
  CertifiedResult,
  DistanceResult,
  FaceDeviations,
  HierarchyResult,
  IterationResult,
  Results,
  Signs,
  Statistics,
  SurfacePoint,
  WithGaps,
} from "./measure/result.js";
export type {
  CertifiedStatistics,
  StatisticsOptions,
} from "./measure/statistics.js";
export type { Area, ModelArea } from "./model/area.js";
export { facePath } from "./model/face-path.js";
export type {
  Body,
  Facts,
  Interval,
  Intervals3,
  Orientation,
  VolumeUnknown,
} from "./model/facts.js";
export type { FaceForm } from "./model/form.js";
export type { MeshArrays, MeshGroup } from "./model/mesh.js";
export type { UpdateOptions } from "./model/model.js";
export type { FreeEdge, Solid } from "./model/solid.js";
export type {
  BrepText,
  ControlPoint,
  InstanceArrays,
  InterchangeCurve,
  InterchangeInstance,
  InterchangeModel,
  InterchangeSurface,
  ModelArrays,
  Numbers,
  SurfaceArrays,
  TrimCurveArrays,
} from "./model/surface.js";
export type { Tessellation, TessellationOptions } from "./model/tessellation.js";
