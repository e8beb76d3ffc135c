// The linear least-squares problem of one step of the best fit.
import type { Vector3 } from "../measure/options.js";
import type { FaceDeviations } from "../measure/result.js";
import { cross } from "./rigid.js";

/** The unknowns of a small rigid motion: three of the shift, three of the rotation vector. */
const UNKNOWNS = 6;

/** The sum of weighted squares at one position, and its linearisation. */
export interface LeastSquares {
  /** The mean of the squared distances over the area. */
  meanSquare: number;
  /** The weighted mean of the samples, about which the rotation is. */
  center: Vector3;
  /** The root mean square of the samples' distances from the centre: the unit of angles. */
  radius: number;
  /** The largest distance of a sample from the centre. */
  extent: number;
  /** The normal matrix JᵀJ, row by row, of mean weight 1. */
  matrix: Float64Array;
  /** The right-hand side Jᵀr. */
  gradient: Float64Array;
}

/**
 * Linearises the distances r of all samples in a shift s and a rotation vector v about
 * their centre c: a sample p with the foot q has the residual r = |p - q|, which changes by
 * u · (s + v × (p - c)) with the unit vector u = (p - q) / r. That is exact to first order,
 * as the foot moves orthogonally to u. Samples at the distance 0 have no u; they add
 * nothing. O(samples).
 */
export function leastSquares(fields: readonly FaceDeviations[]): LeastSquares {
  let area = 0;
  const center: Vector3 = [0, 0, 0];
  forSamples(fields, (point, _foot, weight) => {
    area += weight;
    for (const axis of [0, 1, 2] as const) center[axis] += weight * point[axis];
  });
  const total = area || 1;
  for (const axis of [0, 1, 2] as const) center[axis] /= total;
  let [squares, extent] = [0, 0];
  forSamples(fields, (point, _foot, weight) => {
    const distance = Math.hypot(...difference(point, center));
    squares += weight * distance * distance;
    extent = Math.max(extent, distance);
  });
  const radius = Math.sqrt(squares / total) || 1;
  const matrix = new Float64Array(UNKNOWNS * UNKNOWNS);
  const gradient = new Float64Array(UNKNOWNS);
  let meanSquare = 0;
  forSamples(fields, (point, foot, weight) => {
    const offset = difference(point, foot);
    const distance = Math.hypot(...offset);
    if (distance === 0) return;
    const part = weight / total;
    meanSquare += part * distance * distance;
    const [x, y, z] = offset;
    const direction: Vector3 = [x / distance, y / distance, z / distance];
    const arm = difference(point, center);
    const moment = cross([arm[0] / radius, arm[1] / radius, arm[2] / radius], direction);
    const row = [...direction, ...moment];
    for (let i = 0; i < UNKNOWNS; i++) {
      const scaled = part * (row[i] ?? 0);
      gradient[i] = (gradient[i] ?? 0) + scaled * distance;
      for (let j = 0; j < UNKNOWNS; j++) {
        const place = UNKNOWNS * i + j;
        matrix[place] = (matrix[place] ?? 0) + scaled * (row[j] ?? 0);
      }
    }
  });
  return { meanSquare, center, radius, extent, matrix, gradient };
}

/**
 * Returns the step that minimises the linearised sum of squares with `damping` times the
 * squared step added: the shift, the rotation vector in radians, and the decrease of the
 * mean square that the gradient alone predicts. By Cholesky's decomposition: every pivot of
 * a positive semidefinite matrix with `damping` on its diagonal is at least `damping`.
 */
export function dampedStep(
  { matrix, gradient, radius }: LeastSquares,
  damping: number,
): { shift: Vector3; vector: Vector3; gain: number } {
  const lower = new Float64Array(UNKNOWNS * UNKNOWNS);
  const at = (all: Float64Array, i: number, j: number) => all[UNKNOWNS * i + j] ?? 0;
  for (let i = 0; i < UNKNOWNS; i++) {
    for (let j = 0; j <= i; j++) {
      let sum = at(matrix, i, j) + (i === j ? damping : 0);
      for (let k = 0; k < j; k++) sum -= at(lower, i, k) * at(lower, j, k);
      lower[UNKNOWNS * i + j] = i === j ? Math.sqrt(Math.max(sum, damping)) : sum / at(lower, j, j);
    }
  }
  const step = gradient.map((value) => -value);
  for (let i = 0; i < UNKNOWNS; i++) {
    for (let k = 0; k < i; k++) step[i] = (step[i] ?? 0) - at(lower, i, k) * (step[k] ?? 0);
    step[i] = (step[i] ?? 0) / at(lower, i, i);
  }
  for (let i = UNKNOWNS - 1; i >= 0; i--) {
    for (let k = i + 1; k < UNKNOWNS; k++)
      step[i] = (step[i] ?? 0) - at(lower, k, i) * (step[k] ?? 0);
    step[i] = (step[i] ?? 0) / at(lower, i, i);
  }
  const [a = 0, b = 0, c = 0, x = 0, y = 0, z = 0] = step;
  const gain = step.reduce((sum, value, i) => sum - value * (gradient[i] ?? 0), 0);
  return { shift: [a, b, c], vector: [x / radius, y / radius, z / radius], gain };
}

function forSamples(
  fields: readonly FaceDeviations[],
  visit: (point: Vector3, foot: Vector3, weight: number) => void,
): void {
  for (const { points, feet, areas } of fields) {
    for (const [index, weight] of areas.entries()) {
      visit(vector(points, index), vector(feet, index), weight);
    }
  }
}

const vector = (all: Float64Array, index: number): Vector3 => [
  all[3 * index] ?? 0,
  all[3 * index + 1] ?? 0,
  all[3 * index + 2] ?? 0,
];

const difference = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [a - x, b - y, c - z];
