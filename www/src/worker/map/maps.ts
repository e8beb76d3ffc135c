// What a result says of the maps of its models.
import type { DeviationMapOptions, DistanceResult, KnownDeviation } from "nurbs-hausdorff/worker";
import type { Side } from "../protocol.ts";

/** The result of the distances from one side to the other, where it was computed. */
export function directedFrom(result: DistanceResult, side: Side): DistanceResult | undefined {
  const { forward, reverse } = result;
  if (forward === undefined || reverse === undefined) return side === "a" ? result : undefined;
  return side === "a" ? forward : reverse;
}

/** Returns the options of the maps of some sides: what a result knows of each. */
export const knownOf = (
  result: DistanceResult,
  sides: readonly Side[],
): Pick<DeviationMapOptions, Side> =>
  Object.fromEntries(sides.map((side) => [side, knownOfSide(result, side)]));

/** What no distance from a side to the other exceeds, and the point that the result names as the farthest one. */
function knownOfSide(result: DistanceResult, side: Side): KnownDeviation {
  const directed = directedFrom(result, side);
  if (directed === undefined) return {};
  const uppers = [directed.upper];
  if (directed.computed === 0) return { uppers };
  const { a, b } = directed.witness;
  const [{ face, point }, foot] = side === "a" ? [a, b] : [b, a];
  return { uppers, farthest: { face, point, foot: foot.point } };
}
