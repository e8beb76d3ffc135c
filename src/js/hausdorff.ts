/// <reference lib="esnext.disposable" preserve="true" />

import { HausdorffError, translated, translating } from "./error.js";
import { load, type ModuleSource, requireLoaded } from "./load.js";
import type { ClosestPointOptions, ClosestPoints } from "./measure/closest.js";
import type { DiffOptions, DiffResult } from "./measure/diff.js";
import {
  type Backend,
  type DistanceOptions,
  type OnProgress,
  split,
  type Transform,
} from "./measure/options.js";
import type {
  CertifiedResult,
  DistanceResult,
  HierarchyResult,
  IterationResult,
} from "./measure/result.js";
import { fromBrepText, isBrepText } from "./model/brep-text.js";
import { NurbsModel } from "./model/model.js";
import {
  type BrepText,
  type InterchangeModel,
  type ModelArrays,
  type Numbers,
  numbers,
  prepare,
  type SurfaceArrays,
} from "./model/surface.js";
import { Engine, PreparedModel, shapes } from "./wasm/nurbs_hausdorff.js";

/** Options of `Hausdorff.create`. */
export interface CreateOptions {
  /** Default `auto`. */
  backend?: Backend;
  /**
   * The wasm module, `nurbs-hausdorff/nurbs_hausdorff_bg.wasm`, where the package
   * does not find it beside its own files: compiled, its bytes or its address.
   */
  module?: ModuleSource;
}

/** A shape that the package makes. */
export interface ShapeInfo {
  /** What `Hausdorff.shape` takes. */
  name: string;
  /** A title for people. */
  title: string;
}

/**
 * Measures Hausdorff distances on one GPU device, or on the CPU. Models are
 * not tied to the one that made them.
 */
export class Hausdorff {
  #engine: Engine | undefined;
  // Settled when no distance is being computed.
  #turn: Promise<unknown> = Promise.resolve();

  private constructor(engine: Engine) {
    this.#engine = engine;
  }

  /**
   * Loads the module, once, and looks for a GPU.
   *
   * @throws {HausdorffError} `NO_ADAPTER` if `backend` is `gpu` and there is
   * none; `OPTION_INVALID`; `MODULE_FAILED`, with its cause.
   */
  static async create({ backend, module }: CreateOptions = {}): Promise<Hausdorff> {
    await load(module);
    try {
      return new Hausdorff(await Engine.create(backend));
    } catch (thrown) {
      throw translated(thrown);
    }
  }

  /** Where distances are computed unless their options say otherwise. */
  get backend(): "gpu" | "cpu" {
    return this.#open().hasGpu ? "gpu" : "cpu";
  }

  /** The GPU's name, if there is a GPU and the platform reports it. */
  get adapter(): string | null {
    return this.#open().adapter ?? null;
  }

  /** The reason why there is no GPU, if one was looked for. */
  get notice(): string | null {
    return this.#open().notice ?? null;
  }

  /**
   * A model of surfaces as plain arrays, whole or trimmed, of interchange JSON or its
   * text, or of OpenCASCADE's BREP text.
   *
   * @throws {HausdorffError} naming the surface, the place, what was found and
   * what was expected.
   */
  model(
    input: readonly SurfaceArrays[] | ModelArrays | InterchangeModel | BrepText | string,
  ): NurbsModel {
    this.#open();
    if (isBrepText(input)) return fromBrepText(input);
    return translating(() => NurbsModel.of(prepare(input)));
  }

  /**
   * A shape by its name, one of `Hausdorff.shapes`.
   *
   * @throws {HausdorffError} `UNKNOWN_SHAPE`.
   */
  shape(name: string): NurbsModel {
    this.#open();
    return translating(() => NurbsModel.of(PreparedModel.shape(`${name}`)));
  }

  /**
   * The shapes there are.
   *
   * @throws {HausdorffError} `MODULE_NOT_LOADED` before the first `create` resolved.
   */
  static shapes(): ShapeInfo[] {
    requireLoaded();
    return shapes() as ShapeInfo[];
  }

