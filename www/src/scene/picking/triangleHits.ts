// What a ray hits of all triangles of a mesh, those that are not drawn too.
import {
  BufferAttribute,
  type BufferGeometry,
  type Intersection,
  Mesh,
  type Raycaster,
} from "three";
import { forgetBounds, ofSameVertices } from "../bounds.ts";
import type { Hittable } from "./geometry.ts";
import { Tree } from "./tree.ts";

/** Finds what a ray hits, in the order of the triangles: by a tree once it is built, and until then one by one. */
export class TriangleHits {
  readonly #mesh: Mesh;
  readonly #geometry: BufferGeometry;
  readonly #tree: Tree;

  /** Takes over the mesh's `raycast`; its positions are those of `triangles`, and may be moved in place. */
  constructor(mesh: Mesh, triangles: Hittable) {
    this.#mesh = mesh;
    // Normals of hits are those of the vertices.
    this.#geometry = ofSameVertices(mesh.geometry, "position", "normal");
    this.#geometry.setIndex(new BufferAttribute(triangles.indices, 1));
    this.#tree = new Tree(triangles, this.#geometry);
    mesh.raycast = (ray, hits) => this.#raycast(ray, hits);
  }

  /** Heeds that vertices were moved. */
  moved(): void {
    this.#tree.moved();
    forgetBounds(this.#geometry);
  }

  dispose(): void {
    this.#tree.dispose();
  }

  #raycast(ray: Raycaster, hits: Intersection[]): void {
    const { matrixWorld, material } = this.#mesh;
    const whole = new Mesh(this.#geometry, material);
    whole.matrixWorld.copy(matrixWorld);
    const found: Intersection[] = [];
    const tree = this.#tree.built;
    if (tree === undefined) whole.raycast(ray, found);
    else tree.raycastObject3D(whole, ray, found);
    for (const hit of found) hits.push({ ...hit, object: this.#mesh });
  }
}
