// A kind of task of which one runs, and a new request replaces it.
import { codeOf, isCancelled, messageOf } from "./failure.ts";
import type { Ended } from "./protocol.ts";

/** Computes the last report, and may give others before it. */
type Task<Report> = (signal: AbortSignal, report: (report: Report) => void) => Promise<Report>;

export class Latest<Report> {
  readonly #reply: (report: Report | Ended) => void;
  #abort = new AbortController();

  constructor(reply: (report: Report | Ended) => void) {
    this.#reply = reply;
  }

  /** Runs a task, whose every end is replied to; the one in progress ends without a reply. */
  async run(task: Task<Report>): Promise<void> {
    this.drop();
    const abort = this.#abort;
    const reply = (report: Report | Ended) => {
      if (this.#abort === abort) this.#reply(report);
    };
    try {
      reply(await task(abort.signal, reply));
    } catch (error) {
      reply(
        isCancelled(error)
          ? { state: "cancelled" }
          : { state: "failed", code: codeOf(error), message: messageOf(error) },
      );
    }
  }

  /** Cancels the task in progress, which is replied to. */
  cancel(): void {
    this.#abort.abort();
  }

  /** Ends the task in progress without a reply, because its models are replaced. */
  drop(): void {
    this.#abort.abort();
    this.#abort = new AbortController();
  }
}
