// The queue of measurements: one runs, and only the newest request waits.
import type {
  DistanceOptions,
  DistanceResult,
  FaceDeviations,
  Hausdorff,
  NurbsModel,
  OnProgress,
  Statistics,
} from "nurbs-hausdorff";
import { isCancelled } from "./failure.ts";
import { buffersOf, fieldDisplay } from "./field/fieldDisplay.ts";
import { withWitness } from "./field/witness.ts";
import type { EngineState, PlainOptions, Reply, Sides } from "./protocol.ts";

/**
 * Milliseconds for which a measurement continues although a newer request waits.
 * If it were cancelled at once, no measurement would finish while a slider is
 * dragged. Requests that follow each other have that time as a budget by method
 * certified, which returns the interval reached; the other methods return
 * nothing, so they are given time to finish.
 */
const GRACE = { certified: 120, others: 4000 };

/** The number of samples of a side of a surface unless the options name another. */
const DEFAULT_SAMPLES = 64;

/** More samples than these take so long that coarse ones are shown first. */
const MANY_SAMPLES = 20_000;

/** The part of the samples along each side that the coarse colours have, and their least number. */
const COARSE_FACTOR = 5;
const MIN_COARSE = 5;

interface Requested {
  /** Whether it was made while another was measured, so that more may follow. */
  hurried: boolean;
  run: number;
  options: PlainOptions;
  abort: AbortController;
}

export class Measurements {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: Reply, transfer?: Transferable[]) => void;
  readonly #fail: (error: unknown, run: number) => void;
  #models: Sides<NurbsModel> = {};
  #fields: FaceDeviations[] | undefined;
  #waiting: Requested | undefined;
  #running: Requested | undefined;

  constructor(
    engine: Hausdorff,
    reply: (reply: Reply, transfer?: Transferable[]) => void,
    fail: (error: unknown, run: number) => void,
  ) {
    this.#engine = engine;
    this.#reply = reply;
    this.#fail = fail;
  }

  /** Replaces models, and cancels the measurement of the old ones. */
  replace(models: Sides<NurbsModel>): void {
    this.cancel();
    for (const side of Object.keys(models) as (keyof typeof models)[]) {
      this.#models[side]?.dispose();
    }
    Object.assign(this.#models, models);
  }

  /** The models that are measured. */
  get models(): Sides<NurbsModel> {
    return this.#models;
  }

  /** The samples of the last measurement; undefined if it had none. */
  get fields(): FaceDeviations[] | undefined {
    return this.#fields;
  }

  request(run: number, options: PlainOptions): void {
    const hurried = this.#running !== undefined && isHurriable(options);
    this.#waiting = { hurried, run, options, abort: new AbortController() };
    if (this.#running === undefined) void this.#runAll();
  }

  /** Cancels the running measurement and the waiting one; both are replied to. */
  cancel(): void {
    this.#waiting?.abort.abort();
    this.#running?.abort.abort();
  }

  async #runAll(): Promise<void> {
    while (this.#waiting !== undefined) {
      this.#running = this.#waiting;
      this.#waiting = undefined;
      await this.#measure(this.#running);
      this.#running = undefined;
    }
  }

  async #measure(requested: Requested): Promise<void> {
    const { run, options, abort } = requested;
    const { a, b } = this.#models;
    if (a === undefined || b === undefined) return;
    this.#fields = undefined;
    // Method `iteration` has its samples at once; those of the others come after the
    // distance, of A only, which alone the page draws.
    const colours = options.deviations === true && options.method !== "iteration";
    const part = colours ? 0.5 : 1;
    try {
      const result = await this.#engine.distance(a, b, {
        ...searchOptions(options, requested.hurried),
        signal: abort.signal,
        onProgress: this.#progress(requested, graceOf(requested), { begin: 0, part }),
      });
      const again = requested.hurried && this.#waiting === undefined && isUnfinished(result);
      // The last of a row has its time.
      if (again) this.#waiting = { ...requested, hurried: false };
      const pending = again || (colours && !abort.signal.aborted);
      this.#show(requested, result, (result.forward ?? result).deviations, pending);
      if (pending && !again) await this.#colour(requested, result);
    } catch (error) {
      if (isCancelled(error)) {
        this.#reply({ kind: "cancelled", run, interval: error.interval });
      } else this.#fail(error, run);
    }
  }

  /** Samples the deviation of A, coarsely first where that shows colours much sooner. */
  async #colour(requested: Requested, result: DistanceResult): Promise<void> {
    const { a, b } = this.#models;
    const { options, abort } = requested;
    if (a === undefined || b === undefined) return;
    const { samples = DEFAULT_SAMPLES, transform, scaleUnits } = options;
    const { upper } = result.forward ?? result;
    const common = { upper, ...(transform && { transform }), ...(scaleUnits && { scaleUnits }) };
    const many = a.faceCount * samples ** 2 > MANY_SAMPLES;
    const coarse = many ? [Math.max(MIN_COARSE, Math.round(samples / COARSE_FACTOR))] : [];
    try {
      for (const count of [...coarse, samples]) {
        const fine = count === samples;
        const found = await this.#engine.field(a, b, {
          ...common,
          samples: count,
          signal: abort.signal,
          // A newer request ends the refinement of colours that are shown.
          onProgress: this.#progress(requested, fine && many ? 0 : GRACE.others, {
            begin: fine ? 0.5 : 0,
            part: fine ? 0.5 : 0,
          }),
        });
        this.#show(requested, withStatistics(result, found.statistics), found.deviations, !fine);
      }
    } catch (error) {
      if (!isCancelled(error)) throw error;
      // The result stays, without colours that are not those of the samples requested.
      this.#show(requested, result, undefined, false);
    }
  }

  /**
   * Returns the function that reports the progress of a part of a measurement, and cancels
   * it for a newer request after `grace` milliseconds.
   */
  #progress(
    { run, abort }: Requested,
    grace: number,
    { begin, part }: { begin: number; part: number },
  ): OnProgress {
    const started = performance.now();
    return (fraction, interval, stalled = false) => {
      const done = begin + part * fraction;
      this.#reply({ kind: "progress", run, fraction: done, interval, stalled });
      if (this.#waiting === undefined || performance.now() - started <= grace) return;
      abort.abort();
    };
  }

  /** Replies with a result; `pending` states that colours, or finer ones, follow. */
  #show(
    { run, options }: Requested,
    result: DistanceResult,
    fields: FaceDeviations[] | undefined,
    pending: boolean,
  ): void {
    const transform = options.transform ?? {};
    this.#fields = fields && withWitness(fields, result);
    const field = this.#fields && fieldDisplay(this.#fields, transform);
    const engine = engineState(this.#engine);
    const plain = withoutDeviations(result);
    this.#reply(
      { kind: "measured", run, result: plain, field, pending, transform, engine },
      field && buffersOf(field),
    );
  }
}

