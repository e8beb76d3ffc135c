import type { Transform, Vector3 } from "./options.js";

/** A transform with both parts. */
export interface Rigid {
  rotation: [x: number, y: number, z: number, w: number];
  translation: Vector3;
}

/** Options of `Hausdorff.bestFit`. */
export interface BestFitOptions {
  /**
   * Samples along each direction of every surface of `a`, 2 to 1024; default 16. Of more than
   * 20,000 in all, those at equal steps of the area are taken.
   */
  samples?: number;
  /** The rule by which they are spread: evenly in the parameter (default) or in arc length. */
  sampling?: "uniform" | "arc-length";
  /** Where `a` is at first; default where it lies. Of fits that are equally good, the one near this. */
  transform?: Transform;
  /**
   * The poses from which the fit starts: all rotations (default), or `transform` alone, which
   * gives the local fit near it.
   */
  start?: "any" | "given";
  /** The share of the samples, 0 to 0.95, that lie on nothing of `b` and are left out; default 0. */
  outliers?: number;
  /**
   * The rule by which samples far from `b` lose their weight: the share of `outliers` is left out
   * (`trimmed`, the default with outliers), Tukey's biweight, Geman's and McClure's weight, or
   * `none`, the default without.
   */
  robust?: "none" | "trimmed" | "tukey" | "geman-mcclure";
  /** The length, in model units, below which a step ends the fit. */
  tolerance?: number;
  /**
   * The same as a fraction of the larger diagonal; if neither is given 1e-9, which is the
   * accuracy of the distances. Both at once are an error.
   */
  relativeTolerance?: number;
  /** Largest number of steps of the last fit; default 100. */
  maxSteps?: number;
  /** Whether `b` is scaled to the unit of `a` where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /**
   * Called after every step of the last fit with its number, the root mean square of the distances so
   * far, and the fraction of the work done. While poses are searched the step is 0 and the root mean
   * square `Infinity`. An error that it throws cancels the work.
   */
  onProgress?: (step: number, rms: number, fraction: number) => void;
}

/** A pose of one model that fits another. */
export interface FitPose {
  /** Moves `a` there: what `transform` of `distance` takes. */
  transform: Rigid;
  /** The root mean square of the samples' distances there: an estimate. */
  rms: number;
}

/** The pose of one model that fits another best. */
export interface BestFit {
  /** Moves `a` to its best fit: what `transform` of `distance` takes. */
  transform: Rigid;
  /**
   * The root mean square there of the samples' distances, weighted by area, without those left
   * out: an estimate.
   */
  rms: number;
  /** The same before. */
  rmsBefore: number;
  /**
   * The same in a pose that nothing determines: the median of 48 rotations spread over all, with the
   * centres apart by half the radius of gyration.
   */
  rmsRandom: number;
  /** Number of steps of the last fit. */
  steps: number;
  /**
   * Whether the last fit ended by itself, and its residual is at most a tenth of `rmsRandom`, or all
   * poses known come to it.
   */
  converged: boolean;
  /** The other poses found whose residual is at most twice the best one: those of symmetric parts. */
  ambiguous: FitPose[];
  /** The number of independent motions that change no distance: 1 of a part of revolution, 3 of a ball. */
  freedoms: number;
  /** The number of poses that the fit started from. */
  tried: number;
  /** The number of samples. */
  samples: number;
  /** The samples left out: x, y, z each, where `a` lies in its own file, and the distance beyond which. */
  leftOut: { beyond?: number; points: number[] };
}
