import { type MeshFormat, type MeshOptions, readMesh } from "../cad/mesh.js";
import type { CadOptions, FaceDraft } from "../cad/options.js";
import type { Libraries } from "../cad/peers/peers.js";
import { readCad } from "../cad/read.js";
import { HausdorffError } from "../error.js";
import { type CreateOptions, Hausdorff } from "../hausdorff.js";
import type { ClosestPointOptions } from "../measure/points/closest.js";
import type { DeviationMapOptions, DeviationMaps, MeasureOfMaps } from "../measure/points/maps.js";
import type { SignedDistanceOptions } from "../measure/points/signed-distances.js";
import type { OnProgress } from "../measure/progress.js";
import type { MeshArrays } from "../model/mesh.js";
import { NurbsModel } from "../model/model.js";
import type { ModelSource } from "../model/source.js";
import type {
  Call,
  Connect,
  EngineFacts,
  MapReport,
  ModelFacts,
  ReadingReport,
  Reply,
  Request,
} from "./messages.js";
import { limitsOf, type PoolOptions } from "./pool/options.js";
import { Pool } from "./pool/pool.js";
import { Target } from "./pool/target.js";

type Post = (reply: Reply, transfer: ArrayBuffer[]) => void;

/** A call's signal and progress, as options. */
interface Watch {
  signal: AbortSignal;
  onProgress?: (...progress: unknown[]) => void;
}

/** A model, with the time that it took to be made. */
interface Kept {
  model: NurbsModel;
  milliseconds: number;
}

/** A call in progress. */
interface Running {
  controller: AbortController;
  started: number;
}

type Method = (args: unknown[], watch: Watch) => unknown;

/** The loaders of libraries where a call of `readCad` names none. */
let libraries: Libraries = {};

/**
 * Loads the libraries that files need by these functions: bundlers find what they import, and
 * functions cannot be sent to a worker. For a worker of one's own that imports
 * `nurbs-hausdorff/worker/thread`; what `readCad` is given comes first.
 */
export function loadLibrariesBy(loaders: Libraries): void {
  libraries = loaders;
}

/** What a worker knows of its platform. */
interface Platform {
  /** Starts a worker like this one. */
  connect: Connect;
  processors(): number;
}

/**
 * Answers calls in the worker: returns the function that takes the requests.
 * @internal
 */
export function serve(post: Post, platform: Platform): (request: Request) => void {
  const server = new Server(post, platform);
  return (request) => server.take(request);
}

class Server {
  readonly #post: Post;
  readonly #platform: Platform;
  #hausdorff: Hausdorff | undefined;
  /** The workers beside this one, if there may be some. */
  #pool: Pool | undefined;
  readonly #models = new Map<number, Kept>();
  readonly #running = new Map<number, Running>();

  constructor(post: Post, platform: Platform) {
    this.#post = post;
    this.#platform = platform;
  }

  take(request: Request): void {
    if ("cancel" in request) this.#running.get(request.cancel)?.controller.abort();
    else if ("drop" in request) this.#drop(request.drop);
    else void this.#answer(request);
  }

