// A kind of task whose newest request replaces the one in progress.
import { Latest as Newest } from "nurbs-hausdorff/worker";
import { codeOf, isCancelled, messageOf } from "./failure.ts";
import type { Ended } from "./protocol.ts";

/** Computes the last report, and may give others before it. */
type Task<Report> = (signal: AbortSignal, report: (report: Report) => void) => Promise<Report>;

export class Latest<Report> {
  readonly #reply: (report: Report | Ended) => void;
  readonly #newest = new Newest();

  constructor(reply: (report: Report | Ended) => void) {
    this.#reply = reply;
  }

  /** Runs a task, whose every end is replied to; the one in progress ends without a reply. */
  async run(task: Task<Report>): Promise<void> {
    let last: Report | Ended | undefined;
    try {
      last = await this.#newest.run((signal) =>
        task(signal, (report) => {
          if (!signal.aborted) this.#reply(report);
        }),
      );
    } catch (error) {
      last = isCancelled(error)
        ? { state: "cancelled" }
        : { state: "failed", code: codeOf(error), message: messageOf(error) };
    }
    if (last !== undefined) this.#reply(last);
  }

  /** Cancels the task in progress, which is replied to. */
  cancel(): void {
    this.#newest.cancel();
  }

  /** Ends the task in progress without a reply, because its models are replaced. */
  drop(): void {
    this.#newest.drop();
  }
}
