import { kindOfText } from "../cad/kind.js";
import { HausdorffError } from "../error.js";
import { checkKeys } from "../keys.js";
import { PreparedModel, Surfaces } from "../wasm/nurbs_hausdorff.js";

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
  /** Loops of curves head to tail, material on the left; absent: the whole surface. */
  trim?: readonly (readonly TrimCurveArrays[])[];
  /** Whether the face's normal is opposite to the surface's; no distance uses it. */
  reversed?: boolean;
  /** The face's name in its source; in an assembly with the names of its levels before it, as `facePath` splits. */
  faceName?: string;
  /** The kind of surface in its source, such as `cylinder`. */
  kind?: string;
  /** An upper bound on the surface's distance from its source, in model units; default 0. */
  gap?: number;
  /** Whether this gap, or one of a curve's, was measured at points and is no upper bound. */
  gapMeasured?: boolean;
  /** The face's colour in its source: red, green and blue of sRGB, each from 0 to 1. */
  color?: Numbers;
  /** The number of the shell that the face belongs to in its source: edges within a shell are joined first. */
  shell?: number;
  /** The number of the solid that the face bounds in its source: a shell of one solid is no void of another one. */
  solid?: number;
}

/** A rational B-spline curve in the parameter plane of its surface, as plain arrays. */
export interface TrimCurveArrays {
  /** The degree, 1 to 15. */
  degree: number;
  /** Rising knots; as many as control points, and `degree + 1` more. */
  knots: Numbers;
  /** u, v, w of every control point; u, v not multiplied by w. */
  controlPoints: Numbers;
  /** An upper bound on the distance to the edge that the curve stands for, in model units; default 0. */
  gap?: number;
  /** The edge's number, from 0; neighbouring faces share it. */
  edge?: number;
}

/** A placement of some surfaces of a model. */
export interface InstanceArrays {
  /** The indices of the surfaces. */
  surfaces: readonly number[];
  /** An invertible affine map as a row-major 3x4 matrix, the translation in the last column. */
  transform: Numbers;
  name?: string;
  /**
   * The number of the solid that the placed faces bound, in place of those of the faces: instances with the same number
   * are of one solid. Without it each instance has shells and solids of its own.
   */
  solid?: number;
}

/** A model as plain arrays, where surfaces alone do not suffice. */
export interface ModelArrays {
  name?: string;
  /** Metres per model unit. */
  unit?: number;
  surfaces: readonly SurfaceArrays[];
  /** Absent or empty: each surface once, where it is. */
  instances?: readonly InstanceArrays[];
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
  /** Loops of curves head to tail, material on the left; absent: the whole surface. */
  trim?: readonly (readonly InterchangeCurve[])[];
  reversed?: boolean;
  part?: string;
  kind?: string;
  gap?: number;
  gap_measured?: boolean;
  color?: readonly [red: number, green: number, blue: number];
  shell?: number;
  solid?: number;
}

/** A trimming curve of the interchange JSON. */
export interface InterchangeCurve {
  degree: number;
  knots: readonly number[];
  /** u, v and the weight w; u, v not multiplied by w. */
  ctrl: readonly (readonly [u: number, v: number, w: number])[];
  gap?: number;
  edge?: number;
}

/** A placement of some surfaces of the interchange JSON. */
export interface InterchangeInstance {
  surfaces: readonly number[];
  /** A row-major 3x4 matrix. */
  transform: readonly number[];
  name?: string;
  solid?: number;
}

/** The interchange JSON, version 1 or 2, parsed; other keys are ignored. */
export interface InterchangeModel {
  name?: string;
  /** Metres per model unit. */
  unit?: number;
  surfaces: readonly InterchangeSurface[];
  instances?: readonly InterchangeInstance[];
}

/** The text that OpenCASCADE writes of a shape, with `BRepTools.Write`; `readCad` reads it. */
export interface BrepText {
  brep: string;
  /** Metres per unit of its coordinates, which the text does not state. */
  unit?: number;
}

