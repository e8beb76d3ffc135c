// The circle that fits points in space.
import {
  along,
  crossed,
  dot,
  eigen,
  leastSquares,
  length,
  mean,
  minus,
  outerSum,
  unit,
  type Vector,
} from "./linear.ts";

export interface Circle {
  center: Vector;
  normal: Vector;
  radius: number;
  /** The largest distance of a point from the circle. */
  residual: number;
}

/** Two unit vectors that are perpendicular to a unit vector and to each other. */
export function acrossOf(axis: Vector): readonly [Vector, Vector] {
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  const other: Vector = [least === 0 ? 1 : 0, least === 1 ? 1 : 0, least === 2 ? 1 : 0];
  const first = unit(crossed(axis, other));
  return [first, crossed(axis, first)];
}

/** Returns the circle of least squares of points of a plane; undefined where they lie on a line. O(n). */
export function planeCircle(
  points: readonly (readonly [number, number])[],
): { x: number; y: number; radius: number } | undefined {
  // |p|² = 2 c·p + k, which is linear in c and k.
  const rows = points.map(([x, y]) => [2 * x, 2 * y, 1]);
  const found = leastSquares(
    rows,
    points.map(([x, y]) => x * x + y * y),
  );
  if (found === undefined) return undefined;
  const [x = 0, y = 0, rest = 0] = found;
  const square = rest + x * x + y * y;
  return square > 0 ? { x, y, radius: Math.sqrt(square) } : undefined;
}

/** Returns the circle that fits points in space; undefined of fewer than three, or on a line. O(n). */
export function circleOf(points: readonly Vector[]): Circle | undefined {
  if (points.length < 3) return undefined;
  const middle = mean(points);
  const ways = points.map((point) => minus(point, middle));
  const [flat] = eigen(outerSum(ways.map((way) => [way, way])));
  if (flat === undefined) return undefined;
  const [e, f] = acrossOf(flat.vector);
  const found = planeCircle(ways.map((way) => [dot(way, e), dot(way, f)]));
  if (found === undefined) return undefined;
  const { x, y, radius } = found;
  const center = along(along(middle, x, e), y, f);
  const residual = points.reduce((far, point) => {
    const way = minus(point, center);
    const height = dot(way, flat.vector);
    const off = Math.hypot(height, length(along(way, -height, flat.vector)) - radius);
    return Math.max(far, off);
  }, 0);
  return { center, normal: flat.vector, radius, residual };
}
