// Small dense systems and symmetric eigenproblems, in float64.

export type Vector = readonly [number, number, number];

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** Returns a + t·b. */
export const along = (a: Vector, t: number, b: Vector): Vector => [
  a[0] + t * b[0],
  a[1] + t * b[1],
  a[2] + t * b[2],
];

export const crossed = (a: Vector, b: Vector): Vector => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

export const length = (a: Vector): number => Math.hypot(...a);

/** A vector of length 1; a zero vector stays. */
export function unit(a: Vector): Vector {
  const size = length(a) || 1;
  return [a[0] / size, a[1] / size, a[2] / size];
}

/** The mean of points. */
export function mean(points: readonly Vector[]): Vector {
  let sum: Vector = [0, 0, 0];
  for (const point of points) sum = along(sum, 1, point);
  return along([0, 0, 0], 1 / (points.length || 1), sum);
}

/** The pivot, relative to the largest entry, below which a system has no solution to speak of. */
const SINGULAR = 1e-12;

/**
 * Returns the solution of a square system by Gaussian elimination with partial pivoting; undefined where the
 * matrix is singular. O(n³).
 */
export function solve(
  matrix: readonly (readonly number[])[],
  right: readonly number[],
): number[] | undefined {
  const rows = matrix.map((row, index) => [...row, right[index] ?? 0]);
  const at = (row: number, column: number) => rows[row]?.[column] ?? 0;
  const size = rows.length;
  const largest = Math.max(...matrix.flat().map(Math.abs));
  for (let column = 0; column < size; column++) {
    let pivot = column;
    for (let row = column + 1; row < size; row++) {
      if (Math.abs(at(row, column)) > Math.abs(at(pivot, column))) pivot = row;
    }
    if (!(Math.abs(at(pivot, column)) > SINGULAR * largest)) return undefined;
    [rows[column], rows[pivot]] = [rows[pivot] ?? [], rows[column] ?? []];
    for (let row = 0; row < size; row++) {
      if (row === column) continue;
      const factor = at(row, column) / at(column, column);
      rows[row] = (rows[row] ?? []).map((value, index) => value - factor * at(column, index));
    }
  }
  return rows.map((row, index) => (row[size] ?? 0) / (row[index] ?? 1));
}

/** The solution of least squares of rows · x = right, by the normal equations. O(m n²). */
export function leastSquares(
  rows: readonly (readonly number[])[],
  right: readonly number[],
): number[] | undefined {
  const size = rows[0]?.length ?? 0;
  const matrix = Array.from({ length: size }, () => new Array<number>(size).fill(0));
  const sums = new Array<number>(size).fill(0);
  for (const [index, row] of rows.entries()) {
    for (const [i, a] of row.entries()) {
      sums[i] = (sums[i] ?? 0) + a * (right[index] ?? 0);
      const own = matrix[i];
      if (own !== undefined) for (const [j, b] of row.entries()) own[j] = (own[j] ?? 0) + a * b;
    }
  }
  return solve(matrix, sums);
}

export type Matrix = readonly [Vector, Vector, Vector];

/** Returns the sum of a·bᵀ over pairs of vectors. O(n). */
export function outerSum(pairs: readonly (readonly [Vector, Vector])[]): Matrix {
  const rows = [0, 1, 2].map((i) =>
    [0, 1, 2].map((j) => pairs.reduce((sum, [a, b]) => sum + (a[i] ?? 0) * (b[j] ?? 0), 0)),
  );
  return rows as unknown as Matrix;
}

/** Sweeps of Jacobi's method, of which a 3 × 3 matrix needs about 5. */
const SWEEPS = 12;

/** Returns the eigenvalues of a symmetric matrix with their unit vectors, the smallest first, by Jacobi's method. */
export function eigen(matrix: Matrix): { value: number; vector: Vector }[] {
  const a = matrix.map((row) => [...row]);
  const v = [0, 1, 2].map((i) => [0, 1, 2].map((j) => (i === j ? 1 : 0)));
  const get = (of: number[][], i: number, j: number) => of[i]?.[j] ?? 0;
  const put = (of: number[][], i: number, j: number, value: number) => {
    const row = of[i];
    if (row !== undefined) row[j] = value;
  };
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const) {
      const off = get(a, p, q);
      if (off === 0) continue;
      const theta = (get(a, q, q) - get(a, p, p)) / (2 * off);
      const t = (theta < 0 ? -1 : 1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (let k = 0; k < 3; k++) {
        const [one, other] = [get(a, k, p), get(a, k, q)];
        put(a, k, p, c * one - s * other);
        put(a, k, q, s * one + c * other);
      }
      for (let k = 0; k < 3; k++) {
        const [one, other] = [get(a, p, k), get(a, q, k)];
        put(a, p, k, c * one - s * other);
        put(a, q, k, s * one + c * other);
        const [first, second] = [get(v, k, p), get(v, k, q)];
        put(v, k, p, c * first - s * second);
        put(v, k, q, s * first + c * second);
      }
    }
  }
  return [0, 1, 2]
    .map((i) => ({
      value: get(a, i, i),
      vector: [get(v, 0, i), get(v, 1, i), get(v, 2, i)] as Vector,
    }))
    .sort((one, other) => one.value - other.value);
}