/** The keys of plain arrays, in camel case, and of surfaces of interchange JSON, as files have them. */
const MODEL_KEYS: readonly (keyof ModelArrays)[] = ["name", "unit", "surfaces", "instances"];
const SURFACE_KEYS: readonly (keyof SurfaceArrays)[] = [
  ...(["degree", "knotsU", "knotsV", "counts", "controlPoints", "homogeneous"] as const),
  ...([
    "trim",
    "reversed",
    "faceName",
    "kind",
    "gap",
    "gapMeasured",
    "color",
    "shell",
    "solid",
  ] as const),
];
const CURVE_KEYS: readonly (keyof TrimCurveArrays)[] = [
  ...(["degree", "knots", "controlPoints", "gap", "edge"] as const),
];
const INSTANCE_KEYS: readonly (keyof InstanceArrays)[] = ["surfaces", "transform", "name", "solid"];
const INTERCHANGE_KEYS: readonly string[] = [
  ...([
    "degree",
    "knots_u",
    "knots_v",
    "ctrl",
    "trim",
    "reversed",
    "part",
    "kind",
    "gap",
    "gap_measured",
    "color",
    "shell",
    "solid",
  ] as const),
] satisfies (keyof InterchangeSurface)[];

/**
 * The module's model of what `Hausdorff.model` takes. Here the types of plain
 * arrays are checked; the module checks their numbers, and parses JSON.
 * @internal
 */
export function prepare(
  input: readonly SurfaceArrays[] | ModelArrays | InterchangeModel | string,
): PreparedModel {
  refuseFile(input);
  if (isArray(input)) return fromArrays({ surfaces: input as readonly SurfaceArrays[] });
  if (typeof input === "string") return PreparedModel.fromJson(input);
  if (typeof input !== "object" || input === null) {
    const found = input === null ? "null" : typeof input;
    throw invalid(
      `the model is ${found}, expected an array of surfaces, interchange JSON or its text`,
    );
  }
  if (isModelArrays(input)) return fromArrays(input);
  refuseArrayKeys(input);
  return PreparedModel.fromJson(JSON.stringify(input));
}

/** Keys of plain arrays that interchange JSON has not: those of a mixture would be ignored. */
const ARRAY_KEYS = SURFACE_KEYS.filter((key) => !INTERCHANGE_KEYS.includes(key));

function refuseArrayKeys({ surfaces }: InterchangeModel): void {
  (isArray(surfaces) ? surfaces : []).forEach((surface: unknown, index) => {
    const key = ARRAY_KEYS.find(
      (key) => typeof surface === "object" && surface !== null && key in surface,
    );
    if (key !== undefined) {
      const why = `found "${key}", which plain arrays have, in interchange JSON`;
      throw invalid(`surface ${index}: ${why}: expected ${INTERCHANGE_KEYS.join(", ")}`);
    }
  });
}

/** Whether a value is BREP text. */
export function isBrepText(input: unknown): input is BrepText {
  return typeof input === "object" && input !== null && "brep" in input;
}

/** Refuses files, whose reader is another method. */
function refuseFile(input: unknown): void {
  const isFile =
    isBrepText(input) ||
    input instanceof ArrayBuffer ||
    ArrayBuffer.isView(input) ||
    (typeof input === "string" && kindOfText(input) !== undefined);
  if (isFile) throw invalid("the model is a CAD file, which `await hd.readCad(bytes)` reads");
}

/** Whether the surfaces are plain arrays, and not those of interchange JSON. */
function isModelArrays(input: ModelArrays | InterchangeModel): input is ModelArrays {
  const [first] = isArray(input.surfaces) ? input.surfaces : [];
  return typeof first === "object" && first !== null && "controlPoints" in first;
}

