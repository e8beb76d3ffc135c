import { HausdorffError } from "../../error.js";
import { requireGoing } from "../../measure/cancelled.js";

/** Work that is shared out in blocks. */
export interface Shared<Block, Part, Found> {
  /** Returns the next block; undefined if all were taken. */
  take(): Block | undefined;
  /** Keeps what was found of a block. */
  put(block: Block, part: Part): void;
  /** The fraction that was measured. */
  readonly fraction: number;
  /** What was found, once that is 1. */
  readonly found: Found;
}

/** Measures a block. */
export type Measure<Block, Part> = (block: Block, signal: AbortSignal) => Promise<Part>;

/** What a call passes on. */
export interface WorkOptions {
  signal: AbortSignal;
  /** Called after every block with the fraction that was measured, rising to 1. */
  onProgress?: ((fraction: number) => void) | undefined;
}

/**
 * Measures all blocks, each by the first of some that has nothing to do. One that is not ready yet is not waited
 * for once the others have measured all; one that is undefined measures none.
 *
 * An error of one, or an aborted signal, ends the work of all: the promise rejects once, with it, when the blocks that
 * were begun have ended.
 *
 * @throws {HausdorffError} `CANCELLED`.
 * @internal
 */
export function measureBlocks<Block, Part, Found>(
  shared: Shared<Block, Part, Found>,
  measures: readonly Promise<Measure<Block, Part> | undefined>[],
  { signal, onProgress }: WorkOptions,
): Promise<Found> {
  requireGoing(signal);
  const ending = new AbortController();
  let running = 0;
  let failure: { thrown: unknown } | undefined;
  return new Promise<Found>((resolve, reject) => {
    const settle = () => {
      if (failure !== undefined) {
        if (running === 0) reject(failure.thrown);
      } else if (shared.fraction === 1) resolve(shared.found);
    };
    const fail = (thrown: unknown) => {
      failure ??= { thrown };
      ending.abort();
      settle();
    };
    signal.addEventListener("abort", () => fail(cancelled(signal)), { signal: ending.signal });
    const measureSome = async (ready: Promise<Measure<Block, Part> | undefined>) => {
      const measure = await ready;
      while (measure !== undefined) {
        const block = failure === undefined ? shared.take() : undefined;
        if (block === undefined) return;
        running += 1;
        try {
          shared.put(block, await measure(block, ending.signal));
        } finally {
          running -= 1;
        }
        if (failure === undefined) onProgress?.(shared.fraction);
        settle();
      }
    };
    for (const ready of measures) void measureSome(ready).catch(fail);
    settle();
  }).finally(() => ending.abort());
}

const cancelled = ({ reason }: AbortSignal) =>
  new HausdorffError("CANCELLED", "cancelled", { cause: reason });
