import type { Transform } from "../options.js";
import type { OnProgress } from "../progress.js";
import type { FaceDeviations, Statistics } from "../result.js";

/** Options of `Hausdorff.field`. */
export interface FieldOptions {
  /**
   * Samples along each direction of every surface of `a`, 2 to 1024; default 64. A mesh is sampled
   * at its vertices, and each group in at least their square of triangles; a cloud at its points.
   */
  samples?: number;
  /** The rule by which they are spread: evenly in the parameter (default) or in arc length. */
  sampling?: "uniform" | "arc-length";
  /**
   * A known upper bound on the distance from `a` to `b`, such as a result's `upper`, in
   * model units, 0 or more: no distance of the field exceeds it.
   */
  upper?: number;
  /** Whether `b` is scaled to the unit of `a` where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves `a` before it is measured. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the fraction of the work done, rising to 1. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** The deviation of one model from another at samples of the first. */
export interface DeviationField {
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  /** Where the samples stand for an area. */
  statistics?: Statistics;
  /** One entry a face of the sampled model, a piece of a trimmed one, a group of a mesh, or a cloud. */
  deviations: FaceDeviations[];
}
