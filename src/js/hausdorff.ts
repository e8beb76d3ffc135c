/// <reference lib="esnext.disposable" preserve="true" />

import { type MeshFormat, type MeshOptions, readMesh } from "./cad/mesh.js";
import type { CadOptions } from "./cad/options.js";
import { readCad } from "./cad/read.js";
import { CREATE_OPTIONS } from "./create.js";
import { HausdorffError, translated, translating } from "./error.js";
import { checkKeys } from "./keys.js";
import { load, type ModuleSource, requireLoaded, setSource } from "./load.js";
import { type CheckOptions, type CheckResult, checkRules, levels } from "./measure/bodies/check.js";
import type {
  ClearanceOptions,
  ClearanceResult,
  GapOptions,
  GapsResult,
} from "./measure/bodies/clearance.js";
import type { OverlapOptions, OverlapResult } from "./measure/bodies/overlap.js";
import type { Score, ScoreOptions } from "./measure/bodies/score.js";
import { Reached, requireWhole } from "./measure/cancelled.js";
import type { DiffOptions, DiffResult } from "./measure/diff.js";
import type { DistanceEngine } from "./measure/engine.js";
import { type Backend, type DistanceOptions, split } from "./measure/options.js";
import type { ClosestPointOptions, ClosestPoints } from "./measure/points/closest.js";
import type { DeviationField, FieldOptions } from "./measure/points/field.js";
import { type BestFit, type BestFitOptions, checkFit } from "./measure/points/fit.js";
import {
  CoarseMaps,
  checkMaps,
  type DeviationMapOptions,
  type DeviationMaps,
  type MeasureOfMaps,
} from "./measure/points/maps.js";
import type {
  LayerDistances,
  Precision,
  SignedDistanceOptions,
  SignedDistances,
} from "./measure/points/signed-distances.js";
import type { Results } from "./measure/result.js";
import type { CertifiedStatistics, StatisticsOptions } from "./measure/statistics.js";
import { facetArrays, type MeshArrays } from "./model/mesh.js";
import { NurbsModel } from "./model/model.js";
import {
  type BrepText,
  coordinatesOf,
  type InterchangeModel,
  type ModelArrays,
  type Numbers,
  prepare,
  type SurfaceArrays,
} from "./model/surface.js";
import {
  Call,
  Engine,
  layersOfGrid,
  NamedModels,
  PreparedModel,
  shapes,
} from "./wasm/nurbs_hausdorff.js";

/** Options of `Hausdorff.create`. */
export interface CreateOptions {
  /** Default `auto`. */
  backend?: Backend;
  /**
   * The wasm module, `nurbs-hausdorff/nurbs_hausdorff_bg.wasm`, where the package
   * does not find it beside its own files: compiled, its bytes or its address.
   */
  module?: ModuleSource;
  /** The same of the readers' module, `nurbs-hausdorff/nurbs_hausdorff_readers_bg.wasm`. */
  readers?: ModuleSource;
  /** The same of the module of `readMesh`, `nurbs-hausdorff/nurbs_hausdorff_meshes_bg.wasm`. */
  meshes?: ModuleSource;
  /** The same of the module that `readMesh` reads scans by, `nurbs-hausdorff/nurbs_hausdorff_scans_bg.wasm`. */
  scans?: ModuleSource;
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
 * not tied to the one that made them, and can be made after it is disposed of.
 */
export class Hausdorff implements DistanceEngine<NurbsModel> {
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
  static async create(options: CreateOptions = {}): Promise<Hausdorff> {
    checkKeys("options", options, CREATE_OPTIONS);
    const { backend, module, readers, meshes, scans } = options;
    setSource("nurbs_hausdorff_readers", readers);
    setSource("nurbs_hausdorff_meshes", meshes);
    setSource("nurbs_hausdorff_scans", scans);
    await load(module);
    try {
      return new Hausdorff(await Engine.create(backend));
    } catch (thrown) {
      throw translated(thrown);
    }
  }

  get backend(): "gpu" | "cpu" {
    return this.#open().hasGpu ? "gpu" : "cpu";
  }

  get adapter(): string | null {
    return this.#open().adapter ?? null;
  }

  get notice(): string | null {
    return this.#open().notice ?? null;
  }

  /**
   * A model of surfaces as plain arrays, whole or trimmed, whose keys are in camel case, or
   * of interchange JSON or its text, whose keys are `knots_u`, `knots_v` and `ctrl`. CAD
   * files are for `readCad`.
   *
   * @throws {HausdorffError} naming the surface, the place, what was found and
   * what was expected.
   */
  model(input: readonly SurfaceArrays[] | ModelArrays | InterchangeModel | string): NurbsModel {
    requireLoaded();
    return translating(() => NurbsModel.of(prepare(input)));
  }

