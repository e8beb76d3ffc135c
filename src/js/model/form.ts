import type { Vector3 } from "../measure/options.js";
import type { Interval } from "./facts.js";

/**
 * The elementary surface that all points of a face lie on, up to what is stated, in the model's unit.
 *
 * Guarantee: `radius` contains the distance of every point of the face from `point` (of a sphere), from the line
 * through `point` along `direction` (of a cylinder), or from the circle of `majorRadius` about them (of a torus);
 * `deviation` is at least the distance of every point from the plane, or from the cone with both of its nappes. Points and directions are numbers:
 * what is certain is how far the face is from the form with just these. The gap between the face and its source is not
 * in it.
 */
export type FaceForm =
  /** `direction` is the plane's normal. */
  | { kind: "plane"; point: Vector3; direction: Vector3; deviation: number }
  | { kind: "sphere"; point: Vector3; radius: Interval }
  | { kind: "cylinder"; point: Vector3; direction: Vector3; radius: Interval }
  /** `point` is the apex, from which `direction` points to the face; `halfAngle` is in degrees. */
  | { kind: "cone"; point: Vector3; direction: Vector3; halfAngle: number; deviation: number }
  /** `radius` is that of the tube. */
  | {
      kind: "torus";
      point: Vector3;
      direction: Vector3;
      majorRadius: number;
      radius: Interval;
    };
