import { nearest } from "./nearest.js";

/**
 * What went wrong, as a code that stays the same across releases; the
 * message, for people, may change. Those after `CANCELLED` are JavaScript's.
 *
 * - a model is invalid: `NON_FINITE` to `UNIT_INVALID`, or a face's trimming
 *   curves are: `TRIM_…`; its JSON has another shape: `JSON_SHAPE`, its BREP
 *   text: `BREP_…`, a STEP file `STEP_…`, or it is too long: `FILE_TOO_LARGE`;
 * - `TRANSFER_INVALID`: the wasm modules of core and readers are of two versions;
 * - `NOT_CLOSED`: a model without an inside, where signed distances are asked for;
 * - `UNITS_DIFFER`: two models state different units, and `scaleUnits` is not set;
 * - an option has a value out of range: `OPTION_OUT_OF_RANGE`,
 *   `TRANSFORM_NOT_RIGID`, or another type or an unknown name: `OPTION_INVALID`;
 * - `PAIR_BUDGET_EXCEEDED`: method `hierarchy` needs more pairs of boxes than
 *   its `memoryBudget` holds; the message states how many;
 * - a file is of a format that is not read: `FORMAT_UNSUPPORTED`, breaks its
 *   format: `CAD_UNREADABLE`, or needs a package that is not installed:
 *   `PEER_MISSING`; the messages state how to convert or to install;
 * - `ARGUMENT_INVALID`: an argument has another type than declared;
 * - `MODULE_NOT_LOADED`: used before the first `Hausdorff.create` resolved;
 * - `MODULE_FAILED`: the wasm module could not be fetched, read or compiled; the cause says why;
 * - `WORKER_FAILED`: the worker could not be started, or ended by itself;
 * - `DISPOSED`: used after `dispose()`.
 */
export type ErrorCode =
  | "NON_FINITE"
  | "NUMBER_TOO_LARGE"
  | "WEIGHT_NOT_POSITIVE"
  | "WEIGHT_RATIO_TOO_LARGE"
  | "KNOTS_DECREASING"
  | "KNOTS_LENGTH"
  | "KNOTS_MULTIPLICITY"
  | "KNOTS_EMPTY_DOMAIN"
  | "RAGGED_NET"
  | "TOO_FEW_CONTROL_POINTS"
  | "DEGREE_OUT_OF_RANGE"
  | "FACE_NOT_CUT"
  | "EMPTY_MODEL"
  | "MODEL_TRIMMED"
  | "GAP_INVALID"
  | "INSTANCE_SURFACE"
  | "INSTANCE_TRANSFORM"
  | "TOO_MANY_FACES"
  | "TRIANGLE_INDEX"
  | "NOT_CLOSED"
  | "NO_AREA"
  | "MESH_GROUPS"
  | "MESH_SYNTAX"
  | "FACETS_UNSUPPORTED"
  | "NO_FACETS"
  | "TOO_MANY_FACETS"
  | "UNIT_INVALID"
  | "UNITS_DIFFER"
  | "JSON_SHAPE"
  | "BREP_SYNTAX"
  | "STEP_SYNTAX"
  | "STEP_UNREADABLE"
  | "STEP_TRIANGLES"
  | "IGES_SYNTAX"
  | "IGES_UNREADABLE"
  | "TRANSFER_INVALID"
  | "BREP_UNREADABLE"
  | "FILE_TOO_LARGE"
  | "FILE_UNREADABLE"
  | "CAD_UNREADABLE"
  | "FORMAT_UNSUPPORTED"
  | "OPTION_OUT_OF_RANGE"
  | "OPTION_INVALID"
  | "TRANSFORM_NOT_RIGID"
  | "POINT_OUT_OF_RANGE"
  | "UNKNOWN_SHAPE"
  | "NO_ADAPTER"
  | "DEVICE_LOST"
  | "GPU_FAILED"
  | "PAIR_BUDGET_EXCEEDED"
  | "CANCELLED"
  | "TRIM_NO_LOOPS"
  | "TRIM_CURVE_INVALID"
  | "TRIM_WEIGHT_NOT_POSITIVE"
  | "TRIM_LOOP_OPEN"
  | "TRIM_OUTSIDE_DOMAIN"
  | "TRIM_LOOP_NO_AREA"
  | "TRIM_REGION_NO_AREA"
  | "TRIM_LOOPS_CROSS"
  | "TRIM_WRONG_NESTING"
  | "PEER_MISSING"
  | "ARGUMENT_INVALID"
  | "MODULE_NOT_LOADED"
  | "MODULE_FAILED"
  | "WORKER_FAILED"
  | "DISPOSED";

