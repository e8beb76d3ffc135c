// Whether models agree, and the direction in which a result's distance is attained.
import type { DistanceResult } from "nurbs-hausdorff";
import type { Side, Sides } from "../worker/protocol.ts";

/**
 * Returns the model whose point is the farthest one from the other model: A,
 * unless the result is symmetric and the distance from B to A is larger.
 */
export function farthestSide({ forward, reverse }: DistanceResult): Side {
  if (forward === undefined || reverse === undefined) return "a";
  return reverse.computed > forward.computed ? "b" : "a";
}

/** Returns what is about the models that a distance judges: one way A alone, where A has such a thing. */
export const judgedOf = <Of>({ forward }: DistanceResult, { a, b }: Sides<Of>): Sides<Of> =>
  forward === undefined && a !== undefined ? { a } : { ...(a && { a }), ...(b && { b }) };

/** The distance, in diagonals, below which no place is farther than another: that of a map's rounding. */
export const AGREEING = 5e-7;

/** Whether models certainly agree but for rounding. */
export const agrees = ({ upper, diagonal }: DistanceResult): boolean =>
  upper <= AGREEING * diagonal;
