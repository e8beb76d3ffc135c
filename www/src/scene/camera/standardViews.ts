// The standard directions of view.
import { Vector3 } from "three";

/** From the target to the camera. z is up; the front faces −y, as in CAD systems. */
export const STANDARD_VIEWS = {
  oblique: new Vector3(0.75, -1.25, 0.8).normalize(),
  isometric: new Vector3(1, -1, 1).normalize(),
  front: new Vector3(0, -1, 0),
  back: new Vector3(0, 1, 0),
  left: new Vector3(-1, 0, 0),
  right: new Vector3(1, 0, 0),
  top: new Vector3(0, 0, 1),
  bottom: new Vector3(0, 0, -1),
} as const;

export type StandardView = keyof typeof STANDARD_VIEWS;
