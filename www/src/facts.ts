// The details of a result, as terms and texts.
import type { DistanceResult } from "nurbs-hausdorff";
import { distanceText, duration, grouped, rough, signedText } from "./numbers.ts";

export type Fact = [term: string, text: string];

/** Why a certified search ended, in words. */
const STOPS = {
  converged: "the tolerance",
  cells: "its budget of cells",
  time: "its budget of time",
  precision: "the precision of float64",
  cancelled: "cancelling",
};

export function factsOf(result: DistanceResult): Fact[] {
  const { seconds, patches, diagonal } = result;
  return [
    ...directions(result),
    ["time", `${duration(seconds.solve)} on the ${result.backend.toUpperCase()}`],
    ["preparation", duration(seconds.prepare + seconds.compile)],
    ...methods(result),
    ["patches", `${grouped(patches.a)} · ${grouped(patches.b)}`],
    ["diagonal", distanceText(diagonal, diagonal)],
  ];
}

function directions({ forward, reverse, diagonal }: DistanceResult): Fact[] {
  if (forward === undefined || reverse === undefined) return [];
  return [
    ["A to B", distanceText(forward.computed, diagonal)],
    ["B to A", distanceText(reverse.computed, diagonal)],
  ];
}

function methods(result: DistanceResult): Fact[] {
  if (result.method === "certified") {
    return [
      ["cells", `${grouped(result.cells)} in ${result.levels} levels`],
      ["ended by", STOPS[result.stop]],
    ];
  }
  if (result.method === "hierarchy") {
    const { grid, pairs } = result;
    return [
      ["cells a surface", `${grid} × ${grid}`],
      ["pairs of boxes, at most", grouped(Math.max(...pairs))],
    ];
  }
  const { bounds, samples, statuses } = result;
  return [
    ["K_A, as published", bounds.kA.toPrecision(4)],
    ["K_A, rigorous", bounds.kARigorous.toPrecision(4)],
    ["K_B, observed", bounds.kB === null ? "does not apply" : rough(bounds.kB)],
    ["samples", grouped(samples)],
    ["converged", grouped(statuses.converged)],
    ["on an edge", grouped(statuses.onEdge)],
    ["at the iteration limit", grouped(statuses.iterationLimit)],
  ];
}

/** Statistics of the samples of A, where the result has them. */
export function estimatesOf({ forward, diagonal, ...directed }: DistanceResult): Fact[] {
  const statistics = forward?.statistics ?? directed.statistics;
  if (statistics === undefined) return [];
  const about = (value: number) => `≈ ${distanceText(value, diagonal)}`;
  return [
    ["mean", about(statistics.mean)],
    ["signed mean", `≈ ${signedText(statistics.signedMean, diagonal)}`],
    ["RMS", about(statistics.rms)],
    ["median", about(statistics.median)],
    ["95th percentile", about(statistics.percentile95)],
    ["99th percentile", about(statistics.percentile99)],
  ];
}
