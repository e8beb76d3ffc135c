import { HausdorffError } from "./error.js";

/** Numbers in an array of any kind; taken as float64. */
export type Numbers = Float64Array | Float32Array | readonly number[];

/** A NURBS surface as plain arrays. */
export interface SurfaceArrays {
  /** Degrees in u and v, each 1 to 15. */
  degree: readonly [number, number];
  /** Rising knots in u; `counts[0] + degree[0] + 1` of them. */
  knotsU: Numbers;
  /** Rising knots in v; `counts[1] + degree[1] + 1` of them. */
  knotsV: Numbers;
  /** Numbers of control points along u and v. */
  counts: readonly [number, number];
  /** x, y, z, w of every control point, v fastest; x, y, z not multiplied by w. */
  controlPoints: Numbers;
}

/**
 * Arrays whose types were checked; what the numbers say is for the module to check.
 * @internal
 */
export interface CheckedArrays {
  degree: [number, number];
  knotsU: Float64Array;
  knotsV: Float64Array;
  counts: [number, number];
  controlPoints: Float64Array;
}

/**
 * The surface with its types checked.
 * @internal
 */
export function checked(surface: SurfaceArrays, index: number): CheckedArrays {
  const where = `surface ${index}`;
  if (typeof surface !== "object" || surface === null) {
    throw invalid(`${where} is ${surface === null ? "null" : typeof surface}, expected an object`);
  }
  const controlPoints = numbers(surface.controlPoints, `${where}: controlPoints`);
  if (controlPoints.length % 4 !== 0) {
    throw invalid(
      `${where}: controlPoints has ${controlPoints.length} numbers, expected four a point`,
    );
  }
  return {
    degree: pair(surface.degree, `${where}: degree`),
    knotsU: numbers(surface.knotsU, `${where}: knotsU`),
    knotsV: numbers(surface.knotsV, `${where}: knotsV`),
    counts: pair(surface.counts, `${where}: counts`),
    controlPoints,
  };
}

/** The largest integer that the module's 32 bits take. */
const mostCount = 2 ** 32 - 1;

/**
 * Whether the module takes it for a degree or a number of points.
 * @internal
 */
export function isCount(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 0 && (value as number) <= mostCount;
}

function pair(value: unknown, where: string): [number, number] {
  const [first, second, ...others] = isArray(value) ? value : [];
  if (!isCount(first) || !isCount(second) || others.length > 0) {
    throw invalid(`${where} is ${value}, expected two integers from 0`);
  }
  return [first, second];
}

function numbers(value: unknown, where: string): Float64Array {
  if (value instanceof Float64Array) return value;
  if (value instanceof Float32Array) return Float64Array.from(value);
  if (!isArray(value)) throw invalid(`${where} is ${typeof value}, expected an array of numbers`);
  const wrong = value.findIndex((item) => typeof item !== "number");
  if (wrong >= 0) {
    throw invalid(`${where}: item ${wrong} is ${typeof value[wrong]}, expected a number`);
  }
  return Float64Array.from(value as number[]);
}

/**
 * Unlike Array.isArray, this does not make everything `any`.
 * @internal
 */
export function isArray(value: unknown): value is readonly unknown[] {
  return Array.isArray(value);
}

function invalid(message: string): HausdorffError {
  return new HausdorffError("ARGUMENT_INVALID", message);
}
