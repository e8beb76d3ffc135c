import { HausdorffError } from "../../error.js";
import { checkKeys } from "../../keys.js";
import type { Transform, Vector3 } from "../options.js";
import type { OnProgress } from "../progress.js";
import type { Signs } from "../result.js";
import type { ClosestPointOptions, ClosestPoints } from "./closest.js";

/** What is known of a model whose map is made. */
export interface KnownDeviation {
  /**
   * A known upper bound on the distance of all its points from the other model, such as a result's
   * `upper`, or one for each face, as those of `diff`: no deviation of the map exceeds it.
   */
  uppers?: readonly number[];
  /** The farthest point found, such as a result's witness, which becomes a vertex of the map. */
  farthest?: {
    /** The index of its face. */
    face: number;
    point: Vector3;
    /** Its nearest point on the other model. */
    foot: Vector3;
  };
}

/** Options of `Hausdorff.deviationMaps`. */
export interface DeviationMapOptions {
  /** What is known of `a`, whose map is made; `{}` for nothing. Without `a` and `b` the map of `a` is made. */
  a?: KnownDeviation;
  /** What is known of `b`, whose map is made. */
  b?: KnownDeviation;
  /** Whether `b` is scaled to the unit of `a` where both state different ones; else that is an error. */
  scaleUnits?: boolean;
  /** Moves `a` before it is measured. */
  transform?: Transform;
  /**
   * Called with the maps of all vertices that do not depend on the deviation, much sooner than finer ones are
   * made; not called where these are fine enough. An error that it throws cancels the work.
   */
  onCoarse?: (maps: DeviationMaps) => void;
  /** Cancels the work: the promise rejects with code `CANCELLED`. */
  signal?: AbortSignal;
  /** Called with the fraction of the work done, rising to 1. An error that it throws cancels the work. */
  onProgress?: OnProgress;
}

/** The maps of two models, in the unit of the first. */
export interface DeviationMaps {
  /** The larger diagonal of the two models' boxes. */
  diagonal: number;
  a?: DeviationMap;
  b?: DeviationMap;
}

/**
 * The triangles of a model with its deviation from the other one at each vertex; without triangles the points of
 * a cloud. Between vertices the deviation is an estimate.
 */
export interface DeviationMap {
  /** x, y, z of every vertex relative to `origin`, in the model's own coordinates. */
  positions: Float32Array<ArrayBuffer>;
  /** Unit normals, x, y, z of every vertex; 0 where there is none. */
  normals: Float32Array<ArrayBuffer>;
  /** The point that positions are relative to, in float64. */
  origin: Vector3;
  /** Three vertices a triangle. */
  indices: Uint32Array<ArrayBuffer>;
  /** The face of every triangle; those of a face follow each other. A mesh is one face. */
  faces: Uint32Array<ArrayBuffer>;
  /**
   * x, y, z of the point of the model that was measured for every vertex, in its own coordinates: nearer
   * to the model than the vertex, which is on a triangle.
   */
  points: Float64Array<ArrayBuffer>;
  /** The most that the model is from each of these points, but for rounding to float32, in the unit of `a`. */
  slacks: Float64Array<ArrayBuffer>;
  /** The distances of the points from the other model, in the unit of `a`. */
  distances: Float64Array<ArrayBuffer>;
  /** The distances with signs; NaN without one. */
  signed: Float64Array<ArrayBuffer>;
  /** x, y, z of the nearest points on the other model, in the coordinates of a result. */
  feet: Float64Array<ArrayBuffer>;
  /** What the signs stand for. */
  signs: Signs;
}

/**
 * Measures points of a map from A or from B. It yields the fractions of the work done, and returns the closest points.
 *
 * @internal
 */
export type MeasureOfMaps = (
  isFromA: boolean,
  points: Float64Array<ArrayBuffer>,
  options: ClosestPointOptions,
) => AsyncGenerator<number, ClosestPoints>;

/**
 * Refuses unknown names within options, which the module does not see.
 *
 * @internal
 */
export function checkMaps({ a, b }: DeviationMapOptions): void {
  for (const [side, known] of Object.entries({ a, b })) {
    if (typeof known !== "object" || known === null) continue;
    checkKeys(side, known, ["uppers", "farthest"]);
    if (known.farthest) checkKeys(`${side}.farthest`, known.farthest, ["face", "point", "foot"]);
  }
}

/**
 * The listener to coarse maps, whose errors cancel the work.
 * @internal
 */
export class CoarseMaps {
  readonly #onCoarse: DeviationMapOptions["onCoarse"];
  readonly #onProgress: OnProgress | undefined;
  #failure: { thrown: unknown } | undefined;

  constructor(onCoarse: DeviationMapOptions["onCoarse"], onProgress: OnProgress | undefined) {
    if (onCoarse !== undefined && typeof onCoarse !== "function") {
      throw new HausdorffError(
        "OPTION_INVALID",
        `onCoarse is ${typeof onCoarse}, expected a function`,
      );
    }
    this.#onCoarse = onCoarse;
    this.#onProgress = onProgress;
  }

  /** The function that the module calls. */
  get onCoarse(): ((maps: DeviationMaps) => void) | undefined {
    const onCoarse = this.#onCoarse;
    return (
      onCoarse &&
      ((maps) => {
        try {
          onCoarse(maps);
        } catch (thrown) {
          this.#failure = { thrown };
        }
      })
    );
  }

  /** The listener to progress, as options. */
  get progress(): { onProgress?: OnProgress } {
    const onProgress = this.#onProgress;
    if (this.#onCoarse === undefined) return onProgress === undefined ? {} : { onProgress };
    return {
      onProgress: (...progress) => {
        this.requireWhole();
        onProgress?.(...progress);
      },
    };
  }

  /** Throws what the listener threw. */
  requireWhole(): void {
    if (this.#failure !== undefined) throw this.#failure.thrown;
  }
}
