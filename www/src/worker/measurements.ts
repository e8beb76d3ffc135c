// The queue of measurements: one runs, and only the newest request waits.
import {
  type DistanceOptions,
  type DistanceResult,
  type Field,
  type Hausdorff,
  HausdorffError,
  type NurbsModel,
  type OnProgress,
} from "nurbs-hausdorff";
import { buffersOf, fieldDisplay } from "./field/fieldDisplay.ts";
import type { EngineState, PlainOptions, Reply, Sides } from "./protocol.ts";

/**
 * Milliseconds for which a measurement continues although a newer request waits.
 * If it were cancelled at once, no measurement would finish while a slider is
 * dragged. A cancelled certified search still returns the interval reached; the
 * other methods return nothing, so they are given time to finish.
 */
const GRACE = { certified: 120, others: 4000 };

interface Requested {
  run: number;
  options: PlainOptions;
  abort: AbortController;
}

export class Measurements {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: Reply, transfer?: Transferable[]) => void;
  readonly #fail: (error: unknown, run: number) => void;
  #models: Sides<NurbsModel> = {};
  #fields: Field[] | undefined;
  #waiting: Requested | undefined;
  #running: Requested | undefined;

  constructor(
    engine: Hausdorff,
    reply: (reply: Reply, transfer?: Transferable[]) => void,
    fail: (error: unknown, run: number) => void,
  ) {
    this.#engine = engine;
    this.#reply = reply;
    this.#fail = fail;
  }

  /** Replaces models, and cancels the measurement of the old ones. */
  replace(models: Sides<NurbsModel>): void {
    this.cancel();
    for (const side of Object.keys(models) as (keyof typeof models)[]) {
      this.#models[side]?.dispose();
    }
    Object.assign(this.#models, models);
  }

  /** The models that are measured. */
  get models(): Sides<NurbsModel> {
    return this.#models;
  }

  /** The samples of the last measurement; undefined if it had none. */
  get fields(): Field[] | undefined {
    return this.#fields;
  }

  request(run: number, options: PlainOptions): void {
    this.#waiting = { run, options, abort: new AbortController() };
    if (this.#running === undefined) void this.#runAll();
  }

  /** Cancels the running measurement and the waiting one; both are replied to. */
  cancel(): void {
    this.#waiting?.abort.abort();
    this.#running?.abort.abort();
  }

  async #runAll(): Promise<void> {
    while (this.#waiting !== undefined) {
      this.#running = this.#waiting;
      this.#waiting = undefined;
      await this.#measure(this.#running);
      this.#running = undefined;
    }
  }

  /**
   * Measures the distance; only A is sampled for a field. The samples of B, which
   * the page does not draw, would take the most time where B has more faces.
   */
  async #distance(a: NurbsModel, b: NurbsModel, options: DistanceOptions): Promise<DistanceResult> {
    const sampled = options.method === "iteration";
    if (!options.symmetric || !options.field || sampled)
      return this.#engine.distance(a, b, options);
    const { onProgress } = options;
    const [symmetric, forward] = [
      await this.#engine.distance(a, b, {
        ...options,
        field: false,
        onProgress: halfOf(onProgress, 0),
      }),
      await this.#engine.distance(a, b, {
        ...options,
        symmetric: false,
        onProgress: halfOf(onProgress, 0.5),
      }),
    ];
    // Both are results of the method that the options name.
    return { ...symmetric, forward } as DistanceResult;
  }

  async #measure({ run, options, abort }: Requested): Promise<void> {
    const { a, b } = this.#models;
    if (a === undefined || b === undefined) return;
    const begin = performance.now();
    try {
      const result = await this.#distance(a, b, {
        ...options,
        signal: abort.signal,
        onProgress: (fraction, interval, stalled = false) => {
          this.#reply({ kind: "progress", run, fraction, interval, stalled });
          if (this.#waiting === undefined) return;
          if (mayCancel(options, performance.now() - begin, interval)) abort.abort();
        },
      });
      const transform = options.transform ?? {};
      this.#fields = (result.forward ?? result).field;
      const field = this.#fields && fieldDisplay(this.#fields, transform);
      const engine = engineState(this.#engine);
      const plain = withoutField(result);
      this.#reply(
        { kind: "measured", run, result: plain, field, transform, engine },
        field && buffersOf(field),
      );
    } catch (error) {
      if (error instanceof HausdorffError && error.code === "CANCELLED") {
        this.#reply({ kind: "cancelled", run });
      } else this.#fail(error, run);
    }
  }
}

/** Passes on the progress of one of two measurements as that of both. */
function halfOf(onProgress: OnProgress | undefined, begin: 0 | 0.5): OnProgress {
  return (fraction, ...rest) => onProgress?.(begin + 0.5 * fraction, ...rest);
}

function withoutField<Result extends DistanceResult>(result: Result): Result {
  const { field, forward, reverse, ...rest } = result;
  return {
    ...rest,
    ...(forward && { forward: withoutField(forward) }),
    ...(reverse && { reverse: withoutField(reverse) }),
  } as Result;
}

/** Returns whether a measurement may be cancelled for a newer one. */
function mayCancel(
  { method, field }: PlainOptions,
  milliseconds: number,
  interval: [number, number] | undefined,
): boolean {
  if (method !== "certified" || field === true) return milliseconds > GRACE.others;
  return milliseconds > GRACE.certified && interval !== undefined;
}

/** The state of the engine, which changes when it loses its device. */
export function engineState({ backend, adapter, notice }: Hausdorff): EngineState {
  return { backend, adapter, notice };
}
