// What was measured in the view: in a control of the form, so that links, undoing and kept files hold it. Kept is
// what was picked; numbers follow from the models as they stand.
import { computed } from "@preact/signals-core";
import type { Vector3 } from "nurbs-hausdorff";
import { field } from "../state/store.ts";
import { SIDES, type Side } from "../worker/protocol.ts";

/** The most measurements: a link holds them. */
const MAX_COUNT = 60;
/** Significant digits of a point and of a normal. */
const DIGITS = 9;

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

const state = field("measures");

/** All of them, in the order in which they were made: their numbers are from 1. */
export const measures = computed((): readonly Measure[] => parsed(state.value));

/** Adds one, and returns whether there was room for it. */
export function addMeasure(measure: Measure): boolean {
  const all = measures.peek();
  if (all.length >= MAX_COUNT) return false;
  write([...all, measure]);
  return true;
}

export const removeMeasure = (index: number): void =>
  write(measures.peek().filter((_, at) => at !== index));

/** Removes all of them: the models are new. */
export const clearMeasures = (): void => state.set("");

function write(all: readonly Measure[]): void {
  const short = (value: number) => Number(value.toPrecision(DIGITS));
  const rows = all.map(({ what, places }) => [
    what,
    ...places.map(({ side, face, point, normal }) => [
      ...[side, face, ...point.map(short), ...normal.map(short)],
    ]),
  ]);
  state.set(rows.length === 0 ? "" : JSON.stringify(rows));
}

/** What a link says, which may be anything. */
function parsed(text: string): Measure[] {
  if (text === "") return [];
  let rows: unknown;
  try {
    rows = JSON.parse(text);
  } catch {
    return [];
  }
  return Array.isArray(rows) ? rows.slice(0, MAX_COUNT).flatMap(measureOf) : [];
}

function measureOf(row: unknown): Measure[] {
  if (!Array.isArray(row)) return [];
  const [what, ...rest] = row as unknown[];
  const [first, second] = rest.map(placeOf);
  if (first === undefined) return [];
  if (what === "points") return second === undefined ? [] : [{ what, places: [first, second] }];
  const isKnown = what === "radius" || what === "circle" || what === "edge";
  return isKnown && rest.length === 1 ? [{ what, places: [first] }] : [];
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