  /**
   * A mesh of triangles, or a cloud of points, as either side of `distance` and as the model of
   * `closestPoints`; `fromThreeGeometry` of `nurbs-hausdorff/adapters` makes one of a geometry of
   * three. It is measured as the set of all points of its triangles, the degenerate ones included.
   *
   * @throws {HausdorffError} `POINT_OUT_OF_RANGE` for a coordinate that is not finite or above
   * 1e100 in size; `TRIANGLE_INDEX`, `MESH_GROUPS`, `NO_FACETS`, `TOO_MANY_FACETS`, `UNIT_INVALID`;
   * `ARGUMENT_INVALID`.
   */
  mesh(input: MeshArrays): NurbsModel {
    requireLoaded();
    return translating(() => {
      const arrays = facetArrays(input);
      const [positions, triangles, , counts] = arrays;
      const prepared = PreparedModel.fromFacets(...arrays);
      // The caller's arrays may change.
      return NurbsModel.of(prepared, null, {
        positions: positions.slice(),
        triangles: triangles?.slice(),
        counts: counts?.slice(),
      });
    });
  }

  /**
   * A shape by its name, one of `Hausdorff.shapes`.
   *
   * @throws {HausdorffError} `UNKNOWN_SHAPE`.
   */
  shape(name: string): NurbsModel {
    requireLoaded();
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

  async readCad(
    bytes: Uint8Array | ArrayBuffer | BrepText,
    options: CadOptions = {},
  ): Promise<NurbsModel> {
    return readCad(bytes, options);
  }

  async readMesh(
    bytes: Uint8Array | ArrayBuffer,
    format: MeshFormat,
    options: MeshOptions = {},
  ): Promise<NurbsModel> {
    return readMesh(bytes, format, options);
  }

  async distance<Method extends keyof Results = "certified">(
    a: NurbsModel,
    b: NurbsModel,
    options: DistanceOptions & { method?: Method } = {},
  ): Promise<Results[Method]> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.distance(...models, call));
  }

