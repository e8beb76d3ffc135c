import { HausdorffError } from "../error.js";
import type { OnProgress } from "./progress.js";

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
    // Steps of a fit report a number in its place.
    this.interval = Array.isArray(interval) ? interval : this.interval;
    this.#forward?.(fraction, interval, stalled);
  };
}

/** The part of a result, or of one direction of it, that states why a search ended. */
interface Ended {
  stop?: string;
  lower?: number;
  upper?: number;
  forward?: Ended;
  reverse?: Ended;
}

/**
 * Returns the result, unless the signal ended its search or has been aborted since: a call
 * whose signal is aborted before its promise is settled rejects, however near its end it was.
 *
 * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause, and with the
 * result's interval if it has one.
 * @internal
 */
export function requireWhole<Result>(result: Result, signal: AbortSignal | undefined): Result {
  const { stop, lower, upper, forward, reverse } = (result ?? {}) as Ended;
  const ended = [stop, forward?.stop, reverse?.stop].includes("cancelled");
  if (!ended && signal?.aborted !== true) return result;
  const interval: Interval | undefined =
    lower === undefined || upper === undefined ? undefined : [lower, upper];
  throw new HausdorffError("CANCELLED", "cancelled", { cause: signal?.reason, interval });
}

/**
 * Ends a call between two of its steps if its signal is aborted.
 *
 * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause; `OPTION_INVALID` for
 * what is no signal.
 * @internal
 */
export function requireGoing(signal: AbortSignal | undefined): void {
  requireSignal(signal);
  requireWhole(undefined, signal);
}

/**
 * @throws {HausdorffError} `OPTION_INVALID` for what is no signal.
 * @internal
 */
export function requireSignal(signal: AbortSignal | undefined): void {
  if (signal !== undefined && typeof signal?.aborted !== "boolean") {
    throw new HausdorffError("OPTION_INVALID", "signal is not an AbortSignal");
  }
}
