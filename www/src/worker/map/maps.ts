// The maps of both models of a result: coarse ones first, then fine ones.
import type { DistanceResult, NurbsModel } from "nurbs-hausdorff/worker";
import { isMesh } from "../models/meshes.ts";
import type { Side, Sides } from "../protocol.ts";
import { type Base, baseOf, diagonalOf } from "./base.ts";
import type { Measuring } from "./measured.ts";
import { unplaced } from "./placed.ts";
import { type DeviationMap, mapOf, refined } from "./refine.ts";
import { type Farthest, withFarthest } from "./witness.ts";

/** The part of the largest deviation by which colours may be off: less than a legend shows. */
const STEP = 1 / 150;
/** The least step, in diagonals: the vertices are not on the model more accurately. */
const MIN_STEP = 5e-7;

/**
 * How far the triangles of a map are from the model, in diagonals: half a pixel of a whole view. More
 * only where it would take a million triangles, whose edges are not split.
 */
const FLATNESS = 5e-4;

export class Maps {
  /** What does not depend on positions, of the models that were painted. */
  readonly #bases = new WeakMap<NurbsModel, Base>();

  /** Measures the vertices of a model, and the farthest point where a result has it. */
  async coarse(
    model: NurbsModel,
    result: DistanceResult,
    measuring: Measuring,
  ): Promise<DeviationMap> {
    let base = this.#bases.get(model);
    if (base === undefined) {
      // A model that is a point has triangles at any tolerance.
      const flatness = FLATNESS * (diagonalOf(model) || 1);
      const triangles = await model.tessellate({ tolerance: flatness });
      base = baseOf(model, triangles, { isMesh: isMesh(model), flatness });
      this.#bases.set(model, base);
    }
    const map = await mapOf(base, measuring);
    const farthest = farthestOf(result, measuring);
    return farthest === undefined ? map : withFarthest(map, farthest);
  }

  /** Splits a map until its colours are those of the model. */
  async fine(map: DeviationMap, diagonal: number, measuring: Measuring): Promise<DeviationMap> {
    if (isFine(map, diagonal, measuring)) return map;
    return refined(map, measuring, { step: stepOf(map, diagonal), diagonal });
  }
}

/** Whether no colour can be off by a step: deviations of either sign up to `upper` differ by twice as much at most. */
export const isFine = (
  map: DeviationMap,
  diagonal: number,
  { upper }: { upper: number },
): boolean => 2 * upper <= stepOf(map, diagonal);

/** The deviation by which colours may be off. */
function stepOf({ distances }: DeviationMap, diagonal: number): number {
  const largest = distances.reduce((one, other) => Math.max(one, other), 0);
  return Math.max(STEP * largest, MIN_STEP * diagonal);
}

/** The result of the distances from one side to the other, where it was computed. */
export function directedFrom(result: DistanceResult, side: Side): DistanceResult | undefined {
  const { forward, reverse } = result;
  if (forward === undefined || reverse === undefined) return side === "a" ? result : undefined;
  return side === "a" ? forward : reverse;
}

/** The point of a model that a result names as the farthest one. */
function farthestOf(result: DistanceResult, measuring: Measuring): Farthest | undefined {
  const { side } = measuring;
  const directed = directedFrom(result, side);
  if (directed === undefined || directed.computed === 0) return undefined;
  const { a, b } = directed.witness;
  const [own, foot]: [typeof a, typeof a] = side === "a" ? [a, b] : [b, a];
  return {
    face: own.face,
    point: unplaced(side, own.point, measuring),
    foot: foot.point,
    distance: directed.computed,
  };
}

/** Returns the sides as entries. */
export const entriesOf = <T>(sides: Sides<T>): [Side, T][] => Object.entries(sides) as [Side, T][];
