export type { ClosestPoints } from "../closest.js";
export type { DiffOptions, DiffResult, FaceDifference, FaceState } from "../diff.js";
export { type ErrorCode, HausdorffError } from "../error.js";
export type { ShapeInfo } from "../hausdorff.js";
export type { ModuleSource } from "../load.js";
export type { Backend, DistanceOptions, OnProgress, Transform, Vector3 } from "../options.js";
export type {
  CertifiedResult,
  DistanceResult,
  Field,
  HierarchyResult,
  IterationResult,
  Statistics,
  SurfacePoint,
} from "../result.js";
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
} from "../surface.js";
export type { Tessellation } from "../tessellation.js";
export {
  Hausdorff,
  type WorkerClosestPointOptions,
  type WorkerCreateOptions,
} from "./hausdorff.js";
export { NurbsModel } from "./model.js";
