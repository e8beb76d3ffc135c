// Both models' own coordinates, and those of a result: A's after its transform, in A's unit.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import type { Side } from "../protocol.ts";
import { moved, movedBack } from "../rigid.ts";

/** Where A is, and A's units in one of B's. */
export interface Placing {
  transform: Transform;
  scale: number;
}

/** Returns a point of a model in the coordinates of a result. */
export const placed = (side: Side, point: Vector3, { transform, scale }: Placing): Vector3 =>
  side === "a" ? moved(point, transform) : scaled(point, scale);

/** Returns a point of a result in the coordinates of a model. */
export const unplaced = (side: Side, point: Vector3, { transform, scale }: Placing): Vector3 =>
  side === "a" ? movedBack(point, transform) : scaled(point, 1 / scale);

const scaled = ([x, y, z]: Vector3, factor: number): Vector3 => [
  factor * x,
  factor * y,
  factor * z,
];
