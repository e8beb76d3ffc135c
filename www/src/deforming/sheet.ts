// The deforming sheet: a bicubic surface on fixed knots, through which a wave runs.
import type { SurfaceArrays } from "nurbs-hausdorff/worker";

/** Numbers of control points along u and v. */
export type Size = readonly [rows: number, columns: number];

const DEGREE = 3;
/** Half of the sheet's side; the parts have a radius of about 1. */
const HALF = 1.5;
const HEIGHT = 0.3;
/** Radians a unit of length in x and y. */
const WAVE = [2, 1.5] as const;

/** The knots 0 to `count - 3`, those at the ends four times. */
const knots = (count: number): number[] =>
  Array.from({ length: count + DEGREE + 1 }, (_, index) =>
    Math.min(Math.max(index - DEGREE, 0), count - DEGREE),
  );

/** The control points when the wave has run through this angle, in radians. */
export function wave([rows, columns]: Size, angle: number): Float64Array<ArrayBuffer> {
  const points = new Float64Array(4 * rows * columns);
  for (let index = 0; index < rows * columns; index++) {
    const x = HALF * (2 * (Math.floor(index / columns) / (rows - 1)) - 1);
    const y = HALF * (2 * ((index % columns) / (columns - 1)) - 1);
    const height = HEIGHT * Math.sin(WAVE[0] * x + WAVE[1] * y + angle);
    points.set([x, y, height, 1], 4 * index);
  }
  return points;
}

/** The sheet at the angle 0. */
export const sheet = (size: Size): SurfaceArrays => ({
  degree: [DEGREE, DEGREE],
  counts: size,
  knotsU: knots(size[0]),
  knotsV: knots(size[1]),
  controlPoints: wave(size, 0),
});
