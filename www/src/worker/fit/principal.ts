// The principal axes of a model: the eigenvectors of the covariance of its area.
import type { Vector3 } from "nurbs-hausdorff";

type Matrix = [Vector3, Vector3, Vector3];

/** The middle of an area, and its spread along three orthogonal axes. */
export interface Principal {
  middle: Vector3;
  axes: Matrix;
  /** The variances along the axes. */
  spreads: Vector3;
}

/** Sweeps of Jacobi's rotations: each squares what is off the diagonal. */
const SWEEPS = 12;

/** Returns the principal axes of triangles, or of points without triangles. */
export function principalOf(points: Float64Array, indices: Uint32Array): Principal {
  const weighted = weightedPoints(points, indices);
  const total = weighted.reduce((sum, { weight }) => sum + weight, 0) || 1;
  const middle = [0, 1, 2].map(
    (axis) => weighted.reduce((sum, { at, weight }) => sum + weight * (at[axis] ?? 0), 0) / total,
  ) as Vector3;
  const covariance = [0, 1, 2].map((row) =>
    [0, 1, 2].map(
      (column) =>
        weighted.reduce((sum, { at, weight }) => {
          const [x, y] = [
            (at[row] ?? 0) - (middle[row] ?? 0),
            (at[column] ?? 0) - (middle[column] ?? 0),
          ];
          return sum + weight * x * y;
        }, 0) / total,
    ),
  ) as Matrix;
  return { middle, ...eigen(covariance) };
}

function weightedPoints(points: Float64Array, indices: Uint32Array) {
  const at = (index: number): Vector3 => [
    points[3 * index] ?? 0,
    points[3 * index + 1] ?? 0,
    points[3 * index + 2] ?? 0,
  ];
  if (indices.length === 0) {
    return Array.from({ length: points.length / 3 }, (_, index) => ({ at: at(index), weight: 1 }));
  }
  return Array.from({ length: indices.length / 3 }, (_, triangle) => {
    const [a, b, c] = [0, 1, 2].map((corner) => at(indices[3 * triangle + corner] ?? 0)) as Matrix;
    const [u, v] = [minus(b, a), minus(c, a)];
    const weight =
      Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) /
      2;
    const middle: Vector3 = [0, 1, 2].map(
      (axis) => ((a[axis] ?? 0) + (b[axis] ?? 0) + (c[axis] ?? 0)) / 3,
    ) as Vector3;
    return { at: middle, weight };
  });
}

const minus = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [a - x, b - y, c - z];

/** The eigenvalues of a symmetric matrix, the largest first, with right-handed eigenvectors (Jacobi's method). */
function eigen(matrix: Matrix): Pick<Principal, "axes" | "spreads"> {
  const m = matrix.map((row) => [...row]) as number[][];
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const) {
      rotate(m, v, p, q);
    }
  }
  const order = [0, 1, 2].sort((one, other) => (m[other]?.[other] ?? 0) - (m[one]?.[one] ?? 0));
  const column = (index = 0) => v.map((row) => row[index] ?? 0) as Vector3;
  const [x, y] = [column(order[0]), column(order[1])];
  const z: Vector3 = [
    x[1] * y[2] - x[2] * y[1],
    x[2] * y[0] - x[0] * y[2],
    x[0] * y[1] - x[1] * y[0],
  ];
  return {
    axes: [x, y, z],
    spreads: order.map((index) => m[index]?.[index] ?? 0) as Vector3,
  };
}

/** Makes the element p, q of a symmetric matrix 0 by a rotation, which is also applied to `v`. */
function rotate(m: number[][], v: number[][], p: number, q: number): void {
  const get = (row: number, column: number) => m[row]?.[column] ?? 0;
  const off = get(p, q);
  if (off === 0) return;
  const ratio = (get(q, q) - get(p, p)) / (2 * off);
  const tangent = (ratio < 0 ? -1 : 1) / (Math.abs(ratio) + Math.hypot(ratio, 1));
  const cosine = 1 / Math.hypot(tangent, 1);
  const sine = tangent * cosine;
  const turn = (rows: number[][], row: number, one: number, other: number) => {
    const line = rows[row];
    if (line === undefined) return;
    const [x, y] = [line[one] ?? 0, line[other] ?? 0];
    line[one] = cosine * x - sine * y;
    line[other] = sine * x + cosine * y;
  };
  for (let row = 0; row < 3; row++) {
    turn(m, row, p, q);
    turn(v, row, p, q);
  }
  const [one, other] = [m[p] ?? [], m[q] ?? []];
  for (let column = 0; column < 3; column++) {
    const [x, y] = [one[column] ?? 0, other[column] ?? 0];
    one[column] = cosine * x - sine * y;
    other[column] = sine * x + cosine * y;
  }
}
