// The triangles of one model in a tree, in which what a ray hits is found among a million in a millisecond.
import { type BufferGeometry, type Intersection, Mesh, type Raycaster } from "three";
import { MeshBVH } from "three-mesh-bvh";
import { nextTask } from "../../common/nextTask.ts";
import { geometryOf, type Serialized, type Triangles } from "./geometry.ts";

/** The triangles from which on a tree is worth its worker: fewer are searched one by one in 6 ms. */
export const MIN_TRIANGLES = 50_000;

/** What the time from the request of a tree to its first use is called in the browser's measures. */
export const BUILT = "tree of triangles";

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

/**
 * Finds what a ray hits of all triangles of a mesh, in their order, those that are not drawn too: by its tree
 * once a worker has built that, and until then one by one.
 */
export class TriangleTree {
  readonly #mesh: Mesh;
  readonly #triangles: Triangles;
  readonly #geometry: BufferGeometry;
  #worker: Worker | undefined;
  #tree: MeshBVH | undefined;
  /** Whether vertices were moved since the boxes of the tree were computed. */
  #isStale = false;
  #timer = 0;

  /** Takes over the mesh's `raycast`; its positions are those of `triangles`, and may be moved in place. */
  constructor(mesh: Mesh, triangles: Triangles) {
    this.#mesh = mesh;
    this.#triangles = triangles;
    this.#geometry = geometryOf(triangles);
    // Normals of hits are those of the vertices.
    const { normal } = mesh.geometry.attributes;
    if (normal !== undefined) this.#geometry.setAttribute("normal", normal);
    mesh.raycast = (ray, hits) => this.#raycast(ray, hits);
    if (triangles.indices.length < 3 * MIN_TRIANGLES) return;
    this.#timer = setTimeout(() => this.#build(), SOON) as unknown as number;
  }

  /** Heeds that vertices were moved: the boxes of the tree are computed anew before its next use. */
  moved(): void {
    this.#isStale = true;
    this.#geometry.boundingSphere = null;
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
      const serialized = { ...data, index: this.#triangles.indices };
      this.#tree = MeshBVH.deserialize(serialized, this.#geometry, { setIndex: false });
      performance.measure(BUILT, { start });
    };
    void this.#post(this.#worker);
  }

  /** Gives the worker the triangles, of which a copy is made in short tasks. */
  async #post(worker: Worker): Promise<void> {
    // What is moved from now on may be copied in part only.
    this.#isStale = false;
    const indices = await copied(this.#triangles.indices, Uint32Array);
    const positions = await copied(this.#triangles.positions, Float32Array);
    const copy: Triangles = { positions, indices };
    // Else the model was replaced meanwhile.
    if (this.#worker === worker) worker.postMessage(copy, [positions.buffer, indices.buffer]);
  }

  #raycast(ray: Raycaster, hits: Intersection[]): void {
    const { matrixWorld, material } = this.#mesh;
    const whole = new Mesh(this.#geometry, material);
    whole.matrixWorld.copy(matrixWorld);
    const found: Intersection[] = [];
    if (this.#tree === undefined) whole.raycast(ray, found);
    else {
      if (this.#isStale) this.#tree.refit();
      this.#isStale = false;
      this.#tree.raycastObject3D(whole, ray, found);
    }
    for (const hit of found) hits.push({ ...hit, object: this.#mesh });
  }
}
