// The worker's replies as promises, one request at a time.
import type { DistanceResult } from "nurbs-hausdorff";
import { Client } from "../client.ts";
import type { PlainOptions, Reply, Shown, Sides, Source } from "../protocol.ts";
import type { Failure } from "./outcome.ts";

/** What a request came to. */
export type Answer<T> = { value: T } | { failure: Failure };

type Ready = Extract<Reply, { kind: "ready" }>;

export class Runs {
  readonly #client: Client;
  #answered: ((reply: Reply) => void) | undefined;

  /** `onReady` is told what computes, `onFailed` what failed unasked: the start, for one. */
  constructor(onReady: (ready: Ready) => void, onFailed: (failure: Failure) => void) {
    this.#client = new Client((reply) => {
      if (reply.kind === "ready") onReady(reply);
      else if (reply.kind === "progress") return;
      else if (this.#answered !== undefined) this.#answered(reply);
      else if (reply.kind === "failed") onFailed(reply);
    });
  }

  async load(sources: Required<Sides<Source>>): Promise<Answer<Required<Sides<Shown>>>> {
    const reply = await this.#ask(() => {
      this.#client.load(sources, { move: [0, 0, 0], turn: 0 });
    });
    if (reply.kind === "failed") return { failure: reply };
    const { a, b } = reply.kind === "loaded" ? reply.models : {};
    if (a === undefined || b === undefined) throw new Error(`${reply.kind} for two models`);
    return { value: { a, b } };
  }

  /**
   * Measures the models loaded last. After `limit` seconds `certified` gives
   * the interval so far, and the others fail with `time-limit`; `cancel` ends
   * either as well.
   */
  async measure(options: PlainOptions, limit: number): Promise<Answer<DistanceResult>> {
    const certified = options.method === "certified";
    const within = certified && limit < Number.POSITIVE_INFINITY ? { maxSeconds: limit } : {};
    let timer: ReturnType<typeof setTimeout> | undefined;
    const reply = await this.#ask(() => {
      this.#client.measure({ ...options, ...within });
      if (!certified && limit < Number.POSITIVE_INFINITY) {
        timer = setTimeout(() => this.cancel(), 1000 * limit);
      }
    });
    clearTimeout(timer);
    if (reply.kind === "measured") return { value: reply.result };
    if (reply.kind === "failed") return { failure: reply };
    const message = `took more than the ${limit} s that a run may take`;
    return { failure: { code: "time-limit", message } };
  }

  /** Ends what is being measured. */
  cancel(): void {
    this.#client.cancel();
  }

  async #ask(post: () => void): Promise<Reply> {
    const reply = await new Promise<Reply>((resolve) => {
      this.#answered = resolve;
      post();
    });
    this.#answered = undefined;
    return reply;
  }
}
