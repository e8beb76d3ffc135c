// What was measured in the view, in a list that links, undoing and kept files hold. Kept is what was picked; numbers
// follow from the models as they stand.
import type { Vector3 } from "nurbs-hausdorff";
import { keptList, short } from "../state/keptList.ts";
import { SIDES, type Side } from "../worker/protocol.ts";

/** A place of a model, in the model's own coordinates: it moves with the model. */
export interface Place {
  side: Side;
  face: number;
  point: Vector3;
  /** Zero of points without a surface. */
  normal: Vector3;
}

/**
 * The distance of two places; the radius of the face at a place, or of the round edge there; the length of the edge
 * there.
 */
export type Measure =
  | { what: "points"; places: readonly [Place, Place] }
  | { what: "radius" | "circle" | "edge"; places: readonly [Place] };

const list = keptList("measures", rowOf, measureOf);

/** All of them, in the order in which they were made: their numbers are from 1. */
export const measures = list.all;

/** Adds one, and returns its index; undefined where there is no room for it. */
export const addMeasure = list.add;

export const removeMeasure = (index: number): void =>
  list.write(measures.peek().filter((_, at) => at !== index));

/** Removes all of them: the models are new. */
export const clearMeasures = (): void => list.write([]);

function rowOf({ what, places }: Measure): unknown[] {
  const placed = ({ side, face, point, normal }: Place) => [
    ...[side, face, ...point.map(short), ...normal.map(short)],
  ];
  return [what, ...places.map(placed)];
}

function measureOf([what, ...rest]: readonly unknown[]): Measure | undefined {
  const [first, second] = rest.map(placeOf);
  if (first === undefined) return undefined;
  if (what === "points") return second && { what, places: [first, second] };
  const isKnown = what === "radius" || what === "circle" || what === "edge";
  return isKnown && rest.length === 1 ? { what, places: [first] } : undefined;
}

/** The numbers of a place: its face, its point and its normal. */
const NUMBERS = 7;

function placeOf(row: unknown): Place | undefined {
  if (!Array.isArray(row)) return undefined;
  const [side, ...numbers] = row as unknown[];
  const isValid = numbers.length === NUMBERS && numbers.every((value) => Number.isFinite(value));
  if (!isValid || !SIDES.some((one) => one === side)) return undefined;
  const [face = 0, x = 0, y = 0, z = 0, ...normal] = numbers as number[];
  if (!Number.isInteger(face) || face < 0) return undefined;
  return {
    ...{ side: side as Side, face, point: [x, y, z] },
    normal: normal as unknown as Vector3,
  };
}
