// The details of a result, as terms and texts.
import type { DistanceResult, Signs } from "nurbs-hausdorff";
import {
  certifiedText,
  distanceText,
  duration,
  grouped,
  shownLength,
  signedText,
  twoDigits,
  upperText,
} from "../common/text/numbers.ts";
import type { Estimates } from "../worker/map/distribution.ts";
import type { Side } from "../worker/protocol.ts";

export type Detail = [term: string, text: string];

/** The reasons for which a certified search ends, in words. */
const STOPS = {
  converged: "tolerance reached",
  cells: "limit on cells",
  time: "time limit",
  precision: "precision of float64",
};

export function detailsOf(result: DistanceResult): Detail[] {
  const { seconds, patches, diagonal } = result;
  return [
    ...directions(result),
    ["time", `${duration(seconds.solve)} on the ${result.backend.toUpperCase()}`],
    ["preparation", duration(seconds.prepare + seconds.compile)],
    ...methods(result),
    ["patches", `${grouped(patches.a)} · ${grouped(patches.b)}`],
    ["diagonal", distanceText(diagonal, diagonal)],
    ...gapOf(result),
  ];
}

/** How far the files themselves leave the models open, which is not part of the interval. */
function gapOf({ gap }: DistanceResult): Detail[] {
  return gap > 0 ? [["gaps of both files, at most", upperText(shownLength(gap))]] : [];
}

/** The directed distances of a symmetric result. */
function directions({ forward, reverse, diagonal }: DistanceResult): Detail[] {
  if (forward === undefined || reverse === undefined) return [];
  return [
    ["directed, A to B", certifiedText(forward.computed, [forward.lower, forward.upper], diagonal)],
    ["directed, B to A", certifiedText(reverse.computed, [reverse.lower, reverse.upper], diagonal)],
  ];
}

function methods(result: DistanceResult): Detail[] {
  if (result.method === "certified") {
    return [
      ["cells", `${grouped(result.cells)} in ${result.levels} levels`],
      ["search ended", STOPS[result.stop]],
    ];
  }
  if (result.method === "hierarchy") {
    const { grid, pairs } = result;
    return [
      ["cells per surface", `${grid} × ${grid}`],
      ["box pairs on one level, at most", grouped(Math.max(...pairs))],
    ];
  }
  const { bounds, samples, statuses } = result;
  return [
    ["K_A (2012 paper)", bounds.kA.toPrecision(4)],
    ["K_A (rigorous)", bounds.kARigorous.toPrecision(4)],
    ["K_B (estimate)", bounds.kB === null ? "does not apply" : twoDigits(bounds.kB)],
    ["samples", grouped(samples)],
    ["samples converged", grouped(statuses.converged)],
    ["samples on an edge", grouped(statuses.onEdge)],
    ["samples at the step limit", grouped(statuses.iterationLimit)],
  ];
}

/** Estimates of the deviation over the area of a model; `signs` is undefined where it has none. */
export function statisticsOf(
  of: Side,
  estimates: Estimates,
  signs: Signs | undefined,
  diagonal: number,
): Detail[] {
  const [side, other] = of === "a" ? ["A", "B"] : ["B", "A"];
  const text = (value: number) => `≈ ${distanceText(value, diagonal)}`;
  const bySign: Detail[] =
    signs === undefined
      ? [[`${side}: signs`, `none: ${other} has no inside`]]
      : [
          [`${side}: signed mean`, `≈ ${signedText(estimates.signedMean, diagonal)}`],
          [
            `${side}: negative`,
            signs === "solid" ? `inside the solid ${other}` : `behind ${other}'s normals`,
          ],
        ];
  return [
    [`${side}: mean`, text(estimates.mean)],
    ...bySign,
    [`${side}: RMS`, text(estimates.rms)],
    [`${side}: median`, text(estimates.median)],
    [`${side}: 95th percentile`, text(estimates.percentile95)],
    [`${side}: 99th percentile`, text(estimates.percentile99)],
  ];
}
