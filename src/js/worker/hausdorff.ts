/// <reference lib="esnext.disposable" preserve="true" />

import { HausdorffError } from "../error.js";
import type { CreateOptions, ShapeInfo } from "../hausdorff.js";
import type { ModuleSource } from "../load.js";
import type { ClosestPointOptions, ClosestPoints } from "../measure/closest.js";
import type { DiffOptions, DiffResult } from "../measure/diff.js";
import type { DistanceEngine } from "../measure/engine.js";
import type { DeviationField, FieldOptions } from "../measure/field.js";
import { type DistanceOptions, split } from "../measure/options.js";
import type { Results } from "../measure/result.js";
import {
  type BrepText,
  type InterchangeModel,
  type ModelArrays,
  type Numbers,
  numbers,
  type SurfaceArrays,
} from "../model/surface.js";
import { Channel } from "./channel.js";
import type { Listener, ModelFacts, Port, Reply } from "./messages.js";
import { NurbsModel } from "./model.js";

/** Options of `Hausdorff.create` of this entry. */
export interface WorkerCreateOptions extends CreateOptions {
  /**
   * A worker that runs `nurbs-hausdorff/worker/thread`, for bundlers that do not
   * bundle workers of packages. By default the package starts its own.
   */
  worker?: Worker;
}

/** Options of `Hausdorff.closestPoints` of this entry. */
export interface WorkerClosestPointOptions extends ClosestPointOptions {
  /** Whether the points' buffer is transferred, and empty afterwards, not copied; default no. */
  transfer?: boolean;
}

/** Connects to a worker: the caller's, or a new one. */
export type Connect = (listener: Listener<Reply>, worker: Worker | undefined) => Port;

let connect: Connect;
let connectsReaders = false;

/**
 * Sets how workers are started on this platform. Where a program imports both
 * entries, those with the readers of files are started, whichever was set last.
 * @internal
 */
export function connectBy(platform: Connect, { readers = false } = {}): void {
  if (connectsReaders && !readers) return;
  connect = platform;
  connectsReaders = readers;
}

/**
 * The class `Hausdorff` of the main entry, of which all work is done in a worker:
 * the caller's thread only sends and receives. Results' arrays are transferred.
 */
export class Hausdorff implements DistanceEngine<NurbsModel> {
  readonly #channel: Channel;

  private constructor(channel: Channel) {
    this.#channel = channel;
  }

  /**
   * Starts a worker, loads the module there and looks for a GPU.
   *
   * @throws {HausdorffError} `WORKER_FAILED`, and those of the main entry's `create`.
   */
  static async create(options: WorkerCreateOptions = {}): Promise<Hausdorff> {
    const { worker, module, ...rest } = options;
    const channel = new Channel((listener) => connect(listener, worker));
    try {
      await channel.call("create", [{ ...rest, module: sendable(module) }]);
    } catch (error) {
      channel.close();
      throw error;
    }
    return new Hausdorff(channel);
  }

  get backend(): "gpu" | "cpu" {
    return this.#facts.backend;
  }

  get adapter(): string | null {
    return this.#facts.adapter;
  }

  get notice(): string | null {
    return this.#facts.notice;
  }

  /**
   * As the main entry's `model`. Text and typed arrays are sent at once; a large
   * object of plain arrays is copied item by item on the caller's thread.
   */
  async model(
    input: readonly SurfaceArrays[] | ModelArrays | InterchangeModel | BrepText | string,
  ): Promise<NurbsModel> {
    return Hausdorff.newModel(this, "model", [input]);
  }

  /** As the main entry's `shape`. */
  async shape(name: string): Promise<NurbsModel> {
    return Hausdorff.newModel(this, "shape", [name]);
  }

  /** The shapes there are, as the main entry's static `shapes`. */
  async shapes(): Promise<ShapeInfo[]> {
    const [result] = await this.#channel.call("shapes", []);
    return result as ShapeInfo[];
  }

  async distance<Method extends keyof Results = "certified">(
    a: NurbsModel,
    b: NurbsModel,
    options: DistanceOptions & { method?: Method } = {},
  ): Promise<Results[Method]> {
    return this.#measure("distance", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async field(a: NurbsModel, b: NurbsModel, options: FieldOptions = {}): Promise<DeviationField> {
    return this.#measure("field", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async diff(a: NurbsModel, b: NurbsModel, options: DiffOptions = {}): Promise<DiffResult> {
    return this.#measure("diff", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async closestPoints(
    model: NurbsModel,
    points: Numbers,
    options: WorkerClosestPointOptions = {},
  ): Promise<ClosestPoints> {
    const id = this.#id(model, "model");
    const { transfer, ...rest } = options;
    const typed = points instanceof Float32Array ? points : numbers(points, "points");
    // What was converted is nobody else's.
    const given = typed !== points || transfer === true ? [typed.buffer as ArrayBuffer] : [];
    return this.#measure("closestPoints", [id, typed], rest, given);
  }

  /** Ends the worker once the calls that it has received are answered. */
  dispose(): void {
    this.#channel.close();
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  get #facts() {
    this.#channel.requireOpen();
    // The reply to `create` stated them.
    return this.#channel.engine as NonNullable<Channel["engine"]>;
  }

  #id(model: unknown, name: string): number {
    return NurbsModel.id(model, this.#channel, name);
  }

  /**
   * The model that a method of the worker makes.
   * @internal
   */
  static async newModel(
    hausdorff: Hausdorff,
    method: "model" | "shape" | "readCad",
    args: unknown[],
    transfer: ArrayBuffer[] = [],
  ): Promise<NurbsModel> {
    const channel = hausdorff.#channel;
    const [facts, id] = await channel.call(method, args, { transfer });
    return NurbsModel.of(channel, id, facts as ModelFacts);
  }

  async #measure<Result>(
    method: string,
    args: unknown[],
    options: DistanceOptions | FieldOptions | DiffOptions | ClosestPointOptions,
    transfer: ArrayBuffer[] = [],
  ): Promise<Result> {
    const { plain, transform, signal, onProgress } = split(options);
    const sent = transform === undefined ? plain : { ...plain, transform };
    const [result] = await this.#channel.call(method, [...args, sent], {
      signal,
      onProgress,
      transfer,
    });
    return result as Result;
  }
}

/** The module's source as it can be sent: addresses as absolute text. */
function sendable(module: ModuleSource | undefined): ModuleSource | undefined {
  if (module instanceof URL) return module.href;
  if (typeof module === "string") {
    return new URL(module, globalThis.document?.baseURI ?? globalThis.location?.href).href;
  }
  if (
    (typeof Response !== "undefined" && module instanceof Response) ||
    (typeof Request !== "undefined" && module instanceof Request)
  ) {
    throw new HausdorffError(
      "OPTION_INVALID",
      "module is a request or a response, expected its address, bytes or the compiled module",
    );
  }
  return module;
}
