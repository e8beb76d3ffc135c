import { HausdorffError } from "../../error.js";
import type { Hausdorff } from "../../hausdorff.js";
import type { ClosestPointOptions, ClosestPoints } from "../../measure/points/closest.js";
import type {
  LayerDistances,
  SignedDistanceOptions,
  SignedDistances,
} from "../../measure/points/signed-distances.js";
import { memoryBytes } from "../../wasm/nurbs_hausdorff.js";
import type { Connect } from "../messages.js";
import { Helper } from "./helper.js";
import { Layers } from "./layers.js";
import type { PoolLimits } from "./options.js";
import { type PointBlock, PointBlocks } from "./points.js";
import type { Target } from "./target.js";
import { type Measure, measureBlocks, type Shared, type WorkOptions } from "./work.js";
import { Worth } from "./worth.js";

/** The blocks that a worker has at a time: one that it measures, and one that waits, as the first worker answers late. */
const BLOCKS_AHEAD = 2;

/** A block without points. */
const NO_POINTS: PointBlock = { indices: new Uint32Array(), points: new Float64Array() };

/** A block measured by this worker, and by another one. */
interface Measures<Block, Part> {
  here: Measure<Block, Part>;
  there(helper: Helper, block: Block, signal: AbortSignal): Promise<Part>;
}

/**
 * The workers that measure points beside this one, which shares the points out.
 *
 * Guarantee: results are those of this worker alone, bit for bit.
 * @internal
 */
export class Pool {
  readonly #hausdorff: Hausdorff;
  readonly #connect: Connect;
  readonly #limits: PoolLimits;
  /** The other workers by their places. */
  readonly #helpers = new Map<number, Helper>();

  constructor(hausdorff: Hausdorff, connect: Connect, limits: PoolLimits) {
    this.#hausdorff = hausdorff;
    this.#connect = connect;
    this.#limits = limits;
  }

  /** The number of workers that run, with this one. */
  get workers(): number {
    return 1 + this.#helpers.size;
  }

  /** Returns the closest points of a model; to be called in turn. */
  async closestPoints(
    target: Target,
    points: Float64Array,
    options: ClosestPointOptions,
    work: WorkOptions,
  ): Promise<ClosestPoints> {
    const blocks = new PointBlocks(points);
    const measures: Measures<PointBlock, ClosestPoints> = {
      here: ({ points }, signal) =>
        this.#hausdorff.closestPointsOfBlock(target.model, points, { ...options, signal }),
      there: (helper, { points }, signal) => {
        const args = [points, options];
        return helper.call("closestPointsOfBlock", target, args, signal, [points.buffer]);
      },
    };
    if (points.length === 0) return measures.here(NO_POINTS, work.signal);
    return this.#measured(blocks, measures, { target, ...work });
  }

  /** Returns the signed distances of a model on a grid; to be called in turn. */
  async signedDistances(
    target: Target,
    options: SignedDistanceOptions,
    work: WorkOptions,
  ): Promise<SignedDistances> {
    const layers = new Layers(this.#hausdorff.layersOfGrid(target.model, options));
    const measures: Measures<number, LayerDistances> = {
      here: (layer, signal) =>
        this.#hausdorff.signedDistancesOfLayer(target.model, layer, { ...options, signal }),
      there: (helper, layer, signal) =>
        helper.call("signedDistancesOfLayer", target, [layer, options], signal),
    };
    return this.#measured(layers, measures, { target, ...work });
  }

  /** Frees the other workers' copies of a model; to be called in turn. */
  drop(id: number): void {
    for (const helper of this.#helpers.values()) helper.drop(id);
  }

  /** Measures blocks here, and by the other workers as soon as they have the model, if that is worth it. */
  #measured<Block, Part, Found>(
    shared: Shared<Block, Part, Found>,
    { here, there }: Measures<Block, Part>,
    { target, signal, onProgress }: WorkOptions & { target: Target },
  ): Promise<Found> {
    const worth = new Worth(target.milliseconds);
    const byHelper = async (place: number): Promise<Measure<Block, Part> | undefined> => {
      if (!this.#helpers.get(place)?.has(target)) await worth.known;
      const helper = this.#helpers.get(place) ?? new Helper(this.#connect);
      this.#helpers.set(place, helper);
      if (!(await this.#kept(place, helper.receive(target)))) return undefined;
      return (block, signal) => this.#kept(place, there(helper, block, signal));
    };
    const ready = Array.from({ length: this.#most() }, (_, place) => byHelper(place));
    const ahead = Array.from({ length: BLOCKS_AHEAD }, () => ready).flat();
    return measureBlocks(shared, [Promise.resolve(here), ...ahead], {
      signal,
      onProgress: (fraction) => {
        worth.report(fraction);
        onProgress?.(fraction);
      },
    });
  }

  /** Returns the most workers beside this one, and ends those that memory forbids. */
  #most(): number {
    const copies = Math.floor(this.#limits.memory / memoryBytes());
    const most = Math.max(0, Math.min(this.#limits.workers, copies) - 1);
    for (const place of this.#helpers.keys()) if (place >= most) this.#end(place);
    return most;
  }

  /**
   * Returns the result of some work of a worker. One that fails, or whose module does, is ended; a later call starts
   * another one.
   */
  async #kept<Result>(place: number, work: Promise<Result>): Promise<Result> {
    try {
      return await work;
    } catch (error) {
      const isCoded = error instanceof HausdorffError;
      if (!isCoded || error.code === "WORKER_FAILED") this.#end(place);
      throw error;
    }
  }

  #end(place: number): void {
    this.#helpers.get(place)?.close();
    this.#helpers.delete(place);
  }
}
