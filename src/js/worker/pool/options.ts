import { HausdorffError } from "../../error.js";

/** Options of `Hausdorff.create` of `nurbs-hausdorff/worker` on workers beside the first. */
export interface PoolOptions {
  /**
   * The most workers, 1 to 64, that measure many points at a time: calls of `closestPoints`, `signedDistances` and
   * `deviationMaps`. `"auto"` is one for each processor, at most 8. Default 1. Results do not depend on it. A worker is
   * started, and is sent a model, when what is left of a call would take longer than the model took to be made.
   */
  workers?: number | "auto";
  /**
   * MiB that the modules of all workers may have together; default 2048. Each has a copy of the models: where that
   * many copies of the first worker's memory would exceed it, fewer workers are used.
   */
  memoryBudget?: number;
}

/** The most workers: beyond the processors of nearly all machines, so that a mistaken number starts no thousands. */
const MAX_WORKERS = 64;

/**
 * The most workers of `"auto"`. Each has a copy of the models, and the first one gives out and takes back all blocks
 * beside its own work.
 */
const MAX_AUTO = 8;

/** Half of what one module of WebAssembly may have: several copies of a model never take what a larger one would. */
const DEFAULT_MEMORY_BUDGET = 2048;

const MIB = 2 ** 20;

/** How many workers there may be. */
export interface PoolLimits {
  workers: number;
  /** Bytes that the modules of all workers may have. */
  memory: number;
}

/**
 * Returns the options as they are sent.
 *
 * @throws {HausdorffError} `OPTION_OUT_OF_RANGE` for a number beyond its range, `OPTION_INVALID` for another type.
 * @internal
 */
export function requirePoolOptions({
  workers = 1,
  memoryBudget,
}: { [Name in keyof PoolOptions]: PoolOptions[Name] | undefined }): PoolOptions {
  if (workers !== "auto") {
    requireNumber("workers", workers, `a number of workers or "auto"`);
    if (!Number.isInteger(workers) || workers < 1 || workers > MAX_WORKERS) {
      throw outOfRange("workers", workers, `an integer from 1 to ${MAX_WORKERS}, or "auto"`);
    }
  }
  if (memoryBudget === undefined) return { workers };
  requireNumber("memoryBudget", memoryBudget, "a number of MiB");
  if (!(memoryBudget > 0)) throw outOfRange("memoryBudget", memoryBudget, "a positive number");
  return { workers, memoryBudget };
}

/**
 * Returns the limits that the options state, on a machine with this many processors.
 * @internal
 */
export function limitsOf(
  { workers = 1, memoryBudget = DEFAULT_MEMORY_BUDGET }: PoolOptions,
  processors: number,
): PoolLimits {
  const most = workers === "auto" ? Math.min(processors, MAX_AUTO) : workers;
  return { workers: most, memory: memoryBudget * MIB };
}

function requireNumber(name: string, value: unknown, expected: string): void {
  if (typeof value === "number") return;
  const found = typeof value === "string" ? JSON.stringify(value) : typeof value;
  throw new HausdorffError("OPTION_INVALID", `${name} is ${found}, expected ${expected}`);
}

function outOfRange(name: string, value: number, expected: string): HausdorffError {
  return new HausdorffError("OPTION_OUT_OF_RANGE", `${name} is ${value}, expected ${expected}`);
}
