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

export const cross = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [
  b * z - c * y,
  c * x - a * z,
  a * y - b * x,
];

/** The rows of a rotation's matrix, and a translation before it. */
export interface Backwards {
  before: Vector3;
  rows: readonly [Vector3, Vector3, Vector3];
}

/** Returns the inverse of a transform, for many points. */
export function backwards({ rotation, translation }: Transform): Backwards {
  const [x = 0, y = 0, z = 0] = translation ?? [];
  const axes: Vector3[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  // The rows of the inverse are the columns of the rotation, the images of the axes.
  const [a, b, c] = axes.map((axis) => (rotation === undefined ? axis : rotate(axis, rotation)));
  const rows = [a ?? [1, 0, 0], b ?? [0, 1, 0], c ?? [0, 0, 1]] as const;
  return { before: [-x, -y, -z], rows };
}

/** Writes the points, moved back and relative to `origin`, to the start of `into`. */
export function placeBack(
  points: Float64Array,
  { before, rows }: Backwards,
  origin: Vector3,
  into: Float32Array,
): void {
  const [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = rows;
  for (let place = 0; place < points.length; place += 3) {
    const x = (points[place] ?? 0) + before[0];
    const y = (points[place + 1] ?? 0) + before[1];
    const z = (points[place + 2] ?? 0) + before[2];
    into[place] = xx * x + xy * y + xz * z - origin[0];
    into[place + 1] = yx * x + yy * y + yz * z - origin[1];
    into[place + 2] = zx * x + zy * y + zz * z - origin[2];
  }
}
