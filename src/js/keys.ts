import { type ErrorCode, HausdorffError } from "./error.js";
import { nearest } from "./nearest.js";

/**
 * Refuses properties that are not known, even undefined ones: a misspelt one would be ignored.
 *
 * @throws {HausdorffError} of this code, with the nearest known name.
 * @internal
 */
export function checkKeys(
  where: string,
  given: object,
  known: readonly string[],
  code: ErrorCode = "OPTION_INVALID",
): void {
  const unknown = Object.keys(given).find((key) => !known.includes(key));
  if (unknown === undefined) return;
  throw new HausdorffError(
    code,
    `${where}: found ${JSON.stringify(unknown)}, ${nearest(unknown, known)}`,
  );
}
