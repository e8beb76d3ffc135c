// A plane that cuts the models open.
import { type Box3, Plane, Vector3 } from "three";

export interface Section {
  /** The axis that the plane is orthogonal to. */
  axis: 0 | 1 | 2;
  /** The position of the plane along the axis, from one end of the models to the other. */
  fraction: number;
  /** Whether the other side is shown. */
  flipped: boolean;
}

/** Returns the planes with which to clip a scene in this box; without a section, none. */
export function clippingPlanes(section: Section | undefined, box: Box3): Plane[] {
  if (section === undefined || box.isEmpty()) return [];
  const { axis, fraction, flipped } = section;
  const [low, high] = [box.min.getComponent(axis), box.max.getComponent(axis)];
  const at = low + fraction * (high - low);
  // The side that is kept is the one where normal · point + constant is positive.
  const sign = flipped ? 1 : -1;
  return [new Plane(new Vector3().setComponent(axis, sign), -sign * at)];
}
