// Rigid transforms as unit quaternions and translations.
import type { Transform, Vector3 } from "../measure/options.js";

/** A transform with both parts. */
export interface Rigid {
  rotation: [x: number, y: number, z: number, w: number];
  translation: Vector3;
}

/** Returns the transform with the identity's parts for those that are absent. */
export function complete({ rotation, translation }: Transform): Rigid {
  const [x, y, z, w] = rotation ?? [0, 0, 0, 1];
  const [a, b, c] = translation ?? [0, 0, 0];
  return { rotation: [x, y, z, w], translation: [a, b, c] };
}

/**
 * Returns the transform followed by a rotation about `center` and a shift. The rotation
 * vector has the direction of the axis and the length of the angle in radians.
 */
export function followed(
  { rotation, translation }: Rigid,
  vector: Vector3,
  center: Vector3,
  shift: Vector3,
): Rigid {
  const angle = Math.hypot(...vector);
  // sin(angle / 2) / angle, which is 1/2 in the limit.
  const factor = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
  const [x, y, z] = [factor * vector[0], factor * vector[1], factor * vector[2]];
  const turn: Rigid["rotation"] = [x, y, z, Math.cos(angle / 2)];
  const relative = minus(translation, center);
  const turned = rotated(relative, turn);
  return {
    rotation: unit(product(turn, rotation)),
    translation: plus(plus(turned, center), shift),
  };
}

/** Returns the vector rotated: p + 2 w (q × p) + 2 q × (q × p) for the unit quaternion (q, w). */
function rotated(p: Vector3, [x, y, z, w]: Rigid["rotation"]): Vector3 {
  const first = cross([x, y, z], p);
  const second = cross([x, y, z], first);
  return [
    p[0] + 2 * (w * first[0] + second[0]),
    p[1] + 2 * (w * first[1] + second[1]),
    p[2] + 2 * (w * first[2] + second[2]),
  ];
}

/** Returns the quaternion of the rotation `b` followed by `a`. */
function product(a: Rigid["rotation"], b: Rigid["rotation"]): Rigid["rotation"] {
  const [ax, ay, az, aw] = a;
  const [bx, by, bz, bw] = b;
  return [
    aw * bx + bw * ax + ay * bz - az * by,
    aw * by + bw * ay + az * bx - ax * bz,
    aw * bz + bw * az + ax * by - ay * bx,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

function unit([x, y, z, w]: Rigid["rotation"]): Rigid["rotation"] {
  const length = Math.hypot(x, y, z, w);
  return [x / length, y / length, z / length, w / length];
}

export const cross = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [
  b * z - c * y,
  c * x - a * z,
  a * y - b * x,
];

const plus = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [a + x, b + y, c + z];

const minus = ([a, b, c]: Vector3, [x, y, z]: Vector3): Vector3 => [a - x, b - y, c - z];
