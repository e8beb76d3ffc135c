// One pair, every position, the methods in turn.
import type { DistanceResult, Transform } from "nurbs-hausdorff";
import settings from "../../../examples/experiments/sweep.json";
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
    const patches = methods.some(onAllPatches) ? await this.#patches() : { value: 0 };
    const middle = along[Math.floor(along.length / 2)];
    for (const position of along) {
      const transform = transformAt(pair, a, b, position);
      for (const { method, outcomes } of curves) {
        if (this.#stopped) return false;
        listener.onRun(position, method);
        const ruledOut = this.#ruledOut(method, patches, position === middle);
        const answer = ruledOut ? { failure: ruledOut } : await this.#repeated(method, transform);
        if (this.#stopped) return false;
        outcomes.push(outcome(position, answer));
        listener.onOutcome();
      }
    }
    return true;
  }

  /** Patches of B as extraction gives them, which a measurement of few samples tells. */
  async #patches(): Promise<Answer<number>> {
    const few = { method: "iteration", samples: 2, flatness: "none", backend: "cpu" } as const;
    const answer = await this.#runs.measure(few, Number.POSITIVE_INFINITY);
    if ("value" in answer) return { value: answer.value.patches.b };
    const { code, message } = answer.failure;
    return { failure: { code, message: `B’s patches were not counted: ${message}` } };
  }

  /**
   * Why a method that tries all patches is not run: its work is too much, but
   * once in the middle if it cuts no patches, or is not known.
   */
  #ruledOut(method: Entry, patches: Answer<number>, inTheMiddle: boolean): Failure | undefined {
    if (!onAllPatches(method)) return undefined;
    if ("failure" in patches) return patches.failure;
    const { samples = 0, flatness } = method.options;
    const all = this.#models.a.surfaceCount * samples ** 2;
    if (all * patches.value <= settings.most_projections) return undefined;
    const found = `${grouped(all)} samples on ${grouped(patches.value)} patches`;
    const code = "left-out";
    if (flatness !== "none") return { code, message: `${found} or more: too long for a sweep` };
    if (inTheMiddle) return undefined;
    return { code, message: `${found}: too long but for one run in the middle` };
  }

  /** The result with the shortest of the times, as other work on the machine only adds. */
  async #repeated({ options }: Entry, transform: Transform): Promise<Answer<DistanceResult>> {
    const { limit } = this.#plan;
    const first = await this.#runs.measure({ ...options, transform }, limit);
    if (!("value" in first)) return first;
    const { seconds } = first.value;
    for (let round = 1; round < settings.rounds && !this.#stopped; round++) {
      if (round * seconds.solve >= settings.repeated_seconds) break;
      const again = await this.#runs.measure({ ...options, transform }, limit);
      if ("value" in again) seconds.solve = Math.min(seconds.solve, again.value.seconds.solve);
    }
    return first;
  }
}

/** Whether every sample is projected on every patch, as in the 2012 paper. */
const onAllPatches = ({ options }: Entry): boolean => options.culling === "none";

function outcome(position: number, answer: Answer<DistanceResult>): Outcome {
  if ("value" in answer) return { position, result: answer.value };
  return { position, failure: answer.failure };
}
