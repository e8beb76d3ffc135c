import { HausdorffError } from "../error.js";
import { requireSignal } from "./cancelled.js";
import type { OnProgress } from "./progress.js";

/** The processor to compute on: `auto` is the GPU if there is one, else the CPU. */
export type Backend = "auto" | "gpu" | "cpu";

export type Vector3 = [x: number, y: number, z: number];

/** A rotation about the origin, then a translation. */
export interface Transform {
  translation?: readonly [x: number, y: number, z: number];
  /** A unit quaternion. */
  rotation?: readonly [x: number, y: number, z: number, w: number];
}

/** Options of `Hausdorff.distance` with every method. */
export interface CommonOptions {
  /** The permitted width of the interval, in model units. Methods but `certified` only report whether theirs is as narrow. */
  tolerance?: number;
  /** The same as a fraction of the larger diagonal; 1e-6 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /**
   * The length that the verdict is about: see `within` of the results. The search of `certified` ends
   * as soon as it is known.
   */
  limit?: number;
  /** Whether the distance from B to A is computed too; default no. */
  symmetric?: boolean;
  /** Whether B is scaled to A's unit where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves A before it is measured, without an upload. */
  transform?: Transform;
  /** The processor for this distance; default `auto`. */
  backend?: Backend;
  /** Whether every sample of a grid, its foot point and statistics are returned; default no. */
  deviations?: boolean;
  /**
   * Samples along each direction of every surface, 2 to 1024; default 64. Only with method
   * `iteration` or `deviations`.
   */
  samples?: number;
  /** The rule by which they are spread: evenly in the parameter (default) or in arc length. */
  sampling?: "uniform" | "arc-length";
  /**
   * Cancels the work, before it begins or while it is done: the promise rejects with code
   * `CANCELLED`, and the error has the interval reached, if there is one. Budgets resolve to it.
   */
  signal?: AbortSignal;
  /**
   * Called with the fraction of the work done, rising to 1, and by all methods
   * but `iteration` with the interval reached, by `certified` also with whether
   * the search has stalled. An error that it throws cancels
   * the work.
   */
  onProgress?: OnProgress;
}

/** Options of `Hausdorff.distance` by method `certified`, the default. */
export interface CertifiedOptions extends CommonOptions {
  method?: "certified";
  /** Seconds per direction after which the interval reached is the result. */
  maxSeconds?: number;
  /** Cells per direction after which the interval reached is the result. */
  maxCells?: number;
  /**
   * The upper bounds that are audited while the search runs, by certified closest points that they have
   * nothing in common with: a share of those beyond the simplest (default), or all of them.
   */
  audit?: "share" | "all";
}

/** Options of `Hausdorff.distance` by the 2012 paper's method, with the defaults of the paper. */
export interface IterationOptions extends CommonOptions {
  method: "iteration";
  /** The flatness to which the other model's patches are cut; default `loose`, normals within 45°. */
  flatness?: "none" | "loose" | "tight" | "curvature";
  /** The step of the projection: damped Newton (default) or the paper's tangent-plane step. */
  projection?: "newton" | "tangent-plane";
  /** The patches on which a sample is projected: those near enough (default), or all as in the paper. */
  culling?: "tree" | "none";
  /** Largest number of steps on one patch, 1 to 300; default 5. */
  iterations?: number;
  /** Change of distance that ends the tangent-plane iteration, in model units; default 0.01. */
  stepTolerance?: number;
}

/** Options of `Hausdorff.distance` by the 2011 paper's method. */
export interface HierarchyOptions extends CommonOptions {
  method: "hierarchy";
  /**
   * Cells along each direction of every surface, 2 to 1024 provided that a model has at most
   * 2^22 cells; default 64.
   */
  grid?: number;
  /** MiB for pairs of boxes, 1 to 256; default 256. */
  memoryBudget?: number;
}

/** Options of `Hausdorff.distance`, by the method that they name; those of another one are refused. */
export type DistanceOptions = CertifiedOptions | IterationOptions | HierarchyOptions;

/**
 * Options of any method.
 * @internal
 */
export interface SplittableOptions<Report> {
  transform?: Transform;
  signal?: AbortSignal;
  onProgress?: Report;
}

/** @internal */
export interface SplitOptions<Report> {
  plain: object;
  transform: Transform | undefined;
  signal: AbortSignal | undefined;
  onProgress: Report | undefined;
}

/**
 * The options that are plain data and the transform, which the module checks,
 * and those that are objects of JavaScript.
 * @internal
 */
export function split<Report extends (...progress: never[]) => void>(
  options: SplittableOptions<Report>,
): SplitOptions<Report> {
  if (typeof options !== "object" || options === null) {
    throw invalid(`options are ${options === null ? "null" : typeof options}, expected an object`);
  }
  const { transform, signal, onProgress, ...plain } = options;
  requireSignal(signal);
  if (onProgress !== undefined && typeof onProgress !== "function") {
    throw invalid(`onProgress is ${typeof onProgress}, expected a function`);
  }
  return { plain, transform, signal, onProgress };
}

function invalid(message: string): HausdorffError {
  return new HausdorffError("OPTION_INVALID", message);
}
