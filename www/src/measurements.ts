// One measurement at a time, and of those asked for meanwhile only the newest.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import type { PlainOptions, Reply, Sides } from "./protocol.ts";

/**
 * Milliseconds that a measurement is left to run although a newer one waits.
 * Ended at once, none would come to an end while a slider is dragged. Method
 * `certified` then tells the interval so far; `iteration` tells nothing, so it
 * has time to finish.
 */
const GRACE = { certified: 120, iteration: 1000 };

interface Asked {
  run: number;
  options: PlainOptions;
}

export class Measurements {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: Reply) => void;
  readonly #fail: (error: unknown, run: number) => void;
  #models: Sides<NurbsModel> = {};
  #waiting: Asked | undefined;
  #running: { abort: AbortController; until: number } | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;

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
    this.#waiting = { run, options };
    const running = this.#running;
    if (running === undefined) void this.#runAll();
    else {
      this.#timer ??= setTimeout(
        () => running.abort.abort(),
        Math.max(0, running.until - performance.now()),
      );
    }
  }

  cancel(): void {
    this.#waiting = undefined;
    this.#running?.abort.abort();
  }

  async #runAll(): Promise<void> {
    while (this.#waiting !== undefined) {
      const { run, options } = this.#waiting;
      this.#waiting = undefined;
      const abort = new AbortController();
      const grace = GRACE[options.method ?? "certified"];
      this.#running = { abort, until: performance.now() + grace };
      await this.#measure(run, options, abort.signal);
      clearTimeout(this.#timer);
      this.#timer = undefined;
      this.#running = undefined;
    }
  }

  async #measure(run: number, options: PlainOptions, signal: AbortSignal): Promise<void> {
    const { a, b } = this.#models;
    if (a === undefined || b === undefined) return;
    try {
      const result = await this.#engine.distance(a, b, {
        ...options,
        signal,
        onProgress: (fraction, interval) =>
          this.#reply({ kind: "progress", run, fraction, interval }),
      });
      this.#reply({ kind: "measured", run, result });
    } catch (error) {
      if (error instanceof HausdorffError && error.code === "CANCELLED") {
        this.#reply({ kind: "cancelled", run });
      } else this.#fail(error, run);
    }
  }
}