function fromArrays(model: ModelArrays): PreparedModel {
  checkKeys("the model", model, MODEL_KEYS, "ARGUMENT_INVALID");
  const { name, unit, surfaces: input, instances } = model;
  const surfaces = new Surfaces(optional(name, "string", "name"), optional(unit, "number", "unit"));
  try {
    input.forEach((surface, index) => {
      push(surfaces, surface, `surface ${index}`);
    });
    list(instances ?? [], "instances").forEach((instance, index) => {
      pushInstance(surfaces, instance, `instance ${index}`);
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
  checkKeys(where, surface, SURFACE_KEYS, "ARGUMENT_INVALID");
  const points = controlPoints(surface.controlPoints, surface.homogeneous, `${where}: `);
  surfaces.push(
    ...pair(surface.degree, `${where}: degree`),
    numbers(surface.knotsU, `${where}: knotsU`),
    numbers(surface.knotsV, `${where}: knotsV`),
    ...pair(surface.counts, `${where}: counts`),
    points,
  );
  surfaces.describe(
    optional(surface.reversed, "boolean", `${where}: reversed`) ?? false,
    optional(surface.faceName, "string", `${where}: faceName`),
    optional(surface.kind, "string", `${where}: kind`),
    optional(surface.gap, "number", `${where}: gap`) ?? 0,
    optional(surface.gapMeasured, "boolean", `${where}: gapMeasured`) ?? false,
    surface.color === undefined ? undefined : numbers(surface.color, `${where}: color`),
    surface.shell === undefined ? undefined : count(surface.shell, `${where}: shell`),
    surface.solid === undefined ? undefined : count(surface.solid, `${where}: solid`),
  );
  if (surface.trim === undefined) return;
  surfaces.beginTrim();
  list(surface.trim, `${where}: trim`).forEach((curves, index) => {
    surfaces.beginLoop();
    list(curves, `${where}, loop ${index}`).forEach((curve, position) => {
      pushCurve(surfaces, curve, `${where}, loop ${index}, curve ${position}`);
    });
  });
}

function pushCurve(surfaces: Surfaces, curve: TrimCurveArrays, where: string): void {
  if (typeof curve !== "object" || curve === null) {
    throw invalid(`${where} is ${curve === null ? "null" : typeof curve}, expected an object`);
  }
  checkKeys(where, curve, CURVE_KEYS, "ARGUMENT_INVALID");
  const controlPoints = numbers(curve.controlPoints, `${where}: controlPoints`);
  if (controlPoints.length % 3 !== 0) {
    throw invalid(
      `${where}: controlPoints has ${controlPoints.length} numbers, expected three a point`,
    );
  }
  surfaces.pushCurve(
    count(curve.degree, `${where}: degree`),
    numbers(curve.knots, `${where}: knots`),
    controlPoints,
    optional(curve.gap, "number", `${where}: gap`) ?? 0,
    curve.edge === undefined ? undefined : count(curve.edge, `${where}: edge`),
  );
}

function pushInstance(surfaces: Surfaces, instance: InstanceArrays, where: string): void {
  if (typeof instance !== "object" || instance === null) {
    throw invalid(
      `${where} is ${instance === null ? "null" : typeof instance}, expected an object`,
    );
  }
  checkKeys(where, instance, INSTANCE_KEYS, "ARGUMENT_INVALID");
  const transform = numbers(instance.transform, `${where}: transform`);
  if (transform.length !== 12) {
    throw invalid(`${where}: transform has ${transform.length} numbers, expected 12`);
  }
  const indices = list(instance.surfaces, `${where}: surfaces`);
  surfaces.pushInstance(
    Uint32Array.from(indices, (index) => count(index, `${where}: surfaces`)),
    transform,
    optional(instance.name, "string", `${where}: name`),
    instance.solid === undefined ? undefined : count(instance.solid, `${where}: solid`),
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

function count(value: unknown, where: string): number {
  if (!isCount(value)) throw invalid(`${where} is ${value}, expected an integer from 0`);
  return value;
}

function list<T>(value: readonly T[], where: string): readonly T[] {
  if (!isArray(value)) throw invalid(`${where} is ${typeof value}, expected an array`);
  return value;
}

function optional<T>(value: T | undefined, type: string, where: string): T | undefined {
  if (value !== undefined && typeof value !== type) {
    throw invalid(`${where} is ${value === null ? "null" : typeof value}, expected a ${type}`);
  }
  return value;
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

/**
 * The coordinates of points, x, y, z each, as float64.
 * @internal
 */
export function coordinatesOf(points: unknown): Float64Array {
  const coordinates = numbers(points, "points");
  if (coordinates.length % 3 !== 0) {
    throw invalid(`points has ${coordinates.length} numbers, not a multiple of 3`);
  }
  return coordinates;
}

/** Unlike Array.isArray, this does not make everything `any`. */
function isArray(value: unknown): value is readonly unknown[] {
  return Array.isArray(value);
}

function invalid(message: string): HausdorffError {
  return new HausdorffError("ARGUMENT_INVALID", message);
}
