// Promises for the worker's replies, one request at a time.

import type { DistanceResult } from "nurbs-hausdorff";
import { texts } from "../../texts/index.ts";
import { Client } from "../../worker/client.ts";
import type { DisplayModel, PlainOptions, Reply, Sides, Source } from "../../worker/protocol.ts";
import type { Failure } from "./sweepPoint.ts";

/** The result or failure of a request. */
export type Answer<T> = { value: T } | { failure: Failure };

type Ready = Extract<Reply, { kind: "ready" }>;

/** Replies that end a request; others tell what is new meanwhile. */
const ENDS: readonly Reply["kind"][] = ["loaded", "measured", "cancelled", "failed"];

export class Runs {
  readonly #client: Client;
  #resolve: ((reply: Reply) => void) | undefined;

  /** Calls `onReady` once the engine has started, and `onFailed` for failures outside any request. */
  constructor(onReady: (ready: Ready) => void, onFailed: (failure: Failure) => void) {
    this.#client = new Client((reply) => {
      if (reply.kind === "ready") onReady(reply);
      else if (!ENDS.includes(reply.kind)) return;
      else if (this.#resolve !== undefined) this.#resolve(reply);
      else if (reply.kind === "failed") onFailed(reply);
    });
  }

  /** Loads both models. */
  async load(sources: Required<Sides<Source>>): Promise<Answer<Required<Sides<DisplayModel>>>> {
    const reply = await this.#request(() => {
      this.#client.load(sources, { move: [0, 0, 0], turn: 0 });
    });
    if (reply.kind === "failed") return { failure: reply };
    const { a, b } = reply.kind === "loaded" ? reply.models : {};
    if (a === undefined || b === undefined)
      throw new Error(texts.experiments.forTwoModels(reply.kind));
    return { value: { a, b } };
  }

  /**
   * Measures the models loaded last. After `limit` seconds `certified` returns
   * the interval so far, and the other methods fail with `time-limit`; `cancel`
   * has the same effect.
   */
  async measure(options: PlainOptions, limit: number): Promise<Answer<DistanceResult>> {
    const certified = options.method === "certified";
    const timeLimit = certified && limit < Number.POSITIVE_INFINITY ? { maxSeconds: limit } : {};
    let timer: ReturnType<typeof setTimeout> | undefined;
    const reply = await this.#request(() => {
      this.#client.measure({ ...options, ...timeLimit }, []);
      if (!certified && limit < Number.POSITIVE_INFINITY) {
        timer = setTimeout(() => this.cancel(), 1000 * limit);
      }
    });
    clearTimeout(timer);
    if (reply.kind === "measured") return { value: reply.result };
    if (reply.kind === "failed") return { failure: reply };
    const message = texts.experiments.exceededTheTimeLimitOf(limit);
    return { failure: { code: "time-limit", message } };
  }

  /** Cancels the current measurement. */
  cancel(): void {
    this.#client.cancel();
  }

  async #request(post: () => void): Promise<Reply> {
    const reply = await new Promise<Reply>((resolve) => {
      this.#resolve = resolve;
      post();
    });
    this.#resolve = undefined;
    return reply;
  }
}
