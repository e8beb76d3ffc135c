// The comparison of the two models face by face: one runs, and a new request replaces it.
import { type Hausdorff, HausdorffError, type NurbsModel } from "nurbs-hausdorff";
import { codeOf, messageOf } from "./failure.ts";
import type { DiffReply, PlainDiffOptions, Sides } from "./protocol.ts";

export class Differences {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: DiffReply) => void;
  #abort = new AbortController();

  constructor(engine: Hausdorff, reply: (reply: DiffReply) => void) {
    this.#engine = engine;
    this.#reply = reply;
  }

  /** Compares the models; a comparison in progress is cancelled and not replied to. */
  async compare({ a, b }: Sides<NurbsModel>, options: PlainDiffOptions): Promise<void> {
    this.#abort.abort();
    const abort = new AbortController();
    this.#abort = abort;
    if (a === undefined || b === undefined) return;
    const reply = (message: DiffReply) => {
      if (this.#abort === abort) this.#reply(message);
    };
    reply({ kind: "diff", state: "working", fraction: 0 });
    try {
      const result = await this.#engine.diff(a, b, {
        ...options,
        signal: abort.signal,
        onProgress: (fraction) => reply({ kind: "diff", state: "working", fraction }),
      });
      reply({ kind: "diff", state: "done", result });
    } catch (error) {
      const cancelled = error instanceof HausdorffError && error.code === "CANCELLED";
      reply(
        cancelled
          ? { kind: "diff", state: "cancelled" }
          : { kind: "diff", state: "failed", code: codeOf(error), message: messageOf(error) },
      );
    }
  }

  /** Ends the comparison in progress without a reply, because its models are replaced. */
  drop(): void {
    this.#abort.abort();
    this.#abort = new AbortController();
  }

  /** Cancels the comparison in progress, which is replied to. */
  cancel(): void {
    this.#abort.abort();
  }
}
