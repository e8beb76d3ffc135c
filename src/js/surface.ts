import { HausdorffError } from "./error.js";
import { PreparedModel, Surfaces } from "./wasm/nurbs_hausdorff.js";

/** Numbers in an array of any kind, converted to float64. */
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
  /** x, y, z, w of every control point, v fastest; x, y, z not multiplied by w unless `homogeneous`. */
  controlPoints: Numbers;
  /**
   * Whether x, y, z are given multiplied by w, as rhino3dm's and many libraries'
   * are; default no. They are divided in float64. **No check can notice a wrong
   * value**: both are surfaces, but different ones unless all weights are 1.
   */
  homogeneous?: boolean;
}

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

/**
 * The module's model of what `Hausdorff.model` takes. Here the types of plain
 * arrays are checked; the module checks their numbers, and parses JSON.
 * @internal
 */
export function prepare(
  input: readonly SurfaceArrays[] | InterchangeModel | string,
): PreparedModel {
  if (isArray(input)) return fromArrays(input as readonly SurfaceArrays[]);
  if (typeof input === "string") return PreparedModel.fromJson(input);
  if (typeof input !== "object" || input === null) {
    const found = input === null ? "null" : typeof input;
    throw invalid(
      `the model is ${found}, expected an array of surfaces, interchange JSON or its text`,
    );
  }
  return PreparedModel.fromJson(JSON.stringify(input));
}

function fromArrays(input: readonly SurfaceArrays[]): PreparedModel {
  const surfaces = new Surfaces();
  try {
    input.forEach((surface, index) => {
      push(surfaces, surface, `surface ${index}`);
    });
  } catch (error) {
    surfaces.free();
    throw error;
  }
  // Takes the surfaces over, and frees them.
  return PreparedModel.fromArrays(surfaces);
}

function push(surfaces: Surfaces, surface: SurfaceArrays, where: string): void {
  if (typeof surface !== "object" || surface === null) {
    throw invalid(`${where} is ${surface === null ? "null" : typeof surface}, expected an object`);
  }
  const points = controlPoints(surface.controlPoints, surface.homogeneous, `${where}: `);
  surfaces.push(
    ...pair(surface.degree, `${where}: degree`),
    numbers(surface.knotsU, `${where}: knotsU`),
    numbers(surface.knotsV, `${where}: knotsV`),
    ...pair(surface.counts, `${where}: counts`),
    points,
  );
}

/**
 * The control points of a surface as the module takes them.
 * @internal
 */
export function controlPoints(value: unknown, homogeneous: unknown, where: string): Float64Array {
  const points = numbers(value, `${where}controlPoints`);
  if (points.length % 4 !== 0) {
    throw invalid(`${where}controlPoints has ${points.length} numbers, expected four a point`);
  }
  return flag(homogeneous, `${where}homogeneous`) ? projected(points) : points;
}

/** Control points divided by their weights; the module refuses weights that are not positive. */
function projected(homogeneous: Float64Array): Float64Array {
  return homogeneous.map((value, index) => {
    // The last of the point's four numbers.
    const weight = homogeneous[index | 3] as number;
    return (index & 3) < 3 && weight > 0 ? value / weight : value;
  });
}

function flag(value: unknown, where: string): boolean {
  if (value !== undefined && typeof value !== "boolean") {
    throw invalid(`${where} is ${typeof value}, expected a boolean`);
  }
  return value === true;
}

/** The largest integer that the module's 32 bits take. */
const MAX_COUNT = 2 ** 32 - 1;

function isCount(value: unknown): value is number {
  return Number.isInteger(value) && (value as number) >= 0 && (value as number) <= MAX_COUNT;
}

function pair(value: unknown, where: string): [number, number] {
  const [first, second, ...others] = isArray(value) ? value : [];
  if (!isCount(first) || !isCount(second) || others.length > 0) {
    throw invalid(`${where} is ${value}, expected two integers from 0`);
  }
  return [first, second];
}

/**
 * The numbers as float64, checked to be numbers.
 * @internal
 */
export function numbers(value: unknown, where: string): Float64Array {
  if (value instanceof Float64Array) return value;
  if (value instanceof Float32Array) return new Float64Array(value);
  if (!isArray(value)) throw invalid(`${where} is ${typeof value}, expected an array of numbers`);
  const wrong = value.findIndex((item) => typeof item !== "number");
  if (wrong >= 0) {
    throw invalid(`${where}: item ${wrong} is ${typeof value[wrong]}, expected a number`);
  }
  return Float64Array.from(value as number[]);
}

/** Unlike Array.isArray, this does not make everything `any`. */
function isArray(value: unknown): value is readonly unknown[] {
  return Array.isArray(value);
}

function invalid(message: string): HausdorffError {
  return new HausdorffError("ARGUMENT_INVALID", message);
}
