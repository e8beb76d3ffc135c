// The page's side of the worker.

import type { Transform, Vector3 } from "nurbs-hausdorff";
import { texts } from "../texts/index.ts";
import type {
  CheckOf,
  Placement,
  PlainCheckOptions,
  PlainDiffOptions,
  PlainFitOptions,
  PlainGapOptions,
  PlainOptions,
  PlainOverlapOptions,
  Reply,
  Request,
  Side,
  Sides,
  Source,
} from "./protocol.ts";

/** Milliseconds after which a load is not waited for when another one is requested. */
const PATIENCE = 1000;

export class Client {
  readonly #onReply: (reply: Reply) => void;
  #worker: Worker;
  #newest = 0;
  /** The first run with the current models. */
  #first = 0;
  /** The models that are loaded, which a new worker loads again. */
  #sources: Sides<Source> = {};
  /** When the load in progress began. */
  #loading: number | undefined;
  /** Whether a new worker has yet to load what the one before had. */
  #isBare = false;

  /** Starts the worker. Replies to runs with models that were replaced since are discarded. */
  constructor(onReply: (reply: Reply) => void) {
    this.#onReply = onReply;
    this.#worker = this.#start();
  }

  #start(): Worker {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), { type: "module" });
    worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#take(data);
    worker.onerror = (event) => {
      const message = event.message ?? texts.files.workerNotLoaded;
      this.#onReply({ kind: "failed", code: "UNEXPECTED", message });
    };
    return worker;
  }

  #take(reply: Reply): void {
    if (reply.kind === "loaded") {
      this.#first = this.#newest + 1;
      for (const [side, { source }] of Object.entries(reply.models)) {
        this.#sources[side as Side] = source;
      }
    }
    const failed = reply.kind === "failed" && reply.run === undefined;
    if (reply.kind === "loaded" || failed) this.#loading = undefined;
    const isBare = this.#isBare && this.#loading === undefined;
    if (isBare) this.#isBare = false;
    // The models that stay are those before, which only the worker before had.
    if (isBare && failed) this.#post({ kind: "restore", sources: this.#sources });
    if (!("run" in reply) || reply.run === undefined || reply.run >= this.#first) {
      this.#onReply(reply);
    }
  }

  /**
   * Loads one model or both; if one is invalid, none is replaced. A load that takes long already
   * is given up, as a reader cannot be interrupted: a new worker loads the others again.
   */
  load(sources: Sides<Source>, placement: Placement): void {
    const isLate = this.#loading !== undefined && performance.now() - this.#loading > PATIENCE;
    if (isLate) this.#restart();
    const all = isLate ? { ...this.#sources, ...sources } : sources;
    this.#loading = performance.now();
    this.#post({ kind: "load", sources: all, placement });
  }

  /** Gives up the load in progress, and loads the models before it again. */
  stopLoading(placement: Placement): void {
    if (this.#loading === undefined) return;
    this.#restart();
    if (Object.keys(this.#sources).length > 0) this.load(this.#sources, placement);
  }

  #restart(): void {
    this.#worker.terminate();
    this.#loading = undefined;
    this.#isBare = true;
    this.#worker = this.#start();
  }

  /** Requests a measurement, and maps of some models; it replaces the current one. */
  measure(options: PlainOptions, paint: readonly Side[]): void {
    this.#newest += 1;
    this.#post({ kind: "measure", run: this.#newest, options, paint });
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

  /** Requests what is certain of each face of the result of a run. */
  bound(run: number, options: PlainDiffOptions): void {
    this.#post({ kind: "bound", run, options });
  }

  cancelBound(): void {
    this.#post({ kind: "cancelBound" });
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

  /** Requests the least distance, and the pairs of faces nearer than `below`; replaces the current one. */
  clearance(options: PlainGapOptions): void {
    this.#post({ kind: "clearance", options });
  }

  cancelClearance(): void {
    this.#post({ kind: "cancelClearance" });
  }

  /** Requests the faces of each body of the models. */
  bodies(): void {
    this.#post({ kind: "bodies" });
  }

  /** Requests the facts of the models and of their bodies. */
  facts(): void {
    this.#post({ kind: "facts" });
  }

  /** Requests the volumes that both models have in common and apart. */
  overlap(options: PlainOverlapOptions): void {
    this.#post({ kind: "overlap", options });
  }

  cancelOverlap(): void {
    this.#post({ kind: "cancelOverlap" });
  }

  /** Requests the check of all pairs of bodies; `transform` moves A where both are one assembly. */
  check(of: CheckOf, options: PlainCheckOptions, transform?: Transform): void {
    this.#post({ kind: "check", of, options, ...(transform && { transform }) });
  }

  cancelCheck(): void {
    this.#post({ kind: "cancelCheck" });
  }

  /** Requests the distance of the point of a model that is close to this one, in the model's coordinates. */
  probe(id: number, side: Side, near: Vector3, transform: Transform, scale: number): void {
    this.#post({ kind: "probe", id, side, near, transform, scale });
  }

  /** Requests the vertices of the last maps as a table. */
  csv(): void {
    this.#post({ kind: "csv" });
  }

  #post(request: Request): void {
    this.#worker.postMessage(request);
  }
}
