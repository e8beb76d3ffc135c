import { type MeshFormat, type MeshOptions, readMesh } from "../cad/mesh.js";
import type { CadOptions, FaceDraft } from "../cad/options.js";
import type { Libraries } from "../cad/peers/peers.js";
import { readCad } from "../cad/read.js";
import { HausdorffError } from "../error.js";
import { type CreateOptions, Hausdorff } from "../hausdorff.js";
import type { DeviationMaps } from "../measure/points/maps.js";
import type { OnProgress } from "../measure/progress.js";
import type { MeshArrays } from "../model/mesh.js";
import type { NurbsModel } from "../model/model.js";
import type {
  Call,
  EngineFacts,
  MapReport,
  ModelFacts,
  ReadingReport,
  Reply,
  Request,
} from "./messages.js";

type Post = (reply: Reply, transfer: ArrayBuffer[]) => void;

/** A call's signal and progress, as options. */
interface Watch {
  signal: AbortSignal;
  onProgress?: (...progress: unknown[]) => void;
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

/**
 * Answers calls in the worker: returns the function that takes the requests.
 * @internal
 */
export function serve(post: Post): (request: Request) => void {
  const server = new Server(post);
  return (request) => server.take(request);
}

class Server {
  readonly #post: Post;
  #hausdorff: Hausdorff | undefined;
  readonly #models = new Map<number, NurbsModel>();
  readonly #running = new Map<number, AbortController>();

  constructor(post: Post) {
    this.#post = post;
  }

  take(request: Request): void {
    if ("cancel" in request) this.#running.get(request.cancel)?.abort();
    else if ("drop" in request) this.#drop(request.drop);
    else void this.#answer(request);
  }

  async #answer({ id, method, args, progress }: Call): Promise<void> {
    const controller = new AbortController();
    this.#running.set(id, controller);
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
    create: async ([, options]) => {
      this.#hausdorff = await Hausdorff.create(options as CreateOptions);
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
    area: ([, model]) => this.#model(model).area(),
    solid: ([, model]) => this.#model(model).solid(),
    facts: ([, model]) => this.#model(model).facts(),
    bodies: ([, model]) => this.#model(model).bodies(),
    faceForms: ([, model]) => this.#model(model).faceForms(),
    tessellate: ([, model, options]) => this.#model(model).tessellate(options as object),
    update: ([, id, face, points, options]) => {
      const model = this.#model(id);
      model.update(face as number, points as Float64Array, options as object);
      return facts(model);
    },
    distance: ([, a, b, options], watch) =>
      this.#open.distance(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    field: ([, a, b, options], watch) =>
      this.#open.field(this.#model(a), this.#model(b), { ...(options as object), ...watch }),
    deviationMaps: ([, a, b, options, reports], { signal, onProgress }) => {
      const told = (reports ?? {}) as { onCoarse?: boolean; onProgress?: boolean };
      const report = (what: MapReport) => onProgress?.(what);
      return this.#open.deviationMaps(this.#model(a), this.#model(b), {
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
    closestPoints: ([, model, points, options], watch) =>
      this.#open.closestPoints(this.#model(model), points as Float64Array, {
        ...(options as object),
        ...watch,
      }),
    signedDistances: ([, model, options], watch) =>
      this.#open.signedDistances(this.#model(model), { ...(options as object), ...watch }),
  };

  get #open(): Hausdorff {
    if (this.#hausdorff === undefined) {
      throw new HausdorffError("MODULE_NOT_LOADED", "the worker has no module yet");
    }
    return this.#hausdorff;
  }

  #model(id: unknown): NurbsModel {
    const model = this.#models.get(id as number);
    if (model === undefined) throw new HausdorffError("DISPOSED", "the model was disposed of");
    return model;
  }

  #keep(id: unknown, model: NurbsModel): ModelFacts {
    this.#models.set(id as number, model);
    return facts(model);
  }

  #drop(id: number): void {
    this.#models.get(id)?.dispose();
    this.#models.delete(id);
  }

  #facts(): EngineFacts | undefined {
    if (this.#hausdorff === undefined) return undefined;
    const { backend, adapter, notice } = this.#hausdorff;
    return { backend, adapter, notice };
  }
}

function facts(model: NurbsModel): ModelFacts {
  const { name, unit, report, gap, gapProven, faceCount, boundingBox } = model;
  const faces = Array.from({ length: faceCount }, (_, face) => face);
  const faceNames = faces.map((face) => model.faceName(face));
  const faceColors = faces.map((face) => model.faceColor(face));
  return { name, unit, report, gap, gapProven, faceCount, faceNames, faceColors, boundingBox };
}

/** The buffers of all arrays in a result, which are transferred, not copied. */
function buffers(value: unknown): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) return [value.buffer as ArrayBuffer];
  if (typeof value !== "object" || value === null) return [];
  return Object.values(value).flatMap(buffers);
}
