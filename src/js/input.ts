import { HausdorffError } from "./error.js";
import { PreparedModel, Surfaces } from "./wasm/nurbs_hausdorff.js";

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

/** x, y, z and the weight w. */
export type ControlPoint = readonly [number, number, number, number];

/** A surface of the interchange JSON. */
export interface InterchangeSurface {
  degree: readonly [number, number];
  knots_u: readonly number[];
  knots_v: readonly number[];
  /** `ctrl[i][j]`, i along u. */
  ctrl: readonly (readonly ControlPoint[])[];
}

/** The interchange JSON, parsed. */
export interface InterchangeModel {
  name?: string;
  surfaces: readonly InterchangeSurface[];
}

/** @internal */
export type ModelInput = readonly SurfaceArrays[] | InterchangeModel | string;

/**
 * The module's model of the input.
 * @internal
 */
export function prepare(input: ModelInput): PreparedModel {
  if (typeof input === "string") return PreparedModel.fromJson(input);
  if (isArray(input)) return fromArrays(input);
  if (typeof input === "object" && input !== null) return PreparedModel.fromJson(toJson(input));
  throw invalid(`the model is ${typeof input}, expected an array of surfaces or interchange JSON`);
}

// Unlike Array.isArray, this narrows readonly arrays too.
function isArray(input: object): input is readonly SurfaceArrays[] {
  return Array.isArray(input);
}

function toJson(input: InterchangeModel): string {
  try {
    return JSON.stringify(input);
  } catch (cause) {
    throw new HausdorffError("JSON_SHAPE", `the model is not interchange JSON: ${cause}`, {
      cause,
    });
  }
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
  // Takes the surfaces over.
  return PreparedModel.fromArrays(surfaces);
}

function push(surfaces: Surfaces, surface: SurfaceArrays, where: string): void {
  if (typeof surface !== "object" || surface === null) {
    throw invalid(`${where} is ${surface === null ? "null" : typeof surface}, expected an object`);
  }
  const [degreeU, degreeV] = pair(surface.degree, `${where}: degree`);
  const [countU, countV] = pair(surface.counts, `${where}: counts`);
  const points = numbers(surface.controlPoints, `${where}: controlPoints`);
  if (points.length % 4 !== 0) {
    throw invalid(`${where}: controlPoints has ${points.length} numbers, expected four a point`);
  }
  surfaces.push(
    degreeU,
    degreeV,
    numbers(surface.knotsU, `${where}: knotsU`),
    numbers(surface.knotsV, `${where}: knotsV`),
    countU,
    countV,
    points,
  );
}

/** The largest integer that the module's 32 bits take. */
const mostCount = 2 ** 32 - 1;

function pair(value: unknown, where: string): [number, number] {
  const found =
    Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(value as Numbers) : [];
  const valid = found.every((item) => Number.isInteger(item) && item >= 0 && item <= mostCount);
  const [first, second] = found;
  if (!valid || found.length !== 2 || first === undefined || second === undefined) {
    throw invalid(
      `${where} is ${found.length ? `[${found}]` : typeof value}, expected two integers from 0`,
    );
  }
  return [first, second];
}

function numbers(value: unknown, where: string): Float64Array {
  if (value instanceof Float64Array) return value;
  if (value instanceof Float32Array) return Float64Array.from(value);
  if (!Array.isArray(value)) {
    throw invalid(`${where} is ${typeof value}, expected an array of numbers`);
  }
  const wrong = value.findIndex((item) => typeof item !== "number");
  if (wrong >= 0) {
    throw invalid(`${where}: item ${wrong} is ${typeof value[wrong]}, expected a number`);
  }
  return Float64Array.from(value);
}

function invalid(message: string): HausdorffError {
  return new HausdorffError("ARGUMENT_INVALID", message);
}
