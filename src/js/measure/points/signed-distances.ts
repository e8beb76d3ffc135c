import type { Vector3 } from "../options.js";
import type { OnProgress } from "../progress.js";

/** The precision of the values of `Hausdorff.signedDistances`. */
export type Precision = "float32" | "float64";

/** Options of `Hausdorff.signedDistances`. What is left out of the grid follows from the model's box. */
export interface SignedDistanceOptions<P extends Precision = Precision> {
  /** The first point. If it is left out, the box is in the middle of the grid. */
  origin?: Vector3;
  /** The distance of neighbours along each axis, in model units. */
  spacing?: number;
  /**
   * The number of points along x, y and z. If it is left out, the grid reaches to the band's width and to two
   * spacings at least beyond the box.
   */
  counts?: Vector3;
  /** The number of spacings along the longest side of the box, 1 to 1024; 64 by default. Not beside `spacing`. */
  resolution?: number;
  /** Distances above it, in model units, are not measured: their values are its width, with their sign. */
  band?: number;
  /** The permitted excess of a distance over the least one, in model units. */
  tolerance?: number;
  /** The same as a fraction of the model's diagonal; 1e-6 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /** The precision of the values, `"float64"` by default; `bound` has the rounding to it. */
  precision?: P;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the fraction of the work done, rising to 1. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** The signed distances of a solid at the points `origin + spacing (i, j, k)`. */
export interface SignedDistances<P extends Precision = Precision> {
  origin: [x: number, y: number, z: number];
  spacing: number;
  counts: [nx: number, ny: number, nz: number];
  /** The value of point (i, j, k) at `i + nx * (j + ny * k)`, negative inside, never NaN. */
  values: { float32: Float32Array<ArrayBuffer>; float64: Float64Array<ArrayBuffer> }[P];
  precision: P;
  /**
   * Guarantee: a value of a size below `band` is within it of the true distance. Where a value has the band's
   * size, the true distance is at least that less the bound.
   */
  bound: number;
  /** The band's width; infinite if all points were measured. */
  band: number;
  /**
   * The places in `values` of the points whose side is not decided, rising: on the boundary, or in its gaps. Their
   * values are positive. All other signs are certain.
   */
  undecided: Uint32Array<ArrayBuffer>;
  /** The number of measured points: of each brick its middle, and its points unless they are beyond the band. */
  measured: number;
}

/**
 * The signed distances of a layer of a grid's bricks: the bound is without the rounding to the precision.
 * @internal
 */
export interface LayerDistances extends SignedDistances {
  /** What the rounding adds to the bound. */
  rounding: number;
}
