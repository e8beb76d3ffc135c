// The tasks that compare both models beside the measurement: face by face, the best fit, and
// the clearance.
import type { DiffResult, Hausdorff, NurbsModel } from "nurbs-hausdorff/worker";
import { diffByLimits, placedParts } from "./diffs.ts";
import { Latest } from "./latest.ts";
import { buffersOf, type MapDisplay } from "./map/display.ts";
import type {
  ClearanceState,
  DiffState,
  FitState,
  PlainDiffOptions,
  PlainFitOptions,
  PlainGapOptions,
  Reply,
  Sides,
} from "./protocol.ts";

/** Seconds that bounds of faces may take which nobody asked for. */
const BOUND_SECONDS = 20;

/** What is certain of each face, for the maps of a run. */
interface BoundState {
  state: "done";
  run: number;
  result: DiffResult;
}

interface Pair {
  a: NurbsModel;
  b: NurbsModel;
}

export class Comparisons {
  readonly #engine: Hausdorff;
  readonly #faces: Latest<DiffState>;
  readonly #bounds: Latest<BoundState>;
  readonly #fit: Latest<FitState>;
  readonly #clearance: Latest<ClearanceState>;

  /** `keep` keeps the maps of a run within what is certain of each face, and returns those that change. */
  constructor(
    engine: Hausdorff,
    reply: (reply: Reply, transfer?: Transferable[]) => void,
    keep: (run: number, faces: DiffResult) => Sides<MapDisplay>,
  ) {
    this.#engine = engine;
    this.#faces = new Latest((state) => reply({ kind: "diff", ...state }));
    this.#bounds = new Latest((state) => {
      if (!("run" in state)) return;
      const maps = keep(state.run, state.result);
      reply({ kind: "bound", ...state, maps }, Object.values(maps).flatMap(buffersOf));
    });
    this.#fit = new Latest((state) => reply({ kind: "fit", ...state }));
    this.#clearance = new Latest((state) => reply({ kind: "clearance", ...state }));
  }

  /** Compares the models face by face. */
  compareFaces({ a, b }: Pair, options: PlainDiffOptions): Promise<void> {
    return this.#faces.run(async (signal, report) => {
      report({ state: "working", fraction: 0 });
      const onProgress = (fraction: number) => report({ state: "working", fraction });
      const result = await diffByLimits(this.#engine, { a, b }, { ...options, signal, onProgress });
      return { state: "done", result, parts: await placedParts(result, { a, b }) };
    });
  }

  /** Bounds the deviation of each face, for a run's maps: after all that the user waits for. */
  boundFaces({ a, b }: Pair, run: number, options: PlainDiffOptions): Promise<void> {
    return this.#bounds.run(async (signal) => {
      const bounded = { ...options, maxSeconds: BOUND_SECONDS, signal };
      return { state: "done", run, result: await diffByLimits(this.#engine, { a, b }, bounded) };
    });
  }

  cancelBounds(): void {
    this.#bounds.drop();
  }

  /** Fits A to B from any pose; of equal fits the one nearest to where A is. */
  fit({ a, b }: Pair, options: PlainFitOptions): Promise<void> {
    return this.#fit.run(async (signal, report) => {
      const onProgress = (step: number, rms: number, fraction: number) =>
        report({ state: "working", step, rms, fraction });
      const fit = await this.#engine.bestFit(a, b, { ...options, signal, onProgress });
      return { state: "done", fit };
    });
  }

  /** Measures how near the models come, and which faces do. */
  clearance({ a, b }: Pair, { below, ...options }: PlainGapOptions): Promise<void> {
    return this.#clearance.run(async (signal) => {
      const clearance = await this.#engine.clearance(a, b, { ...options, signal });
      const near = Math.max(below ?? 0, clearance.tolerance);
      const gaps =
        clearance.lower <= near
          ? await this.#engine.gaps(a, b, { ...options, below: near, signal })
          : undefined;
      return { state: "done", clearance, gaps };
    });
  }

  cancelClearance(): void {
    this.#clearance.drop();
  }

  cancelFaces(): void {
    this.#faces.cancel();
  }

  cancelFit(): void {
    this.#fit.cancel();
  }

  /** Ends all tasks because their models are replaced; a fit is replied to. */
  drop(): void {
    this.#faces.drop();
    this.#bounds.drop();
    this.#clearance.drop();
    this.#fit.cancel();
  }
}
