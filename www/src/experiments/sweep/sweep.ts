// A sweep: all methods, in turn, at every position of one pair.

import type { DistanceResult, IterationOptions, Transform } from "nurbs-hausdorff";
import settings from "../../../../examples/experiments/sweep.json";
import { grouped } from "../../common/text/numbers.ts";
import { texts } from "../../texts/index.ts";
import type { DisplayModel, Plain, PlainOptions, Sides } from "../../worker/protocol.ts";
import type { Entry } from "./methods.ts";
import { type Pair, positions, transformAt } from "./pairs.ts";
import type { Answer, Runs } from "./runs.ts";
import type { Curve, Failure, SweepPoint } from "./sweepPoint.ts";

export interface Plan {
  pair: Pair;
  methods: readonly Entry[];
  /** Number of positions. */
  count: number;
  /** The time limit per run, in seconds. */
  limit: number;
}

/** The callbacks of a sweep. */
export interface Listener {
  /** Called first, with the positions and the curves, which are still empty. */
  onBegin(positions: readonly number[], curves: readonly Curve[]): void;
  /** Called before each run. */
  onRun(position: number, method: Entry): void;
  /** Called after a point was added to a curve. */
  onPoint(): void;
}

export class Sweep {
  readonly #runs: Runs;
  readonly #plan: Plan;
  readonly #models: Required<Sides<DisplayModel>>;
  #stopped = false;

  /** A sweep of the models loaded last. */
  constructor(runs: Runs, plan: Plan, models: Required<Sides<DisplayModel>>) {
    this.#runs = runs;
    this.#plan = plan;
    this.#models = models;
  }

  /** Stops the sweep; the current run adds no point. */
  stop(): void {
    this.#stopped = true;
    this.#runs.cancel();
  }

  /** Runs the sweep, and returns whether it finished without being stopped. */
  async run(listener: Listener): Promise<boolean> {
    const { pair, methods, count } = this.#plan;
    const [a, b] = [this.#models.a.box, this.#models.b.box];
    const along = positions(pair, a, b, count);
    const curves = methods.map((method): Curve => ({ method, points: [] }));
    listener.onBegin(along, curves);
    const patches = methods.some(({ options }) => isOnAllPatches(options))
      ? await this.#countPatches()
      : { value: 0 };
    const middle = along[Math.floor(along.length / 2)];
    for (const position of along) {
      const transform = transformAt(pair, a, b, position);
      for (const { method, points } of curves) {
        if (this.#stopped) return false;
        listener.onRun(position, method);
        const leftOut = this.#leftOut(method, patches, position === middle);
        const answer = leftOut
          ? { failure: leftOut }
          : await this.#measureRepeatedly(method, transform);
        if (this.#stopped) return false;
        points.push(pointOf(position, answer));
        listener.onPoint();
      }
    }
    return true;
  }

  /** Returns the number of patches of B before cutting, from a measurement with few samples. */
  async #countPatches(): Promise<Answer<number>> {
    const few = { method: "iteration", samples: 2, flatness: "none", backend: "cpu" } as const;
    const answer = await this.#runs.measure(few, Number.POSITIVE_INFINITY);
    if ("value" in answer) return { value: answer.value.patches.b };
    const { code, message } = answer.failure;
    return { failure: { code, message: texts.experiments.patchesNotCounted(message) } };
  }

  /**
   * Returns the reason why a method that projects on all patches is not run: too
   * many projections, or their number is unknown. Without flatness the method
   * is still run once, at the middle position.
   */
  #leftOut(method: Entry, patches: Answer<number>, atMiddle: boolean): Failure | undefined {
    const { options } = method;
    if (!isOnAllPatches(options)) return undefined;
    if ("failure" in patches) return patches.failure;
    const { samples = 0, flatness } = options;
    const all = this.#models.a.faceCount * samples ** 2;
    if (all * patches.value <= settings.most_projections) return undefined;
    const found = texts.experiments.samplesOnPatches(grouped(all), grouped(patches.value));
    const code = "left-out";
    if (flatness !== "none") return { code, message: texts.experiments.orMoreTooSlowFor(found) };
    if (atMiddle) return undefined;
    return { code, message: texts.experiments.tooSlowExceptAtThe(found) };
  }

  /** Returns the result with the shortest of several times: other work on the machine only adds time. */
  async #measureRepeatedly(
    { options }: Entry,
    transform: Transform,
  ): Promise<Answer<DistanceResult>> {
    const { limit } = this.#plan;
    const first = await this.#runs.measure({ ...options, transform }, limit);
    if (!("value" in first)) return first;
    const { seconds } = first.value;
    for (let round = 1; round < settings.rounds && !this.#stopped; round++) {
      if (round * seconds.solve >= settings.repeated_seconds) break;
      const repeated = await this.#runs.measure({ ...options, transform }, limit);
      if ("value" in repeated)
        seconds.solve = Math.min(seconds.solve, repeated.value.seconds.solve);
    }
    return first;
  }
}

/** Returns whether every sample is projected on every patch, as in the 2012 paper. */
const isOnAllPatches = (options: PlainOptions): options is Plain<IterationOptions> =>
  options.method === "iteration" && options.culling === "none";

function pointOf(position: number, answer: Answer<DistanceResult>): SweepPoint {
  if ("value" in answer) return { position, result: answer.value };
  return { position, failure: answer.failure };
}
