import type { Backend, Transform } from "../options.js";
import type { OnProgress } from "../progress.js";
import type { Signs } from "../result.js";

/** Options of `Hausdorff.closestPoints`. */
export interface ClosestPointOptions {
  /**
   * The permitted excess of a distance over the least one, in model units.
   * The smaller it is, the longer points near a bisector of the model take.
   */
  tolerance?: number;
  /** The same as a fraction of the model's diagonal; 1e-9 if neither is given. Both at once are an error. */
  relativeTolerance?: number;
  /**
   * Distances up to this, in model units, have the sign 0, which is then not decided; 0 by default.
   * Beside the faces of a solid a sign takes many times as long as the distance.
   */
  signTolerance?: number;
  /**
   * Where feet are looked for; default `cpu`. With `gpu` every point gets a foot and a bound in float32, and the CPU
   * searches where these do not decide the distance; `auto` takes a GPU that is no software. Meshes and clouds are
   * searched on the CPU.
   */
  backend?: Backend;
  /** Moves the points before they are measured. */
  transform?: Transform;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the fraction of the work done, rising to 1. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** The closest points of a model, one entry a point in each array. */
export interface ClosestPoints {
  /** The distances from the points to their feet. */
  distances: Float64Array<ArrayBuffer>;
  /** Guarantee: the true distance of point i differs from `distances[i]` by at most `bounds[i]`. */
  bounds: Float64Array<ArrayBuffer>;
  /** The distances with signs. */
  signed: Float64Array<ArrayBuffer>;
  /** What the signs stand for. */
  signs: Signs;
  /** x, y, z of every foot, the point of the model that was found. */
  feet: Float64Array<ArrayBuffer>;
  /** The index of every foot's face. */
  faces: Uint32Array<ArrayBuffer>;
  /** u, v of every foot on its surface. */
  parameters: Float64Array<ArrayBuffer>;
  /** The number of points that the GPU's feet and bounds decided; the CPU searched for the others. */
  decidedOnGpu: number;
}
