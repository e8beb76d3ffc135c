// The data of the four panels, which are the figures of docs/paper.md.

import type { DistanceResult } from "nurbs-hausdorff";
import { texts } from "../../texts/index.ts";
import { CERTIFIED } from "../sweep/methods.ts";
import type { Curve } from "../sweep/sweepPoint.ts";

/** Values by position; null for a failure or a result that is still missing. */
export interface Series {
  name: string;
  /** The method that it belongs to, which determines its colour. */
  method: string;
  /** Whether it is a bound, which is drawn dashed. */
  dashed: boolean;
  values: (number | null)[];
}

export interface Panel {
  /** The suffix of the element's identifier, after `plot-`. */
  id: string;
  unit: string;
  logarithmic: boolean;
  /** Whether failures are marked in it. */
  marksFailures: boolean;
  series(curves: readonly Curve[]): Series[];
}

/** The resolution of clocks in browsers, in seconds: the smallest time drawn, as a logarithmic axis has no 0. */
const CLOCK_RESOLUTION = 1e-4;

export const panels: readonly Panel[] = [
  {
    id: "time",
    unit: texts.experiments.seconds,
    logarithmic: true,
    marksFailures: true,
    series: (curves) => each(curves, ({ seconds }) => Math.max(seconds.solve, CLOCK_RESOLUTION)),
  },
  {
    id: "distance",
    unit: texts.experiments.modelUnits,
    logarithmic: false,
    marksFailures: false,
    series: (curves) => each(curves, ({ computed }) => computed),
  },
  {
    id: "difference",
    unit: texts.experiments.modelUnits,
    logarithmic: false,
    marksFailures: false,
    series: differences,
  },
  {
    id: "size",
    unit: texts.experiments.modelUnits,
    logarithmic: true,
    marksFailures: false,
    series: sizes,
  },
];

type Value = (result: DistanceResult, index: number) => number | null;

const each = (curves: readonly Curve[], value: Value): Series[] =>
  curves.map((curve) => series(curve, value));

function series({ method: { name }, points }: Curve, value: Value, bound = ""): Series {
  const values = points.map(({ result }, index) =>
    result === undefined ? null : value(result, index),
  );
  return { name: `${name}${bound}`, method: name, dashed: bound !== "", values };
}

/** The certified distances, as the midpoints of the intervals. */
function certifiedDistances(curves: readonly Curve[]): (number | null)[] {
  const certified = curves.find(({ method }) => method.name === CERTIFIED);
  return (certified?.points ?? []).map(({ result }) =>
    result === undefined ? null : 0.5 * (result.lower + result.upper),
  );
}

/** The differences of the computed distances and of their bounds from the certified distance. */
function differences(curves: readonly Curve[]): Series[] {
  const midpoints = certifiedDistances(curves);
  const difference =
    (quantity: Value): Value =>
    (result, index) => {
      const [value, midpoint] = [quantity(result, index), midpoints[index] ?? null];
      return value === null || midpoint === null ? null : value - midpoint;
    };
  const lines = each(
    curves,
    difference(({ computed }) => computed),
  );
  const bounds = curves.flatMap((curve) =>
    boundsOf(curve.method.name).map(([name, bound]) => series(curve, difference(bound), name)),
  );
  return [...lines, ...bounds];
}

/**
 * The bounds drawn for a method. K_A depends on the samples only and K_B hardly
 * on the flatness, so those of one flatness stand for all.
 */
function boundsOf(name: string): [string, Value][] {
  const published = (result: DistanceResult) =>
    result.method === "iteration" ? result.bounds : { kA: null, kB: null };
  const sum = (value: number, bound: number | null) => (bound === null ? null : value + bound);
  if (name === "2012 paper: loose") {
    return [
      [" + K_A", (result) => sum(result.computed, published(result).kA)],
      [
        " - K_B",
        (result) => {
          const { kB } = published(result);
          return kB === null ? null : result.computed - kB;
        },
      ],
    ];
  }
  if (name !== "hierarchy") return [];
  return [
    [texts.experiments.upper, ({ upper }) => upper],
    [texts.experiments.lower, ({ lower }) => lower],
  ];
}

/** The absolute differences from the certified distance; for `certified`, half the width of its interval. */
function sizes(curves: readonly Curve[]): Series[] {
  const midpoints = certifiedDistances(curves);
  return each(curves, ({ method, computed, lower, upper }, index) => {
    if (method === "certified") return 0.5 * (upper - lower);
    const midpoint = midpoints[index] ?? null;
    return midpoint === null ? null : Math.abs(computed - midpoint);
  });
}
