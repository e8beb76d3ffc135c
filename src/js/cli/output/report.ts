import type {
  CertifiedResult,
  DistanceResult,
  HierarchyResult,
  IterationResult,
  Statistics,
  SurfacePoint,
} from "../../measure/result.js";
import { exponential, full, short } from "./numbers.js";

/** Why method `certified` ended, in words. */
const STOPS: Readonly<Record<CertifiedResult["stop"], string>> = {
  converged: "done",
  cells: "ended by the budget of cells",
  time: "ended by the budget of time",
  precision: "ended by the precision of float64",
};

/** A result as lines for people, the same as the native command's. */
export function text(result: DistanceResult): string {
  const { witness, patches } = result;
  const directed = [
    ["A to B", result.forward],
    ["B to A", result.reverse],
  ] as const;
  const lines = [
    `distance   ${full(result.computed)}`,
    interval(result),
    ...gaps(result),
    ...(typeof result.unit === "number" ? [`unit       ${full(result.unit)} m`] : []),
    point("on A", witness.a),
    point("on B", witness.b),
    ...directed.flatMap(([name, one]) =>
      one
        ? [`${name}     [${full(one.lower)}, ${full(one.upper)}]`, ...estimates(one.statistics)]
        : [],
    ),
    ...details(result),
    ...estimates(result.statistics),
    `converged  ${result.converged ? "yes" : "no"}`,
    `patches    ${patches.a} of A, ${patches.b} of B`,
    ...machine(result),
  ];
  return `${lines.join("\n")}\n`;
}

/** The end of a line with a verdict that does not hold for every reading of the files. */
export const GAPS_DECIDE = ", but the gaps of the files could change that";

function gaps({ gap, gapProven, withGaps }: DistanceResult): string[] {
  if (gap === 0) return [];
  const origin = gapProven ? "by what the files state" : "measured, not proven";
  return [
    `gap        ${full(gap)}, ${origin}`,
    `with gaps  [${full(withGaps.lower)}, ${full(withGaps.upper)}]`,
  ];
}

function interval({ lower, upper, diagonal }: DistanceResult): string {
  const width = (upper - lower) / diagonal;
  const found = `interval   [${full(lower)}, ${full(upper)}]`;
  // The diagonal of models of one point is 0.
  if (!Number.isFinite(width)) return found;
  return `${found}, width ${exponential(width, 1)} of the diagonal ${short(diagonal)}`;
}

function point(name: string, { face, faceName, u, v, point }: SurfacePoint): string {
  const place = point.map(full).join(" ");
  const named = faceName ? ` (${faceName})` : "";
  return `${name}       face ${face}${named} at (${full(u)}, ${full(v)}): ${place}`;
}

function details(result: DistanceResult): string[] {
  switch (result.method) {
    case "certified":
      return certified(result);
    case "iteration":
      return iteration(result);
    case "hierarchy":
      return hierarchy(result);
  }
}

function certified(result: CertifiedResult): string[] {
  const { cells, levels, stop, minTolerance, within, withGaps } = result;
  const doubt = withGaps.within === within ? "" : GAPS_DECIDE;
  return [
    `search     ${cells} cells, ${levels} levels, ${STOPS[stop]}`,
    ...(stop === "precision"
      ? [`precision  coordinates of this size allow a tolerance of ${full(minTolerance)}`]
      : []),
    // Absent or null if it was not decided.
    ...(typeof within === "boolean"
      ? [`limit      the distance is ${within ? "within" : "beyond"} it${doubt}`]
      : []),
  ];
}

function iteration({ bounds, statuses, samples }: IterationResult): string[] {
  const { kA, kARigorous, kB } = bounds;
  const observed = kB === null ? "none observed" : `${short(kB)} observed`;
  const { converged, onEdge, iterationLimit } = statuses;
  return [
    `bounds     K_A ${short(kA)} as published, ${short(kARigorous)} rigorous; K_B ${observed}`,
    `samples    ${samples}: ${converged} converged, ${onEdge} on an edge, ${iterationLimit} at the iteration limit`,
  ];
}

function hierarchy({ grid, pairs }: HierarchyResult): string[] {
  const levels = pairs.join(", ");
  return [`hierarchy  ${grid} x ${grid} cells a surface; pairs of boxes by level ${levels}`];
}

function estimates(statistics: Statistics | undefined): string[] {
  if (!statistics) return [];
  const { mean, rms, median, percentile95, percentile99 } = statistics;
  return [
    `estimates  mean ${short(mean)}, rms ${short(rms)}, median ${short(median)}, 95 % ${short(percentile95)}, 99 % ${short(percentile99)}`,
  ];
}

function machine({ seconds, backend, adapter, notice }: DistanceResult): string[] {
  const { prepare, compile, solve } = seconds;
  const times = `${prepare.toFixed(3)} prepare, ${compile.toFixed(3)} compile, ${solve.toFixed(3)} solve`;
  const name = adapter === null ? "" : ` (${adapter})`;
  return [
    `seconds    ${times}, on the ${backend}${name}`,
    ...(notice ? [`notice     ${notice}`] : []),
  ];
}
