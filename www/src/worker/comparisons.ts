// The tasks that compare both models beside the measurement: face by face, and the best fit.
import type { Hausdorff, NurbsModel } from "nurbs-hausdorff";
import { Latest } from "./latest.ts";
import type { DiffState, FitState, PlainDiffOptions, PlainFitOptions, Reply } from "./protocol.ts";

interface Pair {
  a: NurbsModel;
  b: NurbsModel;
}

export class Comparisons {
  readonly #engine: Hausdorff;
  readonly #faces: Latest<DiffState>;
  readonly #fit: Latest<FitState>;

  constructor(engine: Hausdorff, reply: (reply: Reply) => void) {
    this.#engine = engine;
    this.#faces = new Latest((state) => reply({ kind: "diff", ...state }));
    this.#fit = new Latest((state) => reply({ kind: "fit", ...state }));
  }

  /** Compares the models face by face. */
  compareFaces({ a, b }: Pair, options: PlainDiffOptions): Promise<void> {
    return this.#faces.run(async (signal, report) => {
      report({ state: "working", fraction: 0 });
      const onProgress = (fraction: number) => report({ state: "working", fraction });
      const result = await this.#engine.diff(a, b, { ...options, signal, onProgress });
      return { state: "done", result };
    });
  }

  /** Fits A to B from the position of the options. */
  fit({ a, b }: Pair, options: PlainFitOptions): Promise<void> {
    return this.#fit.run(async (signal, report) => {
      const onProgress = (step: number, rms: number) => report({ state: "working", step, rms });
      const fit = await this.#engine.bestFit(a, b, { ...options, signal, onProgress });
      return { state: "done", fit };
    });
  }

  cancelFaces(): void {
    this.#faces.cancel();
  }

  cancelFit(): void {
    this.#fit.cancel();
  }

  /** Ends both tasks because their models are replaced; a fit is replied to. */
  drop(): void {
    this.#faces.drop();
    this.#fit.cancel();
  }
}
