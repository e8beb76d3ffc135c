// The details of a result, as terms and texts.

import type { DistanceResult, Signs } from "nurbs-hausdorff";
import { AGREEING } from "../common/direction.ts";
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
import { texts } from "../texts/index.ts";
import type { Estimates } from "../worker/map/distribution.ts";
import type { Side } from "../worker/protocol.ts";

export type Detail = [term: string, text: string];

/** The reasons for which a certified search ends, in words. */
const STOPS = {
  converged: texts.results.toleranceReached,
  cells: texts.results.limitOnCells,
  time: texts.results.timeLimit,
  precision: texts.results.precisionOfFloat64,
};

export function detailsOf(result: DistanceResult): Detail[] {
  const { seconds, patches, diagonal } = result;
  return [
    ...directions(result),
    [
      texts.results.time,
      texts.results.onThe(duration(seconds.solve), result.backend.toUpperCase()),
    ],
    [texts.results.preparation, duration(seconds.prepare + seconds.compile)],
    ...methods(result),
    [texts.results.patches, `${grouped(patches.a)} · ${grouped(patches.b)}`],
    [texts.results.diagonal, distanceText(diagonal, diagonal)],
    ...gapOf(result),
  ];
}

/** How far the files themselves leave the models open, which is not part of the interval. */
function gapOf({ gap }: DistanceResult): Detail[] {
  return gap > 0 ? [[texts.results.gapsOfBothFilesAt, upperText(shownLength(gap))]] : [];
}

/** The directed distances of a symmetric result. */
function directions({ forward, reverse, diagonal }: DistanceResult): Detail[] {
  if (forward === undefined || reverse === undefined) return [];
  return [
    [
      texts.results.directedAToB,
      certifiedText(forward.computed, [forward.lower, forward.upper], diagonal),
    ],
    [
      texts.results.directedBToA,
      certifiedText(reverse.computed, [reverse.lower, reverse.upper], diagonal),
    ],
  ];
}

function methods(result: DistanceResult): Detail[] {
  if (result.method === "certified") {
    return [
      [texts.results.cells, texts.results.inLevels(grouped(result.cells), result.levels)],
      [texts.results.searchEnded, STOPS[result.stop]],
    ];
  }
  if (result.method === "hierarchy") {
    const { grid, pairs } = result;
    return [
      [texts.results.cellsPerSurface, `${grid} × ${grid}`],
      [texts.results.boxPairsOnOneLevel, grouped(Math.max(...pairs))],
    ];
  }
  const { bounds, samples, statuses } = result;
  return [
    [texts.results.kA, bounds.kA.toPrecision(4)],
    [texts.results.kARigorous, bounds.kARigorous.toPrecision(4)],
    [
      texts.results.kBEstimate,
      bounds.kB === null ? texts.results.doesNotApply : twoDigits(bounds.kB),
    ],
    [texts.results.samples, grouped(samples)],
    [texts.results.samplesConverged, grouped(statuses.converged)],
    [texts.results.samplesOnAnEdge, grouped(statuses.onEdge)],
    [texts.results.samplesAtTheStepLimit, grouped(statuses.iterationLimit)],
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
  // What is less than the map's rounding is none that it measured.
  const known = (value: number) => (Math.abs(value) > AGREEING * diagonal ? value : 0);
  const text = (value: number) => `≈ ${distanceText(known(value), diagonal)}`;
  const signedMean = known(estimates.signedMean);
  const bySign: Detail[] =
    signs === undefined
      ? [[texts.results.signs(side), texts.results.noneHasNoInside(other)]]
      : [
          [
            texts.results.signedMean(side),
            signedMean === 0 ? text(0) : `≈ ${signedText(signedMean, diagonal)}`,
          ],
          [
            texts.results.negative(side),
            signs === "solid"
              ? texts.results.insideTheSolid(other)
              : texts.results.behindSNormals(other),
          ],
        ];
  return [
    [texts.results.mean(side), text(estimates.mean)],
    ...bySign,
    [texts.results.rms(side), text(estimates.rms)],
    [texts.results.median(side), text(estimates.median)],
    [texts.results.percentile95(side), text(estimates.percentile95)],
    [texts.results.percentile99(side), text(estimates.percentile99)],
  ];
}
