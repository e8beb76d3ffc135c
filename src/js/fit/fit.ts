import type { Transform } from "../measure/options.js";
import type { Rigid } from "./rigid.js";

/** Options of `Hausdorff.bestFit`. */
export interface BestFitOptions {
  /** Samples along each direction of every surface of `a`, 2 to 1024; default 16. */
  samples?: number;
  /** The rule by which they are spread: evenly in the parameter (default) or in arc length. */
  sampling?: "uniform" | "arc-length";
  /** Where `a` is at first; default where it lies. The fit found is a local one, near this. */
  transform?: Transform;
  /** The length, in model units, below which a step ends the fit. */
  tolerance?: number;
  /**
   * The same as a fraction of the larger diagonal; if neither is given 1e-9, which is the
   * accuracy of the distances. Both at once are an error.
   */
  relativeTolerance?: number;
  /** Largest number of steps; default 100. */
  maxSteps?: number;
  /** Whether `b` is scaled to the unit of `a` where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called after every step with its number and the root mean square of the distances so far. */
  onProgress?: (step: number, rms: number) => void;
}

/** The position of one model that fits another best. */
export interface BestFit {
  /** Moves `a` to its best fit: what `transform` of `distance` takes. */
  transform: Rigid;
  /** The root mean square of the samples' distances there, weighted by area: an estimate. */
  rms: number;
  /** The root mean square before. */
  rmsBefore: number;
  /** Number of steps taken. */
  steps: number;
  /** Whether a step was below the tolerance or had nothing to gain; else the number of steps ended the fit. */
  converged: boolean;
}