  /**
   * The directed distance from `a`, moved by `transform`, to `b`: the largest
   * distance from a point of `a` to `b`. With `symmetric`, the larger of both
   * directions. Distances requested at once are computed in turn.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its
   * cause; `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`;
   * `UNITS_DIFFER`, unless `scaleUnits` is set;
   * `DEVICE_LOST` and `NO_ADAPTER` with backend `gpu` only; `GPU_FAILED`;
   * `PAIR_BUDGET_EXCEEDED` with method `hierarchy` only.
   */
  distance(
    a: NurbsModel,
    b: NurbsModel,
    options?: DistanceOptions & { method?: "certified" },
  ): Promise<CertifiedResult>;
  distance(
    a: NurbsModel,
    b: NurbsModel,
    options: DistanceOptions & { method: "iteration" },
  ): Promise<IterationResult>;
  distance(
    a: NurbsModel,
    b: NurbsModel,
    options: DistanceOptions & { method: "hierarchy" },
  ): Promise<HierarchyResult>;
  distance(a: NurbsModel, b: NurbsModel, options?: DistanceOptions): Promise<DistanceResult>;
  async distance(
    a: NurbsModel,
    b: NurbsModel,
    options: DistanceOptions = {},
  ): Promise<DistanceResult> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, ...rest) => engine.distance(...models, ...rest));
  }

  /**
   * Compares every face of `a`, moved by `transform`, with `b`, and every face of `b`
   * with `a`, by method `certified` on the CPU: which faces changed by more than the
   * tolerance, how far and where.
   *
   * @throws {HausdorffError} `CANCELLED`, with the signal's reason as its cause;
   * `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`.
   */
  async diff(a: NurbsModel, b: NurbsModel, options: DiffOptions = {}): Promise<DiffResult> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, ...rest) => engine.diff(...models, ...rest));
  }

  /**
   * The closest points of `model` to `points` (x, y, z each, such as the vertices of
   * a mesh or a scan), moved by `transform`: distances, feet and a bound for each.
   * Points that follow each other should be near each other.
   *
   * @throws {HausdorffError} `POINT_OUT_OF_RANGE`, with the index of the point;
   * `CANCELLED`, `OPTION_OUT_OF_RANGE`, `OPTION_INVALID`, `TRANSFORM_NOT_RIGID`.
   */
  async closestPoints(
    model: NurbsModel,
    points: Numbers,
    options: ClosestPointOptions = {},
  ): Promise<ClosestPoints> {
    const surfaces = prepared(model, "model");
    const coordinates = numbers(points, "points");
    return this.#inTurn(options, (engine, ...rest) =>
      engine.closestPoints(surfaces, coordinates, ...rest),
    );
  }

  /** Runs a method of the engine when no other is running. */
  async #inTurn<Result>(
    options: DistanceOptions | DiffOptions | ClosestPointOptions,
    run: (engine: Engine, ...rest: TurnArguments) => Promise<unknown>,
  ): Promise<Result> {
    const engine = this.#open();
    const { plain, transform, signal, onProgress } = split(options);
    const result = run(engine, plain, transform, signal, onProgress, this.#turn) as Promise<Result>;
    this.#turn = Promise.allSettled([this.#turn, result]).then(() => undefined);
    try {
      return await result;
    } catch (thrown) {
      throw translated(thrown, signal?.reason);
    }
  }

  /** Releases the device; distances being computed still end well. */
  dispose(): void {
    this.#engine?.free();
    this.#engine = undefined;
  }

  [Symbol.dispose](): void {
    this.dispose();
  }

  #open(): Engine {
    if (this.#engine === undefined) {
      throw new HausdorffError("DISPOSED", "the Hausdorff object was disposed of");
    }
    return this.#engine;
  }
}

/** The last arguments of every method of the engine that takes its turn. */
type TurnArguments = [
  plain: object,
  transform: Transform | undefined,
  signal: AbortSignal | undefined,
  onProgress: OnProgress | undefined,
  turn: Promise<unknown>,
];

function prepared(model: NurbsModel, name: string): PreparedModel {
  if (!(model instanceof NurbsModel)) {
    throw new HausdorffError("ARGUMENT_INVALID", `${name} is not a NurbsModel`);
  }
  return model.prepared;
}
