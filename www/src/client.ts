// The page's end of the worker.
import type { Placement, PlainOptions, Reply, Request, Sides, Source } from "./protocol.ts";

export class Client {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  #newest = 0;
  /** The first run of the models that are shown. */
  #first = 0;

  /** `onReply` hears of no run whose models are gone. */
  constructor(onReply: (reply: Reply) => void) {
    this.#worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      if (data.kind === "loaded") this.#first = this.#newest + 1;
      if (!("run" in data) || data.run === undefined || data.run >= this.#first) onReply(data);
    };
    this.#worker.onerror = (event) => {
      const message = event.message ?? "the worker's script was not loaded";
      onReply({ kind: "failed", code: "UNEXPECTED", message });
    };
  }

  /** Loads one model or both; both are shown at once, or none if one is invalid. */
  load(sources: Sides<Source>, placement: Placement): void {
    this.#post({ kind: "load", sources, placement });
  }

  /** Replaces the measurement in work, if there is one. */
  measure(options: PlainOptions): void {
    this.#newest += 1;
    this.#post({ kind: "measure", run: this.#newest, options });
  }

  /** Whether no newer measurement was asked for. */
  isNewest(run: number): boolean {
    return run === this.#newest;
  }

  cancel(): void {
    this.#post({ kind: "cancel" });
  }

  #post(request: Request): void {
    this.#worker.postMessage(request);
  }
}
