import { HausdorffError } from "./error.js";

/** Where to compute: `auto` is the GPU if there is one, else the CPU. */
export type Backend = "auto" | "gpu" | "cpu";

export type Vector3 = [x: number, y: number, z: number];

/** A rotation about the origin, then a translation. */
export interface Transform {
  translation?: readonly [x: number, y: number, z: number];
  /** A unit quaternion. */
  rotation?: readonly [x: number, y: number, z: number, w: number];
}

/**
 * Options of `Hausdorff.distance`. Those from `samples` to `stepTolerance` are
 * for method `iteration` and the `field`; their defaults are the 2012 paper's.
 */
export interface DistanceOptions {
  /**
   * How the distance is computed: `certified` (default), the 2012 paper's
   * `iteration` or the 2011 paper's `hierarchy`.
   */
  method?: "certified" | "iteration" | "hierarchy";
  /**
   * `certified`: the width asked of the interval; default 1e-6. `hierarchy`
   * only says whether its interval is as narrow.
   */
  tolerance?: number;
  /** Whether `tolerance` is in model units; else (default) it is relative to the larger diagonal. */
  absolute?: boolean;
  /** `certified`: ask only whether the distance is at most this; see `within` of the result. */
  limit?: number;
  /** `certified`: seconds a direction after which the interval so far is the result. */
  maxSeconds?: number;
  /** `certified`: cells a direction after which the interval so far is the result. */
  maxCells?: number;
  /** Samples along each direction of every surface, 2 to 1024; default 64. */
  samples?: number;
  /** How they are spread: evenly in the parameter (default) or in arc length. */
  sampling?: "uniform" | "arc-length";
  /** How flat the other model's patches are cut; default `loose`, normals within 45°. */
  flatness?: "none" | "loose" | "tight" | "curvature";
  /** The step of the projection: damped Newton (default) or the paper's own. */
  projection?: "newton" | "tangent-plane";
  /** Patches tried for a sample: those near enough (default), or all as in the paper. */
  culling?: "tree" | "none";
  /** Steps on one patch, 1 to 300; default 5. */
  iterations?: number;
  /** Change of distance that ends the tangent-plane iteration, in model units; default 0.01. */
  stepTolerance?: number;
  /**
   * `hierarchy`: cells along each direction of every surface, 2 to 1024 as
   * long as a model has at most 2^22 cells; default 64.
   */
  grid?: number;
  /** `hierarchy`: MiB for pairs of boxes, 1 to 256; default 256. */
  memoryBudget?: number;
  /** Whether the distance from B to A is measured too; default no. */
  symmetric?: boolean;
  /** Moves A before it is measured; costs no upload. */
  transform?: Transform;
  /** Where to compute this distance; default `auto`. */
  backend?: Backend;
  /** Whether every sample of a grid, its foot point and statistics are returned; default no. */
  field?: boolean;
  /**
   * Cancels: all but `certified` then reject with code `CANCELLED`, and so does
   * what has not begun; `certified` resolves to the interval so far, with `stop`
   * `cancelled`.
   */
  signal?: AbortSignal;
  /**
   * Told the part of the work done, rising to 1, and but by `iteration` the
   * interval so far. What it throws cancels the work.
   */
  onProgress?: OnProgress;
}

/** What `onProgress` is. */
export type OnProgress = (fraction: number, interval?: [lower: number, upper: number]) => void;

/** @internal */
export interface SplitOptions {
  plain: object;
  signal: AbortSignal | undefined;
  onProgress: OnProgress | undefined;
}

/**
 * The options that are data, which the module checks, and those that are not.
 * @internal
 */
export function split(options: DistanceOptions): SplitOptions {
  if (typeof options !== "object" || options === null) {
    throw invalid(`options are ${options === null ? "null" : typeof options}, expected an object`);
  }
  const { signal, onProgress, ...plain } = options;
  if (signal !== undefined && typeof signal?.aborted !== "boolean") {
    throw invalid("signal is no AbortSignal");
  }
  if (onProgress !== undefined && typeof onProgress !== "function") {
    throw invalid(`onProgress is ${typeof onProgress}, expected a function`);
  }
  return { plain, signal, onProgress };
}

function invalid(message: string): HausdorffError {
  return new HausdorffError("OPTION_INVALID", message);
}
