// The page's side of the worker.
import type { Transform, Vector3 } from "nurbs-hausdorff";
import type {
  Placement,
  PlainDiffOptions,
  PlainFitOptions,
  PlainOptions,
  Reply,
  Request,
  Side,
  Sides,
  Source,
} from "./protocol.ts";

export class Client {
  readonly #worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
  #newest = 0;
  /** The first run with the current models. */
  #first = 0;

  /** Starts the worker. Replies to runs with models that were replaced since are discarded. */
  constructor(onReply: (reply: Reply) => void) {
    this.#worker.onmessage = ({ data }: MessageEvent<Reply>) => {
      if (data.kind === "loaded") this.#first = this.#newest + 1;
      if (!("run" in data) || data.run === undefined || data.run >= this.#first) onReply(data);
    };
    this.#worker.onerror = (event) => {
      const message = event.message ?? "the worker's script could not be loaded";
      onReply({ kind: "failed", code: "UNEXPECTED", message });
    };
  }

  /** Loads one model or both; if one is invalid, none is replaced. */
  load(sources: Sides<Source>, placement: Placement): void {
    this.#post({ kind: "load", sources, placement });
  }

  /** Requests a measurement, which replaces the current one. */
  measure(options: PlainOptions): void {
    this.#newest += 1;
    this.#post({ kind: "measure", run: this.#newest, options });
  }

  /** Returns whether no newer measurement was requested. */
  isNewest(run: number): boolean {
    return run === this.#newest;
  }

  cancel(): void {
    this.#post({ kind: "cancel" });
  }

  /** Requests the comparison of the models face by face. */
  diff(options: PlainDiffOptions): void {
    this.#post({ kind: "diff", options });
  }

  cancelDiff(): void {
    this.#post({ kind: "cancelDiff" });
  }

  /** Requests the best fit of A to B. */
  fit(options: PlainFitOptions): void {
    this.#post({ kind: "fit", options });
  }

  cancelFit(): void {
    this.#post({ kind: "cancelFit" });
  }

  /** Requests the distance of the point of a model that is close to this one, in the model's coordinates. */
  probe(id: number, side: Side, near: Vector3, transform: Transform, scale: number): void {
    this.#post({ kind: "probe", id, side, near, transform, scale });
  }

  /** Requests the samples of the last measurement as a table. */
  csv(): void {
    this.#post({ kind: "csv" });
  }

  #post(request: Request): void {
    this.#worker.postMessage(request);
  }
}