/** Rust's names of types in messages of the module, and JavaScript's. */
const TYPES: readonly (readonly [RegExp, string])[] = [
  [/\bexpected f(?:32|64)\b/g, "expected a number"],
  [/\bexpected u(?:size|8|16|32|64)\b/g, "expected an integer from 0"],
  [/\bexpected i(?:size|8|16|32|64)\b/g, "expected an integer"],
  [/\bunit value\b/g, "null"],
  [/JsValue\(Function.*?\)(?=, expected)/gs, "a function"],
  [/JsValue\(Object.*?\)(?=, expected)/gs, "an object"],
  [/JsValue\((.*?)\)(?=, expected)/gs, "$1"],
  [/\bexpected struct \w+/g, "expected an object"],
];

/** The end of a message on an unknown name: the name, and those that are known. */
const UNKNOWN_NAME = /unknown field `([^`]*)`, expected (?:one of )?(`.*`)/;

/** A message of the module in the words of JavaScript. */
function inJavaScript(message: string): string {
  const typed = TYPES.reduce((text, [rust, script]) => text.replace(rust, script), message);
  return typed.replace(UNKNOWN_NAME, (_, name: string, names: string) => {
    const known = [...names.matchAll(/`([^`]*)`/g)].map(([, known = ""]) => known);
    return `unknown name "${name}", ${nearest(name, known)}`;
  });
}

/** The codes of errors whose messages name types and properties of the caller's values. */
const ON_VALUES: readonly ErrorCode[] = ["OPTION_INVALID", "JSON_SHAPE"];

/** Options of the constructor of `HausdorffError`. */
export interface HausdorffErrorOptions extends ErrorOptions {
  interval?: readonly [lower: number, upper: number] | undefined;
}

/** The class of all errors that the package raises on purpose. */
export class HausdorffError extends Error {
  readonly code: ErrorCode;

  /** With `CANCELLED`: the interval that contains the distance as far as the work had come, if it had. */
  readonly interval?: readonly [lower: number, upper: number];

  constructor(code: ErrorCode, message: string, options: HausdorffErrorOptions = {}) {
    super(message, options);
    this.name = "HausdorffError";
    this.code = code;
    if (options.interval !== undefined) this.interval = options.interval;
  }
}

/**
 * The error for a value that the wasm module threw; other values are returned as they are.
 * @internal
 */
export function translated(
  thrown: unknown,
  { cause, interval }: HausdorffErrorOptions = {},
): unknown {
  if (typeof thrown !== "object" || thrown === null || thrown instanceof Error) return thrown;
  const { code, message } = thrown as { code?: ErrorCode; message?: string };
  if (code === undefined || message === undefined) return thrown;
  const text = ON_VALUES.includes(code) ? inJavaScript(message) : message;
  return new HausdorffError(code, text, {
    ...(cause === undefined ? {} : { cause }),
    ...(code === "CANCELLED" ? { interval } : {}),
  });
}

/**
 * What `run` returns, its errors translated.
 * @internal
 */
export function translating<T>(run: () => T): T {
  try {
    return run();
  } catch (thrown) {
    throw translated(thrown);
  }
}
