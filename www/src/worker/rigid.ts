// Rigid transforms of points, without the drawing library, which the worker does not load.
import type { Transform, Vector3 } from "nurbs-hausdorff";

/** Returns the point, rotated and then translated. */
export function moved(point: Vector3, { rotation, translation }: Transform): Vector3 {
  const rotated = rotation === undefined ? point : rotate(point, rotation);
  const [x = 0, y = 0, z = 0] = translation ?? [];
  return [rotated[0] + x, rotated[1] + y, rotated[2] + z];
}

/** Returns the point that the transform moves to this one. */
export function movedBack(point: Vector3, { rotation, translation }: Transform): Vector3 {
  const [x = 0, y = 0, z = 0] = translation ?? [];
  const relative: Vector3 = [point[0] - x, point[1] - y, point[2] - z];
  if (rotation === undefined) return relative;
  const [a, b, c, w] = rotation;
  return rotate(relative, [-a, -b, -c, w]);
}

/** p + 2 w (q × p) + 2 q × (q × p) for the unit quaternion (q, w). */
function rotate(p: Vector3, [x, y, z, w]: readonly [number, number, number, number]): Vector3 {
  const [a, b, c] = cross([x, y, z], p);
  const [d, e, f] = cross([x, y, z], [a, b, c]);
  return [p[0] + 2 * (w * a + d), p[1] + 2 * (w * b + e), p[2] + 2 * (w * c + f)];
}

const cross = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [
  b * z - c * y,
  c * x - a * z,
  a * y - b * x,
];
