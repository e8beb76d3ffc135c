import { type CheckedArrays, isArray, isCount } from "./arrays.js";
import { HausdorffError } from "./error.js";

/** x, y, z and the weight w; x, y, z not multiplied by w. */
export type ControlPoint = readonly [x: number, y: number, z: number, w: number];

/** A surface of the interchange JSON. */
export interface InterchangeSurface {
  /** Degrees in u and v, each 1 to 15. */
  degree: readonly [number, number];
  knots_u: readonly number[];
  knots_v: readonly number[];
  /** `ctrl[i][j]`, i along u. */
  ctrl: readonly (readonly ControlPoint[])[];
}

/** The interchange JSON, parsed; other keys are ignored. */
export interface InterchangeModel {
  name?: string;
  surfaces: readonly InterchangeSurface[];
}

/** Longest text taken, the same as in Rust. */
const mostLength = 256 * 2 ** 20;

/**
 * The text's object.
 * @internal
 */
export function parse(text: string): unknown {
  if (text.length > mostLength) {
    const message = `the model is ${text.length} bytes, expected at most ${mostLength}`;
    throw new HausdorffError("FILE_TOO_LARGE", message);
  }
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw new HausdorffError("JSON_SHAPE", `the model is not interchange JSON: ${cause}`, {
      cause,
    });
  }
}

/**
 * The model's name and arrays, if it has the shape of an `InterchangeModel`.
 * The module's own parser would do this as well, but is long to send.
 * @internal
 */
export function read(model: unknown): { name: string | undefined; surfaces: CheckedArrays[] } {
  const { name, surfaces } = record(model, "the model");
  if (name !== undefined && name !== null && typeof name !== "string") {
    throw shape("name", name, "a string");
  }
  return { name: name ?? undefined, surfaces: list(surfaces, "surfaces").map(surface) };
}

function surface(value: unknown, index: number): CheckedArrays {
  const where = `surfaces[${index}]`;
  const { degree, knots_u, knots_v, ctrl } = record(value, where);
  const [first, second, ...others] = list(degree, `${where}.degree`);
  if (!isCount(first) || !isCount(second) || others.length > 0) {
    throw shape(`${where}.degree`, degree, "two integers from 0");
  }
  const rows = list(ctrl, `${where}.ctrl`).map((row, i) => list(row, `${where}.ctrl[${i}]`));
  const columns = rows[0]?.length ?? 0;
  const ragged = rows.findIndex((row) => row.length !== columns);
  if (ragged >= 0) {
    const found = `row ${ragged} of the net has ${rows[ragged]?.length} control points`;
    throw new HausdorffError("RAGGED_NET", `surface ${index}: ${found}, expected ${columns}`);
  }
  const controlPoints = new Float64Array(rows.length * columns * 4);
  rows.flat().forEach((point, k) => {
    const at = `${where}.ctrl[${Math.floor(k / columns)}][${k % columns}]`;
    const values = numbers(point, at);
    if (values.length !== 4) throw shape(at, point, "[x, y, z, w]");
    controlPoints.set(values, 4 * k);
  });
  return {
    degree: [first, second],
    knotsU: Float64Array.from(numbers(knots_u, `${where}.knots_u`)),
    knotsV: Float64Array.from(numbers(knots_v, `${where}.knots_v`)),
    counts: [rows.length, columns],
    controlPoints,
  };
}

function record(value: unknown, where: string): Record<string, unknown> {
  if (typeof value !== "object" || value === null || isArray(value)) {
    throw shape(where, value, "an object");
  }
  return value as Record<string, unknown>;
}

function list(value: unknown, where: string): readonly unknown[] {
  if (!isArray(value)) throw shape(where, value, "an array");
  return value;
}

function numbers(value: unknown, where: string): readonly number[] {
  const items = list(value, where);
  const wrong = items.findIndex((item) => typeof item !== "number");
  if (wrong >= 0) throw shape(`${where}[${wrong}]`, items[wrong], "a number");
  return items as readonly number[];
}

function shape(where: string, found: unknown, expected: string): HausdorffError {
  const kind =
    found === null ? "null" : isArray(found) ? `an array of ${found.length}` : typeof found;
  const message = `the model is not interchange JSON: ${where} is ${kind}, expected ${expected}`;
  return new HausdorffError("JSON_SHAPE", message);
}
