// One measurement at a time, and of those asked for meanwhile only the newest.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import type { PlainOptions, Reply, Sides } from "./protocol.ts";

/**
 * Milliseconds that a measurement is left to run although a newer one waits.
 * Ended at once, none would come to an end while a slider is dragged. A
 * certificate that is ended tells the interval so far; samples tell nothing,
 * so they have time to finish.
 */
const GRACE = { certificate: 120, samples: 4000 };

interface Asked {
  run: number;
  options: PlainOptions;
  abort: AbortController;
}

export class Measurements {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: Reply) => void;
  readonly #fail: (error: unknown, run: number) => void;
  #models: Sides<NurbsModel> = {};
  #waiting: Asked | undefined;
  #running: Asked | undefined;

  constructor(
    engine: Hausdorff,
    reply: (reply: Reply) => void,
    fail: (error: unknown, run: number) => void,
  ) {
    this.#engine = engine;
    this.#reply = reply;
    this.#fail = fail;
  }

  /** Takes new models; the old ones' measurement ends. */
  replace(models: Sides<NurbsModel>): void {
    this.cancel();
    for (const side of Object.keys(models) as (keyof typeof models)[]) {
      this.#models[side]?.dispose();
    }
    Object.assign(this.#models, models);
  }

  ask(run: number, options: PlainOptions): void {
    this.#waiting = { run, options, abort: new AbortController() };
    if (this.#running === undefined) void this.#runAll();
  }

  /** Ends the measurement in work and the waiting one, which is told as well. */
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

  async #measure({ run, options, abort }: Asked): Promise<void> {
    const { a, b } = this.#models;
    if (a === undefined || b === undefined) return;
    const begin = performance.now();
    try {
      const result = await this.#engine.distance(a, b, {
        ...options,
        signal: abort.signal,
        onProgress: (fraction, interval) => {
          this.#reply({ kind: "progress", run, fraction, interval });
          if (this.#waiting === undefined) return;
          if (mayEnd(options, performance.now() - begin, interval)) abort.abort();
        },
      });
      this.#reply({ kind: "measured", run, result, transform: options.transform ?? {} });
    } catch (error) {
      if (error instanceof HausdorffError && error.code === "CANCELLED") {
        this.#reply({ kind: "cancelled", run });
      } else this.#fail(error, run);
    }
  }
}

/** Whether there is something to tell of a measurement, or it took too long for that. */
function mayEnd(
  { method, field }: PlainOptions,
  milliseconds: number,
  interval: [number, number] | undefined,
): boolean {
  if (method !== "certified" || field === true) return milliseconds > GRACE.samples;
  return milliseconds > GRACE.certificate && interval !== undefined;
}
