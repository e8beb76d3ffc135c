// Models of the paper's sizes that the package's list of shapes has not.
import type { ControlPoint, InterchangeModel } from "nurbs-hausdorff";
import type { Source } from "../protocol.ts";

/** Side of a sheet, the size of most of the package's shapes. */
const SHEET_SIZE = 5;
/** Enough control points a wave to be smooth, and few enough waves to see. */
const POINTS_A_WAVE = 5;
const MOST_WAVES = 4;
/** Degree of a sheet in both directions. */
const CUBIC = 3;

/**
 * A wavy sheet with `counts` control points, the same as the command line's;
 * `variant` changes the waves, so that two sheets differ.
 */
export function sheet(counts: [number, number], variant: number): Source {
  const stretch = 1 + 0.3 * variant;
  const phase = 0.7 * variant;
  const waves = (count: number) => Math.min(count / POINTS_A_WAVE, MOST_WAVES) / stretch;
  const [along, across] = [waves(counts[0]), waves(counts[1])];
  const amplitude = SHEET_SIZE / (8 * Math.max(along, across));
  const point = (x: number, y: number): ControlPoint => {
    const height = Math.sin(2 * Math.PI * along * x + phase) * Math.cos(2 * Math.PI * across * y);
    return [SHEET_SIZE * (x - 0.5), SHEET_SIZE * (y - 0.5), amplitude * height, 1];
  };
  const evenly = (count: number) => Array.from({ length: count }, (_, i) => i / (count - 1));
  const ctrl = evenly(counts[0]).map((x) => evenly(counts[1]).map((y) => point(x, y)));
  const [knots_u, knots_v] = [clampedKnots(counts[0]), clampedKnots(counts[1])];
  return asFile("wavy sheet", { degree: [CUBIC, CUBIC], knots_u, knots_v, ctrl });
}

/** Clamped, evenly spaced knots over [0, 1]. */
function clampedKnots(count: number): number[] {
  const spans = count - CUBIC;
  return Array.from({ length: count + CUBIC + 1 }, (_, index) => {
    return Math.min(Math.max(index - CUBIC, 0), spans) / spans;
  });
}

/** Weight of the corners of a circle's square. */
const CORNER = Math.SQRT1_2;

/**
 * Control points x, y, w of the unit circle in four quarters (Piegl and
 * Tiller, The NURBS Book, section 7.5), without the last, which is the first.
 */
const CIRCLE: readonly (readonly [number, number, number])[] = [
  [1, 0, 1],
  [1, 1, CORNER],
  [0, 1, 1],
  [-1, 1, CORNER],
  [-1, 0, 1],
  [-1, -1, CORNER],
  [0, -1, 1],
  [1, -1, CORNER],
];

/** The sphere about the origin: a half circle revolved about the z axis (ibid., 8.5). */
export function ball(radius: number): Source {
  const half = [...CIRCLE.slice(6, 8), ...CIRCLE.slice(0, 3)];
  const ctrl = [...CIRCLE, ...CIRCLE.slice(0, 1)].map(([x, y, around]) =>
    half.map(([out, up, along]): ControlPoint => {
      return [radius * out * x, radius * out * y, radius * up, around * along];
    }),
  );
  const knots_u = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1];
  return asFile("sphere", { degree: [2, 2], knots_u, knots_v: [0, 0, 0, 0.5, 0.5, 1, 1, 1], ctrl });
}

/** As the user's own models come to the worker. */
function asFile(name: string, surface: InterchangeModel["surfaces"][number]): Source {
  const model: InterchangeModel = { name, surfaces: [surface] };
  return { file: new File([JSON.stringify(model)], `${name}.json`) };
}