  async field(a: NurbsModel, b: NurbsModel, options: FieldOptions = {}): Promise<DeviationField> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.field(...models, call));
  }

  async deviationMaps(
    a: NurbsModel,
    b: NurbsModel,
    options: DeviationMapOptions = {},
  ): Promise<DeviationMaps> {
    return this.deviationMapsBy(a, b, options);
  }

  /**
   * As `deviationMaps`, with the points measured by a function.
   * @internal
   */
  async deviationMapsBy(
    a: NurbsModel,
    b: NurbsModel,
    options: DeviationMapOptions,
    measure?: MeasureOfMaps,
  ): Promise<DeviationMaps> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    checkMaps(options);
    const { onCoarse, ...rest } = options;
    const listener = new CoarseMaps(onCoarse, rest.onProgress);
    const maps = await this.#inTurn<DeviationMaps>(
      { ...rest, ...listener.progress },
      (engine, call) => engine.deviationMaps(...models, listener.onCoarse, measure, call),
    );
    listener.requireWhole();
    return maps;
  }

  async diff(a: NurbsModel, b: NurbsModel, options: DiffOptions = {}): Promise<DiffResult> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.diff(...models, call));
  }

  async statistics(
    a: NurbsModel,
    b: NurbsModel,
    options: StatisticsOptions = {},
  ): Promise<CertifiedStatistics> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.statistics(...models, call));
  }

  async score(
    candidate: NurbsModel,
    truth: NurbsModel,
    options: ScoreOptions = {},
  ): Promise<Score> {
    const models = [prepared(candidate, "candidate"), prepared(truth, "truth")] as const;
    return this.#inTurn(options, (engine, call) => engine.score(...models, call));
  }

  async clearance(
    a: NurbsModel,
    b: NurbsModel,
    options: ClearanceOptions = {},
  ): Promise<ClearanceResult> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.clearance(...models, call));
  }

  async overlap(
    a: NurbsModel,
    b: NurbsModel,
    options: OverlapOptions = {},
  ): Promise<OverlapResult> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.overlap(...models, call));
  }

  async check(
    models: NurbsModel | readonly NurbsModel[],
    options: CheckOptions = {},
  ): Promise<CheckResult> {
    const all = Array.isArray(models) ? models : [models];
    const { names, ...rest } = options;
    const above = levels(all.length, names);
    checkRules(rest.rules);
    const wanted = all.map((model, index) => prepared(model, `models[${index}]`));
    return this.#inTurn(rest, (engine, call) => {
      const named = new NamedModels();
      for (const [index, model] of wanted.entries()) named.add(model, above[index]);
      return engine.check(named, call);
    });
  }

  async gaps(a: NurbsModel, b: NurbsModel, options: GapOptions = {}): Promise<GapsResult> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    return this.#inTurn(options, (engine, call) => engine.gaps(...models, call));
  }

  async closestPoints(
    model: NurbsModel,
    points: Numbers,
    options: ClosestPointOptions = {},
  ): Promise<ClosestPoints> {
    const surfaces = prepared(model, "model");
    const coordinates = coordinatesOf(points);
    return this.#inTurn(options, (engine, call) =>
      engine.closestPoints(surfaces, coordinates, call),
    );
  }

  /**
   * The closest points of a block of points in the order in which they are measured; not in turn, as a part of
   * what has its turn.
   * @internal
   */
  async closestPointsOfBlock(
    model: NurbsModel,
    points: Float64Array,
    options: ClosestPointOptions,
  ): Promise<ClosestPoints> {
    const surfaces = prepared(model, "model");
    return this.#apart(options, (engine, call) =>
      engine.closestPointsOfBlock(surfaces, points, call),
    );
  }

  /**
   * The number of layers of bricks that a grid is measured in.
   * @internal
   */
  layersOfGrid(model: NurbsModel, options: SignedDistanceOptions): number {
    return translating(() => layersOfGrid(prepared(model, "model"), options));
  }

  /**
   * The signed distances of one of these layers, as `closestPointsOfBlock`.
   * @internal
   */
  async signedDistancesOfLayer(
    model: NurbsModel,
    layer: number,
    options: SignedDistanceOptions,
  ): Promise<LayerDistances> {
    const surfaces = prepared(model, "model");
    return this.#apart(options, (engine, call) =>
      engine.signedDistancesOfLayers(surfaces, layer, 1, call),
    );
  }

  /** Runs a method of the engine as a part of what has its turn. */
  async #apart<Result>(
    options: ClosestPointOptions | SignedDistanceOptions,
    run: (engine: Engine, call: Call) => Promise<unknown>,
  ): Promise<Result> {
    const { plain, transform, signal } = split(options);
    const call = new Call(plain, transform, signal, undefined, Promise.resolve());
    try {
      return requireWhole((await run(this.#open(), call)) as Result, signal);
    } catch (thrown) {
      throw translated(thrown, { cause: signal?.reason });
    }
  }

  /**
   * Runs work of its own when no method is running.
   * @internal
   */
  async whenFree<Result>(work: () => Result | Promise<Result>): Promise<Result> {
    const result = this.#turn.then(work);
    this.#turn = Promise.allSettled([result]).then(() => undefined);
    return result;
  }

  async signedDistances<P extends Precision = "float64">(
    model: NurbsModel,
    options: SignedDistanceOptions<P> = {},
  ): Promise<SignedDistances<P>> {
    const surfaces = prepared(model, "model");
    return this.#inTurn(options, (engine, call) => engine.signedDistances(surfaces, call));
  }

  async bestFit(a: NurbsModel, b: NurbsModel, options: BestFitOptions = {}): Promise<BestFit> {
    const models = [prepared(a, "a"), prepared(b, "b")] as const;
    checkFit(options);
    // Its progress is by steps; the module calls either kind with what it reports.
    const plain = options as Omit<BestFitOptions, "onProgress"> as FieldOptions;
    return this.#inTurn(plain, (engine, call) => engine.bestFit(...models, call));
  }

  /** Runs a method of the engine when no other is running. */
  async #inTurn<Result>(
    options:
      | DistanceOptions
      | FieldOptions
      | Omit<DeviationMapOptions, "onCoarse">
      | DiffOptions
      | ClearanceOptions
      | GapOptions
      | Omit<CheckOptions, "names">
      | ClosestPointOptions
      | SignedDistanceOptions,
    run: (engine: Engine, call: Call) => Promise<unknown>,
  ): Promise<Result> {
    const engine = this.#open();
    const { plain, transform, signal, onProgress } = split(options);
    const reached = new Reached(onProgress);
    const report = signal === undefined ? onProgress : reached.onProgress;
    const call = new Call(plain, transform, signal, report, this.#turn);
    const result = run(engine, call) as Promise<Result>;
    this.#turn = Promise.allSettled([this.#turn, result]).then(() => undefined);
    try {
      return requireWhole(await result, signal);
    } catch (thrown) {
      throw translated(thrown, { cause: signal?.reason, interval: reached.interval });
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

function prepared(model: NurbsModel, name: string): PreparedModel {
  if (!(model instanceof NurbsModel)) {
    throw new HausdorffError("ARGUMENT_INVALID", `${name} is not a NurbsModel`);
  }
  return model.prepared;
}
