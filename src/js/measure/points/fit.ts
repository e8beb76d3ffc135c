import { checkKeys } from "../../keys.js";
import type { Transform, Vector3 } from "../options.js";

/** A transform with both parts. */
export interface Rigid {
  rotation: [x: number, y: number, z: number, w: number];
  translation: Vector3;
}

/** A point of `a` and the point of `b` on which it belongs, with a positive weight; default 1. */
export interface PointPair {
  a: Vector3;
  b: Vector3;
  weight?: number;
}

/**
 * A feature that a datum is taken from: a plane by a point and its outward normal, an axis by a point
 * and its direction, both of any length, a point, or a face by its index. A flat face stands for its
 * plane, a ball for its centre, another surface of revolution for its axis; its direction is turned to
 * the side of that of the other model.
 */
export type DatumFeature =
  | { plane: { point: Vector3; normal: Vector3 } }
  | { axis: { point: Vector3; direction: Vector3 } }
  | { point: { point: Vector3 } }
  | { face: { index: number } };

/** A datum of `a` and that of `b` on which it belongs; both are of one kind. */
export interface Datum {
  a: DatumFeature;
  b: DatumFeature;
}

/** The motions over which the least largest distance is bounded: a box about the pose found. */
export interface ZoneOptions {
  /** The largest shift, in model units, 0 or more; default a hundredth of the larger diagonal. */
  translation?: number;
  /** The largest angle, in degrees, 0 to 45; default 1. */
  degrees?: number;
  /** The distance that `passes` is about, in model units; 0 or more with `norm: "largest"`. */
  limit?: number;
  /** The largest number of boxes of motions that are bounded; default 5000. */
  maxBoxes?: number;
}

/**
 * The least, over a box of motions, of the largest distance of the points of `a`: certain. With a norm of one side
 * distances on the other one are negative.
 */
export interface Zone {
  /** No motion of the box brings all points of `a` nearer to `b` than this. */
  lower: number;
  /** In the pose found no point of `a` is farther from `b` than this. */
  upper: number;
  /** The box: turns by up to this angle about `center`, in degrees, from the pose found … */
  degrees: number;
  /** … followed by shifts of up to this length; both only in the freedoms that datums leave. */
  translation: number;
  /** The centre of the turns, in the frame of `b`. */
  center: Vector3;
  /** The number of boxes of motions that were bounded. */
  boxes: number;
  /** The number of bounds that an audit refuted, and that were not relied on: 0, unless the library has a fault. */
  refuted: number;
  /**
   * Whether some motion of the box brings all of `a` within the limit; absent without a limit, and
   * where it lies between the bounds.
   */
  passes?: boolean;
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
   * The poses from which the fit starts: all rotations (default); `transform` alone, which gives the
   * local fit near it; the principal axes of both on each other; or `transform`, moved so that the
   * middles of both boxes agree.
   */
  start?: "any" | "given" | "axes" | "boxes";
  /**
   * What the fit makes least: the root mean square of the distances (default); the largest distance; the largest
   * distance of a scan's points outside of the body of `b`, or inside, which is negative if all are on the other side;
   * or nothing: `a` then stays in its first pose, whose residual is stated.
   */
  norm?: "mean" | "largest" | "outside" | "inside" | "none";
  /** Points of `a` with those of `b`, three or more: the first pose lays them on each other. */
  pairs?: PointPair[];
  /**
   * Datums in their order, the primary first, laid on each other in the first pose; the fit moves
   * `a` only in the freedoms that they leave.
   */
  datums?: Datum[];
  /** The motions over which the least largest distance is bounded, with a norm of the largest one. */
  zone?: ZoneOptions;
  /** The share of the samples, 0 to 0.95, that lie on nothing of `b` and are left out; default 0. */
  outliers?: number;
  /**
   * The rule by which samples far from `b` lose their weight: the share of `outliers` is left out
   * (`trimmed`, the default with outliers), Tukey's biweight, Geman's and McClure's weight, or
   * `none`, the default without.
   */
  robust?: "none" | "trimmed" | "tukey" | "geman-mcclure";
  /** The faces of `a`, by their indices, whose samples count in the last fit; default all. `a` has surfaces. */
  facesOfA?: number[];
  /**
   * The faces of `b`, by their indices: in the last fit the samples count whose closest points lie there; default
   * all. `b` has surfaces.
   */
  facesOfB?: number[];
  /** The distance from `b`, in model units, positive, beyond which a sample does not count in the last fit. */
  maxDistance?: number;
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

/** The names within options that are objects themselves. */
const ZONE: readonly (keyof ZoneOptions)[] = ["translation", "degrees", "limit", "maxBoxes"];
const PAIR: readonly (keyof PointPair)[] = ["a", "b", "weight"];
const DATUM: readonly (keyof Datum)[] = ["a", "b"];
const FEATURES = {
  plane: ["point", "normal"],
  axis: ["point", "direction"],
  point: ["point"],
  face: ["index"],
};

/**
 * Refuses names in the zone, the pairs and the datums that are not known: the module sees only those that it looks
 * for.
 *
 * @throws {HausdorffError} `OPTION_INVALID`.
 * @internal
 */
export function checkFit(options: BestFitOptions): void {
  if (typeof options !== "object" || options === null) return;
  const { zone, pairs, datums } = options;
  const check = (where: string, given: unknown, known: readonly string[]) => {
    if (typeof given === "object" && given !== null) checkKeys(where, given, known);
  };
  check("zone", zone, ZONE);
  const all = (list: unknown): unknown[] => (Array.isArray(list) ? list : []);
  for (const pair of all(pairs)) check("pairs", pair, PAIR);
  for (const datum of all(datums)) {
    check("datums", datum, DATUM);
    const { a, b } = (datum ?? {}) as Partial<Datum>;
    for (const feature of [a, b]) {
      check("datums", feature, Object.keys(FEATURES));
      for (const [kind, known] of Object.entries(FEATURES)) {
        check(`datums: ${kind}`, (feature as Record<string, unknown> | undefined)?.[kind], known);
      }
    }
  }
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
  /** The largest of these distances: an estimate. */
  largest: number;
  /** The interval of the least largest distance, with a norm of the largest one. */
  zone?: Zone;
  /**
   * Whether that interval is narrow: at most a hundredth of `zone.upper` wide. Otherwise `zone.upper` is
   * the zone that was found, and that none is less has not been shown.
   */
  zoneProven?: boolean;
  /** The number of freedoms, of six, that each datum took, in their order; absent without datums. */
  taken?: number[];
  /** The root mean square where `a` was at first. */
  rmsBefore: number;
  /**
   * The root mean square in a pose that nothing determines: the median of 48 rotations spread over all, with the
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
  /** The number of samples of `a`, or of `facesOfA`. */
  samples: number;
  /** The number of those that count in the pose found: not left out, and nearest to `facesOfB`. */
  counted: number;
  /** The samples left out: x, y, z each, where `a` lies in its own file, and the distance beyond which. */
  leftOut: { beyond?: number; points: number[] };
}
