// The queue of measurements: one runs, and only the newest request waits.
import type {
  DeviationMaps,
  DiffResult,
  DistanceOptions,
  DistanceResult,
  Hausdorff,
  NurbsModel,
  OnProgress,
} from "nurbs-hausdorff/worker";
import { isCancelled } from "./failure.ts";
import { keepWithin } from "./map/bounded.ts";
import type { MapOf } from "./map/csv.ts";
import { buffersOf, type MapDisplay, mapDisplay } from "./map/display.ts";
import { knownOf } from "./map/maps.ts";
import type { Placing } from "./map/placed.ts";
import {
  type EngineState,
  type PlainOptions,
  type Reply,
  SIDES,
  type Side,
  type Sides,
} from "./protocol.ts";

/**
 * Milliseconds for which a measurement continues although a newer request waits.
 * If it were cancelled at once, no measurement would finish while a slider is
 * dragged. Requests that follow each other have that time as a budget by method
 * certified, which returns the interval reached; the other methods return
 * nothing, so they are given time to finish.
 */
const GRACE = { certified: 120, others: 4000 };

/** The part of the progress that is the distance's where colours follow. */
const DISTANCE_PART = 0.5;

/** A request for a distance, and for the maps of some sides. */
export interface Request {
  run: number;
  options: PlainOptions;
  paint: readonly Side[];
}

interface Requested extends Request {
  /** Whether it was made while another was measured, so that more may follow. */
  hurried: boolean;
  abort: AbortController;
}

/** The maps that a run ended with. */
interface Painted {
  run: number;
  maps: readonly MapOf[];
  /** That of the result. */
  diagonal: number;
}

export class Measurements {
  readonly #engine: Hausdorff;
  readonly #reply: (reply: Reply, transfer?: Transferable[]) => void;
  readonly #fail: (error: unknown, run: number) => void;
  #models: Sides<NurbsModel> = {};
  #painted: Painted | undefined;
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

  /** The maps of the last measurement; none if it had none. */
  get painted(): readonly MapOf[] {
    return this.#painted?.maps ?? [];
  }

  /** Keeps the maps of a run within what is certain of each face; returns those that change by that, to be drawn. */
  bound(run: number, { facesOfA, facesOfB }: DiffResult): Sides<MapDisplay> {
    if (this.#painted?.run !== run) return {};
    const { maps, diagonal } = this.#painted;
    const changed = maps.filter(({ side, map }) =>
      keepWithin(map, side === "a" ? facesOfA : facesOfB),
    );
    return displayed(changed, diagonal);
  }

  request(request: Request): void {
    const hurried = this.#running !== undefined && isHurriable(request.options);
    this.#waiting = { ...request, hurried, abort: new AbortController() };
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
    const { run, options, paint, abort } = requested;
    const { a, b } = this.#models;
    // Models that are being restored are measured when they are there.
    if (a === undefined || b === undefined) {
      this.#reply({ kind: "cancelled", run, interval: undefined });
      return;
    }
    this.#painted = undefined;
    const colours = paint.length > 0;
    try {
      const part = colours ? DISTANCE_PART : 1;
      const result = await this.#engine.distance(a, b, {
        ...searchOptions(options, requested.hurried),
        signal: abort.signal,
        onProgress: this.#progress(requested, graceOf(requested), { begin: 0, part }),
      });
      const again = requested.hurried && this.#waiting === undefined && isUnfinished(result);
      // The last of a row has its time.
      if (again) this.#waiting = { ...requested, hurried: false };
      const pending = again || (colours && !abort.signal.aborted);
      this.#show(requested, result, {}, pending);
      if (pending && !again) await this.#paint(requested, result);
    } catch (error) {
      if (isCancelled(error)) {
        this.#reply({ kind: "cancelled", run, interval: error.interval });
      } else this.#fail(error, run);
    }
  }

  /** Makes the maps, and shows coarse ones first, as that shows colours much sooner. */
  async #paint(requested: Requested, result: DistanceResult): Promise<void> {
    const { options, paint, abort } = requested;
    const { a, b } = this.#models;
    if (a === undefined || b === undefined) return;
    const placing = this.#placing(options);
    const rest = { begin: DISTANCE_PART, part: 1 - DISTANCE_PART };
    let report = this.#progress(requested, GRACE.others, rest);
    let coarse: DeviationMaps | undefined;
    const { diagonal } = result;
    const show = (maps: readonly MapOf[], pending: boolean) => {
      if (!pending) this.#painted = { run: requested.run, maps, diagonal };
      this.#show(requested, result, displayed(maps, diagonal), pending);
    };
    try {
      const fine = await this.#engine.deviationMaps(a, b, {
        ...knownOf(result, paint),
        ...{ transform: placing.transform, scaleUnits: options.scaleUnits === true },
        signal: abort.signal,
        onCoarse: (maps) => {
          coarse = maps;
          show(mapsOf(maps, placing), true);
          // Finer ones wait for nobody.
          report = this.#progress(requested, 0, rest);
        },
        onProgress: (fraction) => report(fraction),
      });
      show(mapsOf(fine, placing), false);
    } catch (error) {
      if (!isCancelled(error)) throw error;
      // Of a newer request come newer colours; else the coarse ones stay, if there are any.
      if (this.#waiting !== undefined) return;
      show(coarse === undefined ? [] : mapsOf(coarse, placing), false);
    }
  }

  /** Where the models are, in a measurement with these options. */
  #placing({ transform = {}, scaleUnits }: PlainOptions): Placing {
    const [a, b] = [this.#models.a?.unit ?? null, this.#models.b?.unit ?? null];
    const scale = scaleUnits === true && a !== null && b !== null ? b / a : 1;
    return { transform, scale };
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
    maps: Sides<MapDisplay>,
    pending: boolean,
  ): void {
    const transform = options.transform ?? {};
    const engine = engineState(this.#engine);
    this.#reply(
      { kind: "measured", run, result, maps, pending, transform, engine },
      Object.values(maps).flatMap(buffersOf),
    );
  }
}

/** The maps that were made. */
const mapsOf = (maps: DeviationMaps, placing: Placing): MapOf[] =>
  SIDES.flatMap((side) => {
    const map = maps[side];
    return map === undefined ? [] : [{ side, map, placing }];
  });

/** What the page draws of the maps of a result of this diagonal. */
const displayed = (maps: readonly MapOf[], diagonal: number): Sides<MapDisplay> =>
  Object.fromEntries(
    maps.map(({ side, map, placing }) => [side, mapDisplay(map, side, placing, diagonal)]),
  );

/** Returns the options of a search, within a budget of time if it is hurried. */
function searchOptions(options: PlainOptions, hurried: boolean): DistanceOptions {
  if (options.method === "iteration" || options.method === "hierarchy" || !hurried) return options;
  return { ...options, maxSeconds: GRACE.certified / 1000 };
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

/** The time that a measurement has beside a newer request; a budget ends a hurried one. */
const graceOf = ({ hurried, options }: Requested): number => {
  if (hurried) return Number.POSITIVE_INFINITY;
  return options.method === "certified" ? GRACE.certified : GRACE.others;
};

/** The state of the engine, which changes when it loses its device. */
export function engineState({ backend, adapter, notice }: Hausdorff): EngineState {
  return { backend, adapter, notice };
}
