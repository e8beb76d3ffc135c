import type { MeshFormat, MeshOptions } from "../cad/mesh.js";
import type { CadOptions } from "../cad/options.js";
import type { BrepText, Numbers } from "../model/surface.js";
import type { CheckOptions, CheckResult } from "./bodies/check.js";
import type {
  ClearanceOptions,
  ClearanceResult,
  GapOptions,
  GapsResult,
} from "./bodies/clearance.js";
import type { OverlapOptions, OverlapResult } from "./bodies/overlap.js";
import type { Score, ScoreOptions } from "./bodies/score.js";
import type { DiffOptions, DiffResult } from "./diff.js";
import type { DistanceOptions } from "./options.js";
import type { ClosestPointOptions, ClosestPoints } from "./points/closest.js";
import type { DeviationField, FieldOptions } from "./points/field.js";
import type { BestFit, BestFitOptions } from "./points/fit.js";
import type { DeviationMapOptions, DeviationMaps } from "./points/maps.js";
import type {
  Precision,
  SignedDistanceOptions,
  SignedDistances,
} from "./points/signed-distances.js";
import type { Results } from "./result.js";
import type { CertifiedStatistics, StatisticsOptions } from "./statistics.js";

/**
 * The methods of both classes `Hausdorff`: that of the main entry, and
 * that of `nurbs-hausdorff/worker`, whose models are of type `Model`.
 */
export interface DistanceEngine<Model> {
  /** Where distances are computed unless their options say otherwise. */
  readonly backend: "gpu" | "cpu";

  /** The GPU's name, if there is a GPU and the platform reports it. */
  readonly adapter: string | null;

  /** The reason why there is no GPU, if one was looked for. */
  readonly notice: string | null;

  /**
   * The directed distance from `a`, moved by `transform`, to `b`: the largest
   * distance from a point of `a` to `b`. With `symmetric`, the larger of both
   * directions. Distances requested at once are computed in turn. The method
   * that the options name decides the result's type.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its
   * cause; `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`;
   * `UNITS_DIFFER`, unless `scaleUnits` is set;
   * `DEVICE_LOST` and `NO_ADAPTER` with backend `gpu` only; `GPU_FAILED`;
   * `PAIR_BUDGET_EXCEEDED` with method `hierarchy` only.
   */
  distance<Method extends keyof Results = "certified">(
    a: Model,
    b: Model,
    options?: DistanceOptions & { method?: Method },
  ): Promise<Results[Method]>;

  /**
   * The deviation of `a`, moved by `transform`, from `b` at a grid of samples: distances,
   * signs, closest points, and statistics over the area. As `distance` with `deviations`, but
   * without the distance, so that a picture can follow a result, coarse and then fine.
   *
   * Guarantee: a sample's distance is not below its true one up to rounding, and exceeds it
   * by at most 1e-9 of the larger diagonal.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause;
   * `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`, `UNITS_DIFFER`.
   */
  field(a: Model, b: Model, options?: FieldOptions): Promise<DeviationField>;

  /**
   * Maps of deviations to draw: the triangles of `a`, moved by `transform`, of `b`, or of both, with the
   * deviation from the other model at each vertex, split where it is not linear between them.
   *
   * Guarantee: the distance at a vertex is that of its point to 5e-8 of the other model's diagonal, unless a
   * known bound is less. Between vertices it is an estimate.
   *
   * @throws {HausdorffError} as `field`; `OPTION_OUT_OF_RANGE` for a bound below 0; `POINT_OUT_OF_RANGE` for a
   * farthest point or foot with a coordinate that is not finite or above 1e100 in size.
   */
  deviationMaps(a: Model, b: Model, options?: DeviationMapOptions): Promise<DeviationMaps>;

  /**
   * Compares every face of `a`, moved by `transform`, with `b`, and every face of `b`
   * with `a`, by method `certified` on the CPU: which faces changed by more than the
   * limit, how far and where.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause;
   * `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`.
   */
  diff(a: Model, b: Model, options?: DiffOptions): Promise<DiffResult>;

  /**
   * The least distance of a point of `a`, moved by `transform`, from a point of `b`, as an interval
   * with the two points, and for solids whether they overlap. The boundaries are measured: a part
   * inside another has the distance of their surfaces.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause;
   * `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`, `UNITS_DIFFER`.
   */
  clearance(a: Model, b: Model, options?: ClearanceOptions): Promise<ClearanceResult>;

