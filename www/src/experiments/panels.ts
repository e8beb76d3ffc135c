// What the four panels draw: the figures of docs/paper.md, point by point.
import type { DistanceResult } from "nurbs-hausdorff";
import { CERTIFIED } from "./methods.ts";
import type { Curve } from "./outcome.ts";

/** Values by position; null is a gap, or has not come yet. */
export interface Series {
  name: string;
  /** The name of the method that it belongs to, which decides its colour. */
  method: string;
  /** Whether it is a bound. */
  dashed: boolean;
  values: (number | null)[];
}

export interface Panel {
  /** The element is `plot-` and this. */
  id: string;
  unit: string;
  logarithmic: boolean;
  /** Whether failures are marked in it. */
  marksFailures: boolean;
  series(curves: readonly Curve[]): Series[];
}

/** What browsers round times to, in seconds; a time of 0 has no place on a logarithmic axis. */
const CLOCK = 1e-4;

export const panels: readonly Panel[] = [
  {
    id: "time",
    unit: "seconds",
    logarithmic: true,
    marksFailures: true,
    series: (curves) => each(curves, ({ seconds }) => Math.max(seconds.solve, CLOCK)),
  },
  {
    id: "distance",
    unit: "model units",
    logarithmic: false,
    marksFailures: false,
    series: (curves) => each(curves, ({ computed }) => computed),
  },
  {
    id: "difference",
    unit: "model units",
    logarithmic: false,
    marksFailures: false,
    series: differences,
  },
  {
    id: "size",
    unit: "model units",
    logarithmic: true,
    marksFailures: false,
    series: sizes,
  },
];

type Value = (result: DistanceResult, index: number) => number | null;

const each = (curves: readonly Curve[], value: Value): Series[] =>
  curves.map((curve) => series(curve, value));

function series({ method: { name }, outcomes }: Curve, value: Value, bound = ""): Series {
  const values = outcomes.map(({ result }, index) =>
    result === undefined ? null : value(result, index),
  );
  return { name: `${name}${bound}`, method: name, dashed: bound !== "", values };
}

/** The certified distances: the middles of the intervals. */
function truth(curves: readonly Curve[]): (number | null)[] {
  const certified = curves.find(({ method }) => method.name === CERTIFIED);
  return (certified?.outcomes ?? []).map(({ result }) =>
    result === undefined ? null : 0.5 * (result.lower + result.upper),
  );
}

/** What the methods computed less the certified distance, and where their bounds say that it can be. */
function differences(curves: readonly Curve[]): Series[] {
  const middles = truth(curves);
  const less =
    (of: Value): Value =>
    (result, index) => {
      const [value, middle] = [of(result, index), middles[index] ?? null];
      return value === null || middle === null ? null : value - middle;
    };
  const lines = each(
    curves,
    less(({ computed }) => computed),
  );
  const bounds = curves.flatMap((curve) =>
    boundsOf(curve.method.name).map(([name, of]) => series(curve, less(of), name)),
  );
  return [...lines, ...bounds];
}

/** K_A is that of the samples, whatever the flatness, and K_B hardly differs: one method's are drawn. */
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
    [": upper", ({ upper }) => upper],
    [": lower", ({ lower }) => lower],
  ];
}

/** How far from the certified distance each method is; that one's interval is half as wide. */
function sizes(curves: readonly Curve[]): Series[] {
  const middles = truth(curves);
  return each(curves, ({ method, computed, lower, upper }, index) => {
    if (method === "certified") return 0.5 * (upper - lower);
    const middle = middles[index] ?? null;
    return middle === null ? null : Math.abs(computed - middle);
  });
}