  async #answer({ id, method, args, progress }: Call): Promise<void> {
    const controller = new AbortController();
    this.#running.set(id, { controller, started: performance.now() });
    const watch: Watch = { signal: controller.signal };
    if (progress) {
      watch.onProgress = (...progress) => this.#post({ id, progress }, buffers(progress));
    }
    try {
      const result = await this.#methods[method]?.([id, ...args], watch);
      // Nobody waits for a model whose reading was cancelled.
      if (controller.signal.aborted) this.#drop(id);
      this.#post({ id, result, engine: this.#facts() }, buffers(result));
    } catch (error) {
      const { code, interval } = error instanceof HausdorffError ? error : {};
      const message = error instanceof Error ? error.message : `${error}`;
      this.#post({ id, failure: { code, message, interval } }, []);
    } finally {
      this.#running.delete(id);
    }
  }

  /** Every method takes the call's number, under which a new model is kept, and its own arguments. */
  readonly #methods: Record<string, Method> = {
    create: async ([, options, pool]) => {
      this.#hausdorff = await Hausdorff.create(options as CreateOptions);
      const limits = limitsOf((pool ?? {}) as PoolOptions, this.#platform.processors());
      if (limits.workers > 1)
        this.#pool = new Pool(this.#hausdorff, this.#platform.connect, limits);
    },
    shapes: () => Hausdorff.shapes(),
    model: ([id, input]) => this.#keep(id, this.#open.model(input as string)),
    mesh: ([id, input]) => this.#keep(id, this.#open.mesh(input as MeshArrays)),
    shape: ([id, name]) => this.#keep(id, this.#open.shape(name as string)),
    readCad: async ([id, bytes, options, reports], { signal, onProgress }) => {
      const { onLibrary, onFace } = (reports ?? {}) as { onLibrary?: boolean; onFace?: boolean };
      const report = (what: ReadingReport) => onProgress?.(what);
      const given = {
        ...libraries,
        ...(options as CadOptions),
        signal,
        ...(onLibrary && {
          onLibrary: (library: NonNullable<ReadingReport["library"]>) => report({ library }),
        }),
        ...(onFace && { onFace: (face: FaceDraft) => report({ face }) }),
      };
      return this.#keep(id, await readCad(bytes as ArrayBuffer, given));
    },
    readMesh: async ([id, bytes, format, options], { signal }) => {
      const given = { ...(options as MeshOptions), signal };
      return this.#keep(id, await readMesh(bytes as ArrayBuffer, format as MeshFormat, given));
    },
    source: ([id, source]) => this.#keep(id, NurbsModel.fromSource(source as ModelSource)),
    area: ([, model]) => this.#model(model).area(),
    solid: ([, model]) => this.#model(model).solid(),
    facts: ([, model]) => this.#model(model).facts(),
    bodies: ([, model]) => this.#model(model).bodies(),
    faceForms: ([, model]) => this.#model(model).faceForms(),
    tessellate: ([, model, options]) => this.#model(model).tessellate(options as object),
    update: ([, id, face, points, options]) => {
      const model = this.#model(id);
      model.update(face as number, points as Float64Array, options as object);
      this.#forget(id as number);
      return facts(model);
    },
    distance: ([, a, b, options], watch) =>
      this.#open.distance(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    field: ([, a, b, options], watch) =>
      this.#open.field(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    deviationMaps: ([, a, b, options, reports], { signal, onProgress }) => {
      const told = (reports ?? {}) as { onCoarse?: boolean; onProgress?: boolean };
      const report = (what: MapReport) => onProgress?.(what);
      return this.#maps([a as number, b as number], {
        ...(options as object),
        signal,
        ...(told.onCoarse && { onCoarse: (coarse: DeviationMaps) => report({ coarse }) }),
        ...(told.onProgress && {
          onProgress: (...progress: Parameters<OnProgress>) => report({ progress }),
        }),
      });
    },
    diff: ([, a, b, options], watch) =>
      this.#open.diff(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    statistics: ([, a, b, options], watch) =>
      this.#open.statistics(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    overlap: ([, a, b, options], watch) =>
      this.#open.overlap(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    score: ([, a, b, options], watch) =>
      this.#open.score(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    clearance: ([, a, b, options], watch) =>
      this.#open.clearance(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    check: ([, ids, options], watch) => {
      const models = (ids as number[]).map((id) => this.#model(id));
      return this.#open.check(models, { ...(options as object), ...watch });
    },
    gaps: ([, a, b, options], watch) =>
      this.#open.gaps(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    bestFit: ([, a, b, options], watch) =>
      this.#open.bestFit(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    closestPoints: ([, id, points, options], watch) => {
      const [given, asked] = [points as Float64Array, options as ClosestPointOptions];
      const alone = (model: NurbsModel) =>
        this.#open.closestPoints(model, given, { ...asked, ...watch });
      // The GPU is this worker's.
      if ((asked.backend ?? "cpu") !== "cpu") return alone(this.#model(id));
      return this.#shared(id, alone, (pool, target) =>
        pool.closestPoints(target, given, asked, watch),
      );
    },
    closestPointsOfBlock: ([, id, points, options], { signal }) => {
      const [model, given, asked] = [this.#model(id), points as Float64Array, options as object];
      return this.#open.whenFree(() =>
        this.#open.closestPointsOfBlock(model, given, { ...asked, signal }),
      );
    },
    signedDistances: ([, id, options], watch) => {
      const asked = options as SignedDistanceOptions;
      return this.#shared(
        id,
        (model) => this.#open.signedDistances(model, { ...asked, ...watch }),
        (pool, target) => pool.signedDistances(target, asked, watch),
      );
    },
    signedDistancesOfLayer: ([, id, layer, options], { signal }) => {
      const [model, asked] = [this.#model(id), options as SignedDistanceOptions];
      return this.#open.whenFree(() =>
        this.#open.signedDistancesOfLayer(model, layer as number, { ...asked, signal }),
      );
    },
  };

  get #open(): Hausdorff {
    if (this.#hausdorff === undefined) {
      throw new HausdorffError("MODULE_NOT_LOADED", "the worker has no module yet");
    }
    return this.#hausdorff;
  }

  #model(id: unknown): NurbsModel {
    const model = this.#models.get(id as number)?.model;
    if (model === undefined) throw new HausdorffError("DISPOSED", "the model was disposed of");
    return model;
  }

  #target(id: number): Target {
    return new Target(id, this.#model(id), this.#models.get(id)?.milliseconds ?? 0);
  }

  #keep(id: unknown, model: NurbsModel): ModelFacts {
    const { started = performance.now() } = this.#running.get(id as number) ?? {};
    this.#models.set(id as number, { model, milliseconds: performance.now() - started });
    return facts(model);
  }

  #drop(id: number): void {
    this.#models.get(id)?.model.dispose();
    this.#models.delete(id);
    this.#forget(id);
  }

  /** Lets the other workers drop their copies of a model, once the calls that were begun have ended. */
  #forget(id: number): void {
    const pool = this.#pool;
    if (pool !== undefined) void this.#open.whenFree(() => pool.drop(id));
  }

  /** Measures from a model: alone, or if there may be other workers with them. */
  async #shared<Result>(
    id: unknown,
    alone: (model: NurbsModel) => Promise<Result>,
    together: (pool: Pool, target: Target) => Promise<Result>,
  ): Promise<Result> {
    const [model, pool] = [this.#model(id), this.#pool];
    if (pool === undefined) return alone(model);
    const target = this.#target(id as number);
    try {
      return await this.#open.whenFree(() => together(pool, target));
    } finally {
      target.dispose();
    }
  }

  /** The maps of two models, whose points all workers measure. */
  async #maps(
    [a, b]: readonly [number, number],
    options: DeviationMapOptions & { signal: AbortSignal },
  ): Promise<DeviationMaps> {
    const models = [this.#model(a), this.#model(b)] as const;
    const pool = this.#pool;
    if (pool === undefined) return this.#open.deviationMaps(...models, options);
    const targets = [this.#target(a), this.#target(b)] as const;
    const { signal } = options;
    const measure: MeasureOfMaps = (isFromA, points, asked) =>
      reported((onProgress) =>
        pool.closestPoints(targets[isFromA ? 0 : 1], points, asked, { signal, onProgress }),
      );
    try {
      return await this.#open.deviationMapsBy(...models, options, measure);
    } finally {
      for (const target of targets) target.dispose();
    }
  }

  #facts(): EngineFacts | undefined {
    if (this.#hausdorff === undefined) return undefined;
    const { backend, adapter, notice } = this.#hausdorff;
    return { backend, adapter, notice, workers: this.#pool?.workers ?? 1 };
  }
}

function facts(model: NurbsModel): ModelFacts {
  const { name, unit, report, gap, gapProven, faceCount, boundingBox } = model;
  const faces = Array.from({ length: faceCount }, (_, face) => face);
  const faceNames = faces.map((face) => model.faceName(face));
  const faceColors = faces.map((face) => model.faceColor(face));
  return { name, unit, report, gap, gapProven, faceCount, faceNames, faceColors, boundingBox };
}

/** Yields the fractions that some work reports, and returns what it found. */
async function* reported<Found>(
  start: (onProgress: (fraction: number) => void) => Promise<Found>,
): AsyncGenerator<number, Found> {
  let report = (_: number) => {};
  const next = () =>
    new Promise<number>((resolve) => {
      report = resolve;
    });
  let coming = next();
  const work = start((fraction) => report(fraction)).then((found) => ({ found }));
  for (;;) {
    const latest = await Promise.race([work, coming]);
    if (typeof latest === "object") return latest.found;
    coming = next();
    yield latest;
  }
}

/** The buffers of all arrays in a result, which are transferred, not copied. */
function buffers(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (typeof value !== "object" || value === null) return [];
  return Object.values(value).flatMap(buffers);
}