  /**
   * The volumes that the solids `a`, moved by `transform`, and `b` have in common and apart, and their ratio, each an
   * interval that holds it. Where a model has no volume, `volumesUnknown` says why.
   *
   * @throws {HausdorffError} as `clearance`.
   */
  overlap(a: Model, b: Model, options?: OverlapOptions): Promise<OverlapResult>;

  /**
   * The pairs of faces of `a`, moved by `transform`, and of `b` that come nearer to each other than
   * `below`, each with the interval of its least distance and the two points.
   *
   * @throws {HausdorffError} as `clearance`.
   */
  gaps(a: Model, b: Model, options?: GapOptions): Promise<GapsResult>;

  /**
   * All pairs of bodies of one assembly, or of several models where they stand: which certainly clash, touch or come
   * near, how deep and where, and the rules that are not kept.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause; `OPTION_OUT_OF_RANGE`,
   * `OPTION_INVALID`, also for a rule of no body; `UNITS_DIFFER`; `FACETS_UNSUPPORTED` for a cloud.
   */
  check(models: Model | readonly Model[], options?: CheckOptions): Promise<CheckResult>;

  /**
   * Statistics of the distances from all points of `a`, moved by `transform`, to `b`, each an
   * interval that holds it: of a cloud by count, else by area. Those of `field` are estimates.
   *
   * @throws {HausdorffError} as `field`; `NO_AREA` for an `a` whose area may be 0.
   */
  statistics(a: Model, b: Model, options?: StatisticsOptions): Promise<CertifiedStatistics>;

  /**
   * The score of a candidate against the truth: mean distances both ways, precision, recall and F1 by
   * area, the Hausdorff distance, differences of facts and validity, each an interval that holds it.
   *
   * @throws {HausdorffError} as `statistics`.
   */
  score(candidate: Model, truth: Model, options?: ScoreOptions): Promise<Score>;

  /**
   * The closest points of `model` to `points` (x, y, z each, such as the vertices of
   * a mesh or a scan), moved by `transform`: distances, feet and a bound for each.
   * Their order does not matter.
   *
   * @throws {HausdorffError} `POINT_OUT_OF_RANGE`, with the index of the point;
   * `CANCELLED`, `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`.
   */
  closestPoints(
    model: Model,
    points: Numbers,
    options?: ClosestPointOptions,
  ): Promise<ClosestPoints>;

  /**
   * The signed distances of the solid `model` on a grid of points, negative inside: all within one
   * stated bound, signs certain but for those that are listed. With a `band`, only points about the
   * boundary are measured.
   *
   * @throws {HausdorffError} `NOT_CLOSED` for a model without an inside; `CANCELLED`,
   * `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`.
   */
  signedDistances<P extends Precision = "float64">(
    model: Model,
    options?: SignedDistanceOptions<P>,
  ): Promise<SignedDistances<P>>;

  /**
   * Finds the rigid motion of `a` that minimises the mean of the squared distances of its
   * samples from `b`, weighted by area, as coordinate metrology aligns parts. Each step
   * searches all closest points anew and solves the linearised problem, after Levenberg and
   * Marquardt; a step that raises the sum is not taken. Directions in which nothing changes,
   * such as the rotation of a sphere, stay as they are.
   *
   * The fit starts from rotations spread over all, from principal axes and from `transform`, and the
   * best is taken; `ambiguous` lists the other poses of symmetric parts. `converged` is never
   * true of a residual that a random pose has. It is no certified result: measure `distance` there.
   *
   * @throws {HausdorffError} as `field`; `OPTION_OUT_OF_RANGE` for a tolerance or a number of
   * steps that is not positive, and for outliers beyond 0 to 0.95.
   */
  bestFit(a: Model, b: Model, options?: BestFitOptions): Promise<BestFit>;

  /**
   * Reads a CAD file: STEP, IGES, Rhino 3DM, OpenCASCADE BREP text, FreeCAD FCStd or
   * interchange JSON, each also compressed by gzip; or the BREP text of a shape in memory,
   * which `fromOcct` writes. The kind is found by the content; the model's `report` says
   * what was kept, approximated and left out, and by which reader. The readers are loaded
   * with the first file.
   *
   * @throws {HausdorffError} as `readCad` of `nurbs-hausdorff/cad`.
   */
  readCad(bytes: Uint8Array | ArrayBuffer | BrepText, options?: CadOptions): Promise<Model>;

  /**
   * Reads a mesh or points of this format. The readers are loaded with the first file.
   *
   * @throws {HausdorffError} as `readMesh` of `nurbs-hausdorff/cad`.
   */
  readMesh(
    bytes: Uint8Array | ArrayBuffer,
    format: MeshFormat,
    options?: MeshOptions,
  ): Promise<Model>;
}
