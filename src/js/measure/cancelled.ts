import { HausdorffError } from "../error.js";
import type { OnProgress } from "./options.js";

/** A pair of bounds that contains a distance. */
type Interval = readonly [lower: number, upper: number];

/**
 * The interval that a call has reached, by its reports.
 * @internal
 */
export class Reached {
  readonly #forward: OnProgress | undefined;
  interval: Interval | undefined;

  constructor(forward: OnProgress | undefined) {
    this.#forward = forward;
  }

  /** Takes a report of the call and passes it on. */
  readonly onProgress: OnProgress = (fraction, interval, stalled) => {
    this.interval = interval ?? this.interval;
    this.#forward?.(fraction, interval, stalled);
  };
}

/** The part of a result, or of one direction of it, that states why a search ended. */
interface Ended {
  stop?: string;
  lower: number;
  upper: number;
  forward?: Ended;
  reverse?: Ended;
}

/**
 * Returns the result, unless the signal ended its search.
 *
 * @throws {HausdorffError} `CANCELLED`, with the interval.
 * @internal
 */
export function requireWhole<Result>(result: Result, cause: unknown): Result {
  const { stop, lower, upper, forward, reverse } = result as Ended;
  if (![stop, forward?.stop, reverse?.stop].includes("cancelled")) return result;
  throw new HausdorffError("CANCELLED", "cancelled", { cause, interval: [lower, upper] });
}
