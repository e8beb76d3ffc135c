/**
 * What went wrong, as a code that stays the same across releases; the
 * message, for people, may change. All but the last three are Rust's.
 *
 * - a model is invalid: `NON_FINITE` to `EMPTY_MODEL`; its JSON has another
 *   shape: `JSON_SHAPE`, or is too long: `FILE_TOO_LARGE`;
 * - an option has a value out of range: `OPTION_OUT_OF_RANGE`,
 *   `TRANSFORM_NOT_RIGID`, or another type or an unknown name: `OPTION_INVALID`;
 * - `PAIR_BUDGET_EXCEEDED`: method `hierarchy` needs more pairs of boxes than
 *   its `memoryBudget` holds; the message states how many;
 * - `ARGUMENT_INVALID`: an argument has another type than declared;
 * - `MODULE_NOT_LOADED`: used before the first `Hausdorff.create` resolved;
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
  | "JSON_SHAPE"
  | "FILE_TOO_LARGE"
  | "FILE_UNREADABLE"
  | "OPTION_OUT_OF_RANGE"
  | "OPTION_INVALID"
  | "TRANSFORM_NOT_RIGID"
  | "UNKNOWN_SHAPE"
  | "NO_ADAPTER"
  | "DEVICE_LOST"
  | "GPU_FAILED"
  | "PAIR_BUDGET_EXCEEDED"
  | "CANCELLED"
  | "ARGUMENT_INVALID"
  | "MODULE_NOT_LOADED"
  | "DISPOSED";

/** The class of all errors that the package raises on purpose. */
export class HausdorffError extends Error {
  readonly code: ErrorCode;

  constructor(code: ErrorCode, message: string, options?: ErrorOptions) {
    super(message, options);
    this.name = "HausdorffError";
    this.code = code;
  }
}

/**
 * The error for a value that the wasm module threw; other values are returned as they are.
 * @internal
 */
export function translated(thrown: unknown, cause?: unknown): unknown {
  if (typeof thrown !== "object" || thrown === null || thrown instanceof Error) return thrown;
  const { code, message } = thrown as { code?: ErrorCode; message?: string };
  if (code === undefined || message === undefined) return thrown;
  return new HausdorffError(code, message, cause === undefined ? undefined : { cause });
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
