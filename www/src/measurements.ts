// One measurement at a time, and of those asked for meanwhile only the newest.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import type { PlainOptions, Reply, Sides } from "./protocol.ts";

/**
 * Milliseconds that a measurement is left to run although a newer one waits.
 * Ended at once, none would come to an end while a slider is dragged. A
 * certificate that is ended tells the interval so far; samples tell nothing,
 * so they have time to finish.
 */
const GRACE = { certificate: 120, samples: 1000 };

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
  #running: (Asked & { until: number }) | undefined;
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
    this.#waiting = { run, options, abort: new AbortController() };
    const running = this.#running;
    if (running === undefined) void this.#runAll();
    else {
      this.#timer ??= setTimeout(
        () => running.abort.abort(),
        Math.max(0, running.until - performance.now()),
      );
    }
  }

  /** Ends the measurement in work and the waiting one, which is told as well. */
  cancel(): void {
    this.#waiting?.abort.abort();
    this.#running?.abort.abort();
  }

  async #runAll(): Promise<void> {
    while (this.#waiting !== undefined) {
      const asked = this.#waiting;
      this.#waiting = undefined;
      const grace = sampled(asked.options) ? GRACE.samples : GRACE.certificate;
      this.#running = { ...asked, until: performance.now() + grace };
      await this.#measure(asked);
      clearTimeout(this.#timer);
      this.#timer = undefined;
      this.#running = undefined;
    }
  }

  async #measure({ run, options, abort }: Asked): Promise<void> {
    const { a, b } = this.#models;
    if (a === undefined || b === undefined) return;
    try {
      const result = await this.#engine.distance(a, b, {
        ...options,
        signal: abort.signal,
        onProgress: (fraction, interval) =>
          this.#reply({ kind: "progress", run, fraction, interval }),
      });
      this.#reply({ kind: "measured", run, result, transform: options.transform ?? {} });
    } catch (error) {
      if (error instanceof HausdorffError && error.code === "CANCELLED") {
        this.#reply({ kind: "cancelled", run });
      } else this.#fail(error, run);
    }
  }
}

/** Whether there is no result before all samples are done. */
const sampled = ({ method, field }: PlainOptions): boolean =>
  method === "iteration" || field === true;