/** Returns the options of a search without samples, and within a budget of time if it is hurried. */
function searchOptions(options: PlainOptions, hurried: boolean): DistanceOptions {
  if (options.method === "iteration") return options;
  const { deviations, samples, sampling, ...rest } = options;
  if (rest.method === "hierarchy" || !hurried) return rest;
  return { ...rest, maxSeconds: GRACE.certified / 1000 };
}

/** Whether a budget of time may end the method early, with an interval. */
function isHurriable(options: PlainOptions): boolean {
  const { method } = options;
  if (method === "iteration" || method === "hierarchy") return false;
  return options.maxSeconds === undefined;
}

/** Whether a budget of time ended the search. */
const isUnfinished = (result: DistanceResult): boolean =>
  [result, result.forward, result.reverse].some(
    (part) => part?.method === "certified" && part.stop === "time",
  );

/** Returns a result with statistics of the samples of A. */
function withStatistics(result: DistanceResult, statistics?: Statistics): DistanceResult {
  if (statistics === undefined) return result;
  const { forward } = result;
  // Of the same method as before.
  if (forward === undefined) return { ...result, statistics };
  return { ...result, forward: { ...forward, statistics } } as DistanceResult;
}

function withoutDeviations<Result extends DistanceResult>(result: Result): Result {
  const { deviations, forward, reverse, ...rest } = result;
  return {
    ...rest,
    ...(forward && { forward: withoutDeviations(forward) }),
    ...(reverse && { reverse: withoutDeviations(reverse) }),
  } as Result;
}

/** The time that a measurement has beside a newer request; a budget ends a hurried one. */
const graceOf = ({ hurried, options }: Requested): number => {
  if (hurried) return Number.POSITIVE_INFINITY;
  return options.method === "certified" ? GRACE.certified : GRACE.others;
};

/** The state of the engine, which changes when it loses its device. */
export function engineState({ backend, adapter, notice }: Hausdorff): EngineState {
  return { backend, adapter, notice };
}
