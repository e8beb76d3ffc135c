/// <reference lib="esnext.disposable" preserve="true" />

import type { MeshFormat, MeshOptions } from "../cad/mesh.js";
import type { CadOptions } from "../cad/options.js";
import type { PeerLoader } from "../cad/peers/peers.js";
import { CREATE_OPTIONS } from "../create.js";
import { HausdorffError } from "../error.js";
import type { CreateOptions, ShapeInfo } from "../hausdorff.js";
import { checkKeys } from "../keys.js";
import type { ModuleSource } from "../load.js";
import type { CheckOptions, CheckResult } from "../measure/bodies/check.js";
import type {
  ClearanceOptions,
  ClearanceResult,
  GapOptions,
  GapsResult,
} from "../measure/bodies/clearance.js";
import type { OverlapOptions, OverlapResult } from "../measure/bodies/overlap.js";
import type { Score, ScoreOptions } from "../measure/bodies/score.js";
import { requireSignal } from "../measure/cancelled.js";
import type { DiffOptions, DiffResult } from "../measure/diff.js";
import type { DistanceEngine } from "../measure/engine.js";
import { type DistanceOptions, split } from "../measure/options.js";
import type { ClosestPointOptions, ClosestPoints } from "../measure/points/closest.js";
import type { DeviationField, FieldOptions } from "../measure/points/field.js";
import type { BestFit, BestFitOptions } from "../measure/points/fit.js";
import type { DeviationMapOptions, DeviationMaps } from "../measure/points/maps.js";
import type {
  Precision,
  SignedDistanceOptions,
  SignedDistances,
} from "../measure/points/signed-distances.js";
import type { Results } from "../measure/result.js";
import type { CertifiedStatistics, StatisticsOptions } from "../measure/statistics.js";
import type { MeshArrays } from "../model/mesh.js";
import {
  type BrepText,
  coordinatesOf,
  type InterchangeModel,
  type ModelArrays,
  type Numbers,
  type SurfaceArrays,
} from "../model/surface.js";
import { type CallOptions, Channel } from "./channel.js";
import type { Connect, MapReport, ModelFacts, ReadingReport } from "./messages.js";
import { NurbsModel } from "./model.js";
import { type PoolOptions, requirePoolOptions } from "./pool/options.js";

/** Options of `Hausdorff.create` of this entry. */
export interface WorkerCreateOptions extends CreateOptions, PoolOptions {
  /**
   * A worker that runs `nurbs-hausdorff/worker/thread`, for bundlers that do not
   * bundle workers of packages. By default the package starts its own.
   */
  worker?: Worker;
}

/** The names of the options of `create` of this entry. */
const WORKER_OPTIONS = [...CREATE_OPTIONS, "worker", "workers", "memoryBudget"];

/** Options of `Hausdorff.closestPoints` of this entry. */
export interface WorkerClosestPointOptions extends ClosestPointOptions {
  /** Whether the points' buffer is transferred, and empty afterwards, not copied; default no. */
  transfer?: boolean;
}

/**
 * Options of `Hausdorff.readCad` of this entry. The worker loads OpenCASCADE and rhino3dm
 * itself: `occt` and `rhino` are addresses of their ES modules. The file of a worker of one's
 * own can give functions to `loadLibrariesBy` instead.
 */
export interface WorkerCadOptions extends CadOptions {
  /** Whether the file's buffer is transferred, and empty afterwards, not copied; default no. */
  transfer?: boolean;
}

/** A function that receives progress, of any method. */
type OnReport = (...progress: never[]) => void;

let connect: Connect;

/**
 * Sets how workers are started on this platform.
 * @internal
 */
export function connectBy(platform: Connect): void {
  connect = platform;
}

