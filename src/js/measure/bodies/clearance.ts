import type { Transform, Vector3 } from "../options.js";
import type { OnProgress } from "../progress.js";
import type { SurfacePoint } from "../result.js";

/** Options of `Hausdorff.clearance`. */
export interface ClearanceOptions {
  /** The permitted width of the interval, in model units. Models nearer than it count as touching. */
  tolerance?: number;
  /** The same as a fraction of the larger diagonal; 1e-6 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /** Only decide whether the clearance is at least this; see `atLeast` of the result. */
  limit?: number;
  /** Seconds after which the interval reached is the result. */
  maxSeconds?: number;
  /** Pairs of cells after which the interval reached is the result. */
  maxCells?: number;
  /** Whether B is scaled to A's unit where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves A before it is measured. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the interval reached. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** Options of `Hausdorff.gaps`. */
export interface GapOptions extends Omit<ClearanceOptions, "limit"> {
  /** The distance, in model units, below which pairs of faces are listed; default 0. */
  below?: number;
}

/**
 * Whether two solids share space. `none`: the boundaries are apart, and each solid is outside the
 * other. `touching`: they are nearer than the tolerance, and no point inside both was found.
 * `intersecting`: `insideBoth` is certainly inside both. `contained`: the boundaries are apart, and
 * a part of one is inside the other.
 */
export type Overlap =
  | { kind: "none" | "touching" }
  | { kind: "intersecting" | "contained"; insideBoth: Vector3 };

/**
 * Why nothing is stated of an overlap. `a-open`, `b-open`, `both-open`: a model is not closed.
 * `too-large`: a mesh has more than 250,000 triangles, which are not joined. `side`: it is not
 * decided whether points of one model are inside the other. `cracks`: the boundaries are nearer than the
 * cracks between faces are wide. `limit`, `budget`, `precision`: the limit was decided, a budget was spent, or rounding ended
 * the search, before the boundaries were known to meet or to be apart.
 */
export type OverlapUnknown =
  | "a-open"
  | "b-open"
  | "both-open"
  | "too-large"
  | "side"
  | "cracks"
  | "limit"
  | "budget"
  | "precision";

/** The clearance of two models. */
export interface ClearanceResult {
  /** Guarantee: the least distance of the models' points is in `[lower, upper]`. */
  lower: number;
  upper: number;
  /** Whether the interval is as narrow as requested, or the limit is decided. */
  converged: boolean;
  /** Why the search ended. */
  stop: "converged" | "cells" | "time" | "precision" | "cancelled";
  /**
   * With a limit: whether the clearance is at least the limit, absent if the search ended before
   * that was known. Solids that certainly overlap have no clearance.
   */
  atLeast?: boolean;
  /** Absent where `overlapUnknown` says why. */
  overlap?: Overlap;
  /** Why nothing is stated of an overlap. */
  overlapUnknown?: OverlapUnknown;
  /** The permitted width of the interval, in model units. */
  tolerance: number;
  /** The least tolerance that the rounding of these coordinates allows. */
  minTolerance: number;
  /** Two points, one a model, that are `upper` apart up to rounding; `a` after the transform. */
  witness: { a: SurfacePoint; b: SurfacePoint };
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  /** Metres per unit of every length, if a model states its unit. */
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it.
   */
  hint?: string;
  /** The sum of both models' gaps, as in a distance. */
  gap: number;
  /** Whether the gap is an upper bound by what both readers have proven. */
  gapProven: boolean;
  /** What holds for the sources, which differ from the models by up to their gaps. */
  withGaps: { lower: number; upper: number; atLeast?: boolean };
  /** Number of pairs of cells bounded. */
  cells: number;
  /**
   * Number of lower bounds that corners of both cells refuted, and that were not relied on: 0, unless the
   * library has a fault.
   */
  refuted: number;
  /** Where the time went. */
  seconds: { prepare: number; compile: number; solve: number };
}

/** Two faces that come near each other. Guarantee: their least distance is in `[lower, upper]`. */
export interface FaceGap {
  lower: number;
  upper: number;
  /** Whether the interval is as narrow as requested. */
  converged: boolean;
  /** The faces, with the points that are nearest to each other; `a` after the transform. */
  witness: { a: SurfacePoint; b: SurfacePoint };
}

/** The pairs of faces of two models that come nearer to each other than `below`. */
export interface GapsResult {
  below: number;
  /** The permitted width of the intervals, in model units. */
  tolerance: number;
  /**
   * The pairs, the nearest first. Every pair that is not listed is farther apart than `below`; one
   * whose interval contains `below` may be.
   */
  pairs: FaceGap[];
  /** Whether all faces were compared: no budget ended the search. */
  complete: boolean;
  diagonal: number;
  unit?: number;
  /**
   * What may be wrong with the units: that one model states none, or that the extents agree after a factor that two
   * units have. Nothing was scaled for it.
   */
  hint?: string;
  gap: number;
  gapProven: boolean;
  seconds: { prepare: number; compile: number; solve: number };
}
