// The best fit of A to B: one runs, and a new request replaces it.
import { bestFit, type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import { codeOf, messageOf } from "./failure.ts";
import type { FitReply, PlainFitOptions, Sides } from "./protocol.ts";

export class Fitting {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: FitReply) => void;
  #abort = new AbortController();

  constructor(engine: Hausdorff, reply: (reply: FitReply) => void) {
    this.#engine = engine;
    this.#reply = reply;
  }

  /** Fits A to B from the position of the options; a fit in progress is cancelled. */
  async fit({ a, b }: Sides<NurbsModel>, options: PlainFitOptions): Promise<void> {
    this.#abort.abort();
    const abort = new AbortController();
    this.#abort = abort;
    if (a === undefined || b === undefined) return;
    const reply = (message: FitReply) => {
      if (this.#abort === abort) this.#reply(message);
    };
    try {
      const fit = await bestFit(this.#engine, a, b, {
        ...options,
        signal: abort.signal,
        onStep: (step, rms) => reply({ kind: "fit", state: "working", step, rms }),
      });
      reply({ kind: "fit", state: "done", fit });
    } catch (error) {
      const cancelled = error instanceof HausdorffError && error.code === "CANCELLED";
      reply(
        cancelled
          ? { kind: "fit", state: "cancelled" }
          : { kind: "fit", state: "failed", code: codeOf(error), message: messageOf(error) },
      );
    }
  }

  cancel(): void {
    this.#abort.abort();
  }
}