/**
 * The class `Hausdorff` of the main entry with all work done in a worker:
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
    checkKeys("options", options, WORKER_OPTIONS);
    const { worker, module, readers, meshes, scans, workers, memoryBudget, ...rest } = options;
    const pool = requirePoolOptions({ workers, memoryBudget });
    const channel = new Channel((listener) => connect(listener, worker));
    try {
      await channel.call("create", [
        {
          ...rest,
          module: sendable(module),
          readers: sendable(readers),
          meshes: sendable(meshes),
          scans: sendable(scans),
        },
        pool,
      ]);
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

  /** The number of workers that run: more than one once a call was shared out, as `create` allows. */
  get workers(): number {
    return this.#facts.workers;
  }

  /**
   * As the main entry's `model`. Text and typed arrays are sent at once; a large
   * object of plain arrays is copied item by item on the caller's thread.
   */
  async model(
    input: readonly SurfaceArrays[] | ModelArrays | InterchangeModel | string,
  ): Promise<NurbsModel> {
    return this.#newModel("model", [input]);
  }

  /** As the main entry's `mesh`; the arrays are copied. */
  async mesh(input: MeshArrays): Promise<NurbsModel> {
    return this.#newModel("mesh", [input]);
  }

  /** As the main entry's `shape`. */
  async shape(name: string): Promise<NurbsModel> {
    return this.#newModel("shape", [name]);
  }

  /** The shapes there are, as the main entry's static `shapes`. */
  async shapes(): Promise<ShapeInfo[]> {
    const [result] = await this.#channel.call("shapes", []);
    return result as ShapeInfo[];
  }

  async readCad(
    bytes: Uint8Array | ArrayBuffer | BrepText,
    options: WorkerCadOptions = {},
  ): Promise<NurbsModel> {
    const { transfer, occt, rhino, onLibrary, onFace, signal, ...rest } = options;
    const libraries = {
      ...(occt === undefined ? {} : { occt: address("occt", occt) }),
      ...(rhino === undefined ? {} : { rhino: address("rhino", rhino) }),
    };
    const buffer = bytes instanceof Uint8Array ? bytes.buffer : bytes;
    const moved = transfer === true && buffer instanceof ArrayBuffer ? [buffer] : [];
    const reports = { onLibrary: onLibrary !== undefined, onFace: onFace !== undefined };
    const report = ({ library, face }: ReadingReport) => {
      if (library !== undefined) onLibrary?.(library);
      if (face !== undefined) onFace?.(face);
    };
    return this.#newModel("readCad", [bytes, { ...rest, ...libraries }, reports], {
      transfer: moved,
      signal,
      ...((reports.onLibrary || reports.onFace) && { onProgress: report }),
    });
  }

  async readMesh(
    bytes: Uint8Array | ArrayBuffer,
    format: MeshFormat,
    options: MeshOptions = {},
  ): Promise<NurbsModel> {
    const { signal, ...rest } = options;
    return this.#newModel("readMesh", [bytes, format, rest], { signal });
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

  async deviationMaps(
    a: NurbsModel,
    b: NurbsModel,
    options: DeviationMapOptions = {},
  ): Promise<DeviationMaps> {
    const { onCoarse, onProgress, ...rest } = options;
    const { plain, transform, signal } = split<OnReport>(rest);
    const sent = transform === undefined ? plain : { ...plain, transform };
    const report = ({ coarse, progress }: MapReport) => {
      if (coarse !== undefined) onCoarse?.(coarse);
      if (progress !== undefined) onProgress?.(...progress);
    };
    const models = [this.#id(a, "a"), this.#id(b, "b")];
    const reports = { onCoarse: onCoarse !== undefined, onProgress: onProgress !== undefined };
    const [result] = await this.#channel.call("deviationMaps", [...models, sent, reports], {
      signal,
      ...((reports.onCoarse || reports.onProgress) && { onProgress: report }),
    });
    return result as DeviationMaps;
  }

  async diff(a: NurbsModel, b: NurbsModel, options: DiffOptions = {}): Promise<DiffResult> {
    return this.#measure("diff", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async statistics(
    a: NurbsModel,
    b: NurbsModel,
    options: StatisticsOptions = {},
  ): Promise<CertifiedStatistics> {
    return this.#measure("statistics", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async score(
    candidate: NurbsModel,
    truth: NurbsModel,
    options: ScoreOptions = {},
  ): Promise<Score> {
    const models = [this.#id(candidate, "candidate"), this.#id(truth, "truth")];
    return this.#measure("score", models, options);
  }

  async clearance(
    a: NurbsModel,
    b: NurbsModel,
    options: ClearanceOptions = {},
  ): Promise<ClearanceResult> {
    return this.#measure("clearance", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async overlap(
    a: NurbsModel,
    b: NurbsModel,
    options: OverlapOptions = {},
  ): Promise<OverlapResult> {
    return this.#measure("overlap", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async check(
    models: NurbsModel | readonly NurbsModel[],
    options: CheckOptions = {},
  ): Promise<CheckResult> {
    const all = Array.isArray(models) ? models : [models];
    const ids = all.map((model, index) => this.#id(model, `models[${index}]`));
    return this.#measure("check", [ids], options);
  }

  async gaps(a: NurbsModel, b: NurbsModel, options: GapOptions = {}): Promise<GapsResult> {
    return this.#measure("gaps", [this.#id(a, "a"), this.#id(b, "b")], options);
  }

  async closestPoints(
    model: NurbsModel,
    points: Numbers,
    options: WorkerClosestPointOptions = {},
  ): Promise<ClosestPoints> {
    const id = this.#id(model, "model");
    const { transfer, ...rest } = options;
    const typed = coordinatesOf(points);
    // What was converted is nobody else's.
    const given = typed !== points || transfer === true ? [typed.buffer as ArrayBuffer] : [];
    return this.#measure("closestPoints", [id, typed], rest, given);
  }

  async signedDistances<P extends Precision = "float64">(
    model: NurbsModel,
    options: SignedDistanceOptions<P> = {},
  ): Promise<SignedDistances<P>> {
    return this.#measure("signedDistances", [this.#id(model, "model")], options);
  }

  async bestFit(a: NurbsModel, b: NurbsModel, options: BestFitOptions = {}): Promise<BestFit> {
    return this.#measure("bestFit", [this.#id(a, "a"), this.#id(b, "b")], options);
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

  /** The model that a method of the worker makes. */
  async #newModel(
    method: "model" | "mesh" | "shape" | "readCad" | "readMesh",
    args: unknown[],
    options: CallOptions = {},
  ): Promise<NurbsModel> {
    const channel = this.#channel;
    requireSignal(options.signal);
    const [facts, id] = await channel.call(method, args, { ...options, makesModel: true });
    return NurbsModel.of(channel, id, facts as ModelFacts);
  }

  async #measure<Result>(
    method: string,
    args: unknown[],
    options:
      | DistanceOptions
      | FieldOptions
      | DiffOptions
      | ClearanceOptions
      | GapOptions
      | CheckOptions
      | OverlapOptions
      | ClosestPointOptions
      | SignedDistanceOptions
      | BestFitOptions,
    transfer: ArrayBuffer[] = [],
  ): Promise<Result> {
    const { plain, transform, signal, onProgress } = split<OnReport>(options);
    const sent = transform === undefined ? plain : { ...plain, transform };
    const [result] = await this.#channel.call(method, [...args, sent], {
      signal,
      onProgress,
      transfer,
    });
    return result as Result;
  }
}

/** The address of a library as it can be sent: a function cannot. */
function address(option: string, loader: PeerLoader): string {
  if (typeof loader === "string") return loader;
  if (loader instanceof URL) return loader.href;
  const why = "no function can be sent to the worker: expected the address of the ES module";
  throw new HausdorffError("OPTION_INVALID", `${option} is ${typeof loader}: ${why}`);
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
