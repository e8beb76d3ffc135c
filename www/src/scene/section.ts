// A plane that cuts the models open.
import { type Box3, MathUtils, Plane, Quaternion, Vector3 } from "three";

export interface Section {
  /** The axis that the plane is orthogonal to before it is tilted; a free one has its own normal. */
  axis: 0 | 1 | 2 | undefined;
  /** The unit vector that the plane is orthogonal to before it is tilted. */
  normal: Vector3;
  /** A point of the line along which the plane is moved; without one, the middle of the models. */
  through: Vector3 | undefined;
  /** The position of the plane along the normal, from one end of the models to the other. */
  fraction: number;
  /** The angles, in degrees, about the directions to the right and up. */
  tilt: readonly [number, number];
  /** Whether the other side is shown. */
  flipped: boolean;
}

/** A section where it is in the scene. */
export interface Cut {
  /** The side that is kept is the one where normal · point + constant is positive. */
  plane: Plane;
  /** The directions in the plane, as they are drawn. */
  right: Vector3;
  up: Vector3;
  /** Their names. */
  names: readonly [string, string];
  /** Whether the plane is orthogonal to the axis of its section. */
  isStraight: boolean;
}

const AXES = ["x", "y", "z"] as const;
/** The cosine of the angle from an axis from which on the axis z is no direction up. */
const UPRIGHT = 0.999;

/** The ends of a box along a direction. */
export function extentOf(box: Box3, normal: Vector3): [low: number, high: number] {
  const [low, high] = [new Vector3(), new Vector3()];
  for (const at of [0, 1, 2]) {
    const ends = [box.min.getComponent(at), box.max.getComponent(at)] as const;
    const [first, last] = normal.getComponent(at) < 0 ? [ends[1], ends[0]] : ends;
    low.setComponent(at, first);
    high.setComponent(at, last);
  }
  return [normal.dot(low), normal.dot(high)];
}

/** Returns where a section is in a scene in this box; without a section or a box, nothing. */
export function cutOf(section: Section | undefined, box: Box3): Cut | undefined {
  if (section === undefined || box.isEmpty()) return undefined;
  const { axis, normal, fraction, tilt, flipped } = section;
  const [low, high] = extentOf(box, normal);
  const at = low + fraction * (high - low);
  const [right, up] = directions(normal, axis);
  const turn = new Quaternion()
    .setFromAxisAngle(up, MathUtils.degToRad(tilt[1]))
    .multiply(new Quaternion().setFromAxisAngle(right, MathUtils.degToRad(tilt[0])));
  const isTilted = tilt.some((angle) => angle !== 0);
  const turned = isTilted ? normal.clone().applyQuaternion(turn).normalize() : normal.clone();
  const base = section.through ?? box.getCenter(new Vector3());
  const point = base.clone().addScaledVector(normal, at - normal.dot(base));
  const sign = flipped ? 1 : -1;
  const place = isTilted ? turned.dot(point) : at;
  const isStraight = axis !== undefined && !isTilted;
  return {
    plane: new Plane(turned.multiplyScalar(sign), -sign * place),
    right: right.applyQuaternion(turn),
    up: up.applyQuaternion(turn),
    names: isStraight
      ? (AXES.filter((_, other) => other !== axis) as unknown as [string, string])
      : ["across", "up"],
    isStraight,
  };
}

/** The directions to the right and up in a plane: axes, or up as far as the axis z is. */
function directions(normal: Vector3, axis: Section["axis"]): [right: Vector3, up: Vector3] {
  if (axis !== undefined) {
    const unit = (at: number) => new Vector3().setComponent(at, 1);
    return [unit(axis === 0 ? 1 : 0), unit(axis === 2 ? 1 : 2)];
  }
  const upright = Math.abs(normal.z) < UPRIGHT ? new Vector3(0, 0, 1) : new Vector3(0, 1, 0);
  const up = upright.addScaledVector(normal, -upright.dot(normal)).normalize();
  return [new Vector3().crossVectors(up, normal), up];
}
