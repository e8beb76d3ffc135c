// One pair, every position, the methods in turn.
import type { DistanceResult, Transform } from "nurbs-hausdorff";
import { grouped } from "../numbers.ts";
import type { Shown, Sides } from "../protocol.ts";
import type { Entry } from "./methods.ts";
import type { Curve, Failure, Outcome } from "./outcome.ts";
import { type Pair, positions, transformAt } from "./pairs.ts";
import type { Answer, Runs } from "./runs.ts";

export interface Plan {
  pair: Pair;
  methods: readonly Entry[];
  /** Number of positions. */
  count: number;
  /** Seconds that one run may take. */
  limit: number;
}

/** Hears of a sweep as it runs. */
export interface Listener {
  /** The positions and the curves, which are empty yet and will be filled. */
  onBegin(positions: readonly number[], curves: readonly Curve[]): void;
  onRun(position: number, method: Entry): void;
  onOutcome(): void;
}

/** Projections of samples on patches beyond which a method that tries all patches is left out. */
const MANY_PROJECTIONS = 20e6;

/** A run shorter than this, in seconds, is repeated, and the shortest time told. */
const SHORT = 0.15;
const ROUNDS = 5;

export class Sweep {
  readonly #runs: Runs;
  readonly #plan: Plan;
  readonly #models: Required<Sides<Shown>>;
  #stopped = false;

  /** Of the models that were loaded last. */
  constructor(runs: Runs, plan: Plan, models: Required<Sides<Shown>>) {
    this.#runs = runs;
    this.#plan = plan;
    this.#models = models;
  }

  /** Ends the sweep; the run in work leaves no outcome. */
  stop(): void {
    this.#stopped = true;
    this.#runs.cancel();
  }

  /** Whether it came to its end. */
  async run(listener: Listener): Promise<boolean> {
    const { pair, methods, count } = this.#plan;
    const [a, b] = [this.#models.a.box, this.#models.b.box];
    const along = positions(pair, a, b, count);
    const curves = methods.map((method): Curve => ({ method, outcomes: [] }));
    listener.onBegin(along, curves);
    const patches = await this.#patches();
    for (const position of along) {
      const transform = transformAt(pair, a, b, position);
      for (const { method, outcomes } of curves) {
        if (this.#stopped) return false;
        listener.onRun(position, method);
        const leftOut = this.#unaffordable(method, patches);
        const answer = leftOut ? { failure: leftOut } : await this.#repeated(method, transform);
        if (this.#stopped) return false;
        outcomes.push(outcome(position, answer));
        listener.onOutcome();
      }
    }
    return true;
  }

  /** Patches of B as extraction gives them, which a measurement of few samples tells. */
  async #patches(): Promise<number> {
    const few = { method: "iteration", samples: 2, flatness: "none", backend: "cpu" } as const;
    const answer = await this.#runs.measure(few, Number.POSITIVE_INFINITY);
    return "value" in answer ? answer.value.patches.b : 0;
  }

  #unaffordable({ options, onAllPatches }: Entry, patches: number): Failure | undefined {
    const samples = this.#models.a.surfaceCount * (options.samples ?? 0) ** 2;
    if (!onAllPatches || samples * patches <= MANY_PROJECTIONS) return undefined;
    const found = `${grouped(samples)} samples on ${grouped(patches)} patches`;
    return { code: "left-out", message: `${found} or more: too long for a page` };
  }

  /** The result with the shortest of the times, as other work on the machine only adds. */
  async #repeated({ options }: Entry, transform: Transform): Promise<Answer<DistanceResult>> {
    const { limit } = this.#plan;
    const first = await this.#runs.measure({ ...options, transform }, limit);
    if (!("value" in first)) return first;
    const { seconds } = first.value;
    if (seconds.solve >= SHORT) return first;
    for (let round = 1; round < ROUNDS && !this.#stopped; round++) {
      const again = await this.#runs.measure({ ...options, transform }, limit);
      if ("value" in again) seconds.solve = Math.min(seconds.solve, again.value.seconds.solve);
    }
    return first;
  }
}

function outcome(position: number, answer: Answer<DistanceResult>): Outcome {
  if ("value" in answer) return { position, result: answer.value };
  return { position, failure: answer.failure };
}
