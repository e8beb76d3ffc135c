// The page's end of the worker. Only the newest measurement counts.
import type { PlainOptions, Reply, Request, Side, Source } from "./protocol.ts";

export class Client {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  #run = 0;

  constructor(onReply: (reply: Reply) => void) {
    this.#worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      if (!("run" in data) || data.run === this.#run) onReply(data);
    };
    this.#worker.onerror = ({ message }) =>
      onReply({ kind: "failed", about: "start", code: "ERROR", message });
  }

  load(side: Side, source: Source): void {
    this.#post({ kind: "load", side, source });
  }

  /** Replaces the measurement in work, if there is one. */
  measure(options: PlainOptions): void {
    this.#run += 1;
    this.#post({ kind: "measure", run: this.#run, options });
  }

  cancel(): void {
    this.#post({ kind: "cancel" });
  }

  #post(request: Request): void {
    this.#worker.postMessage(request);
  }
}
