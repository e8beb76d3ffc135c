// The triangles or points of one model in a tree, in which what a ray hits is found among a million in a millisecond.
import type { BufferGeometry } from "three";
import { MeshBVH } from "three-mesh-bvh";
import { nextTask } from "../../common/nextTask.ts";
import type { Hittable, Serialized } from "./geometry.ts";

/** The triangles or points from which on a tree is worth its worker: fewer are searched one by one in 6 ms. */
export const MIN_COUNT = 50_000;

/** What the time from the request of a tree to its first use is called in the browser's measures. */
export const BUILT = "tree of a model";

/** Milliseconds in which a new model is drawn first. */
const SOON = 200;

/** Numbers that are copied in one task: 4 MB, in a few milliseconds. */
const CHUNK = 2 ** 20;

/** A copy of numbers. */
async function copied<Numbers extends Float32Array | Uint32Array>(
  numbers: Numbers,
  type: new (length: number) => Numbers,
): Promise<Numbers & { buffer: ArrayBuffer }> {
  const copy = new type(numbers.length);
  for (let from = 0; from < numbers.length; from += CHUNK) {
    await nextTask();
    copy.set(numbers.subarray(from, from + CHUNK), from);
  }
  return copy as Numbers & { buffer: ArrayBuffer };
}

/** A tree that a worker builds, of many triangles or points. */
export class Tree {
  readonly #hittable: Hittable;
  readonly #geometry: BufferGeometry;
  #worker: Worker | undefined;
  #tree: MeshBVH | undefined;
  /** Whether vertices were moved since the boxes of the tree were computed. */
  #isStale = false;
  #timer = 0;

  /** `geometry` has the vertices, and all triangles; positions may be moved in place. */
  constructor(hittable: Hittable, geometry: BufferGeometry) {
    this.#hittable = hittable;
    this.#geometry = geometry;
    const { positions, indices } = hittable;
    if ((indices.length || positions.length) < 3 * MIN_COUNT) return;
    this.#timer = setTimeout(() => this.#build(), SOON) as unknown as number;
  }

  /** The tree of the vertices where they are; undefined until it is built, and of few triangles or points. */
  get built(): MeshBVH | undefined {
    if (this.#tree !== undefined && this.#isStale) {
      this.#tree.refit();
      this.#isStale = false;
    }
    return this.#tree;
  }

  /** Heeds that vertices were moved: the boxes of the tree are computed anew before its next use. */
  moved(): void {
    this.#isStale = this.#tree !== undefined || this.#worker !== undefined;
  }

  dispose(): void {
    clearTimeout(this.#timer);
    this.#worker?.terminate();
    this.#worker = undefined;
    this.#tree = undefined;
  }

  #build(): void {
    const start = performance.now();
    this.#worker = new Worker(new URL("./treeWorker.ts", import.meta.url), { type: "module" });
    this.#worker.onmessage = ({ data }: MessageEvent<Serialized>) => {
      this.#worker?.terminate();
      this.#worker = undefined;
      const serialized = { ...data, index: this.#hittable.indices };
      this.#tree = MeshBVH.deserialize(serialized, this.#geometry, { setIndex: false });
      performance.measure(BUILT, { start });
    };
    void this.#post(this.#worker);
  }

  /** Gives the worker the vertices and triangles, of which a copy is made in short tasks. */
  async #post(worker: Worker): Promise<void> {
    const indices = await copied(this.#hittable.indices, Uint32Array);
    const positions = await copied(this.#hittable.positions, Float32Array);
    const copy: Hittable = { positions, indices };
    // Else the model was replaced meanwhile.
    if (this.#worker === worker) worker.postMessage(copy, [positions.buffer, indices.buffer]);
  }
}
